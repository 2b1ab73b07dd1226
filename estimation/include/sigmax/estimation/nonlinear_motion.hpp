#pragma once

#include <concepts>

#include <sigmax/estimation/jacobian.hpp>
#include <sigmax/estimation/model.hpp>

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

namespace detail {

/// ∂f/∂x, as the motion gives it, else by automatic differentiation.
template <NonlinearMotion Moves>
StateMatrixOf<Moves> slope_of(const Moves& motion, const StateOf<Moves>& x, double dt) {
  constexpr int N = Moves::state_size;
  constexpr int max_N = Moves::max_state_size;
  if constexpr (requires { motion.transition_jacobian(x, dt); })
    return motion.transition_jacobian(x, dt);
  else
    return jacobian<N, max_N, N, max_N>(
        [&](const DifferentiableVector<N, max_N>& state) { return motion.propagate(state, dt); }, x);
}

}  // namespace detail

}  // namespace sigmax
