#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <utility>

#include <sigmax/estimation/sensing.hpp>

namespace sigmax {

/// What a tracker is told at one time: a measurement with the sensor that made it, or that there was none. The tag, the
/// number of a row say, comes back with what the plot leads to.
template <Sensing Sensor>
struct Plot {
  struct Seen {
    MeasurementOf<Sensor> z;
    Sensor sensor;
  };

  double time;  ///< in s
  std::optional<Seen> seen;
  std::size_t tag = 0;

  explicit Plot(double t = 0.0, std::size_t number = 0) : time(t), tag(number) {}
  Plot(double t, const MeasurementOf<Sensor>& z, Sensor sensor, std::size_t number = 0)
      : time(t), seen{Seen{z, std::move(sensor)}}, tag(number) {}
  Plot(double t, const MeasurementOf<Sensor>& z, std::size_t number = 0) requires std::default_initializable<Sensor>
      : Plot(t, z, Sensor{}, number) {}
};

namespace detail {

/// The position that a measurement tells by itself, `sensor.position(z)`, if the sensor has one to tell: what a start
/// is made of.
template <int Axes, Sensing Sensor>
std::optional<Gaussian<Axes>> position_told(const Plot<Sensor>& plot) {
  if constexpr (requires { plot.seen->sensor.position(plot.seen->z); }) {
    if (!plot.seen) return std::nullopt;
    const std::optional position = plot.seen->sensor.position(plot.seen->z);  // of an AnySensor it may be nothing
    if (position && position->size() == Axes) return Gaussian<Axes>{position->mean, position->covariance};
  }
  return std::nullopt;
}

}  // namespace detail

/// Where a target starts: estimates, of all models together or one each, and their time. `from_plots` says that the
/// plots that waited are in them; otherwise those are taken as measurements after the start.
template <class Estimates>
struct StartAt {
  double time;
  Estimates estimates;
  bool from_plots = true;
};

}  // namespace sigmax
