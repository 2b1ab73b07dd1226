#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <sigmax/estimation/covariance_root.hpp>
#include <sigmax/estimation/dense.hpp>
#include <sigmax/estimation/filtering.hpp>
#include <sigmax/estimation/motion_numbers.hpp>

#include "kernels/kernels.hpp"
#include "sigma_points.hpp"

namespace sigmax::detail {
namespace {

void require_size(const ModelRef& model, int n) {
  if (n != model.size())
    throw std::invalid_argument("an estimate of model '" + model.name() + "' has " + std::to_string(n) +
                                " components; expected " + std::to_string(model.size()));
}

/// The number of components that a sensor of m quantities sees of a model: leading ones, or all.
int seen_of(const SensorRef& sensor, const ModelRef& model, int n, int m) {
  const int seen = sensor.table->seen(sensor.sensor);
  if (sensor.table->leading && seen != m)
    throw std::invalid_argument("a measurement of " + std::to_string(m) + " quantities by a sensor of " +
                                std::to_string(seen));
  if (seen > n)
    throw std::invalid_argument("a sensor sees " + std::to_string(seen) + " components, but model '" + model.name() +
                                "' has " + std::to_string(n));
  return seen == 0 ? n : seen;
}

/// f(x), ∂f/∂x and the noise's covariance. Throws std::domain_error unless they are finite.
void moved_from(const ModelRef& model, const double* x, double dt, double* image, double* F, double* Q) {
  const int n = model.size();
  Scratch moved(n);
  model.table->tangent(model.motion, x, dt, moved, F, Q);
  if (model.linear()) multiply(F, n, columns_of(x, n), moved, n, n, n, 1, Into::plus);
  std::copy_n(moved.data(), n, image);
  require_finite(image, n, 1, "f(x)", model, x);
  require_finite(F, n * n, 1, "the Jacobian of f", model, x);
}

/// Throws std::domain_error or std::invalid_argument, naming the model, unless there is a result.
void require(Outcome outcome, const ModelRef& model) {
  if (outcome == Outcome::measurement_not_finite)
    throw std::invalid_argument("a measurement of model '" + model.name() + "', or its covariance, is not finite");
  if (outcome == Outcome::estimate_not_finite)
    throw std::domain_error("the estimate of model '" + model.name() + "' is not finite");
  if (outcome == Outcome::not_positive_definite)
    throw std::domain_error("the innovation covariance of model '" + model.name() + "' is not positive definite");
}

/// H of a sensor over what it sees, and z − h(x).
void tangent_of(const ModelRef& model, const SensorRef& sensor, int seen, const double* x, const ConstView& z,
                double* H, double* residual) {
  const SensorTable& table = *sensor.table;
  table.measure(sensor.sensor, sensor.model, x, model.size(), z.n, nullptr, H);
  require_finite(H, z.n * seen, 1, "the Jacobian of h", model, x);
  if (table.linear) {
    std::copy_n(z.mean, z.n, residual);
    multiply(H, z.n, columns_of(x, seen), residual, z.n, z.n, seen, 1, Into::minus);
  } else {
    Scratch<6> predicted(z.n);
    table.measure(sensor.sensor, sensor.model, x, model.size(), z.n, predicted, nullptr);
    require_finite(predicted, z.n, 1, "h(x)", model, x);
    difference(sensor, z.mean, predicted, z.n, 1, residual);
  }
}

}  // namespace

void score(const ModelRef& model, const ConstView& z, InnovationView& innovation, double* S_inverse) {
  require(kernels().score(z, innovation, S_inverse), model);
}

void predict(const AxisLaw& law, int axes, const ConstView& prior, const View& result) {
  kernels().predict(law, axes, prior, result);
}

void predict(const ModelRef& model, const ConstView& prior, double dt, const View& result) {
  require_size(model, prior.n);
  const int n = prior.n;
  if (model.table->law) {
    AxisLaw law;
    model.table->law(model.motion, dt, law);
    return predict(law, model.table->axes, prior, result);
  }
  if (!model.linear() && model.by_points()) return predict_by_points(model, prior, dt, result);
  Scratch F(n * n), Q(n * n), image(n);
  linearised_step(model, prior, dt, image, F, Q);
  kernels().predict_covariance(F, Q, prior.covariance, n, result.covariance);
  std::copy_n(image.data(), n, result.mean);
}

void update(const ModelRef& model, const ConstView& prior, const ConstView& z, const SensorRef& sensor,
            const View& posterior, InnovationView& innovation) {
  require_size(model, prior.n);
  const int m = z.n;
  const int seen = seen_of(sensor, model, prior.n, m);
  if (sensor.table->leading) {
    for (int i = 0; i < m; ++i) innovation.residual[i] = z.mean[i] - prior.mean[i];
    return require(kernels().update(nullptr, seen, prior, z, posterior, innovation), model);
  }
  if (!sensor.table->linear && model.by_points())
    return update_by_points(model, prior, z, sensor, posterior, innovation);
  Scratch<64> H(m * seen);
  tangent_of(model, sensor, seen, prior.mean, z, H, innovation.residual);
  require(kernels().update(H, seen, prior, z, posterior, innovation), model);
}

void linearised_step(const ModelRef& model, const ConstView& start, double dt, double* mean, double* F, double* Q) {
  require_size(model, start.n);
  if (!model.linear() && model.by_points()) return regressed_step(model, start, dt, mean, F, Q);
  moved_from(model, start.mean, dt, mean, F, Q);
}

void prediction_covariance(const ModelRef& model, const ConstView& prior, double dt, double* result) {
  const int n = prior.n;
  Scratch mean(n), F(n * n), Q(n * n);
  linearised_step(model, prior, dt, mean, F, Q);
  multiply(prior.covariance, n, transposed(F, n), result, n, n, n, n);
}

void smooth_step(const ModelRef& model, const ConstView& filtered, double dt, const ConstView& next,
                 const View& result) {
  const int n = filtered.n;
  require_size(model, next.n);
  Scratch mean(n), covariance(n * n), A(n * n), root(n * n), row(n), product(n * n);
  predict(model, filtered, dt, {mean, covariance, n});
  prediction_covariance(model, filtered, dt, A);
  if (covariance_root(covariance, n, root) != 0)
    throw std::domain_error("the predicted covariance of model '" + model.name() + "' is not positive semi-definite");
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) row[k] = A[i + k * n];
    solve_by_root(root, n, row);
    for (int k = 0; k < n; ++k) A[i + k * n] = row[k];
  }
  double* const moved = mean;
  double* const gained = covariance;
  for (int i = 0; i < n; ++i) moved[i] = next.mean[i] - mean[i];
  for (int i = 0; i < n * n; ++i) gained[i] = next.covariance[i] - covariance[i];
  multiply(gained, n, transposed(A, n), product, n, n, n, n);
  if (result.mean != filtered.mean) {
    std::copy_n(filtered.mean, n, result.mean);
    std::copy_n(filtered.covariance, n * n, result.covariance);
  }
  multiply(A, n, columns_of(moved, n), result.mean, n, n, n, 1, Into::plus);
  multiply(A, n, columns_of(product, n), result.covariance, n, n, n, n, Into::plus);
  mirror_lower(result.covariance, n);
}

