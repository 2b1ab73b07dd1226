#pragma once

#include "support/sigmax.hpp"

namespace sigmax {

/// One step of a motion as a linear one about an estimate with mean m: x_k = mean + F (x_k−1 − m) + w, w ~ N(0, Q).
template <class Model>
struct LinearisedStepOf {
  StateOf<Model> mean;
  StateMatrixOf<Model> F;
  StateMatrixOf<Model> Q;
};

/// A measurement as a linear one about an estimate with mean m: residual = H (x − m) + v, v ~ N(0, R).
template <class Model, Sensing Sensor>
struct LinearisedMeasurementOf {
  MeasuredOf<Sensor> residual;
  MeasurementMatrixOf<Sensor, Model> H;
  SquareMatrix<Sensor::measurement_size, detail::max_measurement_size_of<Sensor>> R;
};

/// Of a linear motion: the step itself. Of the extended Kalman filter by the Jacobian at the mean; of a filter with
/// sigma points by regression over them, and what that leaves unexplained is noise.
template <FilterModel Model>
LinearisedStepOf<Model> linearised_step(const Model& model, const EstimateOf<Model>& start, double dt) {
  const auto n = start.size();
  LinearisedStepOf<Model> result;
  result.mean.resize(n);
  result.F.resize(n, n);
  result.Q.resize(n, n);
  detail::linearised_step(detail::model_ref(model), detail::view(start), dt, result.mean.data(), result.F.data(),
                          result.Q.data());
  return result;
}

/// Of a linear sensor the measurement itself; of another by the Jacobian at the prediction, or by regression, as the
/// model's filter has it.
template <StateModel Model, SensorOf<Model> Sensor>
LinearisedMeasurementOf<Model, Sensor> linearised_measurement(const Model& model, const EstimateOf<Model>& predicted,
                                                              const MeasurementOf<Sensor>& z, const Sensor& sensor) {
  LinearisedMeasurementOf<Model, Sensor> result;
  result.residual.resize(z.size());
  result.H.resize(z.size(), predicted.size());
  result.R.resize(z.size(), z.size());
  detail::linearised_measurement(detail::model_ref(model), detail::view(predicted), detail::view(z),
                                 detail::sensor_ref(sensor, model), result.residual.data(), result.H.data(),
                                 result.R.data());
  return result;
}

}  // namespace sigmax
