#pragma once

#include <sigmax/estimation/filtering.hpp>

/// What kalman.cpp and sigma_points.cpp ask of each other.
namespace sigmax::detail {

/// @{
/// What a filter with sigma points does instead of tangents; see the functions of these names in filtering.hpp.
void predict_by_points(const ModelRef& model, const ConstView& prior, double dt, const View& result);
void update_by_points(const ModelRef& model, const ConstView& prior, const ConstView& z, const SensorRef& sensor,
                      const View& posterior, InnovationView& innovation);
void regressed_step(const ModelRef& model, const ConstView& start, double dt, double* mean, double* F, double* Q);
void regressed_measurement(const ModelRef& model, const ConstView& predicted, const ConstView& z,
                           const SensorRef& sensor, double* residual, double* H, double* R);
/// @}

/// Throws std::domain_error, naming the function, the model and the state, a column of `states`, unless its values, a
/// column for each state, are finite.
void require_finite(const double* values, int rows, int columns, const char* function, const ModelRef& model,
                    const double* states);

/// z − predicted by the sensor's own difference, of so many z, a column each; also in the place of z.
void difference(const SensorRef& sensor, const double* z, const double* predicted, int m, int count, double* result);

/// Fills in the squared distance and the log-likelihood of an innovation whose residual and covariance S are known, and
/// gives S⁻¹. Throws as `update`.
void score(const ModelRef& model, const ConstView& z, InnovationView& innovation, double* S_inverse);

}  // namespace sigmax::detail
