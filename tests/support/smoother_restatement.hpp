/// A restatement of the fixed-interval smoother in the manner of restatement.hpp: what the future knows of the state is
/// a likelihood function exp(yᵀu − uᵀYu/2), which every pair of modes multiplies with its own prediction.
///
/// Nothing that a pair predicts is inverted: it may be singular.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/restatement.hpp"
#include "support/second_order_restatement.hpp"

namespace restatement {

/// A = Vᵀ diag(values) V of a symmetric A, by Jacobi's rotations.
struct Axes {
  Vector values;
  Matrix V;
};
inline Axes axes(Matrix A) {
  Matrix V = identity(A.rows);
  for (int sweep = 0; sweep < 12; ++sweep)
    for (Index p = 0; p < A.rows; ++p)
      for (Index q = p + 1; q < A.rows; ++q) {
        if (A(p, q) == 0.0) continue;
        const double angle = 0.5 * std::atan2(2.0 * A(p, q), A(q, q) - A(p, p));
        Matrix rotation = identity(A.rows);
        rotation(p, p) = rotation(q, q) = std::cos(angle);
        rotation(p, q) = -std::sin(angle);
        rotation(q, p) = std::sin(angle);
        A = rotation * A * transposed(rotation);
        V = rotation * V;
      }
  Vector values;
  for (Index a = 0; a < A.rows; ++a) values.push_back(A(a, a));
  return {values, V};
}

/// Some T with T A Tᵀ = 1.
inline Matrix whitening(const Matrix& A) {
  Axes of = axes(A);
  for (Index a = 0; a < A.rows; ++a) {
    if (!(of.values[a] > 0.0)) throw std::domain_error{"a prediction that is not positive definite"};
    for (Index b = 0; b < A.rows; ++b) of.V(a, b) /= std::sqrt(of.values[a]);
  }
  return of.V;
}

/// exp(yᵀu − uᵀYu/2) with u = x − `about`.
struct Evidence {
  Vector about, y;
  Matrix Y;
};

/// N(x; smoothed) / N(x; predicted). Where smoothing widened the prediction it knows nothing, and only leans.
inline Evidence future_evidence(const State& smoothed, const State& predicted) {
  const Matrix white = whitening(predicted.covariance);
  const Axes seen = axes(symmetrised(white * smoothed.covariance * transposed(white)));
  const Matrix T = seen.V * white;  // the predicted covariance becomes 1, and the smoothed one diagonal
  Vector y = T * difference(smoothed.mean, predicted.mean);
  Matrix Y(y.size(), y.size());
  for (Index a = 0; a < y.size(); ++a) {
    const double variance = std::max(seen.values[a], 1e-12);
    y[a] /= variance;
    Y(a, a) = std::max(1.0 / variance - 1.0, 0.0);
  }
  return {predicted.mean, transposed(T) * y, transposed(T) * Y * T};
}

/// A filter that remembers its steps, and the smoother of them. `Order` is Filter or SecondOrderFilter.
template <class Order>
class Smoother : public Order {
 public:
  /// What is known of one time.
  struct Moment {
    Vector log_weights;
    std::vector<State> states;
    Index winner = 0;
  };

  explicit Smoother(Order filter) : Order{std::move(filter)} {}

  void step(double dt, const Vector& z, const Matrix& R) {
    steps_.push_back({dt, now(), predicted(dt, Position{z, R})});
    Order::step(dt, z, R);
  }
  void step(double dt) {
    steps_.push_back({dt, now(), predicted(dt, std::nullopt)});
    Order::step(dt);
  }

  /// Of the start and of every step.
  std::vector<Moment> smoothed() const {
    std::vector<Moment> result{now()};
    for (Index k = steps_.size(); k-- > 0;) result.push_back(at(steps_[k].before).back(steps_[k], result.back()));
    std::reverse(result.begin(), result.end());
    return result;
  }

  /// The output of a moment.
  State estimate(const Moment& moment) const { return at(moment).Order::estimate(); }

 private:
  struct Step {
    double dt;
    Moment before;
    std::vector<State> predicted;
  };

  Moment now() const { return {this->log_weights_, this->states_, this->winner_}; }
  Smoother at(const Moment& moment) const {
    Smoother result = *this;
    result.log_weights_ = moment.log_weights;
    result.states_ = moment.states;
    result.winner_ = moment.winner;
    return result;
  }

  /// What each mode is going to predict. The predecessors that a second-order filter keeps apart collapse by their
  /// weights after the measurement.
  std::vector<State> predicted(double dt, const std::optional<Position>& seen) const {
    if constexpr (std::is_same_v<Order, Filter>) {
      Order ahead = *this;
      ahead.step(dt);
      return ahead.states();
    }
    const Index M = this->models_.size();
    std::vector<State> result;
    for (Index j = 0; j < M; ++j) {
      Vector logs;
      std::vector<State> pairs;
      for (Index l = 0; l < M; ++l) {
        logs.push_back(this->log_weights_[l] + std::log(this->transition_(l, j)));
        pairs.push_back(prediction(l, j, dt));
        if (!seen) continue;
        const Matrix& H = this->models_[j].H;
        const Matrix S = symmetrised(H * pairs[l].covariance * transposed(H) + seen->R);
        logs[l] += this->log_likelihood(difference(seen->z, H * pairs[l].mean), inverse(S));
      }
      const double total = log_total(logs, this->options_.kind);
      result.push_back(total == nothing ? pairs[j] : collapsed(pairs, logs, total, j, this->options_.mixing_tie));
    }
    return result;
  }

