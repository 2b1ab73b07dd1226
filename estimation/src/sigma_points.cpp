#include "sigma_points.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <sigmax/estimation/covariance_root.hpp>
#include <sigmax/estimation/dense.hpp>
#include <sigmax/estimation/unscented.hpp>

namespace sigmax::detail {
namespace {

void root_of(const ModelRef& model, const double* covariance, int n, double* root) {
  if (const int component = covariance_root(covariance, n, root)) refuse_covariance(model.name(), component);
}

/// Room for the points of ten components, a column each.
using Columns = Scratch<210>;

/// The points of a filter over an estimate: the centre, if it has a weight, then those up and those down.
class SigmaPoints {
 public:
  /// Throws std::domain_error, naming the model, if the estimate's covariance is not positive semi-definite.
  SigmaPoints(const ModelRef& model, const ConstView& estimate)
      : weights_(model.points),
        mean_(estimate.mean),
        n_(estimate.n),
        centre_(weights_.centre_of_mean != 0.0 || weights_.centre_of_covariance != 0.0 ? 1 : 0),
        root_(n_ * n_),
        offsets_(n_ * count()),
        points_(n_ * count()) {
    root_of(model, estimate.covariance, n_, root_);
    const double scale = std::sqrt(weights_.spread);
    for (int k = 0; k < n_ * centre_; ++k) offsets_[k] = 0.0;
    for (int i = 0; i < n_ * n_; ++i) {
      offsets_[n_ * centre_ + i] = scale * root_[i];
      offsets_[n_ * (centre_ + n_) + i] = -scale * root_[i];
    }
    for (int i = 0; i < count(); ++i)
      for (int k = 0; k < n_; ++k) points_[k + i * n_] = estimate.mean[k] + offsets_[k + i * n_];
  }

  int count() const { return 2 * n_ + centre_; }
  /// Where a point lies about the mean.
  double* offset(int point) { return offsets_ + point * n_; }
  const double* point(int place) { return points_ + place * n_; }
  const double* mean() const { return mean_; }
  const double* root() { return root_; }
  /// The place of the first point up; those down are n behind.
  int up() const { return centre_; }

  /// The weight of every point but the centre, and in a mean of this one.
  double weight() const { return 0.5 / weights_.spread; }
  double in_mean(int point) const { return point < centre_ ? weights_.centre_of_mean : weight(); }

  /// Σ wᵢ dᵢ dᵢᵀ over deviations of so many rows. All weights but the centre's are equal.
  void covariance(const double* deviations, int rows, double* result) {
    const int size = rows * rows;
    const double* const others = deviations + centre_ * rows;
    multiply(others, rows, transposed(others, rows), result, rows, rows, 2 * n_, rows);
    for (int i = 0; i < size; ++i) result[i] *= weight();
    if (centre_ == 0) return;
    for (int k = 0; k < rows; ++k)
      for (int i = 0; i < rows; ++i)
        result[i + k * rows] += weights_.centre_of_covariance * deviations[i] * deviations[k];
  }

  /// The slope of a function times the root: √spread Σ wᵢ dᵢ lᵢᵀ, rows × n, where lᵢ is the i-th axis, up or down.
  void slope(const double* deviations, int rows, double* result) const {
    const double* const up = deviations + centre_ * rows;
    const double* const down = up + n_ * rows;
    const double scale = 0.5 / std::sqrt(weights_.spread);
    for (int i = 0; i < n_ * rows; ++i) result[i] = scale * (up[i] - down[i]);
  }

