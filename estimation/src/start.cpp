#include <sigmax/estimation/start.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <sigmax/estimation/dense.hpp>
#include <sigmax/estimation/radar_numbers.hpp>

namespace sigmax::detail {
namespace {

double positive_step(double earlier, double later) {
  if (!(later > earlier)) throw std::invalid_argument("a start from points needs increasing times");
  return later - earlier;
}

/// Adds one of independent measurements to a start, whose derivative d (0 position, 1 velocity, …) is the sum of them
/// by their weights[d]. States are ordered by derivative, as in IndependentAxes.
void add_point(std::initializer_list<double> weights, const ConstView& point, const View& start) {
  const double* const weight = weights.begin();
  const int orders = static_cast<int>(weights.size()), M = point.n;
  for (int a = 0; a < orders; ++a) {
    for (int k = 0; k < M; ++k) start.mean[a * M + k] += weight[a] * point.mean[k];
    for (int b = 0; b < orders; ++b)
      for (int k = 0; k < M * M; ++k)
        start.covariance[a * M + k % M + (b * M + k / M) * start.n] += weight[a] * weight[b] * point.covariance[k];
  }
  mirror_lower(start.covariance, start.n);
}

void clear(const View& start) {
  std::fill_n(start.mean, start.n, 0.0);
  std::fill_n(start.covariance, start.n * start.n, 0.0);
}

/// The inverse of a symmetric matrix, of which the lower triangle is read; false if it is not positive definite.
bool invert_symmetric(const double* matrix, int n, double* inverse) {
  Scratch<> factor(n * n), columns(n * n);
  if (!cholesky_factor(matrix, n, factor)) return false;
  std::fill_n(columns.data(), n * n, 0.0);
  for (int k = 0; k < n; ++k) {
    columns.data()[k * (n + 1)] = 1.0;
    lower_solve(factor, n, columns.data() + k * n);
  }
  multiply_transposed(columns, n, columns, n, inverse, n, n, n, n);
  return true;
}

/// How far off a position is at most, as a standard deviation: squared, the greater eigenvalue of its covariance.
double greatest_deviation(const double* covariance, int n) {
  const double half = 0.5 * (covariance[0] + covariance[n + 1]), apart = 0.5 * (covariance[0] - covariance[n + 1]);
  return std::sqrt(half + std::hypot(apart, covariance[1]));
}

}  // namespace

void two_point_start(const TimedView& first, const TimedView& second, const View& start) {
  const double T = positive_step(first.time, second.time);
  clear(start);
  add_point({0.0, -1.0 / T}, first.measurement, start);
  add_point({1.0, 1.0 / T}, second.measurement, start);
}

void three_point_start(const TimedView& first, const TimedView& second, const TimedView& third, const View& start) {
  const double h = positive_step(first.time, second.time), k = positive_step(second.time, third.time);
  clear(start);
  add_point({0.0, k / (h * (h + k)), 2.0 / (h * (h + k))}, first.measurement, start);
  add_point({0.0, -(h + k) / (h * k), -2.0 / (h * k)}, second.measurement, start);
  add_point({1.0, (h + 2.0 * k) / (k * (h + k)), 2.0 / (k * (h + k))}, third.measurement, start);
}

void released_start(const TimedView& first, const TimedView& second, const TimedView& third, const View& start) {
  const double T = positive_step(second.time, third.time);
  const double* const R = third.measurement.covariance;
  clear(start);
  add_point({0.0, 0.0, 1.0 / (T * T)}, {first.measurement.mean, R, first.measurement.n}, start);
  add_point({0.0, -1.0 / T, -2.0 / (T * T)}, {second.measurement.mean, R, second.measurement.n}, start);
  add_point({1.0, 1.0 / T, 1.0 / (T * T)}, third.measurement, start);
}

/// Gauss and Newton's iteration. It begins at the least squares of the distances from the lines of sight, which are
/// linear in the motion. Velocity and acceleration are those of the time between the first and the last bearing, so
/// that all unknowns are lengths.
bool crossed_bearings_start(std::span<const TimedBearing> bearings, const View& start) {
  constexpr int most_passes = 50;
  constexpr double small = 1e-11, greatest = 0.2;  // of the distance to the nearest place
  const int n = start.n;
  if (static_cast<int>(bearings.size()) < n) return false;
  const TimedBearing& last = bearings.back();
  const double span = last.time - bearings.front().time;
  if (!(span > 0.0)) return false;
  double information[36], gradient[6], step[6];
  std::fill_n(start.mean, n, 0.0);
  for (int pass = 0; pass < most_passes; ++pass) {
    double nearest = std::numeric_limits<double>::infinity(), worst = 0.0;
    std::fill_n(information, n * n, 0.0);
    std::fill_n(gradient, n, 0.0);
    for (const TimedBearing& bearing : bearings) {
      const double t = (bearing.time - last.time) / span, powers[3] = {1.0, t, 0.5 * t * t};
      double d[2] = {last.origin(0) - bearing.origin(0), last.origin(1) - bearing.origin(1)};
      for (int i = 0; i < n; ++i) d[i % 2] += powers[i / 2] * start.mean[i];
      const double azimuth = bearing.azimuth.radians(), sigma = bearing.sigma.radians();
      const double c = std::cos(azimuth), s = std::sin(azimuth), range = std::hypot(d[0], d[1]);
      const bool linear = pass == 0;
      const double slope[2] = {linear ? -s : -d[1] / (range * range), linear ? c : d[0] / (range * range)};
      const double left = linear ? s * d[0] - c * d[1] : wrapped(azimuth - std::atan2(d[1], d[0]));
      for (int i = 0; i < n; ++i) {
        const double weighted = slope[i % 2] * powers[i / 2] / (sigma * sigma);
        gradient[i] += weighted * left;
        for (int k = 0; k <= i; ++k) information[i + k * n] += weighted * slope[k % 2] * powers[k / 2];
      }
      nearest = std::min(nearest, range);
      worst = std::max(worst, std::abs(left));
    }
    if (!invert_symmetric(information, n, start.covariance)) return false;
    multiply(start.covariance, n, columns_of(gradient, n), step, n, n, n, 1);
    for (int i = 0; i < n; ++i) start.mean[i] += step[i];
    if (pass == 0 || !(std::hypot(step[0], step[1]) <= small * nearest)) continue;
    if (!(greatest_deviation(start.covariance, n) <= greatest * nearest) || worst > 0.5 * std::numbers::pi)
      return false;  // they tell too little, or cross behind a sensor's back
    const double units[3] = {1.0, 1.0 / span, 1.0 / (span * span)};
    for (int i = 0; i < n; ++i) {
      start.mean[i] = start.mean[i] * units[i / 2] + (i < 2 ? last.origin(i) : 0.0);
      for (int k = 0; k < n; ++k) start.covariance[i + k * n] *= units[i / 2] * units[k / 2];
    }
    return true;
  }
  return false;
}

}  // namespace sigmax::detail
