#pragma once

#include "records/labelled_table.hpp"

namespace sigmax::apps {

/// What is probably wrong with a table, a sentence for each cause with a remedy; each holds by the table alone, so that
/// nothing is trained for it. Docs: recognition_demo.md.
std::vector<std::string> findings_of(const LabelledTable& table);

/// Prints what was left out of a table, and what is probably wrong with it, to standard error.
void print_findings(const LabelledTable& table);

}  // namespace sigmax::apps
