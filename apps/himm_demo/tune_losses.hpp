#pragma once

#include <functional>
#include <vector>

#include "himm_demo/tune_data.hpp"

namespace sigmax::apps {

/// What a filter loses at each row, see Objective: NaN for rows that are not judged. Of the RMSE the squared distance.
using Losses = std::vector<std::vector<double>>;

/// Which rows count.
using Counts = std::function<bool(std::size_t track, std::size_t row)>;

/// Follows every track once. `look(track, row, now)`, if given, sees what the filter knows after each row.
///
/// With a gate a measurement may be a false one: the loss is that of g p(z) + (1 − g) / V, with g the probability of
/// the gate and V the volume of all measurements, so that nothing is gained by turning measurements away. The filter
/// never starts again after rejections, so that all settings are judged on the same rows. Throws std::domain_error
/// where the filter fails.
using Look = std::function<void(std::size_t track, std::size_t row, const TargetPoint& now)>;
Losses losses(const TuneData& data, const FilterSettings& settings, Objective objective, const Look& look = {});

/// The settings by which predictions are compared. What a radar measured is predicted in its own space whatever the
/// settings: the covariance of a conversion depends on what was measured, and so is not that of a density. A target at
/// the radar itself, seen in directions without error, would explain everything.
FilterSettings judged_settings(FilterSettings settings, Objective objective);

/// The choice as `losses` runs it.
TargetChoice judged_choice(const TuneData& data, const FilterSettings& settings);

/// The mean of the rows that count: nats a row, or of the RMSE its logarithm.
double objective_of(const Losses& losses, Objective objective, const Counts& counts);

/// The same as people read it: nats a row, or the RMSE in m.
double figure_of(double value, Objective objective);

}  // namespace sigmax::apps