  /// By moments or, of a fuzzy mode, by selection.
  State collapsed(const std::vector<State>& states, const Vector& logs, double total, Index own, Tie tie) const {
    if (this->options_.kind == Kind::himm) return states[largest(logs, tie, own)];
    Vector weights;
    for (const double log : logs) weights.push_back(std::exp(log - total));
    return Order::moments(states, weights, weights);
  }

  /// By model j from the state of model i.
  State prediction(Index i, Index j, double dt) const {
    const State start = this->received(i, j);
    const Matrix F = this->models_[j].F(dt);
    return {F * start.mean, symmetrised(F * start.covariance * transposed(F) + this->models_[j].Q(dt))};
  }

  /// The state of model i with what model j predicts from it; what the lift stands in for is correlated with nothing.
  Matrix cross_covariance(Index i, Index j, double dt) const {
    const auto& own = this->models_[i].components;
    const auto& others = this->models_[j].components;
    Matrix with_start(own.size(), others.size());
    for (Index b = 0; b < others.size(); ++b)
      if (const auto from = position(own, others[b]))
        for (Index a = 0; a < own.size(); ++a) with_start(a, b) = this->states_[i].covariance(a, *from);
    return with_start * transposed(this->models_[j].F(dt));
  }

  /// The state of model i, with mode j next and its evidence, and the logarithm of how well the two agree.
  std::pair<State, double> met(Index i, Index j, double dt, const Evidence& evidence) const {
    const State pair = prediction(i, j, dt);
    const Vector off = difference(pair.mean, evidence.about);
    const Vector y = difference(evidence.y, evidence.Y * off);
    // The product has the precision M⁻¹ + Y: covariance S = (1 + M Y)⁻¹ M, and mean S y from that of the pair.
    const Inverse gain = inverse(identity(off.size()) + pair.covariance * evidence.Y);
    const Matrix S = symmetrised(gain.matrix * pair.covariance);
    const double log_evidence =
        dot(evidence.y, off) - 0.5 * dot(off, evidence.Y * off) + 0.5 * dot(y, S * y) - 0.5 * gain.log_determinant;
    const Matrix C = cross_covariance(i, j, dt);
    State result = this->states_[i];
    const Vector correction = C * (transposed(gain.matrix) * y);  // M⁻¹(s − m) = (1 + Y M)⁻¹ y
    for (Index a = 0; a < correction.size(); ++a) result.mean[a] += correction[a];
    // M⁻¹(S − M)M⁻¹ = −Y (1 + M Y)⁻¹
    result.covariance = symmetrised(result.covariance - C * evidence.Y * gain.matrix * transposed(C));
    return {result, log_evidence};
  }

  /// One step back from `next`, whose winner stays where modes tie; the filter itself is at the time before the step.
  Moment back(const Step& step, const Moment& next) const {
    const Index M = this->models_.size();
    const Kind kind = this->options_.kind;
    std::vector<Vector> logs(M, Vector(M, nothing));  // logs[i][j]
    std::vector<std::vector<State>> pairs;            // pairs[i][j]
    for (const State& state : this->states_) pairs.push_back(std::vector(M, state));
    for (Index j = 0; j < M; ++j) {
      if (next.log_weights[j] == nothing) continue;
      const Evidence evidence = future_evidence(next.states[j], step.predicted[j]);
      Vector from(M);
      for (Index i = 0; i < M; ++i) {
        double log_evidence = 0.0;
        std::tie(pairs[i][j], log_evidence) = met(i, j, step.dt, evidence);
        from[i] = std::log(this->transition_(i, j)) + this->log_weights_[i] + log_evidence;
      }
      const double total = log_total(from, kind);
      for (Index i = 0; i < M; ++i) logs[i][j] = from[i] - total + next.log_weights[j];
    }

    Moment result{Vector(M), this->states_, 0};
    for (Index i = 0; i < M; ++i) {
      result.log_weights[i] = log_total(logs[i], kind);
      if (result.log_weights[i] == nothing) continue;
      result.states[i] = collapsed(pairs[i], logs[i], result.log_weights[i], i, Tie::stay);
    }
    const double total = log_total(result.log_weights, kind);
    for (double& value : result.log_weights) value -= total;
    result.winner = largest(result.log_weights, this->options_.output_tie, next.winner);
    return result;
  }

  std::vector<Step> steps_;
};

}  // namespace restatement
