#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include <sigmax/estimation/covariance_root.hpp>
#include <sigmax/estimation/dense.hpp>
#include <sigmax/estimation/filtering.hpp>
#include <sigmax/estimation/motion_numbers.hpp>

#include "products.hpp"
#include "sigma_points.hpp"

namespace sigmax::detail {
namespace {

/// What the sums and products of one step may lose of the terms that they are made of.
constexpr double rounding = 128.0 * std::numeric_limits<double>::epsilon();

bool all_finite(const double* numbers, int count) {
  return std::all_of(numbers, numbers + count, [](double number) { return std::isfinite(number); });
}

/// Throws std::domain_error, naming the function, the model and the state, unless the values are finite.
void require_finite(const double* values, int count, const char* function, const ModelRef& model, const double* x) {
  if (all_finite(values, count)) return;
  std::string message = std::string(function) + " of model '" + model.name() + "' is not finite at x = (";
  for (int i = 0; i < model.size(); ++i) message += (i == 0 ? "" : ", ") + std::to_string(x[i]);
  throw std::domain_error(message + ")");
}

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

/// F, Q and the known input of a linear motion.
void linear_motion(const ModelRef& model, double dt, double* F, double* Q, double* input) {
  if (!model.table->law) return model.table->linear(model.motion, dt, F, Q, input);
  AxisLaw law;
  model.table->law(model.motion, dt, law);
  spread_over_axes(law.F, law.order, model.table->axes, F);
  spread_over_axes(law.Q, law.order, model.table->axes, Q);
  std::copy_n(law.input, law.order * model.table->axes, input);
}

/// P = F P Fᵀ + Q, each variance with the rounding of the terms of F P Fᵀ, before they may cancel.
void predict_covariance(const double* F, const double* Q, const double* P, int n, double* result) {
  Scratch FP(n * n), sum(n * n), terms(n);
  multiply(F, n, columns_of(P, n), FP, n, n, n, n);
  for (int i = 0; i < n; ++i) terms[i] = 0.0;
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i) terms[i] += F[i + k * n] * F[i + k * n] * P[k + k * n];
  std::copy_n(Q, n * n, sum.data());
  multiply(FP, n, transposed(F, n), sum, n, n, n, n, Into::plus);
  for (int i = 0; i < n; ++i) sum[i + i * n] += rounding * terms[i];
  mirror_lower(sum, n);
  std::copy_n(sum.data(), n * n, result);
}

/// (27), (28) with F = F_s ⊗ I and F_s upper triangular: blocks are added, nothing is multiplied by zero or by one.
template <int Axes>
void predict_axes(const AxisLaw& law, double* x, double* P) {
  const int order = law.order, n = Axes * order;
  double terms[9];  // of the variances of F P Fᵀ, before they may cancel
  for (int i = 0; i < n; ++i) terms[i] = P[i + i * n];
  for (int a = 0; a < order; ++a) {  // the rows of a, while those below are unchanged, and then the columns likewise
    const double scale = law.F[a + a * order];
    double* const row = P + a * Axes;
    if (scale != 1.0) {
      for (int i = 0; i < Axes; ++i) {
        x[a * Axes + i] *= scale;
        terms[a * Axes + i] *= scale * scale;
      }
      for (int k = 0; k < n; ++k)
        for (int i = 0; i < Axes; ++i) row[i + k * n] *= scale;
    }
    for (int b = a + 1; b < order; ++b) {
      const double f = law.F[a + b * order];
      const double* const other = P + b * Axes;
      for (int i = 0; i < Axes; ++i) {
        x[a * Axes + i] += f * x[b * Axes + i];
        terms[a * Axes + i] += f * f * terms[b * Axes + i];
      }
      for (int k = 0; k < n; ++k)
        for (int i = 0; i < Axes; ++i) row[i + k * n] += f * other[i + k * n];
    }
  }
  for (int a = 0; a < order; ++a) {
    const double scale = law.F[a + a * order];
    double* const columns = P + a * Axes * n;
    if (scale != 1.0)
      for (int k = 0; k < Axes * n; ++k) columns[k] *= scale;
    for (int b = a + 1; b < order; ++b) {
      const double f = law.F[a + b * order];
      const double* const others = P + b * Axes * n;
      for (int k = 0; k < Axes * n; ++k) columns[k] += f * others[k];
    }
  }
  for (int i = 0; i < n; ++i) {
    x[i] += law.input[i];
    for (int b = 0; b < order; ++b) P[i + (i % Axes + b * Axes) * n] += law.Q[i / Axes + b * order];
    P[i + i * n] += rounding * terms[i];
  }
  mirror_lower(P, n);
}

/// Cholesky's factor of S. A pivot that drowned in the rounding of S, as where one model's spread is 10⁸ times as wide
/// as the measurement, is lifted above it.
template <int M>
bool factorise(double* S, int m, double* L) {
  bool drowned = !cholesky_factor<M>(S, m, L);
  for (int k = 0; !drowned && k < m; ++k) drowned = !(L[k + k * m] * L[k + k * m] >= rounding * S[k + k * m]);
  if (!drowned) return true;
  for (int k = 0; k < m; ++k) S[k + k * m] *= 1.0 + rounding;
  return cholesky_factor<M>(S, m, L);
}

/// As `score`, of as many quantities as the compiler knows, if M is not 0.
template <int M>
void scored(const ModelRef& model, ConstView z, InnovationView& innovation, double* S_inverse) {
  const int m = M > 0 ? M : z.n;
  Scratch<36> L(m * m), L_inverse(m * m);
  if (!factorise<M>(innovation.covariance, m, L))
    throw std::domain_error("the innovation covariance of model '" + model.name() + "' is not positive definite");
  lower_inverse<M>(L, m, L_inverse);  // S⁻¹ = L⁻ᵀ L⁻¹
  double distance = 0.0, log_root = 0.0;
  for (int i = 0; i < m; ++i) {
    double whitened = 0.0;
    for (int k = 0; k <= i; ++k) whitened += L_inverse[i + k * m] * innovation.residual[k];
    distance += whitened * whitened;
    log_root += std::log(L[i + i * m]);
  }
  innovation.squared_distance = distance;
  innovation.log_likelihood = -0.5 * distance - log_root - 0.5 * m * std::log(2.0 * std::numbers::pi);
  if (!std::isfinite(distance)) {  // infinite also for a finite measurement that is too far off
    if (!all_finite(z.mean, m) || !all_finite(z.covariance, m * m))
      throw std::invalid_argument("a measurement of model '" + model.name() + "', or its covariance, is not finite");
    if (!all_finite(innovation.residual, m) || !all_finite(innovation.covariance, m * m))
      throw std::domain_error("the estimate of model '" + model.name() + "' is not finite");
    innovation.squared_distance = std::numeric_limits<double>::infinity();  // where terms of both signs overflowed
    innovation.log_likelihood = -innovation.squared_distance;
  }
  for (int k = 0; k < m; ++k)
    for (int i = 0; i < m; ++i) {
      double sum = 0.0;
      for (int j = std::max(i, k); j < m; ++j) sum += L_inverse[j + i * m] * L_inverse[j + k * m];
      S_inverse[i + k * m] = sum;
    }
}

}  // namespace

