#pragma once

#include <sigmax/estimation/radar.hpp>

namespace sigmax {

/// A radar measurement as a Cartesian one with its covariance, by the conversion asked for; `sigma` are standard
/// deviations of Gaussian errors. With the standard conversion c, l = (λ_α λ_ε, λ_α λ_ε, λ_ε), and Cₙ the covariance of
/// the position measured with its errors added n times over, all products component by component:
///
///   unbiased  z = c/l,              R = C₁ + (z − l c)(z − l c)ᵀ, the mean square error given the measurement
///   debiased  z = c − l (l − 1) c,  R = C₂ − l lᵀ C₁, the covariance of the error averaged given the measurement
///
/// In the plane these are the published formulas. Throws std::invalid_argument unless range > 0 and no deviation is
/// negative.
inline Gaussian<3> to_cartesian(const Polar& measured, const Polar& sigma, Conversion conversion) {
  return detail::converted(measured, sigma, conversion);
}

}  // namespace sigmax
