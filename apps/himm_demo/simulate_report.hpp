#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "himm_demo/experiment.hpp"
#include "himm_demo/simulate.hpp"
#include "support/result_files.hpp"

namespace sigmax::apps {

/// By how much the RMSE of one filter is above that of another.
struct Comparison {
  std::size_t filter;
  std::size_t reference;
  std::array<std::array<Interval, 3>, 3> difference;  ///< by phase and axis
};

/// All that an experiment found.
struct SimulateReport {
  const SimulateOptions& options;
  const Experiment& experiment;
  const Outcome& outcome;
  std::vector<Comparison> comparisons;
  std::vector<double> ns_per_step;  ///< of each filter; empty unless all filters were asked for

  const FilterSettings& filter(std::size_t f) const { return experiment.filters[f]; }
};

/// Every fuzzy filter against every random one like it; without such a pair, every filter against the first.
std::vector<Comparison> compare(const Experiment& experiment, const Outcome& outcome);

/// Prints the tables.
void print(const SimulateReport& report);

/// Writes filters.csv, rmse.csv, weights.csv, summary.json and the page of charts, as far as they are wanted.
void write_files(const SimulateReport& report, ResultFiles& files);

}  // namespace sigmax::apps
