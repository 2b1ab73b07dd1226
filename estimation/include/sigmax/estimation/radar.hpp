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

/// The position that a radar measurement stands for.
inline Vector<3> to_cartesian(const Polar& seen) {
  const double ground = seen.range * std::cos(seen.elevation);
  return {ground * std::cos(seen.azimuth), ground * std::sin(seen.azimuth), seen.range * std::sin(seen.elevation)};
}

/// A radar measurement as a Cartesian one with its covariance; `sigma` are standard deviations of Gaussian errors. The
/// standard conversion c is first-order error propagation at the *measured* range, azimuth and elevation (Lerro and
/// Bar-Shalom 1993; Bar-Shalom, Li, Kirubarajan 2001, 10.4). With l = (λ_α λ_ε, λ_α λ_ε, λ_ε), and Cₙ the covariance of
/// the position measured with its errors added n times over, all products component by component:
///
///   unbiased  z = c/l,              R = C₁ + (z − l c)(z − l c)ᵀ, the mean square error given the measurement
///   debiased  z = c − l (l − 1) c,  R = C₂ − l lᵀ C₁, the covariance of the error averaged given the measurement
///
/// In the plane these are the published formulas. Throws std::invalid_argument unless range > 0 and no deviation is
/// negative.
inline Gaussian<3> to_cartesian(const Polar& measured, const Polar& sigma,
                                Conversion conversion = Conversion::standard) {
  const double z[3] = {measured.range, measured.azimuth, measured.elevation};
  const double deviations[3] = {sigma.range, sigma.azimuth, sigma.elevation};
  Gaussian<3> result;
  detail::convert(z, deviations, conversion, result.mean.data(), result.covariance.data());
  return result;
}

/// r σ_α² / σ_r: the standard conversion is valid below 0.4 (Lerro and Bar-Shalom 1993).
inline double conversion_validity(double range, const Polar& sigma) {
  return range * sigma.azimuth * sigma.azimuth / sigma.range;
}

}  // namespace sigmax
