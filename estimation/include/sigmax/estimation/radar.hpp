#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <sigmax/estimation/gaussian.hpp>

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

/// The standard conversion of a radar measurement to a Cartesian one with its covariance: first-order error propagation
/// at the *measured* range, azimuth and elevation (Lerro and Bar-Shalom 1993; Bar-Shalom, Li, Kirubarajan 2001, 10.4).
/// `sigma` are standard deviations. Throws std::invalid_argument unless range > 0 and no deviation is negative.
inline Gaussian<3> to_cartesian(const Polar& measured, const Polar& sigma) {
  if (!(measured.range > 0.0))
    throw std::invalid_argument("a radar range is " + std::to_string(measured.range) + " m; expected a positive one");
  if (!(sigma.range >= 0.0 && sigma.azimuth >= 0.0 && sigma.elevation >= 0.0))
    throw std::invalid_argument("a radar's standard deviations are not negative");
  const double r = measured.range;
  const double ca = std::cos(measured.azimuth), sa = std::sin(measured.azimuth);
  const double ce = std::cos(measured.elevation), se = std::sin(measured.elevation);
  // R = J diag(σ²) Jᵀ, where the columns of J are the derivatives by range, azimuth and elevation.
  Eigen::Matrix3d J;
  J.col(0) << ce * ca, ce * sa, se;
  J.col(1) << -r * ce * sa, r * ce * ca, 0.0;
  J.col(2) << -r * se * ca, -r * se * sa, r * ce;
  J.col(0) *= sigma.range;
  J.col(1) *= sigma.azimuth;
  J.col(2) *= sigma.elevation;
  SquareMatrix<3> R = J * J.transpose();
  detail::mirror_lower(R);
  return {to_cartesian(measured), R};
}

/// r σ_α² / σ_r: the standard conversion is valid below 0.4 (Lerro and Bar-Shalom 1993).
inline double conversion_validity(double range, const Polar& sigma) {
  return range * sigma.azimuth * sigma.azimuth / sigma.range;
}

}  // namespace sigmax
