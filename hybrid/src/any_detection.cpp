#include <sigmax/hybrid/any_detection.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace sigmax {
namespace {

AnyDetection filled(AnyDetection::Sensor sensor, double time, std::span<const double> z,
                    std::span<const double> covariance, std::size_t least, std::size_t most,
                    const std::array<double, 3>& origin = {}) {
  const std::size_t n = z.size();
  if (n < least || n > most)
    throw std::invalid_argument("a detection of " + std::to_string(n) + " measured quantities; expected " +
                                std::to_string(least) + " to " + std::to_string(most));
  if (covariance.size() != n && covariance.size() != n * n)
    throw std::invalid_argument("a covariance of " + std::to_string(covariance.size()) +
                                " numbers for a detection of " + std::to_string(n) + "; expected " + std::to_string(n) +
                                " variances or " + std::to_string(n * n) + " numbers");
  AnyDetection detection{.time = time, .sensor = sensor, .size = static_cast<int>(n), .origin = origin};
  std::copy(z.begin(), z.end(), detection.z.begin());
  if (covariance.size() == n)
    for (std::size_t i = 0; i < n; ++i) detection.covariance[i * (n + 1)] = covariance[i];
  else
    std::copy(covariance.begin(), covariance.end(), detection.covariance.begin());
  return detection;
}

}  // namespace

AnyDetection AnyDetection::missed(double time) { return {.time = time}; }

AnyDetection AnyDetection::position(double time, std::span<const double> z, std::span<const double> covariance) {
  return filled(Sensor::position, time, z, covariance, 1, 3);
}

AnyDetection AnyDetection::polar(double time, std::span<const double> z, std::span<const double> covariance,
                                 const std::array<double, 3>& origin) {
  return filled(Sensor::polar, time, z, covariance, 2, 3, origin);
}

AnyDetection AnyDetection::doppler(double time, std::span<const double> z, std::span<const double> covariance,
                                   const std::array<double, 3>& origin) {
  return filled(Sensor::doppler, time, z, covariance, 3, 4, origin);
}

AnyDetection AnyDetection::bearing(double time, Angle azimuth, Angle sigma, const std::array<double, 3>& origin) {
  const double z = azimuth.radians(), variance = sigma.radians() * sigma.radians();
  return filled(Sensor::bearing, time, {&z, 1}, {&variance, 1}, 1, 1, origin);
}

AnyDetection AnyDetection::components(double time, std::span<const int> places, std::span<const double> z,
                                      std::span<const double> covariance) {
  AnyDetection detection = filled(Sensor::components, time, z, covariance, 1, 6);
  if (places.size() != z.size())
    throw std::invalid_argument(std::to_string(places.size()) + " places for a detection of " +
                                std::to_string(z.size()) + " measured quantities");
  std::copy(places.begin(), places.end(), detection.places.begin());
  return detection;
}

std::optional<double> component_of(const AnyDetection& detection, int component) {
  using enum AnyDetection::Sensor;
  for (std::size_t i = 0; i < static_cast<std::size_t>(detection.size); ++i)
    if (detection.sensor == components ? detection.places[i] == component
                                       : detection.sensor == position && static_cast<int>(i) == component)
      return detection.z[i];
  return std::nullopt;
}

int axes_seen(const AnyDetection& detection, int axes) {
  if (detection.sensor == AnyDetection::Sensor::polar || detection.sensor == AnyDetection::Sensor::doppler)
    return std::min(detection.size, axes);
  int seen = 0;
  for (int axis = 0; axis < axes; ++axis) seen += component_of(detection, axis) ? 1 : 0;
  return seen;
}

bool is_moving(const AnyDetection& detection, int axes) {
  return detection.sensor == AnyDetection::Sensor::components && axes_seen(detection, axes) < detection.size;
}

}  // namespace sigmax
