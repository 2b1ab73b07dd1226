#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "himm_demo/filter_settings.hpp"
#include "himm_demo/reading.hpp"
#include "himm_demo/recording.hpp"

namespace sigmax::apps {

/// What a row measured, with the covariances that a filter believes; nothing if it takes none of it for measured. A
/// place must have become a position before.
template <int Axes>
std::optional<Reading<Axes>> reading_of(const Fix& fix, const FilterSettings& settings, const Vector<3>& radar_at) {
  const Accuracy& accuracy = settings.accuracy_of(fix.sensor);
  if constexpr (Axes > 1) {
    const Polar sigma = accuracy.radar_of(fix.sigma);
    if (fix.bearing)
      return Reading<Axes>{.bearing = {{*fix.bearing, sigma.azimuth * sigma.azimuth}},
                           .bearing_from = radar_at.head<2>()};
    if (fix.seen) {
      const bool doppler = fix.range_rate && accuracy.range_rate_mps;
      auto reading =
          radar_reading<Axes>(*fix.seen, sigma, radar_at, doppler ? RadarForm::polar : settings.radar_measurement);
      if (doppler) reading.range_rate = {*fix.range_rate, std::pow(*accuracy.range_rate_mps, 2)};
      return reading;
    }
  }
  const bool moving = fix.moving() && accuracy.velocity_mps;
  if (!fix.position && !moving) return std::nullopt;
  Reading<Axes> reading;
  for (std::size_t axis = 0; axis < reading.missing.size(); ++axis)
    reading.missing[axis] = !fix.position || fix.missing[axis];
  if (fix.position) reading.position.mean = fix.position->head<Axes>();
  for (int i = 0; i < Axes; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    reading.position.covariance(i, i) = std::pow(accuracy.position_of(fix.sigma, axis), 2);
    if (moving && fix.velocity[axis])
      reading.velocity[axis] = {*fix.velocity[axis], std::pow(*accuracy.velocity_mps, 2)};
  }
  return reading;
}

/// How many quantities of a row a filter with this accuracy takes for measured.
inline int measured_quantities(const Fix& fix, const Accuracy& accuracy, int axes) {
  if (fix.bearing) return 1;
  if (fix.seen) return fix.range_rate && accuracy.range_rate_mps ? axes + 1 : axes;
  const auto along = std::count_if(fix.velocity.begin(), fix.velocity.begin() + axes,
                                   [](const auto& component) { return component.has_value(); });
  return fix.measured_axes(axes) + (accuracy.velocity_mps ? static_cast<int>(along) : 0);
}

}  // namespace sigmax::apps
