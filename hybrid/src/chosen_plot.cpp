#include <stdexcept>
#include <string>

#include "chosen_target_of.hpp"

namespace sigmax::detail {
namespace {

using Sensor = AnyPlot::Sensor;

/// How many quantities a plot's sensor measures; 0 if it may be any number.
int expected_size(Sensor sensor, int axes) {
  switch (sensor) {
    case Sensor::none:
    case Sensor::components:
      return 0;
    case Sensor::bearing:
      return 1;
    case Sensor::doppler:
      return axes + 1;
    default:
      return axes;
  }
}

template <int Axes>
KnownSensor sensor_of(const AnyPlot& plot) {
  const Vector<Axes> origin(plot.origin.data());
  switch (plot.sensor) {
    case Sensor::polar:
      return PolarSensor<Axes>(origin);
    case Sensor::bearing:
      return BearingSensor(Vector<2>(plot.origin.data()));
    case Sensor::components:
      return ComponentSensor<6>(std::span(plot.places).first(static_cast<std::size_t>(plot.size)));
    case Sensor::doppler:
      return DopplerSensor<Axes>(origin);
    default:
      return PositionSensor<Axes>{};
  }
}

}  // namespace

Plot<KnownSensor> chosen_plot(const AnyPlot& plot, int axes) {
  if (plot.sensor == Sensor::none) return Plot<KnownSensor>(plot.time, plot.tag);
  const int m = plot.size;
  const int expected = expected_size(plot.sensor, axes);
  if (m < 1 || m > 6 || (expected > 0 && m != expected))
    throw std::invalid_argument("a plot has " + std::to_string(m) + " measured quantities; expected " +
                                (expected > 0 ? std::to_string(expected) : "1 to 6"));
  MeasurementOf<KnownSensor> z;
  z.mean = Eigen::Map<const Eigen::VectorXd>(plot.z.data(), m);
  z.covariance = Eigen::Map<const Eigen::MatrixXd>(plot.covariance.data(), m, m);
  return {plot.time, z, axes == 2 ? sensor_of<2>(plot) : sensor_of<3>(plot), plot.tag};
}

}  // namespace sigmax::detail
