#pragma once

#include <concepts>

#include <sigmax/estimation/jacobian.hpp>
#include <sigmax/estimation/model.hpp>
#include <sigmax/estimation/sensing.hpp>

namespace sigmax {

/// A motion x_k = f(x_k−1) + w, (21), by its valid expressions; no base class is needed. Functions of another size do
/// not compile.
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

/// Any motion, linear or not.
template <class Model>
concept Motion = LinearMotion<Model> || NonlinearMotion<Model>;

/// f(x), (21); of a linear motion F x + u. Throws std::domain_error unless it is finite.
template <Motion Model>
StateOf<Model> propagated(const Model& motion, const StateOf<Model>& x, double dt) {
  const auto image = [&]() -> StateOf<Model> {
    if constexpr (LinearMotion<Model>)
      return motion.transition(dt) * x + motion.known_input(dt);
    else
      return motion.propagate(x, dt);
  };
  return detail::require_finite(image(), "f(x)", motion, x);
}

/// ∂f/∂x, as the motion gives it, else by automatic differentiation; of a linear motion F. Throws std::domain_error
/// unless it is finite.
template <Motion Model>
StateMatrixOf<Model> transition_jacobian(const Model& motion, const StateOf<Model>& x, double dt) {
  constexpr int N = Model::state_size;
  constexpr int max_N = Model::max_state_size;
  const auto jacobian_at = [&]() -> StateMatrixOf<Model> {
    if constexpr (LinearMotion<Model>)
      return motion.transition(dt);
    else if constexpr (requires { motion.transition_jacobian(x, dt); })
      return motion.transition_jacobian(x, dt);
    else
      return jacobian<N, max_N, N, max_N>(
          [&](const DifferentiableVector<N, max_N>& state) { return motion.propagate(state, dt); }, x);
  };
  return detail::require_finite(jacobian_at(), "the Jacobian of f", motion, x);
}

}  // namespace sigmax
