#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include <sigmax/estimation/gaussian.hpp>
#include <sigmax/estimation/radar.hpp>
#include <sigmax/estimation/sensors.hpp>

namespace sigmax::apps {

/// How a filter takes a radar's measurements: converted to positions, or in the radar's own space; there only the start
/// is from positions, by the unbiased conversion.
enum class RadarForm { standard, unbiased, debiased, polar };

/// What a row measured, as a filter takes it.
template <int Axes>
struct Reading {
  static constexpr int radar_axes = std::max(Axes, 2);  // no radar sees along one

  /// Range, azimuth and with three axes elevation, and the radar that measured them.
  struct Seen {
    PolarSensor<radar_axes> radar;
    Gaussian<radar_axes> z;
  };

  /// A number and its variance.
  struct Scalar {
    double value;
    double variance;
  };

  Gaussian<Axes> position{Vector<Axes>::Zero(), SquareMatrix<Axes>::Zero()};  ///< of a radar: converted
  std::array<bool, static_cast<std::size_t>(Axes)> missing{};  ///< axes of the position that were not measured
  std::optional<Seen> seen{};  ///< by a radar, if the filter takes that in the radar's own space
  std::array<std::optional<Scalar>, static_cast<std::size_t>(Axes)> velocity{};  ///< along each axis, in m/s
  std::optional<Scalar> range_rate{};                                            ///< of the radar that has `seen`
  std::optional<Scalar> bearing{};  ///< all that was measured, counter-clockwise from x in rad
  Vector<2> bearing_from = Vector<2>::Zero();
};

/// What a radar at `radar_at` with these standard deviations measured. With two axes there is no elevation.
template <int Axes>
Reading<Axes> radar_reading(const Polar& measured, Polar sigma, const Vector<3>& radar_at, RadarForm form) {
  if constexpr (Axes == 2) sigma.elevation = 0.0;
  Conversion conversion = Conversion::standard;
  if (form == RadarForm::unbiased || form == RadarForm::polar) conversion = Conversion::unbiased;
  if (form == RadarForm::debiased) conversion = Conversion::debiased;
  const Gaussian<3> position = to_cartesian(measured, sigma, conversion);
  const Vector<3> mean = position.mean + radar_at;
  Reading<Axes> reading{{mean.head<Axes>(), position.covariance.topLeftCorner<Axes, Axes>()}};
  if (form == RadarForm::polar)
    reading.seen = {PolarSensor<Axes>(Vector<Axes>(radar_at.head<Axes>())),
                    PolarSensor<Axes>::measurement(measured, sigma)};
  return reading;
}

}  // namespace sigmax::apps
