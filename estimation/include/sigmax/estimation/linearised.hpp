#pragma once

#include <string>
#include <string_view>

#include <Eigen/Cholesky>

#include <sigmax/estimation/any_model.hpp>
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
template <int M, int N, int MaxN = N>
struct LinearisedMeasurement {
  Vector<M> residual;
  RectangularMatrix<M, N, M, MaxN> H;
  SquareMatrix<M> R;
};

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
LinearisedStep<Model::state_size, Model::max_state_size> linearised_step(const Model& model,
                                                                         const EstimateOf<Model>& start, double dt) {
  const auto& F = model.transition(dt);
  return {(F * start.mean).eval() + model.known_input(dt), F, model.process_covariance(dt)};
}

/// Of the extended Kalman filter: by the Jacobian at the mean.
template <NonlinearModel Model>
LinearisedStep<Model::state_size, Model::max_state_size> linearised_step(const Extended<Model>& member,
                                                                         const EstimateOf<Model>& start, double dt) {
  const Model& model = member.model();
  if constexpr (LinearMotion<Model>)
    return linearised_step(model, start, dt);
  else
    return {propagated(model, start.mean, dt), transition_jacobian(model, start.mean, dt),
            model.process_covariance(dt)};
}

namespace detail {

/// What sigma points over N(m, L Lᵀ) make of a function, as a linear one: `slope` L⁻¹ (x − m), and the covariance of
/// what that leaves unexplained. `deviations` are the function's, a column for each point.
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
    rest = points.covariance(even, even);
  }
};

}  // namespace detail

/// Of a filter with sigma points: by regression over them; what that leaves unexplained is noise.
template <SigmaPointMember Filter>
LinearisedStep<Filter::state_size, Filter::max_state_size> linearised_step(const Filter& member,
                                                                           const EstimateOf<Filter>& start, double dt) {
  if constexpr (LinearMotion<typename Filter::ModelType>) {
    return linearised_step(member.model(), start, dt);
  } else {
    const SigmaPoints<Filter> points(member, start);
    const detail::Propagated<Filter> images(member, points, start.mean, dt);
    const detail::SigmaPointRegression<Filter, Filter::state_size, Filter::max_state_size> linear(
        member, points, images.deviations, covariance_root(start.covariance, member.name()));
    return {images.mean, linear.slope, linear.rest + member.model().process_covariance(dt)};
  }
}

/// As the model that it is.
template <int MaxStateSize, class... Models>
LinearisedStep<Eigen::Dynamic, MaxStateSize> linearised_step(const AnyModel<MaxStateSize, Models...>& any,
                                                             const EstimateOf<AnyModel<MaxStateSize, Models...>>& start,
                                                             double dt) {
  return any.visit([&](const auto& model) -> LinearisedStep<Eigen::Dynamic, MaxStateSize> {
    const auto own = linearised_step(model, detail::estimate_for(model, start), dt);
    return {own.mean, own.F, own.Q};
  });
}

/// Of a linear model: the measurement itself.
template <LinearModel Model>
LinearisedMeasurement<Model::measurement_size, Model::state_size, Model::max_state_size> linearised_measurement(
    const Model& model, const EstimateOf<Model>& predicted, const MeasurementOf<Model>& z) {
  const auto& H = model.measurement_matrix();
  return {z.mean - H * predicted.mean, H, z.covariance};
}

/// Of the extended Kalman filter: by the Jacobian at the prediction.
template <NonlinearModel Model>
LinearisedMeasurement<Model::measurement_size, Model::state_size, Model::max_state_size> linearised_measurement(
    const Extended<Model>& member, const EstimateOf<Model>& predicted, const MeasurementOf<Model>& z) {
  const Model& model = member.model();
  return {measurement_difference(model, z.mean, predicted_measurement(model, predicted.mean)),
          measurement_jacobian(model, predicted.mean), z.covariance};
}

/// Of a filter with sigma points: by regression over them; what that leaves unexplained is noise.
template <SigmaPointMember Filter>
LinearisedMeasurement<Filter::measurement_size, Filter::state_size, Filter::max_state_size> linearised_measurement(
    const Filter& member, const EstimateOf<Filter>& predicted, const MeasurementOf<Filter>& z) {
  constexpr int M = Filter::measurement_size;
  const SigmaPoints<Filter> points(member, predicted);
  typename SigmaPoints<Filter>::template Columns<M> seen(M, points.size());
  const auto see = [&](Eigen::Index i) {
    seen.col(i) = predicted_measurement(member.model(), StateOf<Filter>(predicted.mean + points.offsets().col(i)));
  };
  see(0);  // silences a warning of g++ 12: there is always a first point
  for (Eigen::Index i = 1; i < points.size(); ++i) see(i);
  const Vector<M> mean = measurement_mean(member.model(), seen, points.mean_weights());
  for (Eigen::Index i = 0; i < points.size(); ++i)
    seen.col(i) = measurement_difference(member.model(), Vector<M>(seen.col(i)), mean);
  const detail::SigmaPointRegression<Filter, M, M> linear(member, points, seen,
                                                          covariance_root(predicted.covariance, member.name()));
  return {measurement_difference(member.model(), z.mean, mean), linear.slope, linear.rest + z.covariance};
}

/// As the model that it is.
template <int MaxStateSize, class... Models>
auto linearised_measurement(const AnyModel<MaxStateSize, Models...>& any,
                            const EstimateOf<AnyModel<MaxStateSize, Models...>>& predicted,
                            const MeasurementOf<AnyModel<MaxStateSize, Models...>>& z) {
  using Result =
      LinearisedMeasurement<AnyModel<MaxStateSize, Models...>::measurement_size, Eigen::Dynamic, MaxStateSize>;
  return any.visit([&](const auto& model) -> Result {
    const auto own = linearised_measurement(model, detail::estimate_for(model, predicted), z);
    return {own.residual, own.H, own.R};
  });
}

namespace detail {

/// Cholesky's factor of R. Where R is singular, the rounding of the innovation's covariance stands for its zeros.
template <int M, int N, int MaxN>
Eigen::LLT<SquareMatrix<M>> noise_root(const LinearisedMeasurement<M, N, MaxN>& measurement) {
  Eigen::LLT<SquareMatrix<M>> factor(measurement.R);
  if (factor.info() == Eigen::Success) return factor;
  SquareMatrix<M> R = measurement.R;
  R.diagonal().array() += 1e-24;
  return factor.compute(R);
}

}  // namespace detail

}  // namespace sigmax
