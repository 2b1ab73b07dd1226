#pragma once

#include <cmath>

#include <sigmax/estimation/gaussian.hpp>
#include <sigmax/estimation/radar_numbers.hpp>

namespace sigmax {

/// A target as a radar sees it: range in m, azimuth counter-clockwise from x and elevation from the x–y plane in rad.
/// The same three numbers serve as standard deviations.
struct Polar {
  double range;
  double azimuth;
  double elevation;
};

/// Where a radar at the origin sees a position.
inline Polar to_polar(const Vector<3>& position) {
  const double ground = std::hypot(position.x(), position.y());
  return {std::hypot(ground, position.z()), std::atan2(position.y(), position.x()), std::atan2(position.z(), ground)};
}

namespace detail {
inline Gaussian<3> converted(const Polar& measured, const Polar& sigma, Conversion conversion) {
  const double z[3] = {measured.range, measured.azimuth, measured.elevation};
  const double deviations[3] = {sigma.range, sigma.azimuth, sigma.elevation};
  Gaussian<3> result;
  convert(z, deviations, conversion, result.mean.data(), result.covariance.data());
  return result;
}
}  // namespace detail

/// The position that a radar measurement stands for.
inline Vector<3> to_cartesian(const Polar& seen) {
  const double ground = seen.range * std::cos(seen.elevation);
  return {ground * std::cos(seen.azimuth), ground * std::sin(seen.azimuth), seen.range * std::sin(seen.elevation)};
}

/// The standard conversion of a radar measurement to a Cartesian one with its covariance: first-order error propagation
/// at the *measured* range, azimuth and elevation (Lerro and Bar-Shalom 1993; Bar-Shalom, Li, Kirubarajan 2001, 10.4).
/// `sigma` are standard deviations. Throws std::invalid_argument unless range > 0 and no deviation is negative.
inline Gaussian<3> to_cartesian(const Polar& measured, const Polar& sigma) {
  return detail::converted(measured, sigma, Conversion::standard);
}

/// r σ_α² / σ_r: the standard conversion is valid below 0.4 (Lerro and Bar-Shalom 1993).
inline double conversion_validity(double range, const Polar& sigma) {
  return range * sigma.azimuth * sigma.azimuth / sigma.range;
}

}  // namespace sigmax
