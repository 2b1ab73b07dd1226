#pragma once

#include <sigmax/estimation/filtering.hpp>
#include <sigmax/estimation/sensor_ref.hpp>
#include <sigmax/estimation/sensors.hpp>

namespace sigmax {

/// The innovation of a measurement: its difference from the prediction.
template <int M, int MaxM = M>
struct Innovation {
  Vector<M, MaxM> residual;          ///< ν = z − h(x)
  SquareMatrix<M, MaxM> covariance;  ///< S, (31)
  double squared_distance = 0.0;     ///< d² = νᵀ S⁻¹ ν, the NIS
  double log_likelihood = 0.0;       ///< log N(ν; 0, S)
};

/// The innovation of a sensor's measurement.
template <Sensing Sensor>
using InnovationOf = Innovation<Sensor::measurement_size, detail::max_measurement_size_of<Sensor>>;

/// A model that has a prediction: a linear motion, or any motion in a member of the Kalman family.
template <class Model>
concept FilterModel = StateModel<Model> &&(
    LinearMotion<Model> || requires(const Model& model) { model.ref(); } || requires { typename Model::MotionType; });

/// Prediction: of a linear motion (27) and (28), x = F x + u, P = F P Fᵀ + G Q Gᵀ. Of another with `Extended` x = f(x)
/// and F = ∂f/∂x; with sigma points χ x = Σ wᵢ f(χᵢ), P = Σ wᵢ (f(χᵢ) − x)(·)ᵀ + Q. `result` may be `prior`.
/// Throws std::domain_error if f or its Jacobian is not finite, or a covariance whose points are wanted is not positive
/// semi-definite, naming the model.
template <FilterModel Model>
void predict(const Model& model, const EstimateOf<Model>& prior, double dt, EstimateOf<Model>& result) {
  detail::predict(detail::model_ref(model), detail::view(prior), dt, detail::sized_view(result, prior.size()));
}

/// Cov(x_k−1, x_k | z_1:k−1) = P Fᵀ, n × n: what a smoother needs of a prediction beside its result.
template <FilterModel Model>
StateMatrixOf<Model> prediction_covariance(const Model& model, const EstimateOf<Model>& prior, double dt) {
  const auto n = prior.size();
  StateMatrixOf<Model> result(n, n);
  detail::prediction_covariance(detail::model_ref(model), detail::view(prior), dt, result.data());
  return result;
}

/// Update, (29), (31), (32), and instead of (30) Joseph's form (I − WH) P (I − WH)ᵀ + W R Wᵀ, which keeps P symmetric
/// and positive semi-definite. Of a sensor that is not linear, H = ∂h/∂x and ν = z − h(x) at the prior's mean, by the
/// sensor's own difference: the extended Kalman filter's update.
///
/// A member with sigma points draws them anew over the prediction: z̄ = Σ wᵢ h(χᵢ), S = Σ wᵢ (h(χᵢ) − z̄)(·)ᵀ + R,
/// W = Σ wᵢ (χᵢ − x)(h(χᵢ) − z̄)ᵀ S⁻¹, and instead of P − W S Wᵀ it has the equal sum of squares
/// Σ wᵢ (χᵢ − x − W (h(χᵢ) − z̄))(·)ᵀ + W R Wᵀ; where h is linear this is Joseph's form, and is computed so.
///
/// `posterior` may be `prior`. Throws std::domain_error if h or its Jacobian is not finite, S is not positive definite,
/// or the prior not finite or, for points, not positive semi-definite; std::invalid_argument if the measurement is not
/// finite. All name the model.
template <StateModel Model, SensorOf<Model> Sensor>
InnovationOf<Sensor> update(const Model& model, const EstimateOf<Model>& prior,
                            const MeasurementOf<Sensor>& measurement, const Sensor& sensor,
                            EstimateOf<Model>& posterior) {
  const auto m = measurement.size();
  InnovationOf<Sensor> innovation;
  innovation.residual.resize(m);
  innovation.covariance.resize(m, m);
  detail::InnovationView view{innovation.residual.data(), innovation.covariance.data()};
  detail::update(detail::model_ref(model), detail::view(prior), detail::view(measurement),
                 detail::sensor_ref(sensor, model), detail::sized_view(posterior, prior.size()), view);
  innovation.squared_distance = view.squared_distance;
  innovation.log_likelihood = view.log_likelihood;
  return innovation;
}

/// Update by a measurement of the position, which leads the state.
template <StateModel Model>
  requires(axes_of<Model> > 0)
Innovation<Model::axes> update(const Model& model, const EstimateOf<Model>& prior,
                               const Gaussian<Model::axes>& measurement, EstimateOf<Model>& posterior) {
  return update(model, prior, measurement, PositionSensor<Model::axes>{}, posterior);
}

/// Update by what says by which sensor it was measured.
template <StateModel Model, SensorOf<Model> Sensor>
InnovationOf<Sensor> update(const Model& model, const EstimateOf<Model>& prior, const MeasuredBy<Sensor>& measured,
                            EstimateOf<Model>& posterior) {
  return update(model, prior, measured.z, measured.sensor, posterior);
}

/// @{
/// The same verbs, returning the estimate.
template <FilterModel Model>
EstimateOf<Model> predict(const Model& model, const EstimateOf<Model>& prior, double dt) {
  EstimateOf<Model> result = prior;
  predict(model, prior, dt, result);
  return result;
}
template <StateModel Model, SensorOf<Model> Sensor>
EstimateOf<Model> update(const Model& model, const EstimateOf<Model>& prior, const MeasurementOf<Sensor>& measurement,
                         const Sensor& sensor) {
  EstimateOf<Model> result = prior;
  update(model, prior, measurement, sensor, result);
  return result;
}
template <StateModel Model>
  requires(axes_of<Model> > 0)
EstimateOf<Model> update(const Model& model, const EstimateOf<Model>& prior, const Gaussian<Model::axes>& measurement) {
  return update(model, prior, measurement, PositionSensor<Model::axes>{});
}
/// @}

}  // namespace sigmax
