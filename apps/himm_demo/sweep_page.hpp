#pragma once

#include "himm_demo/sweep.hpp"
#include "himm_demo/sweep_findings.hpp"
#include "support/report.hpp"
#include "support/result_table.hpp"

namespace sigmax::apps {

/// Everything about every filter in every condition.
ResultTable tuned_table(const Findings& findings);

/// The same in one condition.
ResultTable tuned_table(const Findings& findings, std::size_t condition);

/// The map as a page: by how much each filter is above the tuned IMM. Where conditions cross, there is a map of all of
/// them for each filter; else one of conditions and filters.
Report page_of(const SweepOptions& options, const Findings& findings);

}  // namespace sigmax::apps
