#include <sigmax/estimation/start.hpp>

#include <algorithm>
#include <stdexcept>

#include <sigmax/estimation/dense.hpp>

namespace sigmax::detail {
namespace {

double positive_step(double earlier, double later) {
  if (!(later > earlier)) throw std::invalid_argument("a start from points needs increasing times");
  return later - earlier;
}

/// The state whose derivative d (0 position, 1 velocity, …) is Σᵢ weights(d, i) zᵢ, with the covariance that follows
/// from independent measurements. States are ordered by derivative, as in IndependentAxes.
void start_from_points(const double* weights, int orders, const ConstView* points, int count, View start) {
  const int M = points[0].n, n = M * orders;
  std::fill_n(start.mean, n, 0.0);
  std::fill_n(start.covariance, n * n, 0.0);
  for (int i = 0; i < count; ++i) {
    const double* const of_point = weights + i * orders;
    for (int a = 0; a < orders; ++a) {
      for (int k = 0; k < M; ++k) start.mean[a * M + k] += of_point[a] * points[i].mean[k];
      for (int b = 0; b < orders; ++b)
        for (int k = 0; k < M * M; ++k)
          start.covariance[a * M + k % M + (b * M + k / M) * n] += of_point[a] * of_point[b] * points[i].covariance[k];
    }
  }
  mirror_lower(start.covariance, n);
}

}  // namespace

void two_point_start(const TimedView& first, const TimedView& second, View start) {
  const double T = positive_step(first.time, second.time);
  const double weights[] = {0.0, -1.0 / T, 1.0, 1.0 / T};
  const ConstView points[] = {first.measurement, second.measurement};
  start_from_points(weights, 2, points, 2, start);
}

void three_point_start(const TimedView& first, const TimedView& second, const TimedView& third, View start) {
  const double h = positive_step(first.time, second.time), k = positive_step(second.time, third.time);
  const double weights[] = {0.0,
                            k / (h * (h + k)),
                            2.0 / (h * (h + k)),  //
                            0.0,
                            -(h + k) / (h * k),
                            -2.0 / (h * k),  //
                            1.0,
                            (h + 2.0 * k) / (k * (h + k)),
                            2.0 / (k * (h + k))};
  const ConstView points[] = {first.measurement, second.measurement, third.measurement};
  start_from_points(weights, 3, points, 3, start);
}

void released_start(const TimedView& first, const TimedView& second, const TimedView& third, View start) {
  const double T = positive_step(second.time, third.time);
  const double weights[] = {0.0, 0.0, 1.0 / (T * T), 0.0, -1.0 / T, -2.0 / (T * T), 1.0, 1.0 / T, 1.0 / (T * T)};
  const double* const R = third.measurement.covariance;
  const int M = third.measurement.n;
  const ConstView points[] = {{first.measurement.mean, R, M}, {second.measurement.mean, R, M}, third.measurement};
  start_from_points(weights, 3, points, 3, start);
}

}  // namespace sigmax::detail