void score(const ModelRef& model, ConstView z, InnovationView& innovation, double* S_inverse) {
  if (z.n == 1) return scored<1>(model, z, innovation, S_inverse);
  if (z.n == 2) return scored<2>(model, z, innovation, S_inverse);
  if (z.n == 3) return scored<3>(model, z, innovation, S_inverse);
  scored<0>(model, z, innovation, S_inverse);
}

namespace {

/// Joseph's update, (I − WH) P (I − WH)ᵀ + W R Wᵀ, block by block: of the k components that are seen, for which H (m ×
/// k) has columns, and of the others. I − W [H 0] = [A 0; −B I]. Without H, which is [I 0] then, A is R S⁻¹, which does
/// not cancel. If K is not 0, it is k and m, and n is K + Rest.
template <int K, int Rest>
void update_by(const ModelRef& model, const double* H, int seen, ConstView prior, ConstView z, View posterior,
               InnovationView& innovation) {
  constexpr int N = K + Rest;
  const int k = K > 0 ? K : seen, n = K > 0 ? N : prior.n, m = K > 0 ? K : z.n, rest = n - k;
  const double* const P = prior.covariance;
  const double* const R = z.covariance;
  Scratch PHt_(n * m), W_(n * m), WR_(n * m), B_(n * k), C_(n * k), result_(n * n), terms_(n);
  Scratch<36> S_inverse_(m * m), A_(k * k), AP_(k * k);
  double *W = W_, *WR = WR_, *B = B_, *C = C_, *result = result_, *terms = terms_;
  double *S_inverse = S_inverse_, *A = A_, *AP = AP_;
  const double* PHt = P;  // its leading columns, if H has none
  if (H) {
    multiply<N, K>(P, n, transposed(H, m), PHt_, n, n, k, m);
    PHt = PHt_;
    std::copy_n(R, m * m, innovation.covariance);
    multiply<K, K>(H, m, {PHt, 1, n}, innovation.covariance, m, m, k, m, Into::plus);
  } else {
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i) innovation.covariance[i + j * m] = P[i + j * n] + R[i + j * m];
  }
  score(model, z, innovation, S_inverse);
  multiply<N, K>(PHt, n, columns_of(S_inverse, m), W, n, n, m, m);
  multiply<N, K>(W, n, columns_of(R, m), WR, n, n, m, m);
  if (H) {
    std::fill_n(A, k * k, 0.0);
    for (int i = 0; i < k; ++i) A[i + i * k] = 1.0;
    multiply<K, K>(W, n, columns_of(H, m), A, k, k, m, k, Into::minus);
    multiply<Rest, K>(W + k, n, columns_of(H, m), B, rest, rest, m, k);
  } else {
    multiply<K, K>(R, m, columns_of(S_inverse, m), A, m, m, m, m);
    for (int j = 0; j < k; ++j) std::copy_n(W + k + j * n, rest, B + j * rest);
  }

