#pragma once

#include <functional>
#include <string>
#include <vector>

#include <sigmax/hybrid/fit.hpp>

#include "himm_demo/tune_data.hpp"

namespace sigmax::apps {

/// A number of a filter's settings that is fitted, and where it stands.
struct FreeNumber {
  FitParameter parameter;
  std::function<void(FilterSettings&, double)> set;
  bool sensor = false;    ///< whether it is a sensor's
  bool relative = false;  ///< whether `set` changes what is there by it
};

/// All that a search may change: the parameters of the models, the sensors' standard deviations, and one factor on
/// leaving any mode. By the RMSE, which a common factor of all noises leaves as it is, the sensors stay as they are.
std::vector<FreeNumber> free_numbers(const FilterSettings& settings, const TuneData& data, const TuneOptions& options);

/// The settings with these numbers.
FilterSettings with(FilterSettings settings, const std::vector<FreeNumber>& numbers, const std::vector<double>& values);

/// So many numbers are fitted, those of the transition included.
std::size_t count_of(const std::vector<FreeNumber>& numbers, const FilterSettings& settings,
                     const TuneOptions& options);

/// Whether there is a transition to fit.
bool has_transition(const FilterSettings& settings, const TuneOptions& options);

/// Every fitted number to four digits, as people write them; transitions stay normalised.
void round_off(FilterSettings& settings);

/// Other motions in place of the filter's: models that it had keep their parameters.
/// Throws UsageError for a name that is no motion.
FilterSettings with_models(const FilterSettings& settings, const std::string& joined);

}  // namespace sigmax::apps
