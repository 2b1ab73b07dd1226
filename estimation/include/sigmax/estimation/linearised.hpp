#pragma once

#include <string>
#include <string_view>

#include <Eigen/Cholesky>

#include <sigmax/estimation/any_member.hpp>
#include <sigmax/estimation/covariance_root.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/sigma_points.hpp>

namespace sigmax {

/// One step of a motion as a linear one about an estimate with mean m: x_k = mean + F (x_k−1 − m) + w, w ~ N(0, Q).
template <int N, int MaxN = N>
struct LinearisedStep {
  Vector<N, MaxN> mean;
  SquareMatrix<N, MaxN> F;
  SquareMatrix<N, MaxN> Q;
};

/// A measurement as a linear one about an estimate with mean m: residual = H (x − m) + v, v ~ N(0, R).
template <int M, int MaxM, int N, int MaxN>
struct LinearisedMeasurement {
  Vector<M, MaxM> residual;
  RectangularMatrix<M, N, MaxM, MaxN> H;
  SquareMatrix<M, MaxM> R;
};

/// That of a model's state by a sensor.
template <class Model, Sensing Sensor>
using LinearisedMeasurementOf = LinearisedMeasurement<Sensor::measurement_size, detail::max_measurement_size_of<Sensor>,
                                                      Model::state_size, Model::max_state_size>;
/// A step of a model.
template <class Model>
using LinearisedStepOf = LinearisedStep<Model::state_size, Model::max_state_size>;

namespace detail {

/// A with A L = B, for a lower triangular L. Where a column of L is zero, A knows nothing: its column is zero, too.
template <int Rows, int MaxRows, int N, int MaxN>
RectangularMatrix<Rows, N, MaxRows, MaxN> regressed(const RectangularMatrix<Rows, N, MaxRows, MaxN>& B,
                                                    const SquareMatrix<N, MaxN>& L) {
  RectangularMatrix<Rows, N, MaxRows, MaxN> A = B;
  for (Eigen::Index k = L.cols(); k-- > 0;) {
    if (L(k, k) == 0.0) {
      A.col(k).setZero();
      continue;
    }
    for (Eigen::Index i = k + 1; i < L.rows(); ++i) A.col(k) -= L(i, k) * A.col(i);
    A.col(k) /= L(k, k);
  }
  return A;
}

}  // namespace detail

/// Of a linear motion: the step itself.
template <LinearMotion Model>
LinearisedStepOf<Model> linearised_step(const Model& model, const EstimateOf<Model>& start, double dt) {
  const auto& F = model.transition(dt);
  return {(F * start.mean).eval() + model.known_input(dt), F, model.process_covariance(dt)};
}

namespace detail {

/// As the motion that the member's is.
template <class Filter>
LinearisedStepOf<Filter> linearised_as_chosen(const Filter& member, const EstimateOf<Filter>& start, double dt) {
  return as_chosen(member, start, [&](const auto& own, const auto& estimate) -> LinearisedStepOf<Filter> {
    const auto linear = linearised_step(own, estimate, dt);
    return {linear.mean, linear.F, linear.Q};
  });
}

}  // namespace detail

/// Of the extended Kalman filter: by the Jacobian at the mean.
template <Motion Moves>
LinearisedStepOf<Moves> linearised_step(const Extended<Moves>& member, const EstimateOf<Moves>& start, double dt) {
  const Moves& motion = member.motion();
  if constexpr (LinearMotion<Moves>)
    return linearised_step(motion, start, dt);
  else if constexpr (detail::ChosenMotion<Moves>)
    return detail::linearised_as_chosen(member, start, dt);
  else
    return {propagated(motion, start.mean, dt), transition_jacobian(motion, start.mean, dt),
            motion.process_covariance(dt)};
}

namespace detail {

/// Fits a linear function to the values at the sigma points of N(m, L Lᵀ): `slope` L⁻¹ (x − m), and the covariance of
/// the remainder. `deviations` are the function's, a column for each point.
template <SigmaPointMember Filter, int A, int MaxA>
struct SigmaPointRegression {
  RectangularMatrix<A, Filter::state_size, MaxA, Filter::max_state_size> slope;
  SquareMatrix<A, MaxA> rest;

