/// A restatement of the fixed-interval smoother of docs/multiple_models.md, in the manner of restatement.hpp, for any
/// type of number: at a hundred digits it shows what rounding does to the library's, which shares neither code nor form
/// with it. What the future knows of a state is a likelihood function exp(yᵀu − uᵀYu/2), and Y a difference of two
/// information matrices, which doubles would lose. Nothing that may be singular is inverted.
#pragma once

#include "support/restatement.hpp"

namespace restatement::smoothing {

using std::abs, std::atan2, std::cos, std::exp, std::log, std::sin, std::sqrt;  // or those of a long number's own

template <class Real>
using Matrix = MatrixOf<Real>;

/// Eigenvectors of a symmetric matrix as the rows of V, by Jacobi's rotations.
template <class Real>
std::pair<std::vector<Real>, Matrix<Real>> axes(Matrix<Real> A) {
  Matrix<Real> V = identity<Real>(A.rows);
  for (int sweep = 0; sweep < 20; ++sweep)
    for (Index p = 0; p < A.rows; ++p)
      for (Index q = p + 1; q < A.rows; ++q) {
        if (A(p, q) == 0) continue;
        const Real angle = atan2(Real(2 * A(p, q)), Real(A(q, q) - A(p, p))) / 2;
        Matrix<Real> rotation = identity<Real>(A.rows);
        rotation(p, p) = rotation(q, q) = cos(angle);
        rotation(p, q) = -sin(angle);
        rotation(q, p) = sin(angle);
        A = rotation * A * transposed(rotation);
        V = rotation * V;
      }
  std::vector<Real> values;
  for (Index a = 0; a < A.rows; ++a) values.push_back(A(a, a));
  return {values, V};
}

/// What a filter recorded of one step: per mode an estimate and what is believed of it, and the measurement if taken.
struct Step {
  double dt;
  std::vector<State> states;
  Vector log_weights;
  std::optional<std::pair<Vector, restatement::Matrix>> seen;  // z, R
};

struct Rules {
  Kind kind;
  StateAugmentation augmentation;
  restatement::Matrix transition;
};

template <class Real>
struct Moment {
  std::vector<Real> log_weights;
  std::vector<Matrix<Real>> means, covariances;
};

/// exp(yᵀu − uᵀYu/2).
template <class Real>
struct Evidence {
  Matrix<Real> Y, y;
};

/// Y = L Z Lᵀ, where L Lᵀ is the average information of the parts: axes of Z with less than 1e-8 say nothing.
template <class Real>
void clip(Evidence<Real>& evidence, const Matrix<Real>& about, const Matrix<Real>& average) {
  const Index n = average.rows;
  Matrix<Real> L(n, n);
  std::vector<Index> pivots;
  for (Index k = 0; k < n; ++k) {
    Real pivot = average(k, k);
    for (Index j = 0; j < k; ++j) pivot -= L(k, j) * L(k, j);
    if (pivot <= 1e4 * std::numeric_limits<Real>::epsilon() * average(k, k)) continue;
    pivots.push_back(k);
    L(k, k) = sqrt(pivot);
    for (Index i = k + 1; i < n; ++i) {
      Real entry = average(i, k);
      for (Index j = 0; j < k; ++j) entry -= L(i, j) * L(k, j);
      L(i, k) = entry / L(k, k);
    }
  }
  const Index m = pivots.size();
  Matrix<Real> square(m, m), Y(m, m), y(m, 1), whole(n, m);
  const Matrix<Real> at = evidence.y - evidence.Y * about;
  for (Index a = 0; a < m; ++a) {
    y(a, 0) = at(pivots[a], 0);
    for (Index b = 0; b < m; ++b) {
      square(a, b) = L(pivots[a], pivots[b]);
      Y(a, b) = evidence.Y(pivots[a], pivots[b]);
    }
    for (Index i = 0; i < n; ++i) whole(i, a) = L(i, pivots[a]);
  }
  if (m == 0) return;
  const Matrix<Real> Z = solved(square, transposed(solved(square, Y).first)).first;
  const Matrix<Real> z = solved(square, y).first;
  const auto [values, V] = axes(Real(0.5) * (Z + transposed(Z)));
  bool any = false;
  for (const Real& value : values) any = any || value < Real(1e-8);
  if (!any) return;
  Matrix<Real> kept(m, m), kept_z(m, 1);
  for (Index a = 0; a < m; ++a) {
    if (values[a] < Real(1e-8)) continue;
    Matrix<Real> v(m, 1);
    for (Index i = 0; i < m; ++i) v(i, 0) = V(a, i);
    kept = kept + values[a] * (v * transposed(v));
    kept_z = kept_z + (transposed(v) * z)(0, 0) * v;
  }
  evidence.Y = whole * kept * transposed(whole);
  evidence.y = whole * kept_z + evidence.Y * about;
}

/// The smoothed moments of all steps.
template <class Real>
std::vector<Moment<Real>> smoothed(const std::vector<ModelOf<Real>>& models, const Rules& rules,
                                   const std::vector<Step>& steps) {
  const Index M = models.size();
  const auto filtered = [&](const Step& step) {
    Moment<Real> result;
    for (Index j = 0; j < M; ++j) {
      result.log_weights.emplace_back(step.log_weights[j]);
      result.means.push_back(as<Real>(step.states[j].mean));
      result.covariances.push_back(as<Real>(step.states[j].covariance));
    }
    return result;
  };
  const auto told = [&](const Step& step, Index j) {
    const Index n = models[j].components.size();
    Evidence<Real> result{Matrix<Real>(n, n), Matrix<Real>(n, 1)};
    if (!step.seen) return result;
    const Matrix<Real> H = as<Real>(models[j].H);
    result.Y = transposed(H) * solved(as<Real>(step.seen->second), H).first;
    result.y = transposed(H) * solved(as<Real>(step.seen->second), as<Real>(step.seen->first)).first;
    return result;
  };

  std::vector<Moment<Real>> moments{filtered(steps.back())};
  std::vector<Evidence<Real>> evidence;
  for (Index j = 0; j < M; ++j) evidence.push_back(told(steps.back(), j));
  for (Index k = steps.size() - 1; k-- > 0;) {
    const Step& step = steps[k];
    const double dt = steps[k + 1].dt;
    const Moment<Real> known = filtered(step);
    const Moment<Real> next = moments.back();
    Moment<Real> result = known;
    std::vector<std::vector<Real>> logs(M, std::vector<Real>(M, Real(nothing)));
    std::vector<std::vector<Evidence<Real>>> parts(M, std::vector<Evidence<Real>>(M));
    for (Index j = 0; j < M; ++j) {
      if (next.log_weights[j] == nothing) continue;
      const Matrix<Real> F = models[j].F(dt), Q = models[j].Q(dt);
      const Index n = F.rows;
      std::vector<Real> from;
      for (Index i = 0; i < M; ++i) {
        const auto& own = models[i].components;
        Matrix<Real> B(n, own.size()), augmented(n, n), value(n, 1);
        for (Index b = 0; b < n; ++b) {
          if (const auto at = position(own, models[j].components[b])) {
            for (Index a = 0; a < n; ++a) B(a, *at) = F(a, b);
            continue;
          }
          if (rules.augmentation == StateAugmentation::unbiased) value(b, 0) = known.means[j](b, 0);
          if (rules.augmentation == StateAugmentation::borrowed_variance) augmented(b, b) = known.covariances[j](b, b);
          if (rules.augmentation == StateAugmentation::unbiased)
            for (Index c = 0; c < n; ++c)
              if (!position(own, models[j].components[c])) augmented(b, c) = known.covariances[j](b, c);
        }
        const Matrix<Real> noise = Q + F * augmented * transposed(F);
        const auto& [Y, y] = evidence[j];
        const Matrix<Real> I = identity<Real>(n);
        parts[i][j] = {transposed(B) * solved(I + Y * noise, Y * B).first,
                       transposed(B) * solved(I + Y * noise, y - Y * (F * value)).first};
        const Matrix<Real> mean = B * known.means[i] + F * value;
        const Matrix<Real> P = B * known.covariances[i] * transposed(B) + noise;
        const Matrix<Real> rest = y - Y * mean;
        const auto [moved, log_determinant] = solved(I + P * Y, P * rest);
        const Real log_evidence = (transposed(y) * mean)(0, 0) - (transposed(mean) * Y * mean)(0, 0) / 2 +
                                  (transposed(rest) * moved)(0, 0) / 2 - log_determinant / 2;
        from.push_back(log(Real(rules.transition(i, j))) + known.log_weights[i] + log_evidence);
      }
      const Real total = log_total(from, rules.kind);
      for (Index i = 0; i < M; ++i) logs[i][j] = from[i] - total + next.log_weights[j];
    }
    std::vector<Evidence<Real>> before(M);
    for (Index i = 0; i < M; ++i) {
      before[i] = told(step, i);
      result.log_weights[i] = log_total(logs[i], rules.kind);
      if (result.log_weights[i] == nothing) continue;
      const Matrix<Real>& f = known.means[i];
      const Matrix<Real>& C = known.covariances[i];
      const Index n = f.rows;
      std::vector<Matrix<Real>> W, g;  // in part j the mean moves by C g, the covariance by −C W C
      for (Index j = 0; j < M; ++j) {
        const auto& [Y, y] = parts[i][j];
        if (logs[i][j] == nothing) {
          W.emplace_back(n, n);
          g.emplace_back(n, 1);
          continue;
        }
        W.push_back(solved(identity<Real>(n) + Y * C, Y).first);
        g.push_back(solved(identity<Real>(n) + Y * C, y - Y * f).first);
      }
      std::vector<Real> weights(M, Real(0));
      if (rules.kind == Kind::himm) {
        Vector relative;
        for (const Real& value : logs[i]) relative.push_back(static_cast<double>(value - result.log_weights[i]));
        weights[largest(relative, Tie::stay, i)] = 1;
      } else {
        for (Index j = 0; j < M; ++j)
          if (logs[i][j] != nothing) weights[j] = exp(Real(logs[i][j] - result.log_weights[i]));
      }
      Matrix<Real> all_W(n, n), all_g(n, 1), average = before[i].Y;
      for (Index j = 0; j < M; ++j) all_g = all_g + weights[j] * g[j];
      for (Index j = 0; j < M; ++j) {
        if (weights[j] == 0) continue;
        all_W = all_W + weights[j] * (W[j] - (g[j] - all_g) * transposed(g[j] - all_g));
        average = average + weights[j] * parts[i][j].Y;
      }
      result.means[i] = f + C * all_g;
      result.covariances[i] = C - C * all_W * C;
      const Matrix<Real> Y = solved(identity<Real>(n) - all_W * C, all_W).first;
      before[i].Y = before[i].Y + Y;
      before[i].y = before[i].y + solved(identity<Real>(n) - all_W * C, all_g).first + Y * f;
      if (rules.kind == Kind::imm) clip(before[i], f, average);
    }
    const Real total = log_total(result.log_weights, rules.kind);
    for (Real& value : result.log_weights) value -= total;
    evidence = before;
    moments.push_back(result);
  }
  return {moments.rbegin(), moments.rend()};
}

}  // namespace restatement::smoothing

