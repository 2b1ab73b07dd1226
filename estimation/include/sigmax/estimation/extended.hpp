#pragma once

#include <utility>

#include <sigmax/estimation/kalman.hpp>
#include <sigmax/estimation/member.hpp>

namespace sigmax {

/// The extended Kalman filter over a model: f and h are replaced by their tangents at the estimate. As a mode of a
/// multiple-model filter, or by itself with `predict` and `update`.
///
///     const Extended filter{Observed{dwna<3>(3.0), PolarSensor<3>{}}};
///
/// Jacobians are the model's own, else by automatic differentiation (Bar-Shalom, Li, Kirubarajan 2001, 10.3).
template <NonlinearModel Model>
class Extended : public Member<Model> {
 public:
  explicit Extended(Model model) : Member<Model>(std::move(model)) {}
};

/// x = f(x), P = F P Fᵀ + Q with F = ∂f/∂x. `result` may be `prior`.
/// Throws std::domain_error if f or its Jacobian is not finite, naming the model and the state.
template <NonlinearModel Model>
void predict(const Extended<Model>& member, const EstimateOf<Model>& prior, double dt, EstimateOf<Model>& result) {
  const Model& model = member.model();
  if constexpr (LinearMotion<Model>) {
    predict(model, prior, dt, result);
  } else {
    const auto F = transition_jacobian(model, prior.mean, dt);
    result.mean = propagated(model, prior.mean, dt);
    detail::predict_covariance(F, model.process_covariance(dt), prior.covariance, result.covariance);
  }
}

/// Cov(x_k−1, x_k | z_1:k−1) = P Fᵀ, for smoothing.
template <NonlinearModel Model>
SquareMatrix<Model::state_size, Model::max_state_size> prediction_covariance(const Extended<Model>& member,
                                                                             const EstimateOf<Model>& prior,
                                                                             double dt) {
  return prior.covariance * transition_jacobian(member.model(), prior.mean, dt).transpose();
}

/// The Kalman filter's update, in Joseph's form, with H = ∂h/∂x and the model's own difference z − h(x).
/// `posterior` may be `prior`. Throws std::domain_error if h, its Jacobian or the prior is not finite or S is not
/// positive definite, std::invalid_argument if the measurement is not finite, naming the model.
template <NonlinearModel Model>
Innovation<Model::measurement_size> update(const Extended<Model>& member, const EstimateOf<Model>& prior,
                                           const MeasurementOf<Model>& measurement, EstimateOf<Model>& posterior) {
  const Model& model = member.model();
  const auto H = measurement_jacobian(model, prior.mean);
  const auto residual = measurement_difference(model, measurement.mean, predicted_measurement(model, prior.mean));
  return detail::update_by(model, H, residual, prior, measurement, posterior);
}

}  // namespace sigmax
