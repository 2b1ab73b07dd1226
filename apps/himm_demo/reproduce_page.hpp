#pragma once

#include "himm_demo/reproduce.hpp"
#include "himm_demo/reproduce_tables.hpp"
#include "support/report.hpp"

namespace sigmax::apps {

/// Section VI as a page: every sentence with its verdicts, and for each preset, scenario and group the figures that
/// decide them and the RMSE of the filters.
Report page_of(const ReproduceOptions& options, const std::vector<Condition>& conditions, const Judgements& all);

/// "As printed: 3 of 20 hold, …".
std::string counts_of_verdicts(const Judgements& all, Preset preset);

/// "As printed".
const char* words_of(Preset preset);

}  // namespace sigmax::apps
