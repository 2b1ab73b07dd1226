#include <sigmax/estimation/radar_numbers.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <sigmax/estimation/dense.hpp>

namespace sigmax {

double wrapped(double angle) {
  return std::abs(angle) <= std::numbers::pi ? angle : std::remainder(angle, 2.0 * std::numbers::pi);  // rarely
}

namespace detail {
namespace {

/// Where a target lies from a sensor.
struct Offset {
  double d[3] = {};
  double ground_squared, ground, range;

  Offset(int axes, const double* origin, const double* position) {
    for (int i = 0; i < axes; ++i) d[i] = position[i] - origin[i];
    ground_squared = d[0] * d[0] + d[1] * d[1];
    ground = std::sqrt(ground_squared);
    range = axes == 2 ? ground : std::sqrt(ground_squared + d[2] * d[2]);
  }
};

/// ∂/∂position of what a radar sees, in a matrix of m rows: without the elevation, if there are two.
void write_slopes(int axes, const Offset& at, int m, double* H) {
  for (int i = 0; i < axes; ++i) {
    H[i * m] = at.d[i] / at.range;
    H[1 + i * m] = 0.0;
  }
  H[1] = -at.d[1] / at.ground_squared;
  H[1 + m] = at.d[0] / at.ground_squared;
  if (axes == 2 || m == 2) return;
  const double scale = at.d[2] / (at.range * at.range * at.ground);
  H[2] = -at.d[0] * scale;
  H[2 + m] = -at.d[1] * scale;
  H[2 + 2 * m] = at.ground / (at.range * at.range);
}

void write_seen(int axes, const Offset& at, double* z) {
  z[0] = at.range;
  z[1] = std::atan2(at.d[1], at.d[0]);
  if (axes == 3) z[2] = std::atan2(at.d[2], at.ground);
}

/// Mean and covariance of (cos a, sin a) for a Gaussian angle. Nothing cancels, however small the variance.
struct UncertainDirection {
  double mean[2];
  double covariance[2][2];

