#pragma once

#include <cmath>

#include <Eigen/Dense>
#include <unsupported/Eigen/MatrixFunctions>

#include <sigmax/estimation/kalman.hpp>

#include "support/matrices.hpp"

namespace sigmax::support {

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
template <class Model>
void require_steps_to_add_up(const Model& model, double s, double t) {
  const auto F = model.transition(t);
  require_near_matrix(model.transition(s + t), F * model.transition(s), 1e-12);
  require_near_covariance(model.process_covariance(s + t),
                          F * model.process_covariance(s) * F.transpose() + model.process_covariance(t), 1e-12);
  require_near_matrix(model.known_input(s + t), F * model.known_input(s) + model.known_input(t), 1e-12);
}

/// F and Q are the numerical integrals of dx = A x dt + dw with E[dw dwᵀ] = D dt over dt seconds, by the exponential of
/// one matrix (Van Loan 1978).
inline void require_integral(const AnyMatrix& A, const AnyMatrix& D, double dt, const AnyMatrix& found_F,
                             const AnyMatrix& found_Q) {
  const Eigen::Index n = A.rows();
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  block.topLeftCorner(n, n) = -A * dt;
  block.topRightCorner(n, n) = D * dt;
  block.bottomRightCorner(n, n) = A.transpose() * dt;
  const Eigen::MatrixXd exponential = block.exp();
  const Eigen::MatrixXd F = exponential.bottomRightCorner(n, n).transpose();
  require_near_matrix(found_F, F, 1e-9);
  require_near_covariance(found_Q, F * exponential.topRightCorner(n, n), 1e-9);
}
template <class Model>
void require_integral_of(const AnyMatrix& A, const AnyMatrix& D, const Model& model, double dt) {
  require_integral(A, D, dt, model.transition(dt), model.process_covariance(dt));
}

/// `predict`, which may use the structure of a model, is the formula.
template <class Model>
void require_dense_prediction(const Model& model, double dt) {
  const auto prior = generated_gaussian<Model::state_size>();
  const auto F = dense(model.transition(dt));
  Gaussian<Model::state_size> predicted, in_place = prior;
  predict(model, prior, dt, predicted);
  predict(model, in_place, dt, in_place);
  require_near_matrix(predicted.mean, F * dense(prior.mean) + dense(model.known_input(dt)), 1e-12);
  require_near_matrix(predicted.covariance,
                      F * dense(prior.covariance) * restatement::transposed(F) + dense(model.process_covariance(dt)),
                      1e-12);
  RC_ASSERT(predicted.covariance == predicted.covariance.transpose());
  RC_ASSERT(in_place.mean == predicted.mean && in_place.covariance == predicted.covariance);
}

}  // namespace sigmax::support
