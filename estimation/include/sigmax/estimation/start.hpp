#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>

#include <sigmax/estimation/gaussian.hpp>

namespace sigmax {

/// A measurement and its time in s.
template <int M>
struct TimedMeasurement {
  double time;
  Gaussian<M> measurement;
};

/// The state whose derivative d (0 position, 1 velocity, …) is Σᵢ weights(d, i) zᵢ, with the covariance that follows
/// from independent measurements. States are ordered by derivative, as in IndependentAxes.
template <int M, int Orders, std::size_t Points>
Gaussian<M * Orders> start_from_points(const Eigen::Matrix<double, Orders, static_cast<int>(Points)>& weights,
                                       const std::array<Gaussian<M>, Points>& points) {
  Gaussian<M * Orders> start;
  start.mean.setZero();
  start.covariance.setZero();
  for (int i = 0; i < static_cast<int>(Points); ++i) {
    const auto& point = points[static_cast<std::size_t>(i)];
    for (int a = 0; a < Orders; ++a) {
      start.mean.template segment<M>(a * M) += weights(a, i) * point.mean;
      for (int b = 0; b < Orders; ++b)
        start.covariance.template block<M, M>(a * M, b * M) += weights(a, i) * weights(b, i) * point.covariance;
    }
  }
  detail::mirror_lower(start.covariance);
  return start;
}

namespace detail {
inline double positive_step(double earlier, double later) {
  if (!(later > earlier)) throw std::invalid_argument("a start from points needs increasing times");
  return later - earlier;
}
}  // namespace detail

/// Position and velocity at the second point: x = z₂, v = (z₂ − z₁)/T.
/// Throws std::invalid_argument unless the times increase.
template <int M>
Gaussian<2 * M> two_point_start(const TimedMeasurement<M>& first, const TimedMeasurement<M>& second) {
  const double T = detail::positive_step(first.time, second.time);
  Eigen::Matrix2d weights;
  weights << 0.0, 1.0, -1.0 / T, 1.0 / T;
  return start_from_points<M, 2, 2>(weights, {first.measurement, second.measurement});
}

/// Position, velocity and acceleration at the third point, unbiased under constant acceleration: the parabola through
/// the points. With equal steps v = (3z₃ − 4z₂ + z₁)/2T, a = (z₃ − 2z₂ + z₁)/T².
/// Throws std::invalid_argument unless the times increase.
template <int M>
Gaussian<3 * M> three_point_start(const TimedMeasurement<M>& first, const TimedMeasurement<M>& second,
                                  const TimedMeasurement<M>& third) {
  const double h = detail::positive_step(first.time, second.time);
  const double k = detail::positive_step(second.time, third.time);
  Eigen::Matrix3d weights;
  weights.row(0) << 0.0, 0.0, 1.0;
  weights.row(1) << k / (h * (h + k)), -(h + k) / (h * k), (h + 2.0 * k) / (k * (h + k));
  weights.row(2) << 2.0 / (h * (h + k)), -2.0 / (h * k), 2.0 / (k * (h + k));
  return start_from_points<M, 3, 3>(weights, {first.measurement, second.measurement, third.measurement});
}

/// The start of the authors' released program: as above but v = (z₃ − z₂)/T, biased under acceleration, and every
/// covariance taken to be that of the third point. T is the last step.
template <int M>
Gaussian<3 * M> released_start(const TimedMeasurement<M>& first, const TimedMeasurement<M>& second,
                               const TimedMeasurement<M>& third) {
  const double T = detail::positive_step(second.time, third.time);
  Eigen::Matrix3d weights;
  weights.row(0) << 0.0, 0.0, 1.0;
  weights.row(1) << 0.0, -1.0 / T, 1.0 / T;
  weights.row(2) << 1.0 / (T * T), -2.0 / (T * T), 1.0 / (T * T);
  const SquareMatrix<M>& R = third.measurement.covariance;
  return start_from_points<M, 3, 3>(
      weights, {Gaussian<M>{first.measurement.mean, R}, Gaussian<M>{second.measurement.mean, R}, third.measurement});
}

}  // namespace sigmax
