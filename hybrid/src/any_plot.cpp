#include <sigmax/hybrid/any_plot.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace sigmax {
namespace {

AnyPlot filled(AnyPlot::Sensor sensor, double time, std::span<const double> z, std::span<const double> covariance,
               std::size_t least, std::size_t most, const std::array<double, 3>& origin = {}) {
  const std::size_t n = z.size();
  if (n < least || n > most)
    throw std::invalid_argument("a plot of " + std::to_string(n) + " measured quantities; expected " +
                                std::to_string(least) + " to " + std::to_string(most));
  if (covariance.size() != n && covariance.size() != n * n)
    throw std::invalid_argument("a covariance of " + std::to_string(covariance.size()) + " numbers for a plot of " +
                                std::to_string(n) + "; expected " + std::to_string(n) + " variances or " +
                                std::to_string(n * n) + " numbers");
  AnyPlot plot{.time = time, .sensor = sensor, .size = static_cast<int>(n), .origin = origin};
  std::copy(z.begin(), z.end(), plot.z.begin());
  if (covariance.size() == n)
    for (std::size_t i = 0; i < n; ++i) plot.covariance[i * (n + 1)] = covariance[i];
  else
    std::copy(covariance.begin(), covariance.end(), plot.covariance.begin());
  return plot;
}

}  // namespace

AnyPlot AnyPlot::missed(double time) { return {.time = time}; }

AnyPlot AnyPlot::position(double time, std::span<const double> z, std::span<const double> covariance) {
  return filled(Sensor::position, time, z, covariance, 1, 3);
}

AnyPlot AnyPlot::polar(double time, std::span<const double> z, std::span<const double> covariance,
                       const std::array<double, 3>& origin) {
  return filled(Sensor::polar, time, z, covariance, 2, 3, origin);
}

AnyPlot AnyPlot::doppler(double time, std::span<const double> z, std::span<const double> covariance,
                         const std::array<double, 3>& origin) {
  return filled(Sensor::doppler, time, z, covariance, 3, 4, origin);
}

AnyPlot AnyPlot::bearing(double time, Angle azimuth, Angle sigma, const std::array<double, 3>& origin) {
  const double z = azimuth.radians(), variance = sigma.radians() * sigma.radians();
  return filled(Sensor::bearing, time, {&z, 1}, {&variance, 1}, 1, 1, origin);
}

AnyPlot AnyPlot::components(double time, std::span<const int> places, std::span<const double> z,
                            std::span<const double> covariance) {
  AnyPlot plot = filled(Sensor::components, time, z, covariance, 1, 6);
  if (places.size() != z.size())
    throw std::invalid_argument(std::to_string(places.size()) + " places for a plot of " + std::to_string(z.size()) +
                                " measured quantities");
  std::copy(places.begin(), places.end(), plot.places.begin());
  return plot;
}

std::optional<double> component_of(const AnyPlot& plot, int component) {
  using enum AnyPlot::Sensor;
  for (std::size_t i = 0; i < static_cast<std::size_t>(plot.size); ++i)
    if (plot.sensor == components ? plot.places[i] == component
                                  : plot.sensor == position && static_cast<int>(i) == component)
      return plot.z[i];
  return std::nullopt;
}

int axes_seen(const AnyPlot& plot, int axes) {
  if (plot.sensor == AnyPlot::Sensor::polar || plot.sensor == AnyPlot::Sensor::doppler)
    return std::min(plot.size, axes);
  int seen = 0;
  for (int axis = 0; axis < axes; ++axis) seen += component_of(plot, axis) ? 1 : 0;
  return seen;
}

bool is_moving(const AnyPlot& plot, int axes) {
  return plot.sensor == AnyPlot::Sensor::components && axes_seen(plot, axes) < plot.size;
}

}  // namespace sigmax
