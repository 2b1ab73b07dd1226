#pragma once

#include <sigmax/estimation/refs.hpp>

/// The Kalman family in plain numbers, compiled once: what the verbs of kalman.hpp call. Results may be what they are
/// made of; if something is thrown, they are as they were.
namespace sigmax::detail {

/// The innovation of m quantities, to be written.
struct InnovationView {
  double* residual;
  double* covariance;
  double squared_distance = 0.0;
  double log_likelihood = 0.0;
};

/// Prediction, (27) and (28). Throws std::invalid_argument for an estimate of another size than the model's,
/// std::domain_error if f or its Jacobian is not finite or a covariance not positive semi-definite, naming the model.
void predict(const ModelRef& model, const ConstView& prior, double dt, const View& result);

/// The same with the law at hand, of a motion along independent axes.
void predict(const AxisLaw& law, int axes, const ConstView& prior, const View& result);

/// Update, (29)–(32); throws as sigmax::update.
void update(const ModelRef& model, const ConstView& prior, const ConstView& z, const SensorRef& sensor,
            const View& posterior, InnovationView& innovation);

/// x_k = mean + F (x_{k−1} − m) + w, w ~ N(0, Q), about an estimate with mean m.
void linearised_step(const ModelRef& model, const ConstView& start, double dt, double* mean, double* F, double* Q);

/// Cov(x_k−1, x_k) = P Fᵀ with that F.
void prediction_covariance(const ModelRef& model, const ConstView& prior, double dt, double* result);

/// A step of the smoother of Rauch, Tung and Striebel, see sigmax::smooth_step.
void smooth_step(const ModelRef& model, const ConstView& filtered, double dt, const ConstView& next,
                 const View& result);

/// residual = H (x − m) + v, v ~ N(0, R), about an estimate with mean m; H has a column for each component.
void linearised_measurement(const ModelRef& model, const ConstView& predicted, const ConstView& z,
                            const SensorRef& sensor, double* residual, double* H, double* R);

/// p → A p + b of the position along `axes` axes, which leads the state, and A p of its derivatives; A by columns.
void transform(const double* A, const double* b, int axes, const View& estimate);

}  // namespace sigmax::detail
