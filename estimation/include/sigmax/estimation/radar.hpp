#pragma once

#include <array>
#include <cmath>

#include <sigmax/estimation/angle.hpp>
#include <sigmax/estimation/gaussian.hpp>
#include <sigmax/estimation/radar_numbers.hpp>

namespace sigmax {

/// A target as a radar sees it: range in m, azimuth counter-clockwise from x and elevation from the x–y plane. The same
/// three serve as standard deviations.
///
///     const Polar seen{10.05e3, degrees(37.2), radians(0.1)}, sigma{10.0, degrees(0.1), degrees(0.1)};
struct Polar {
  double range = 0.0;
  Angle azimuth{};
  Angle elevation{};
};

namespace detail {
inline std::array<double, 3> numbers_of(const Polar& seen) {
  return {seen.range, seen.azimuth.radians(), seen.elevation.radians()};
}
}  // namespace detail

/// Where a radar at the origin sees a position.
inline Polar to_polar(const Vector<3>& position) {
  const double ground = std::hypot(position.x(), position.y());
  return {std::hypot(ground, position.z()), radians(std::atan2(position.y(), position.x())),
          radians(std::atan2(position.z(), ground))};
}

/// The position that a radar measurement stands for; in the plane, as of all that is below, the elevation is ignored.
template <int Axes = 3>
Vector<Axes> to_cartesian(const Polar& seen) {
  static_assert(Axes == 2 || Axes == 3, "in the plane or in space");
  const double azimuth = seen.azimuth.radians(), elevation = Axes == 3 ? seen.elevation.radians() : 0.0;
  const double ground = seen.range * std::cos(elevation);
  return Vector<3>(ground * std::cos(azimuth), ground * std::sin(azimuth), seen.range * std::sin(elevation))
      .template head<Axes>();
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
template <int Axes = 3>
Gaussian<Axes> to_cartesian(const Polar& measured, const Polar& sigma, Conversion conversion = Conversion::standard) {
  static_assert(Axes == 2 || Axes == 3, "in the plane or in space");
  auto z = detail::numbers_of(measured), deviations = detail::numbers_of(sigma);
  if (Axes == 2) z[2] = deviations[2] = 0.0;
  Gaussian<3> result;
  detail::convert(z.data(), deviations.data(), conversion, result.mean.data(), result.covariance.data());
  return {result.mean.template head<Axes>(), result.covariance.template topLeftCorner<Axes, Axes>()};
}

/// r σ_α² / σ_r: the standard conversion is valid below 0.4 (Lerro and Bar-Shalom 1993).
inline double conversion_validity(double range, const Polar& sigma) {
  return range * sigma.azimuth.radians() * sigma.azimuth.radians() / sigma.range;
}

}  // namespace sigmax