void linearised_measurement(const ModelRef& model, const ConstView& predicted, const ConstView& z,
                            const SensorRef& sensor, double* residual, double* H, double* R) {
  const int n = predicted.n, m = z.n;
  require_size(model, n);
  const int seen = seen_of(sensor, model, n, m);
  if (!sensor.table->linear && model.by_points())
    return regressed_measurement(model, predicted, z, sensor, residual, H, R);
  std::copy_n(z.covariance, m * m, R);
  std::fill_n(H, m * n, 0.0);
  if (sensor.table->leading) {
    for (int i = 0; i < m; ++i) {
      H[i + i * m] = 1.0;
      residual[i] = z.mean[i] - predicted.mean[i];
    }
    return;
  }
  tangent_of(model, sensor, seen, predicted.mean, z, H, residual);
}

void require_finite(const double* values, int rows, int columns, const char* function, const ModelRef& model,
                    const double* states) {
  const double* const end = values + rows * columns;
  const auto not_finite = std::find_if_not(values, end, [](double value) { return std::isfinite(value); });
  if (not_finite == end) return;
  const double* const x = states + (not_finite - values) / rows * model.size();
  std::string message = std::string(function) + " of model '" + model.name() + "' is not finite at x = (";
  for (int i = 0; i < model.size(); ++i) message += (i == 0 ? "" : ", ") + std::to_string(x[i]);
  throw std::domain_error(message + ")");
}

void difference(const SensorRef& sensor, const double* z, const double* predicted, int m, int count, double* result) {
  if (sensor.table->difference) return sensor.table->difference(sensor.sensor, z, predicted, m, count, result);
  for (int i = 0; i < m * count; ++i) result[i] = z[i] - predicted[i % m];
}

void transform(const double* A, const double* b, int axes, const View& estimate) {
  const int n = estimate.n;
  Scratch all(n * n), product(n * n), mean(n);
  std::fill_n(all.data(), n * n, 0.0);
  for (int i = 0; i < n; ++i) all[i + i * n] = 1.0;
  for (int d = 0; d + axes <= n; d += axes)
    for (int k = 0; k < axes; ++k)
      for (int i = 0; i < axes; ++i) all[d + i + (d + k) * n] = A[i + k * axes];
  multiply(all, n, columns_of(estimate.mean, n), mean, n, n, n, 1);
  for (int i = 0; i < n; ++i) estimate.mean[i] = mean[i] + (i < axes ? b[i] : 0.0);
  multiply(all, n, columns_of(estimate.covariance, n), product, n, n, n, n);
  multiply(product, n, transposed(all, n), estimate.covariance, n, n, n, n);
  mirror_lower(estimate.covariance, n);
}

}  // namespace sigmax::detail
