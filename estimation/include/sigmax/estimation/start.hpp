#pragma once

#include <array>
#include <cstddef>

#include <sigmax/estimation/view.hpp>

namespace sigmax {

/// A measurement and its time in s.
template <int M>
struct TimedMeasurement {
  double time;
  Gaussian<M> measurement;
};

namespace detail {

/// A measurement's numbers, and its time.
struct TimedView {
  double time;
  ConstView measurement;
};
template <int M>
TimedView timed(const TimedMeasurement<M>& point) {
  return {point.time, view(point.measurement)};
}

/// @{
/// The starts below in numbers, of points along as many axes as they have; a result has two or three derivatives.
void start_from_points(const double* weights, int orders, const ConstView* points, int count, View start);
void two_point_start(const TimedView& first, const TimedView& second, View start);
void three_point_start(const TimedView& first, const TimedView& second, const TimedView& third, View start);
void released_start(const TimedView& first, const TimedView& second, const TimedView& third, View start);
/// @}

}  // namespace detail

/// The state whose derivative d (0 position, 1 velocity, …) is Σᵢ weights(d, i) zᵢ, with the covariance that follows
/// from independent measurements. States are ordered by derivative, as in IndependentAxes.
template <int M, int Orders, std::size_t Points>
Gaussian<M * Orders> start_from_points(const Eigen::Matrix<double, Orders, static_cast<int>(Points)>& weights,
                                       const std::array<Gaussian<M>, Points>& points) {
  Gaussian<M * Orders> start;
  detail::ConstView views[Points];
  for (std::size_t i = 0; i < Points; ++i) views[i] = detail::view(points[i]);
  detail::start_from_points(weights.data(), Orders, views, static_cast<int>(Points), detail::view(start));
  return start;
}

/// Position and velocity at the second point: x = z₂, v = (z₂ − z₁)/T.
/// Throws std::invalid_argument unless the times increase.
template <int M>
Gaussian<2 * M> two_point_start(const TimedMeasurement<M>& first, const TimedMeasurement<M>& second) {
  Gaussian<2 * M> start;
  detail::two_point_start(detail::timed(first), detail::timed(second), detail::view(start));
  return start;
}

/// Position, velocity and acceleration at the third point, unbiased under constant acceleration: the parabola through
/// the points. With equal steps v = (3z₃ − 4z₂ + z₁)/2T, a = (z₃ − 2z₂ + z₁)/T².
/// Throws std::invalid_argument unless the times increase.
template <int M>
Gaussian<3 * M> three_point_start(const TimedMeasurement<M>& first, const TimedMeasurement<M>& second,
                                  const TimedMeasurement<M>& third) {
  Gaussian<3 * M> start;
  detail::three_point_start(detail::timed(first), detail::timed(second), detail::timed(third), detail::view(start));
  return start;
}

/// The start of the authors' released program: as above but v = (z₃ − z₂)/T, biased under acceleration, and every
/// covariance taken to be that of the third point. T is the last step.
template <int M>
Gaussian<3 * M> released_start(const TimedMeasurement<M>& first, const TimedMeasurement<M>& second,
                               const TimedMeasurement<M>& third) {
  Gaussian<3 * M> start;
  detail::released_start(detail::timed(first), detail::timed(second), detail::timed(third), detail::view(start));
  return start;
}

}  // namespace sigmax
