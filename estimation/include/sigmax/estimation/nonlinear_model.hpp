#pragma once

#include <concepts>
#include <stdexcept>
#include <string>

#include <sigmax/estimation/jacobian.hpp>
#include <sigmax/estimation/model.hpp>

namespace sigmax {

/// Of the scalar type of x, a state of the model: what its functions take when they are differentiated.
template <class Model>
using DifferentiableStateOf = DifferentiableVector<Model::state_size, Model::max_state_size>;

/// A motion x_k = f(x_k−1) + w, (21), by its valid expressions; no base class is needed, here or below. Functions of
/// another size do not compile.
///
///   motion.propagate(x, dt)           f, n, for a step of dt seconds
///   motion.process_covariance(dt)     of w, n × n, symmetric positive semi-definite; it does not depend on the state
///   motion.transition_jacobian(x, dt) ∂f/∂x, n × n. Optional: if it is absent and a filter wants it, `propagate` must
///                                     take states of any scalar type and is differentiated automatically
///
/// An angle among the states is not wrapped: f takes and gives it continuously.
template <class Motion>
concept NonlinearMotion = StateModel<Motion> && requires(const Motion& motion, const StateOf<Motion>& x, double dt) {
  { motion.propagate(x, dt) } -> MatrixOf<Motion::state_size>;
  { motion.process_covariance(dt) } -> MatrixOf<Motion::state_size, Motion::state_size>;
  requires !requires { motion.transition_jacobian(x, dt); }
  || requires {
    { motion.transition_jacobian(x, dt) } -> MatrixOf<Motion::state_size, Motion::state_size>;
  };
};

/// A non-linear motion with a measurement z_k = h(x_k) + v_k, (22); the measurement brings the covariance of v.
///
///   Model::measurement_size           number of measured quantities, m
///   model.measure(x)                  h, m
///   model.measurement_jacobian(x)     ∂h/∂x, m × n. Optional, as above
///   model.measurement_difference(z, predicted)  z − predicted, m, where z is a measured or predicted measurement.
///                                     Optional: wraps angles
///   model.measurement_mean(points, weights)  the weighted mean of measurements, a column each. Optional: by default
///                                     z₀ + Σ wᵢ (zᵢ − z₀) with the difference above, right for angles less than half a
///                                     turn apart
template <class Model>
concept NonlinearModel = NonlinearMotion<Model> &&
    requires(const Model& model, const StateOf<Model>& x, const Vector<Model::measurement_size>& z) {
  { model.measure(x) } -> MatrixOf<Model::measurement_size>;
  requires !requires { model.measurement_jacobian(x); }
  || requires {
    { model.measurement_jacobian(x) } -> MatrixOf<Model::measurement_size, Model::state_size>;
  };
  requires !requires { model.measurement_difference(z, z); }
  || requires {
    { model.measurement_difference(z, z) } -> MatrixOf<Model::measurement_size>;
  };
};

namespace detail {

template <class Model>
concept GivesTransitionJacobian = requires(const Model& model, const StateOf<Model>& x, double dt) {
  model.transition_jacobian(x, dt);
};
template <class Model>
concept GivesMeasurementJacobian = requires(const Model& model, const StateOf<Model>& x) {
  model.measurement_jacobian(x);
};

/// Returns the value. Throws std::domain_error, naming the function, the model and the state, unless it is finite.
template <class Value, class Model>
const Value& require_finite(const Value& value, const char* function, const Model& model, const StateOf<Model>& x) {
  if (value.allFinite()) return value;
  std::string message = std::string(function) + " of model '" + std::string(model.name()) + "' is not finite at x = (";
  for (Eigen::Index i = 0; i < x.size(); ++i) message += (i == 0 ? "" : ", ") + std::to_string(x(i));
  throw std::domain_error(message + ")");
}

}  // namespace detail

/// f(x), (21). Throws std::domain_error unless it is finite.
template <NonlinearMotion Motion>
StateOf<Motion> propagated(const Motion& motion, const StateOf<Motion>& x, double dt) {
  return detail::require_finite(StateOf<Motion>(motion.propagate(x, dt)), "f(x)", motion, x);
}

/// h(x), (22). Throws std::domain_error unless it is finite.
template <NonlinearModel Model>
Vector<Model::measurement_size> predicted_measurement(const Model& model, const StateOf<Model>& x) {
  return detail::require_finite(Vector<Model::measurement_size>(model.measure(x)), "h(x)", model, x);
}

/// ∂f/∂x as the motion gives it, else by automatic differentiation. Throws std::domain_error unless it is finite.
template <NonlinearMotion Motion>
SquareMatrix<Motion::state_size, Motion::max_state_size> transition_jacobian(const Motion& motion,
                                                                             const StateOf<Motion>& x, double dt) {
  constexpr int N = Motion::state_size;
  constexpr int max_N = Motion::max_state_size;
  const auto jacobian_at = [&]() -> SquareMatrix<N, max_N> {
    if constexpr (detail::GivesTransitionJacobian<Motion>)
      return motion.transition_jacobian(x, dt);
    else
      return jacobian<N, max_N, N, max_N>(
          [&](const DifferentiableStateOf<Motion>& state) { return motion.propagate(state, dt); }, x);
  };
  return detail::require_finite(jacobian_at(), "the Jacobian of f", motion, x);
}

/// ∂h/∂x as the model gives it, else by automatic differentiation. Throws std::domain_error unless it is finite.
template <NonlinearModel Model>
RectangularMatrix<Model::measurement_size, Model::state_size, Model::measurement_size, Model::max_state_size>
measurement_jacobian(const Model& model, const StateOf<Model>& x) {
  constexpr int N = Model::state_size;
  constexpr int max_N = Model::max_state_size;
  constexpr int M = Model::measurement_size;
  const auto jacobian_at = [&]() -> RectangularMatrix<M, N, M, max_N> {
    if constexpr (detail::GivesMeasurementJacobian<Model>)
      return model.measurement_jacobian(x);
    else
      return jacobian<M, M, N, max_N>([&](const DifferentiableStateOf<Model>& state) { return model.measure(state); },
                                      x);
  };
  return detail::require_finite(jacobian_at(), "the Jacobian of h", model, x);
}

namespace detail {

/// f(x) of any motion as it gives it, finite or not; of a linear one F x + u.
template <class Motion, class State>
  requires(LinearMotion<Motion> || NonlinearMotion<Motion>)
auto moved(const Motion& motion, const State& x, double dt) {
  if constexpr (LinearMotion<Motion>)
    return StateOf<Motion>(motion.transition(dt) * x + motion.known_input(dt));
  else
    return motion.propagate(x, dt);
}

/// ∂f/∂x of any motion; of a linear one F. Throws std::domain_error unless that of another is finite.
template <class Motion>
  requires(LinearMotion<Motion> || NonlinearMotion<Motion>)
SquareMatrix<Motion::state_size, Motion::max_state_size> tangent(const Motion& motion, const StateOf<Motion>& x,
                                                                 double dt) {
  if constexpr (LinearMotion<Motion>)
    return motion.transition(dt);
  else
    return transition_jacobian(motion, x, dt);
}

}  // namespace detail

/// z − predicted, by the model's own difference if it has one.
template <NonlinearModel Model>
Vector<Model::measurement_size> measurement_difference(const Model& model, const Vector<Model::measurement_size>& z,
                                                       const Vector<Model::measurement_size>& predicted) {
  if constexpr (requires { model.measurement_difference(z, predicted); })
    return model.measurement_difference(z, predicted);
  else
    return z - predicted;
}

/// The mean of measurements, a column each, with weights that sum to one: the model's own if it has one.
template <NonlinearModel Model, class Points, class Weights>
Vector<Model::measurement_size> measurement_mean(const Model& model, const Points& points, const Weights& weights) {
  if constexpr (requires { model.measurement_mean(points, weights); }) {
    return model.measurement_mean(points, weights);
  } else {
    const Vector<Model::measurement_size> first = points.col(0);
    Vector<Model::measurement_size> mean = first;
    for (Eigen::Index i = 1; i < points.cols(); ++i)
      mean += weights(i) * measurement_difference<Model>(model, points.col(i), first);
    return mean;
  }
}

}  // namespace sigmax
