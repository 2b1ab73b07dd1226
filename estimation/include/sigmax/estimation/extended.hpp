#pragma once

#include <utility>

#include <sigmax/estimation/kalman.hpp>
#include <sigmax/estimation/member.hpp>

namespace sigmax {

/// The extended Kalman filter over a motion: f and h are replaced by their tangents at the estimate. As a mode of a
/// multiple-model filter, or by itself with `predict` and `update`.
///
///     const Extended filter{CoordinatedTurn<3>{1.0, 1e-4}};
///     update(filter, x, z, PolarSensor<3>{}, x);
///
/// Jacobians are the motion's and the sensor's own, else by automatic differentiation (Bar-Shalom, Li, Kirubarajan
/// 2001, 10.3). The update is that of kalman.hpp, which a linear motion has without this wrapper.
template <Motion Moves>
class Extended : public Member<Moves> {
 public:
  explicit Extended(Moves motion) : Member<Moves>(std::move(motion)) {}

  /// The same filter over another motion.
  template <Motion Other>
  Extended<Other> over(Other motion) const {
    return Extended<Other>(std::move(motion));
  }
};

/// x = f(x), P = F P Fᵀ + Q with F = ∂f/∂x. `result` may be `prior`.
/// Throws std::domain_error if f or its Jacobian is not finite, naming the model and the state.
template <Motion Moves>
void predict(const Extended<Moves>& member, const EstimateOf<Moves>& prior, double dt, EstimateOf<Moves>& result) {
  const Moves& motion = member.motion();
  if constexpr (LinearMotion<Moves>) {
    predict(motion, prior, dt, result);
  } else if constexpr (detail::ChosenMotion<Moves>) {
    detail::predict_as_chosen(member, prior, dt, result);
  } else {
    const auto F = transition_jacobian(motion, prior.mean, dt);
    result.mean = propagated(motion, prior.mean, dt);
    detail::predict_covariance(F, motion.process_covariance(dt), prior.covariance, result.covariance);
  }
}

/// The update of kalman.hpp.
template <Motion Moves, SensorOf<Moves> Sensor>
InnovationOf<Sensor> update(const Extended<Moves>& member, const EstimateOf<Moves>& prior,
                            const MeasurementOf<Sensor>& measurement, const Sensor& sensor,
                            EstimateOf<Moves>& posterior) {
  return update(member.motion(), prior, measurement, sensor, posterior);
}

/// Cov(x_k−1, x_k | z_1:k−1) = P Fᵀ, for smoothing.
template <Motion Moves>
StateMatrixOf<Moves> prediction_covariance(const Extended<Moves>& member, const EstimateOf<Moves>& prior, double dt) {
  if constexpr (detail::ChosenMotion<Moves>)
    return detail::covariance_as_chosen(member, prior, dt);
  else
    return prior.covariance * transition_jacobian(member.motion(), prior.mean, dt).transpose();
}

}  // namespace sigmax
