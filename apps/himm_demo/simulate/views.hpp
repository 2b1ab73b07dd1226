#pragma once

#include <vector>

#include "himm_demo/simulate/performance.hpp"
#include "result/report.hpp"

namespace sigmax::apps {

/// So many filters that not all can be told apart at once.
inline bool crowded(const Experiment& experiment) { return experiment.filters.size() > 6; }

/// The experiment as the views of a page: curves over the samples of all runs (Figs. 2–11), of the measurement and all
/// filters, and of the first runs each, up to 8, fewer if many filters would make the page great.
std::vector<View> views_of(const Experiment& experiment, const std::vector<Performance>& found);

/// Of the first view what ends the output on a terminal: the RMSE in x, and the weights.
std::vector<LineChart> charts_of(const View& view);

}  // namespace sigmax::apps