 private:
  SigmaPointWeights weights_;
  const double* mean_;
  int n_;
  int centre_;
  Scratch<> root_;
  Columns offsets_, points_;
};

/// What f makes of the points: its mean, and the deviations from it.
void propagate(const ModelRef& model, SigmaPoints& points, double dt, double* mean, double* deviations, double* Q) {
  const int n = model.size();
  for (int i = 0; i < points.count(); ++i)
    model.table->tangent(model.motion, points.point(i), dt, deviations + i * n, nullptr, i == 0 ? Q : nullptr);
  require_finite(deviations, n, points.count(), "f(x)", model, points.point(0));
  Scratch<32> first(n), shift(n);
  for (int k = 0; k < n; ++k) {
    first[k] = deviations[k];
    shift[k] = 0.0;
  }
  for (int i = 1; i < points.count(); ++i)  // about one of them, so that large weights of either sign cancel little
    for (int k = 0; k < n; ++k) shift[k] += deviations[k + i * n] - first[k];
  for (int k = 0; k < n; ++k) {
    shift[k] *= points.weight();
    mean[k] = first[k] + shift[k];
  }
  for (int i = 0; i < points.count(); ++i)
    for (int k = 0; k < n; ++k) deviations[k + i * n] = (deviations[k + i * n] - first[k]) - shift[k];
}

/// The weighted mean of measurements, a column each: the sensor's own, or z₀ + Σ wᵢ (zᵢ − z₀) by its difference, where
/// z₀ is what it sees at the mean of the points.
void mean_of(const SensorRef& sensor, SigmaPoints& points, const double* seen, const double* at_mean, int m,
             double* mean) {
  if (sensor.table->mean) {
    Scratch<32> weights(points.count());
    for (int i = 0; i < points.count(); ++i) weights[i] = points.in_mean(i);
    return sensor.table->mean(sensor.sensor, seen, weights, m, points.count(), mean);
  }
  Columns apart(m * points.count());
  difference(sensor, seen, at_mean, m, points.count(), apart);
  std::copy_n(at_mean, m, mean);
  for (int i = 0; i < points.count(); ++i)
    for (int k = 0; k < m; ++k) mean[k] += points.in_mean(i) * apart[k + i * m];
}

/// What h makes of the points: its mean, and the deviations from it. Points that the sensor cannot tell from the mean
/// share one evaluation.
void measure(const ModelRef& model, SigmaPoints& points, const SensorRef& sensor, int m, double* mean,
             double* deviations) {
  const int n = model.size(), own = sensor.table->seen(sensor.sensor), seen = own == 0 ? n : own;
  int at_mean = -1;  // the first that is seen there
  for (int i = 0; i < points.count(); ++i) {
    const double* const offset = points.offset(i);
    const bool there = std::all_of(offset, offset + seen, [](double number) { return number == 0.0; });
    if (there && at_mean >= 0) {
      std::copy_n(deviations + at_mean * m, m, deviations + i * m);
      continue;
    }
    sensor.table->measure(sensor.sensor, sensor.model, points.point(i), n, m, deviations + i * m, nullptr);
    if (there) at_mean = i;
  }
  require_finite(deviations, m, points.count(), "h(x)", model, points.point(0));
  Scratch<6> centre(m);
  if (at_mean >= 0)
    std::copy_n(deviations + at_mean * m, m, centre.data());
  else
    sensor.table->measure(sensor.sensor, sensor.model, points.mean(), n, m, centre, nullptr);
  mean_of(sensor, points, deviations, centre, m, mean);
  difference(sensor, deviations, mean, m, points.count(), deviations);
}

/// Writes a symmetric sum of squares. Only a negative weight can take its definiteness away: throws std::domain_error
/// if it did.
void write_semidefinite(const ModelRef& model, const double* covariance, int n, double* result) {
  if (model.points.centre_of_covariance < 0.0) {
    Scratch<> root(n * n);
    root_of(model, covariance, n, root);
  }
  std::copy_n(covariance, n * n, result);
}

/// Fits a linear function to the values at the sigma points of N(m, L Lᵀ): the slope, rows × n, and the covariance of
/// the remainder. `deviations` are the function's, a column for each point.
void regress(SigmaPoints& points, int n, double* deviations, int rows, double* slope, double* rest) {
  double* const up = deviations + points.up() * rows;
  double* const down = up + n * rows;
  points.slope(deviations, rows, slope);
  for (int i = 0; i < n * rows; ++i) up[i] = down[i] = 0.5 * (up[i] + down[i]);
  points.covariance(deviations, rows, rest);
  const double* const L = points.root();
  for (int k = n; k-- > 0;) {  // A with A L = slope; where a column of L is zero, A knows nothing
    double* const column = slope + k * rows;
    if (L[k + k * n] == 0.0) {
      std::fill_n(column, rows, 0.0);
      continue;
    }
    for (int i = k + 1; i < n; ++i)
      for (int row = 0; row < rows; ++row) column[row] -= L[i + k * n] * slope[row + i * rows];
    for (int row = 0; row < rows; ++row) column[row] /= L[k + k * n];
  }
}

}  // namespace

void predict_by_points(const ModelRef& model, const ConstView& prior, double dt, const View& result) {
  const int n = prior.n;
  SigmaPoints points(model, prior);
  Columns deviations(n * points.count());
  Scratch<> Q(n * n), sum(n * n);
  Scratch<32> mean(n);
  propagate(model, points, dt, mean, deviations, Q);
  points.covariance(deviations, n, sum);
  for (int i = 0; i < n * n; ++i) sum[i] += Q[i];
  mirror_lower(sum, n);
  write_semidefinite(model, sum, n, result.covariance);
  std::copy_n(mean.data(), n, result.mean);
}

void update_by_points(const ModelRef& model, const ConstView& prior, const ConstView& z, const SensorRef& sensor,
                      const View& posterior, InnovationView& innovation) {
  const int n = prior.n, m = z.n;
  SigmaPoints points(model, prior);
  Columns seen(m * points.count()), rest(n * points.count());
  Scratch<6> predicted(m);
  Scratch<36> S_inverse(m * m);
  Scratch<> slope(m * n), cross(n * m), W(n * m), WR(n * m), sum(n * n);
  measure(model, points, sensor, m, predicted, seen);
  difference(sensor, z.mean, predicted, m, 1, innovation.residual);
  points.covariance(seen, m, innovation.covariance);
  for (int i = 0; i < m * m; ++i) innovation.covariance[i] += z.covariance[i];
  mirror_lower(innovation.covariance, m);
  score(model, z, innovation, S_inverse);

  points.slope(seen, m, slope);
  multiply(points.root(), n, transposed(slope, m), cross, n, n, n, m);
  multiply(cross, n, columns_of(S_inverse, m), W, n, n, m, m);
  std::copy_n(points.offset(0), n * points.count(), rest.data());
  multiply(W, n, columns_of(seen, m), rest, n, n, m, points.count(), Into::minus);
  points.covariance(rest, n, sum);
  multiply(W, n, columns_of(z.covariance, m), WR, n, n, m, m);
  multiply(WR, n, transposed(W, n), sum, n, n, m, n, Into::plus);
  mirror_lower(sum, n);
  write_semidefinite(model, sum, n, posterior.covariance);
  if (posterior.mean != prior.mean) std::copy_n(prior.mean, n, posterior.mean);
  multiply(W, n, columns_of(innovation.residual, m), posterior.mean, n, n, m, 1, Into::plus);
}

void regressed_step(const ModelRef& model, const ConstView& start, double dt, double* mean, double* F, double* Q) {
  const int n = start.n;
  SigmaPoints points(model, start);
  Columns deviations(n * points.count());
  Scratch<> rest(n * n);
  propagate(model, points, dt, mean, deviations, Q);
  regress(points, n, deviations, n, F, rest);
  for (int i = 0; i < n * n; ++i) Q[i] += rest[i];
}

void regressed_measurement(const ModelRef& model, const ConstView& predicted, const ConstView& z,
                           const SensorRef& sensor, double* residual, double* H, double* R) {
  const int n = predicted.n, m = z.n;
  SigmaPoints points(model, predicted);
  Columns seen(m * points.count());
  Scratch<6> mean(m);
  measure(model, points, sensor, m, mean, seen);
  difference(sensor, z.mean, mean, m, 1, residual);
  regress(points, n, seen, m, H, R);
  for (int i = 0; i < m * m; ++i) R[i] += z.covariance[i];
}

SigmaPointWeights unscented_weights(const UnscentedScaling& scaling, std::string_view model, int n) {
  const auto& [alpha, beta, kappa] = scaling;
  const double spread = alpha * alpha * (n + kappa), centre = 1.0 - n / spread;
  if (!(spread > 0.0 && std::isfinite(spread) && std::isfinite(beta)))
    throw std::invalid_argument("the unscented filter of model '" + std::string(model) +
                                "' with alpha = " + std::to_string(alpha) + ", beta = " + std::to_string(beta) +
                                ", kappa = " + std::to_string(kappa) + " and " + std::to_string(n) +
                                " states; expected alpha² (n + kappa) > 0");
  return {spread, centre, centre + 1.0 - alpha * alpha + beta};
}

}  // namespace sigmax::detail
