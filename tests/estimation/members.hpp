#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/estimation/cubature.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/fixed_step_motion.hpp>
#include <sigmax/estimation/unscented.hpp>

#include "support/matrices.hpp"

namespace sigmax::support {

/// A linear motion as a non-linear one whose Jacobian nobody gives.
template <int N>
struct HiddenMotion {
  static constexpr int state_size = N;
  static constexpr int max_state_size = N;
  FixedStepMotion<N> motion;

  Eigen::Index size() const { return N; }
  std::string_view name() const { return "hidden"; }
  std::vector<std::string> components() const { return motion.components(); }
  template <class Scalar>
  Eigen::Matrix<Scalar, N, 1> propagate(const Eigen::Matrix<Scalar, N, 1>& x, double dt) const {
    return motion.transition(dt).template cast<Scalar>() * x + motion.known_input(dt).template cast<Scalar>();
  }
  SquareMatrix<N> process_covariance(double dt) const { return motion.process_covariance(dt); }
};

/// A linear sensor as one whose Jacobian nobody gives.
template <int M, int N>
struct HiddenSensor {
  static constexpr int seen_size = N;
  static constexpr int measurement_size = M;
  RectangularMatrix<M, N> H;

  template <class Scalar>
  Eigen::Matrix<Scalar, M, 1> measure(const Eigen::Matrix<Scalar, N, 1>& x) const {
    return H.template cast<Scalar>() * x;
  }
};

/// A generated scaling of the unscented filter, also with negative weights.
inline UnscentedScaling generated_scaling() {
  return {number_between(0.3, 2.0), number_between(0.0, 3.0), number_between(-1.0, 3.0)};
}

/// Calls visit(member) with every non-linear member over the motion.
template <class Moves, class Visit>
void with_every_member(const Moves& motion, const Visit& visit) {
  visit(Extended{motion});
  visit(Unscented{motion});
  visit(Unscented{motion, generated_scaling()});
  visit(Cubature{motion});
}
/// The same outside of properties, with defaults.
template <class Moves, class Visit>
void with_default_members(const Moves& motion, const Visit& visit) {
  visit(Extended{motion});
  visit(Unscented{motion});
  visit(Cubature{motion});
}

template <int N, int MaxN>
void require_near_gaussian(const Gaussian<N, MaxN>& found, const Gaussian<N, MaxN>& expected, double tolerance = 1e-9) {
  require_near_matrix(found.mean, expected.mean, tolerance);
  require_near_matrix(found.covariance, expected.covariance, tolerance);
}
template <int M, int MaxM>
void require_near_innovation(const Innovation<M, MaxM>& found, const Innovation<M, MaxM>& expected,
                             double tolerance = 1e-9) {
  require_near_matrix(found.residual, expected.residual, tolerance);
  require_near_matrix(found.covariance, expected.covariance, tolerance);
  require_near(found.squared_distance, expected.squared_distance, tolerance);
  require_near(found.log_likelihood, expected.log_likelihood, tolerance);
}

}  // namespace sigmax::support
