#pragma once

namespace sigmax {

/// How a radar measurement becomes a Cartesian one with its covariance.
enum class Conversion {
  standard,  ///< first-order error propagation: biased, and too sure of itself from r σ_α²/σ_r ≈ 0.4 on
  unbiased,  ///< divided by λ_α λ_ε, λ = exp(−σ²/2) (Mo, Song, Zhou, Sun, Bar-Shalom 1998)
  debiased   ///< less the bias expected given the measurement (Lerro, Bar-Shalom 1993)
};

/// The angle less whole turns, in [−π, π].
double wrapped(double angle);

/// The numbers of the library's sensors, computed in one place: h(x) in z, and ∂h/∂x by columns in H, where they are
/// asked for. The classes of sensors.hpp say what they mean.
namespace detail {

/// Range, azimuth and, with three axes, elevation.
void polar(int axes, const double* origin, const double* position, double* z, double* H);
/// Range and azimuth, in space.
void slant(const double* origin, const double* position, double* z, double* H);
/// Azimuth.
void bearing(const double* origin, const double* position, double* z, double* H);
/// What `polar` sees, and the rate of the range; of position and velocity.
void doppler(int axes, const double* origin, const double* x, double* z, double* H);

/// Writes z − predicted for `count` measurements z, a column each, of m quantities. The second quantity is an azimuth.
void polar_difference(const double* z, const double* predicted, int m, int count, double* result);

/// What a radar's measurement of m quantities, with its covariance, tells of the position: its unbiased conversion.
void position_of_polar(int axes, const double* origin, const double* z, const double* R, int m, double* mean,
                       double* covariance);

/// Mean and covariance of the position, of three axes, that a radar measurement with these standard deviations stands
/// for. Throws std::invalid_argument unless the range is positive and no deviation negative.
void convert(const double* measured, const double* sigma, Conversion conversion, double* mean, double* covariance);

}  // namespace detail
}  // namespace sigmax