  SigmaPointRegression(const Filter& member, const SigmaPoints<Filter>& points,
                       const typename SigmaPoints<Filter>::template Columns<A, MaxA>& deviations,
                       const SquareMatrix<Filter::state_size, Filter::max_state_size>& L) {
    const Eigen::Index n = L.rows();
    const auto up = deviations.middleCols(points.size() - 2 * n, n);
    const auto down = deviations.rightCols(n);
    slope = regressed<A, MaxA, Filter::state_size, Filter::max_state_size>(
        (up - down) / (2.0 * std::sqrt(member.weights().spread)), L);
    typename SigmaPoints<Filter>::template Columns<A, MaxA> even = deviations;
    even.middleCols(points.size() - 2 * n, n) = 0.5 * (up + down);
    even.rightCols(n) = 0.5 * (up + down);
    rest = points.covariance(even);
  }
};

}  // namespace detail

/// Of a filter with sigma points: by regression over them; what that leaves unexplained is noise.
template <SigmaPointMember Filter>
LinearisedStepOf<Filter> linearised_step(const Filter& member, const EstimateOf<Filter>& start, double dt) {
  if constexpr (LinearMotion<typename Filter::MotionType>) {
    return linearised_step(member.motion(), start, dt);
  } else if constexpr (detail::ChosenMotion<typename Filter::MotionType>) {
    return detail::linearised_as_chosen(member, start, dt);
  } else {
    const SigmaPoints<Filter> points(member, start);
    const detail::Propagated<Filter> images(member, points, start.mean, dt);
    const detail::SigmaPointRegression<Filter, Filter::state_size, Filter::max_state_size> linear(
        member, points, images.deviations, detail::covariance_root(start.covariance, member.name()));
    return {images.mean, linear.slope, linear.rest + member.motion().process_covariance(dt)};
  }
}

/// As the member that it is.
template <Motion Moves>
LinearisedStepOf<Moves> linearised_step(const AnyMember<Moves>& any, const EstimateOf<Moves>& start, double dt) {
  return any.visit([&](const auto& member) { return linearised_step(member, start, dt); });
}

/// Of a linear sensor the measurement itself; of another by the Jacobian at the prediction, as the extended Kalman
/// filter has it.
template <StateModel Model, SensorOf<Model> Sensor>
LinearisedMeasurementOf<Model, Sensor> linearised_measurement(const Model& model, const EstimateOf<Model>& predicted,
                                                              const MeasurementOf<Sensor>& z, const Sensor& sensor) {
  return {measurement_difference(sensor, z.mean, predicted_measurement(model, sensor, predicted.mean)),
          measurement_jacobian(model, sensor, predicted.mean), z.covariance};
}

/// Of a filter with sigma points, unless the sensor is linear: by regression over them; what that leaves unexplained is
/// noise.
template <SigmaPointMember Filter, SensorOf<Filter> Sensor>
LinearisedMeasurementOf<Filter, Sensor> linearised_measurement(const Filter& member,
                                                               const EstimateOf<Filter>& predicted,
                                                               const MeasurementOf<Sensor>& z, const Sensor& sensor) {
  if constexpr (LinearSensorOf<Sensor, Filter>) {
    return linearised_measurement(member.motion(), predicted, z, sensor);
  } else {
    constexpr int M = Sensor::measurement_size;
    constexpr int max_M = detail::max_measurement_size_of<Sensor>;
    const SigmaPoints<Filter> points(member, predicted);
    auto seen = detail::seen_points(member, points, predicted.mean, sensor, z.size());
    const MeasuredOf<Sensor> mean = measurement_mean(sensor, seen, points.mean_weights());
    for (Eigen::Index i = 0; i < points.size(); ++i)
      seen.col(i) = measurement_difference(sensor, MeasuredOf<Sensor>(seen.col(i)), mean);
    const detail::SigmaPointRegression<Filter, M, max_M> linear(
        member, points, seen, detail::covariance_root(predicted.covariance, member.name()));
    return {measurement_difference(sensor, z.mean, mean), linear.slope, linear.rest + z.covariance};
  }
}

/// As the member that it is.
template <Motion Moves, SensorOf<AnyMember<Moves>> Sensor>
LinearisedMeasurementOf<Moves, Sensor> linearised_measurement(const AnyMember<Moves>& any,
                                                              const EstimateOf<Moves>& predicted,
                                                              const MeasurementOf<Sensor>& z, const Sensor& sensor) {
  return any.visit([&](const auto& member) -> LinearisedMeasurementOf<Moves, Sensor> {
    return linearised_measurement(member, predicted, z, sensor);
  });
}

namespace detail {

/// Cholesky's factor of R. Where R is singular, the rounding of the innovation's covariance stands for its zeros.
template <int M, int MaxM>
Eigen::LLT<SquareMatrix<M, MaxM>> noise_root(const SquareMatrix<M, MaxM>& noise) {
  Eigen::LLT<SquareMatrix<M, MaxM>> factor(noise);
  if (factor.info() == Eigen::Success) return factor;
  SquareMatrix<M, MaxM> R = noise;
  R.diagonal().array() += 1e-24;
  return factor.compute(R);
}

}  // namespace detail

}  // namespace sigmax
