#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "himm_demo/tune/data.hpp"

namespace sigmax::apps {

/// One way to set a filter, judged.
struct Candidate {
  std::string name;
  FilterSettings settings{};  ///< fitted to all rows
  double fitted = 0.0;        ///< the objective over all rows, which those settings have seen
  double held_out = 0.0;      ///< the same over all rows, each with settings that have not seen its fold
  MeanDifference gain{};      ///< of the held-out loss of a row on that of the settings before
};

/// What tuning found for one filter.
struct TunedFilter {
  std::vector<Candidate> candidates;  ///< the settings before come first, with nothing fitted
  std::vector<std::size_t> numbers;   ///< so many were fitted of each
  std::vector<RowLosses> held_out;    ///< of each
  Selected selected;

  const Candidate& before() const { return candidates.front(); }
  const Candidate& best() const { return candidates[selected.best]; }
  const Candidate& simple() const { return candidates[selected.simple]; }
};

/// Whether this build has an optimiser.
bool can_search();

/// The filter with each set of models that is to be tried. Throws UsageError for a name that is no motion.
struct ModelSet {
  std::string name;
  FilterSettings settings;
};
std::vector<ModelSet> model_sets(const FilterSettings& settings, const TuneOptions& options);

/// So much work is a filter's tuning, in calls of `advance`.
std::size_t work_of(const FilterSettings& settings, const TuneData& data, const TuneOptions& options);

/// Fits every candidate to all rows and, for its held-out loss, to all but each fold. The result is that of the seed,
/// on any number of threads.
TunedFilter tune(const FilterSettings& settings, const TuneData& data, const TuneOptions& options,
                 const std::function<void(std::size_t work)>& advance);

}  // namespace sigmax::apps
