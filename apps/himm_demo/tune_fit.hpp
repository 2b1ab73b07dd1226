#pragma once

#include <functional>
#include <string>
#include <vector>

#include "himm_demo/tune_losses.hpp"

namespace sigmax::apps {

/// One way to set a filter, judged.
struct Candidate {
  std::string name;
  FilterSettings settings{};  ///< fitted to all rows
  std::size_t numbers = 0;    ///< so many were fitted
  double fitted = 0.0;        ///< the objective over all rows, which those settings have seen
  double held_out = 0.0;      ///< the same over all rows, each with settings that have not seen its fold
  double gain = 0.0;          ///< of the held-out loss of a row on that of the settings before
  double gain_error = 0.0;    ///< its standard error
  Losses losses{};            ///< held out
};

/// What tuning found for one filter.
struct TunedFilter {
  std::vector<Candidate> candidates;  ///< the settings before come first, with nothing fitted
  std::size_t best = 0;               ///< the least held-out loss
  std::size_t simple = 0;             ///< with the fewest numbers of those within one standard error of the best
};

/// A mean with its standard error, over blocks of rows in a row: neighbours are not independent.
struct BlockMean {
  double mean = 0.0;
  double error = 0.0;
};
BlockMean block_mean_difference(const Losses& a, const Losses& b);

/// The sets of models that are to be tried for a filter.
std::vector<std::string> model_sets(const FilterSettings& settings, const TuneOptions& options);

/// So much work is a filter's tuning, in calls of `advance`.
std::size_t work_of(const FilterSettings& settings, const TuneData& data, const TuneOptions& options);

/// Fits every candidate to all rows and, for its held-out loss, to all but each fold. The result is that of the seed,
/// on any number of threads.
TunedFilter tune(const FilterSettings& settings, const TuneData& data, const TuneOptions& options,
                 const std::function<void(std::size_t work)>& advance);

}  // namespace sigmax::apps
