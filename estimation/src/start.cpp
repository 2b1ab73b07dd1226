#include <sigmax/estimation/start.hpp>

#include <algorithm>
#include <initializer_list>
#include <stdexcept>

#include <sigmax/estimation/dense.hpp>

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

}  // namespace sigmax::detail
