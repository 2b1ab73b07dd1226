#pragma once

#include <sigmax/estimation/filtering.hpp>

/// What a filter with sigma points does instead of tangents; see the functions of these names in filtering.hpp.
namespace sigmax::detail {

void predict_by_points(const ModelRef& model, ConstView prior, double dt, View result);
void update_by_points(const ModelRef& model, ConstView prior, ConstView z, const SensorRef& sensor, View posterior,
                      InnovationView& innovation);
void regressed_step(const ModelRef& model, ConstView start, double dt, double* mean, double* F, double* Q);
void regressed_measurement(const ModelRef& model, ConstView predicted, ConstView z, const SensorRef& sensor,
                           double* residual, double* H, double* R);

/// Fills in the squared distance and the log-likelihood of an innovation whose residual and covariance S are known, and
/// gives S⁻¹. Throws as `update`.
void score(const ModelRef& model, ConstView z, InnovationView& innovation, double* S_inverse);

}  // namespace sigmax::detail
