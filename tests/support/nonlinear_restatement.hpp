/// A restatement of the extended, unscented and cubature Kalman filters in plain loops. It shares no code with the
/// library.
#pragma once

#include "support/restatement.hpp"

namespace restatement {

/// x_k = f(x_{k−1}) + w, z_k = h(x_k) + v, (21)–(22), with the Jacobians of f and h.
struct NonlinearModel {
  std::function<Vector(const Vector&, double)> f;
  std::function<Matrix(const Vector&, double)> F;
  std::function<Matrix(double)> Q;
  std::function<Vector(const Vector&)> h;
  std::function<Matrix(const Vector&)> H;
  std::vector<bool> is_angle;  // Of each measured quantity.
};

/// An angle less whole turns.
inline double in_half_a_turn(double angle) {
  while (angle > std::numbers::pi) angle -= 2.0 * std::numbers::pi;
  while (angle < -std::numbers::pi) angle += 2.0 * std::numbers::pi;
  return angle;
}

inline Vector measured_difference(const NonlinearModel& model, const Vector& a, const Vector& b) {
  Vector result = difference(a, b);
  for (Index i = 0; i < result.size(); ++i)
    if (model.is_angle[i]) result[i] = in_half_a_turn(result[i]);
  return result;
}

inline State extended_prediction(const NonlinearModel& model, const State& prior, double dt) {
  const Matrix F = model.F(prior.mean, dt);
  return {model.f(prior.mean, dt), F * prior.covariance * transposed(F) + model.Q(dt)};
}
inline Sighting extended_update(const NonlinearModel& model, const State& prior, const Vector& z, const Matrix& R) {
  const Matrix H = model.H(prior.mean);
  return corrected(prior, measured_difference(model, z, model.h(prior.mean)), H * prior.covariance * transposed(H) + R,
                   prior.covariance * transposed(H));
}

/// Points with their weights for means and for covariances.
struct Points {
  std::vector<Vector> at;
  Vector mean_weights;
  Vector covariance_weights;
};

/// Cholesky's lower triangular root, by rows.
inline Matrix root(const Matrix& P) {
  Matrix L(P.rows, P.rows);
  for (Index i = 0; i < P.rows; ++i)
    for (Index j = 0; j <= i; ++j) {
      double sum = P(i, j);
      for (Index k = 0; k < j; ++k) sum -= L(i, k) * L(j, k);
      L(i, j) = i == j ? std::sqrt(sum) : sum / L(j, j);
    }
  return L;
}

inline void add_pairs(Points& points, const State& state, double spread) {
  const Matrix L = root(state.covariance);
  for (const double sign : {1.0, -1.0})
    for (Index i = 0; i < state.mean.size(); ++i) {
      Vector x = state.mean;
      for (Index k = 0; k < x.size(); ++k) x[k] += sign * std::sqrt(spread) * L(k, i);
      points.at.push_back(x);
      points.mean_weights.push_back(0.5 / spread);
      points.covariance_weights.push_back(0.5 / spread);
    }
}

/// Σ wᵢ aᵢ bᵢᵀ.
inline Matrix weighted_outer(const Vector& weights, const std::vector<Vector>& a, const std::vector<Vector>& b) {
  Matrix result(a.front().size(), b.front().size());
  for (Index i = 0; i < weights.size(); ++i)
    for (Index r = 0; r < result.rows; ++r)
      for (Index c = 0; c < result.columns; ++c) result(r, c) += weights[i] * a[i][r] * b[i][c];
  return result;
}
inline Vector weighted_mean(const Vector& weights, const std::vector<Vector>& values) {
  Vector result(values.front().size(), 0.0);
  for (Index i = 0; i < weights.size(); ++i)
    for (Index k = 0; k < result.size(); ++k) result[k] += weights[i] * values[i][k];
  return result;
}

inline State points_prediction(const NonlinearModel& model, const Points& points, double dt) {
  std::vector<Vector> images;
  for (const Vector& x : points.at) images.push_back(model.f(x, dt));
  State result;
  result.mean = weighted_mean(points.mean_weights, images);
  for (Vector& image : images) image = difference(image, result.mean);
  result.covariance = weighted_outer(points.covariance_weights, images, images) + model.Q(dt);
  return result;
}

/// Cov(x_k−1, x_k).
inline Matrix points_cross_covariance(const NonlinearModel& model, const State& prior, const Points& points,
                                      double dt) {
  std::vector<Vector> images, offsets;
  for (const Vector& x : points.at) {
    images.push_back(model.f(x, dt));
    offsets.push_back(difference(x, prior.mean));
  }
  return weighted_outer(points.covariance_weights, offsets, images);  // the offsets' weighted sum is zero
}

inline Sighting points_update(const NonlinearModel& model, const State& prior, const Points& points, const Vector& z,
                              const Matrix& R) {
  std::vector<Vector> seen, offsets;
  for (const Vector& x : points.at) {
    const Vector h = model.h(x);
    // Angles are averaged as they lie about the first, without jumps.
    seen.push_back(h);
    if (seen.size() > 1) {
      const Vector from_first = measured_difference(model, h, seen.front());
      for (Index k = 0; k < h.size(); ++k) seen.back()[k] = seen.front()[k] + from_first[k];
    }
    offsets.push_back(difference(x, prior.mean));
  }
  const Vector mean = weighted_mean(points.mean_weights, seen);
  for (Vector& h : seen) h = difference(h, mean);
  return corrected(prior, measured_difference(model, z, mean),
                   weighted_outer(points.covariance_weights, seen, seen) + R,
                   weighted_outer(points.covariance_weights, offsets, seen));
}

/// What a radar in the plane at (x0, y0) saw: range and azimuth of the first two components of a model.
inline See seen_by_radar(const Vector& z, double x0, double y0) {
  return [z, x0, y0](const Model& model, const Vector& x) -> Seen {
    const double dx = x[0] - x0, dy = x[1] - y0, r = std::sqrt(dx * dx + dy * dy);
    Matrix H(2, model.components.size());
    H(0, 0) = dx / r;
    H(0, 1) = dy / r;
    H(1, 0) = -dy / (r * r);
    H(1, 1) = dx / (r * r);
    return {{z[0] - r, in_half_a_turn(z[1] - std::atan2(dy, dx))}, H};
  };
}

/// The azimuth alone.
inline See seen_by_bearing(double z, double x0, double y0) {
  return [z, x0, y0](const Model& model, const Vector& x) -> Seen {
    const double dx = x[0] - x0, dy = x[1] - y0;
    Matrix H(1, model.components.size());
    H(0, 0) = -dy / (dx * dx + dy * dy);
    H(0, 1) = dx / (dx * dx + dy * dy);
    return {{in_half_a_turn(z - std::atan2(dy, dx))}, H};
  };
}

/// Combinations of the first components, a row each.
inline See seen_by_rows(const Vector& z, const Matrix& rows) {
  return [z, rows](const Model& model, const Vector& x) -> Seen {
    Matrix H(rows.rows, model.components.size());
    for (Index i = 0; i < rows.rows; ++i)
      for (Index k = 0; k < rows.columns; ++k) H(i, k) = rows(i, k);
    return {difference(z, H * x), H};
  };
}

}  // namespace restatement