  // The blocks of the result on and below the diagonal.
  multiply<K, K>(A, k, {P, 1, n}, AP, k, k, k, k);
  multiply<K, K>(AP, k, transposed(A, k), result, n, k, k, k);
  multiply<K, K>(WR, n, transposed(W, n), result, n, k, m, k, Into::plus);
  for (int j = 0; j < k; ++j) std::copy_n(P + k + j * n, rest, C + j * rest);
  multiply<Rest, K>(B, rest, {P, 1, n}, C, rest, rest, k, k, Into::minus);
  multiply<Rest, K>(C, rest, transposed(A, k), result + k, n, rest, k, k);
  multiply<Rest, K>(WR + k, n, transposed(W, n), result + k, n, rest, m, k, Into::plus);
  for (int j = 0; j < rest; ++j) std::copy_n(P + k + (k + j) * n, rest, result + k + (k + j) * n);
  multiply<Rest, K>(B, rest, {P + k * n, 1, n}, result + k + k * n, n, rest, k, rest, Into::minus);
  multiply<Rest, K>(C, rest, transposed(B, rest), result + k + k * n, n, rest, k, rest, Into::minus);
  multiply<Rest, K>(WR + k, n, {W + k, n, 1}, result + k + k * n, n, rest, m, rest, Into::plus);

  for (int i = 0; i < n; ++i) terms[i] = i < k ? 0.0 : P[i + i * n];  // of the variances, before they may cancel
  for (int j = 0; j < k; ++j) {
    const double variance = P[j + j * n];
    for (int i = 0; i < k; ++i) terms[i] += A[i + j * k] * A[i + j * k] * variance;
    for (int i = 0; i < rest; ++i) terms[k + i] += B[i + j * rest] * B[i + j * rest] * variance;
  }
  for (int i = 0; i < n; ++i) result[i + i * n] += rounding * terms[i];
  mirror_lower(result, n);

  if (posterior.mean != prior.mean) std::copy_n(prior.mean, n, posterior.mean);
  multiply<N, K>(W, n, columns_of(innovation.residual, m), posterior.mean, n, n, m, 1, Into::plus);
  std::copy_n(result, n * n, posterior.covariance);
}

/// The same: the compiler knows the sizes where as many quantities are measured as there are axes.
template <int Axes>
void update_along(const ModelRef& model, const double* H, ConstView prior, ConstView z, View posterior,
                  InnovationView& innovation) {
  if (prior.n == 2 * Axes) return update_by<Axes, Axes>(model, H, Axes, prior, z, posterior, innovation);
  if (prior.n == 2 * Axes + 1) return update_by<Axes, Axes + 1>(model, H, Axes, prior, z, posterior, innovation);
  if (prior.n == 3 * Axes) return update_by<Axes, 2 * Axes>(model, H, Axes, prior, z, posterior, innovation);
  update_by<0, 0>(model, H, Axes, prior, z, posterior, innovation);
}

void update_by_any(const ModelRef& model, const double* H, int seen, ConstView prior, ConstView z, View posterior,
                   InnovationView& innovation) {
  if (seen == z.n && seen == 1) return update_along<1>(model, H, prior, z, posterior, innovation);
  if (seen == z.n && seen == 2) return update_along<2>(model, H, prior, z, posterior, innovation);
  if (seen == z.n && seen == 3) return update_along<3>(model, H, prior, z, posterior, innovation);
  update_by<0, 0>(model, H, seen, prior, z, posterior, innovation);
}