  UncertainDirection(double angle, double variance) {
    const double damped = std::exp(-variance), lost = -std::expm1(-variance);  // λ² and 1 − λ²
    const double scale = std::exp(-0.5 * variance);
    mean[0] = scale * std::cos(angle);
    mean[1] = scale * std::sin(angle);
    const double c = damped * std::cos(2.0 * angle), s = damped * std::sin(2.0 * angle);
    covariance[0][0] = 0.5 * lost * (1.0 - c);
    covariance[1][1] = 0.5 * lost * (1.0 + c);
    covariance[0][1] = covariance[1][0] = -0.5 * lost * s;
  }
};

/// Covariance of the Cartesian position of a radar measurement with its Gaussian errors added `times` over.
void position_covariance(const double* measured, const double* sigma, int times, double* result) {
  const UncertainDirection azimuth(measured[1], times * sigma[1] * sigma[1]);
  const UncertainDirection elevation(measured[2], times * sigma[2] * sigma[2]);
  // x, y, z are r · (ce, ce, se) · (ca, sa, 1): three independent factors.
  const double e[3] = {elevation.mean[0], elevation.mean[0], elevation.mean[1]};
  const double a[3] = {azimuth.mean[0], azimuth.mean[1], 1.0};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const double e_covariance = elevation.covariance[i == 2][k == 2];
      const double a_covariance = i < 2 && k < 2 ? azimuth.covariance[i][k] : 0.0;
      const double ee = e[i] * e[k], aa = a[i] * a[k];
      const double directions = ee * a_covariance + e_covariance * aa + e_covariance * a_covariance;
      result[i + 3 * k] = measured[0] * measured[0] * directions + times * sigma[0] * sigma[0] * (directions + ee * aa);
    }
}

}  // namespace

void polar(int axes, const double* origin, const double* position, double* z, double* H) {
  const Offset at(axes, origin, position);
  if (z) write_seen(axes, at, z);
  if (H) write_slopes(axes, at, axes, H);
}

void slant(const double* origin, const double* position, double* z, double* H) {
  const Offset at(3, origin, position);
  if (z) write_seen(2, at, z);
  if (H) write_slopes(3, at, 2, H);
}

void bearing(const double* origin, const double* position, double* z, double* H) {
  const Offset at(2, origin, position);
  if (z) z[0] = std::atan2(at.d[1], at.d[0]);
  if (H) {
    H[0] = -at.d[1] / at.ground_squared;
    H[1] = at.d[0] / at.ground_squared;
  }
}

void doppler(int axes, const double* origin, const double* x, double* z, double* H) {
  const Offset at(axes, origin, x);
  const double* const v = x + axes;
  double along = 0.0;
  for (int i = 0; i < axes; ++i) along += at.d[i] * v[i];
  if (z) {
    write_seen(axes, at, z);
    z[axes] = along / at.range;
  }
  if (!H) return;
  const int m = axes + 1;
  std::fill_n(H, m * 2 * axes, 0.0);
  write_slopes(axes, at, m, H);
  for (int i = 0; i < axes; ++i) {
    H[axes + i * m] = (v[i] - at.d[i] * (along / (at.range * at.range))) / at.range;
    H[axes + (axes + i) * m] = at.d[i] / at.range;
  }
}

void polar_difference(const double* z, const double* predicted, int m, int count, double* result) {
  for (int k = 0; k < count * m; k += m)
    for (int i = 0; i < m; ++i) {
      const double apart = z[k + i] - predicted[i];
      result[k + i] = i == 1 ? wrapped(apart) : apart;
    }
}

void convert(const double* measured, const double* sigma, Conversion conversion, double* mean, double* covariance) {
  const double r = measured[0];
  if (!(r > 0.0)) throw std::invalid_argument("a radar range is " + std::to_string(r) + " m; expected a positive one");
  if (!(sigma[0] >= 0.0 && sigma[1] >= 0.0 && sigma[2] >= 0.0))
    throw std::invalid_argument("a radar's standard deviations are not negative");
  const double ca = std::cos(measured[1]), sa = std::sin(measured[1]);
  const double ce = std::cos(measured[2]), se = std::sin(measured[2]);
  const double position[3] = {r * ce * ca, r * ce * sa, r * se};
  if (conversion == Conversion::standard) {
    // R = J diag(σ²) Jᵀ, where the columns of J are the derivatives by range, azimuth and elevation.
    const double J[9] = {ce * ca, ce * sa, se, -r * ce * sa, r * ce * ca, 0.0, -r * se * ca, -r * se * sa, r * ce};
    double scaled[9];
    for (int k = 0; k < 9; ++k) scaled[k] = J[k] * sigma[k / 3];
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i)
        covariance[i + 3 * k] = scaled[i] * scaled[k] + scaled[i + 3] * scaled[k + 3] + scaled[i + 6] * scaled[k + 6];
    std::copy_n(position, 3, mean);
  } else {
    const double lambda_a = std::exp(-0.5 * sigma[1] * sigma[1]), lambda_e = std::exp(-0.5 * sigma[2] * sigma[2]);
    const double l[3] = {lambda_a * lambda_e, lambda_a * lambda_e, lambda_e};
    double C1[9], rest[3];
    position_covariance(measured, sigma, 1, C1);
    if (conversion == Conversion::unbiased) {
      std::copy_n(C1, 9, covariance);
      for (int i = 0; i < 3; ++i) {
        mean[i] = position[i] / l[i];
        rest[i] = mean[i] - l[i] * position[i];  // from the mean of the true position, given the measurement
      }
      for (int i = 0; i < 9; ++i) covariance[i] += rest[i % 3] * rest[i / 3];
    } else {
      for (int i = 0; i < 3; ++i) mean[i] = position[i] - l[i] * (l[i] * position[i] - position[i]);
      position_covariance(measured, sigma, 2, covariance);
      for (int i = 0; i < 9; ++i) covariance[i] -= C1[i] * l[i % 3] * l[i / 3];
    }
  }
  mirror_lower(covariance, 3);
}

void position_of_polar(int axes, const double* origin, const double* z, const double* R, int m, double* mean,
                       double* covariance) {
  double measured[3] = {}, deviations[3] = {}, all_mean[3], all_covariance[9];
  for (int i = 0; i < axes; ++i) {
    measured[i] = z[i];
    deviations[i] = std::sqrt(R[i + i * m]);
  }
  convert(measured, deviations, Conversion::unbiased, all_mean, all_covariance);
  for (int i = 0; i < axes; ++i) {
    mean[i] = all_mean[i] + origin[i];
    for (int k = 0; k < axes; ++k) covariance[i + k * axes] = all_covariance[i + 3 * k];
  }
}

}  // namespace detail
}  // namespace sigmax
