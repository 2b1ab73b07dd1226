#pragma once

#include <cmath>

#include <sigmax/estimation/radar.hpp>

namespace sigmax {

/// How a radar measurement becomes a Cartesian one with its covariance.
enum class Conversion {
  standard,  ///< first-order error propagation: biased, and too sure of itself from r σ_α²/σ_r ≈ 0.4 on
  unbiased,  ///< divided by λ_α λ_ε, λ = exp(−σ²/2) (Mo, Song, Zhou, Sun, Bar-Shalom 1998)
  debiased   ///< less the bias expected given the measurement (Lerro, Bar-Shalom 1993)
};

namespace detail {

/// Mean and covariance of (cos a, sin a) for a Gaussian angle. Nothing cancels, however small the variance.
struct UncertainDirection {
  Vector<2> mean;
  SquareMatrix<2> covariance;

  UncertainDirection(double angle, double variance) {
    const double damped = std::exp(-variance), lost = -std::expm1(-variance);  // λ² and 1 − λ²
    mean = std::exp(-0.5 * variance) * Vector<2>(std::cos(angle), std::sin(angle));
    const double c = damped * std::cos(2.0 * angle), s = damped * std::sin(2.0 * angle);
    covariance << 1.0 - c, -s, -s, 1.0 + c;
    covariance *= 0.5 * lost;
  }
};

/// Covariance of the Cartesian position of a radar measurement with its Gaussian errors added `times` over.
inline SquareMatrix<3> position_covariance(const Polar& measured, const Polar& sigma, int times) {
  const UncertainDirection azimuth(measured.azimuth, times * sigma.azimuth * sigma.azimuth);
  const UncertainDirection elevation(measured.elevation, times * sigma.elevation * sigma.elevation);
  // x, y, z are r · (ce, ce, se) · (ca, sa, 1): three independent factors.
  const Vector<3> e(elevation.mean(0), elevation.mean(0), elevation.mean(1));
  const Vector<3> a(azimuth.mean(0), azimuth.mean(1), 1.0);
  SquareMatrix<3> e_covariance, a_covariance = SquareMatrix<3>::Zero();
  a_covariance.topLeftCorner<2, 2>() = azimuth.covariance;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) e_covariance(i, k) = elevation.covariance(i == 2, k == 2);
  const SquareMatrix<3> ee = e * e.transpose(), aa = a * a.transpose();
  const SquareMatrix<3> directions =
      ee.cwiseProduct(a_covariance) + e_covariance.cwiseProduct(aa) + e_covariance.cwiseProduct(a_covariance);
  return measured.range * measured.range * directions +
         times * sigma.range * sigma.range * (directions + ee.cwiseProduct(aa));
}

}  // namespace detail

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
  Gaussian<3> standard = to_cartesian(measured, sigma);
  if (conversion == Conversion::standard) return standard;
  const double lambda_a = std::exp(-0.5 * sigma.azimuth * sigma.azimuth);
  const double lambda_e = std::exp(-0.5 * sigma.elevation * sigma.elevation);
  const Vector<3> l(lambda_a * lambda_e, lambda_a * lambda_e, lambda_e);
  const Vector<3> mean = l.cwiseProduct(standard.mean);  // of the true position, given the measurement
  const SquareMatrix<3> C1 = detail::position_covariance(measured, sigma, 1);
  Gaussian<3> result;
  if (conversion == Conversion::unbiased) {
    result.mean = standard.mean.cwiseQuotient(l);
    const Vector<3> rest = result.mean - mean;
    result.covariance = C1 + rest * rest.transpose();
  } else {
    result.mean = standard.mean - l.cwiseProduct(mean - standard.mean);
    result.covariance = detail::position_covariance(measured, sigma, 2) - C1.cwiseProduct(l * l.transpose());
  }
  detail::mirror_lower(result.covariance);
  return result;
}

}  // namespace sigmax