/// H of a sensor over what it sees, and z − h(x).
void tangent_of(const ModelRef& model, const SensorRef& sensor, int seen, const double* x, ConstView z, double* H,
                double* residual) {
  const SensorTable& table = *sensor.table;
  table.measure(sensor.sensor, sensor.model, x, model.size(), z.n, nullptr, H);
  require_finite(H, z.n * seen, "the Jacobian of h", model, x);
  if (table.linear) {
    std::copy_n(z.mean, z.n, residual);
    multiply(H, z.n, columns_of(x, seen), residual, z.n, z.n, seen, 1, Into::minus);
  } else {
    Scratch<6> predicted(z.n);
    measured_at(model, sensor, x, z.n, predicted);
    difference(sensor, z.mean, predicted, z.n, residual);
  }
}

}  // namespace

void predict(const AxisLaw& law, int axes, ConstView prior, View result) {
  if (result.mean != prior.mean) {
    std::copy_n(prior.mean, prior.n, result.mean);
    std::copy_n(prior.covariance, prior.n * prior.n, result.covariance);
  }
  if (axes == 1)
    predict_axes<1>(law, result.mean, result.covariance);
  else if (axes == 2)
    predict_axes<2>(law, result.mean, result.covariance);
  else
    predict_axes<3>(law, result.mean, result.covariance);
}

void predict(const ModelRef& model, ConstView prior, double dt, View result) {
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
  predict_covariance(F, Q, prior.covariance, n, result.covariance);
  std::copy_n(image.data(), n, result.mean);
}

void update(const ModelRef& model, ConstView prior, ConstView z, const SensorRef& sensor, View posterior,
            InnovationView& innovation) {
  require_size(model, prior.n);
  const int m = z.n;
  const int seen = seen_of(sensor, model, prior.n, m);
  if (sensor.table->leading) {
    for (int i = 0; i < m; ++i) innovation.residual[i] = z.mean[i] - prior.mean[i];
    return update_by_any(model, nullptr, seen, prior, z, posterior, innovation);
  }
  if (!sensor.table->linear && model.by_points())
    return update_by_points(model, prior, z, sensor, posterior, innovation);
  Scratch<64> H(m * seen);
  tangent_of(model, sensor, seen, prior.mean, z, H, innovation.residual);
  update_by_any(model, H, seen, prior, z, posterior, innovation);
}

void linearised_step(const ModelRef& model, ConstView start, double dt, double* mean, double* F, double* Q) {
  require_size(model, start.n);
  if (!model.linear() && model.by_points()) return regressed_step(model, start, dt, mean, F, Q);
  moved_from(model, start.mean, dt, mean, F, Q);
}

void prediction_covariance(const ModelRef& model, ConstView prior, double dt, double* result) {
  const int n = prior.n;
  Scratch mean(n), F(n * n), Q(n * n);
  linearised_step(model, prior, dt, mean, F, Q);
  multiply(prior.covariance, n, transposed(F, n), result, n, n, n, n);
}

void smooth_step(const ModelRef& model, ConstView filtered, double dt, ConstView next, View result) {
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

void linearised_measurement(const ModelRef& model, ConstView predicted, ConstView z, const SensorRef& sensor,
                            double* residual, double* H, double* R) {
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

void measured_at(const ModelRef& model, const SensorRef& sensor, const double* x, int m, double* z) {
  sensor.table->measure(sensor.sensor, sensor.model, x, model.size(), m, z, nullptr);
  require_finite(z, m, "h(x)", model, x);
}

void moved_from(const ModelRef& model, const double* x, double dt, double* image, double* F, double* Q) {
  const int n = model.size();
  if (model.linear()) {
    Scratch moved(n);
    linear_motion(model, dt, F, Q, moved);
    multiply(F, n, columns_of(x, n), moved, n, n, n, 1, Into::plus);
    std::copy_n(moved.data(), n, image);
  } else {
    model.table->tangent(model.motion, x, dt, image, F, Q);
  }
  require_finite(image, n, "f(x)", model, x);
  if (F) require_finite(F, n * n, "the Jacobian of f", model, x);
}

void difference(const SensorRef& sensor, const double* z, const double* predicted, int m, double* result) {
  if (sensor.table->difference) return sensor.table->difference(sensor.sensor, z, predicted, m, result);
  for (int i = 0; i < m; ++i) result[i] = z[i] - predicted[i];
}

void transform(const double* A, const double* b, int axes, View estimate) {
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