namespace restatement {

/// A filter that remembers its steps, and the smoother of them.
class Smoother : public Filter {
 public:
  /// What is known of one time.
  struct Moment {
    Vector log_weights;
    std::vector<State> states;
    Index winner = 0;
  };

  explicit Smoother(Filter filter) : Filter{std::move(filter)} { remember(0.0); }

  void step(double dt, const Vector& z, const Matrix& R) {
    Filter::step(dt, z, R);
    remember(dt);
    steps_.back().seen = {z, R};
  }
  void step(double dt) {
    Filter::step(dt);
    remember(dt);
  }

  /// Of the start and of every step.
  std::vector<Moment> smoothed() const {
    using Real = long double;
    std::vector<ModelOf<Real>> models;
    for (const Model& model : models_)
      models.push_back({model.components, [&](double dt) { return as<Real>(model.F(dt)); },
                        [&](double dt) { return as<Real>(model.Q(dt)); }, model.H});
    std::vector<Moment> result;
    for (const auto& moment :
         smoothing::smoothed<Real>(models, {options_.kind, options_.augmentation, transition_}, steps_)) {
      auto& plain = result.emplace_back();
      plain.log_weights.assign(moment.log_weights.begin(), moment.log_weights.end());
      for (Index j = 0; j < models.size(); ++j) {
        const auto& [mean, covariance] = std::tie(moment.means[j].values, moment.covariances[j].values);
        plain.states.push_back({{mean.begin(), mean.end()},
                                {moment.means[j].rows, moment.means[j].rows, {covariance.begin(), covariance.end()}}});
      }
    }
    result.back().winner = winner_;
    for (Index k = result.size() - 1; k-- > 0;)
      result[k].winner = largest(result[k].log_weights, options_.output_tie, result[k + 1].winner);
    return result;
  }

  /// The output of a moment.
  State estimate(const Moment& moment) const {
    Smoother at = *this;
    at.log_weights_ = moment.log_weights;
    at.states_ = moment.states;
    at.winner_ = moment.winner;
    return at.Filter::estimate();
  }

 private:
  void remember(double dt) { steps_.push_back({dt, states_, log_weights_, std::nullopt}); }

  std::vector<smoothing::Step> steps_;
};

}  // namespace restatement
