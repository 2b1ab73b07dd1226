#pragma once

#include "himm_demo/page_names.hpp"
#include "himm_demo/simulate_report.hpp"
#include "support/report.hpp"

namespace sigmax::apps {

/// How many of the first runs a page shows one by one: up to 8, fewer if many filters would make it great.
int runs_in_page(const Experiment& experiment);

/// The experiment as a page: curves over the samples of all runs (Figs. 2–11), and of the kept ones each.
Report page_of(const SimulateReport& report);

/// Of these those that end the output on a terminal: the RMSE in x, and the weights.
std::vector<LineChart> charts_of(const SimulateReport& report);

/// So many filters that not all can be told apart at once.
inline bool crowded(const Experiment& experiment) { return experiment.filters.size() > 6; }

/// The track of a run, counted from one; with an error ellipse of each filter at a few samples.
Plan plan_of(const Experiment& experiment, const TracedRun& run, std::size_t number);

}  // namespace sigmax::apps
