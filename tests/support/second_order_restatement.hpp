/// A restatement of GPB2 and of the Viterbi filter in the manner of restatement.hpp: every pair of a predecessor and a
/// mode is a Kalman filter of its own, and the predecessors collapse after the measurement.
#pragma once

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "support/restatement.hpp"

namespace restatement {

class SecondOrderFilter : public Filter {
 public:
  using Filter::Filter;

  void step(double dt, const Vector& z, const Matrix& R) { step(dt, seen_by_matrix(z), R); }
  void step(double dt, const See& see, const Matrix& R) { cycle(dt, Sight{see, R}); }
  void step(double dt) { cycle(dt, std::nullopt); }

 private:
  struct Sight {
    See see;
    Matrix R;
  };

  /// Mode j after mode l: its estimate, its log weight before and after the measurement, and its innovation.
  struct Pair {
    State state;
    double before = nothing;
    double after = nothing;
    double fit = nothing;
    State innovation;
  };

  void cycle(double dt, const std::optional<Sight>& seen) {
    const Index M = models_.size();
    std::vector<std::vector<Pair>> pairs(M);  // pairs[j][l]
    Vector predicted(M), updated(M), fits;
    for (Index j = 0; j < M; ++j) {
      Vector before, after;
      for (Index l = 0; l < M; ++l) {
        pairs[j].push_back(pair(l, j, dt, seen));
        before.push_back(pairs[j][l].before);
        after.push_back(pairs[j][l].after);
        fits.push_back(pairs[j][l].fit);
      }
      predicted[j] = log_total(before, options_.kind);
      updated[j] = log_total(after, options_.kind);
    }

    std::vector<State> merged;
    for (Index j = 0; j < M; ++j) merged.push_back(over_predecessors(pairs[j], updated[j], j));
    gate_distance_ = -2.0 * log_total(fits, options_.kind);
    nis_ = seen ? std::optional(nis_of(pairs, predicted)) : std::nullopt;
    states_ = merged;
    log_weights_ = updated;
    const double total = log_total(updated, options_.kind);
    for (double& value : log_weights_) value -= total;
    tell_evidence(predicted, total);
    winner_ = largest(log_weights_, options_.output_tie, winner_);
  }

  Pair pair(Index l, Index j, double dt, const std::optional<Sight>& seen) const {
    Pair result;
    result.before = result.after = log_weights_[l] + std::log(transition_(l, j));
    const State start = received(l, j);
    const Matrix F = models_[j].F(dt);
    result.state = {F * start.mean, symmetrised(F * start.covariance * transposed(F) + models_[j].Q(dt))};
    if (!seen) return result;
    const auto [nu, H] = seen->see(models_[j], result.state.mean);
    const Matrix& P = result.state.covariance;
    result.innovation = {nu, symmetrised(H * P * transposed(H) + seen->R)};
    const Inverse S_inverse = inverse(result.innovation.covariance);
    const Matrix W = P * transposed(H) * S_inverse.matrix;
    const Vector correction = W * result.innovation.mean;
    for (Index i = 0; i < correction.size(); ++i) result.state.mean[i] += correction[i];
    const Matrix kept = identity(correction.size()) - W * H;
    result.state.covariance = symmetrised(kept * P * transposed(kept) + W * seen->R * transposed(W));
    result.fit = result.before - 0.5 * dot(nu, S_inverse.matrix * nu);
    result.after += log_likelihood(result.innovation.mean, S_inverse);
    return result;
  }

  /// One Gaussian for the predecessors of j; a mode that nothing reaches comes from itself.
  State over_predecessors(const std::vector<Pair>& of_j, double total, Index j) const {
    if (total == nothing) return of_j[j].state;
    Vector logs, weights;
    std::vector<State> states;
    for (const Pair& each : of_j) {
      logs.push_back(each.after - total);
      weights.push_back(std::exp(each.after - total));
      states.push_back(each.state);
    }
    if (options_.kind == Kind::himm) return states[largest(logs, options_.mixing_tie, j)];
    return moments(states, weights, weights);
  }

  /// Of the mixture of all M² innovations, by their weights before the measurement.
  double nis_of(const std::vector<std::vector<Pair>>& pairs, const Vector& predicted) const {
    State one;
    if (options_.kind == Kind::himm) {
      const Index j = largest(predicted, options_.output_tie, winner_);
      Vector before;
      for (const Pair& each : pairs[j]) before.push_back(each.before);
      one = pairs[j][largest(before, options_.mixing_tie, j)].innovation;
    } else {
      Vector weights;
      std::vector<State> innovations;
      for (const auto& of_j : pairs)
        for (const Pair& each : of_j) {
          weights.push_back(std::exp(each.before));
          innovations.push_back(each.innovation);
        }
      double sum = 0.0;
      for (const double weight : weights) sum += weight;
      for (double& weight : weights) weight /= sum;
      one = moments(innovations, weights, weights);
    }
    return dot(one.mean, inverse(one.covariance).matrix * one.mean);
  }
};

}  // namespace restatement
