#pragma once

#include "records/labelled_table.hpp"

namespace sigmax::apps {

/// Prints what was left out of a table, and what is probably wrong with it, to standard error: a sentence for each
/// cause with a remedy. Each holds by the table alone, so that nothing is trained for it. Docs: recognition_demo.md.
void print_findings(const LabelledTable& table);

}  // namespace sigmax::apps
