#pragma once

#include <optional>
#include <span>

#include <sigmax/estimation/angle.hpp>
#include <sigmax/estimation/view.hpp>

namespace sigmax {

/// The azimuth of a target at a time, in s, as it was seen from a place: counter-clockwise from x.
struct TimedBearing {
  double time;
  Vector<2> origin;
  Angle azimuth;
  Angle sigma;  ///< its standard deviation
};

namespace detail {

/// A measurement's numbers, and its time.
struct TimedView {
  double time;
  ConstView measurement;
};

/// @{
/// The starts below in numbers, of points along as many axes as they have; a result has two or three derivatives.
void two_point_start(const TimedView& first, const TimedView& second, const View& start);
void three_point_start(const TimedView& first, const TimedView& second, const TimedView& third, const View& start);
void released_start(const TimedView& first, const TimedView& second, const TimedView& third, const View& start);
/// @}
/// That from bearings; false if they do not tell it.
bool crossed_bearings_start(std::span<const TimedBearing> bearings, const View& start);

}  // namespace detail

/// A measurement and its time in s.
template <int M>
struct TimedMeasurement {
  double time;
  Gaussian<M> measurement;

  operator detail::TimedView() const { return {time, detail::view(measurement)}; }
};

/// Position and velocity at the second point: x = z₂, v = (z₂ − z₁)/T.
/// Throws std::invalid_argument unless the times increase.
template <int M>
Gaussian<2 * M> two_point_start(const TimedMeasurement<M>& first, const TimedMeasurement<M>& second) {
  Gaussian<2 * M> start;
  detail::two_point_start(first, second, detail::view(start));
  return start;
}

/// Position, velocity and acceleration at the third point, unbiased under constant acceleration: the parabola through
/// the points. With equal steps v = (3z₃ − 4z₂ + z₁)/2T, a = (z₃ − 2z₂ + z₁)/T².
/// Throws std::invalid_argument unless the times increase.
template <int M>
Gaussian<3 * M> three_point_start(const TimedMeasurement<M>& first, const TimedMeasurement<M>& second,
                                  const TimedMeasurement<M>& third) {
  Gaussian<3 * M> start;
  detail::three_point_start(first, second, third, detail::view(start));
  return start;
}

/// The start of the authors' released program: as above but v = (z₃ − z₂)/T, biased under acceleration, and every
/// covariance taken to be that of the third point. T is the last step.
template <int M>
Gaussian<3 * M> released_start(const TimedMeasurement<M>& first, const TimedMeasurement<M>& second,
                               const TimedMeasurement<M>& third) {
  Gaussian<3 * M> start;
  detail::released_start(first, second, third, detail::view(start));
  return start;
}

/// The most likely motion of constant velocity, or with 3 derivatives of constant acceleration, from bearings in the
/// order of their times. It holds at the last bearing; its covariance is the inverse of the Fisher information.
/// Returns nothing if the bearings do not determine it: too few, all from one place that stands still, or nearly
/// parallel. Nearly parallel: a standard deviation of the position is above a fifth of the distance to the nearest
/// place.
template <int Derivatives>
  requires(Derivatives == 2 || Derivatives == 3)
std::optional<Gaussian<2 * Derivatives>> crossed_bearings_start(std::span<const TimedBearing> bearings) {
  Gaussian<2 * Derivatives> start;
  if (!detail::crossed_bearings_start(bearings, detail::view(start))) return std::nullopt;
  return start;
}

}  // namespace sigmax
