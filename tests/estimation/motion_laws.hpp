#pragma once

#include "support/linearised.hpp"

namespace sigmax::support {

/// F and Q of a linear motion for a step of dt seconds, and what its known input adds, as the mean.
inline LinearisedStepOf<AnyModel> matrices_of(const AnyModel& model, double dt) {
  const auto n = model.size();
  return linearised_step(model, {StateOf<AnyModel>::Zero(n), StateMatrixOf<AnyModel>::Identity(n, n)}, dt);
}

/// Fails the current case of a property unless two covariances are near, each entry on the scale of its variances.
inline void require_near_covariance(const AnyMatrix& found, const AnyMatrix& expected, double tolerance) {
  RC_ASSERT(found.rows() == expected.rows());
  for (Eigen::Index i = 0; i < found.rows(); ++i)
    for (Eigen::Index j = 0; j < found.cols(); ++j) {
      const double scale = std::sqrt(expected(i, i) * expected(j, j));
      if (scale == 0.0)
        RC_ASSERT(found(i, j) == 0.0);
      else
        require_near(found(i, j) / scale, expected(i, j) / scale, tolerance);
    }
}

/// A generated step: 10⁻⁶ to 10 s, each power of ten alike.
inline double generated_step() { return std::pow(10.0, number_between(-6.0, 1.0)); }

/// A step of s and one of t seconds are a step of s + t: F(s+t) = F(t) F(s), Q(s+t) = F(t) Q(s) F(t)ᵀ + Q(t),
/// u(s+t) = F(t) u(s) + u(t).
inline void require_steps_to_add_up(const AnyModel& model, double s, double t) {
  const auto first = matrices_of(model, s), second = matrices_of(model, t), both = matrices_of(model, s + t);
  require_near(both.F, second.F * first.F, 1e-12);
  require_near_covariance(both.Q, second.F * first.Q * second.F.transpose() + second.Q, 1e-12);
  require_near(both.mean, second.F * first.mean + second.mean, 1e-12);
}

/// By its series, of a sixteenth or less of the matrix, squared.
inline restatement::Matrix exponential(restatement::Matrix A) {
  int squarings = 0;
  for (double size = 0.0; squarings == 0 || size > 0.1; ++squarings) {
    A = 0.5 * A;
    size = 0.0;
    for (const double value : A.values) size = std::max(size, std::abs(value));
  }
  restatement::Matrix term = restatement::identity(A.rows), sum = term;
  for (int k = 1; k < 20; ++k) {
    term = (1.0 / k) * (term * A);
    sum = sum + term;
  }
  while (squarings-- > 0) sum = sum * sum;
  return sum;
}

/// F and Q are the integrals of dx = A x dt + dw with E[dw dwᵀ] = D dt over dt seconds, by the exponential of one
/// matrix (Van Loan 1978). A and D may be of one axis of several.
inline void require_integral(const restatement::Matrix& A, const restatement::Matrix& D, const AnyModel& model,
                             double dt) {
  const std::size_t n = A.rows;
  restatement::Matrix block(2 * n, 2 * n), F(n, n), corner(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      block(i, k) = -dt * A(i, k);
      block(i, n + k) = dt * D(i, k);
      block(n + i, n + k) = dt * A(k, i);
    }
  const auto power = exponential(block);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      F(k, i) = power(n + i, n + k);
      corner(i, k) = power(i, n + k);
    }
  const auto found = matrices_of(model, dt);
  require_near(found.F, F, 1e-9);
  require_near_covariance(found.Q, matrix_of(F * corner), 1e-9);
}

}  // namespace sigmax::support
