#include <stdexcept>
#include <string>

#include "chosen_target_of.hpp"

namespace sigmax::detail {
namespace {

void require_size(int size, int expected) {
  if (size < 1 || size > 6 || (expected != Eigen::Dynamic && size != expected))
    throw std::invalid_argument("a plot has " + std::to_string(size) + " measured quantities; expected " +
                                (expected == Eigen::Dynamic ? "1 to 6" : std::to_string(expected)));
}

}  // namespace

Plot<KnownSensor> chosen_plot(const AnyPlot& plot, int axes) {
  if (plot.sensor == AnyPlot::Sensor::none) return Plot<KnownSensor>(plot.time, plot.tag);
  require_size(plot.size, Eigen::Dynamic);
  const KnownSensor sensor = axes == 1   ? known_sensor_of_a_line(plot)
                             : axes == 2 ? known_sensor<2>(plot)
                                         : known_sensor<3>(plot);
  sensor.visit([&]<Sensing Sensor>(const Sensor&) { require_size(plot.size, Sensor::measurement_size); });
  MeasurementOf<KnownSensor> z;
  z.mean = Eigen::Map<const Eigen::VectorXd>(plot.z.data(), plot.size);
  z.covariance = Eigen::Map<const Eigen::MatrixXd>(plot.covariance.data(), plot.size, plot.size);
  return {plot.time, z, sensor, plot.tag};
}

}  // namespace sigmax::detail
