/// A restatement of the filter over mode histories in the manner of restatement.hpp: every history is the list of its
/// modes with a Kalman filter of its own. Nothing is shared between them, and nothing is kept in place.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "support/restatement.hpp"

namespace restatement {

struct HistoryOptions {
  Kind kind = Kind::himm;
  Index histories = 1000000;
  double least = nothing;  ///< log weight beside the best
  double cut = 0.05;
  double tempering = 1.0;
  Vector scales = {11.0, 20.0};
};

struct ModeHistory {
  std::vector<Index> modes;
  State state;
  double log_weight = 0.0;
  Vector nu;
  Matrix S;
  double before = 0.0;  ///< log weight before the measurement
  double distance = 0.0;
};

class HistoryFilter {
 public:
  HistoryFilter(std::vector<Model> models, Matrix transition, const std::vector<State>& starts, HistoryOptions options)
      : models_{std::move(models)}, transition_{std::move(transition)}, options_{std::move(options)} {
    for (Index j = 0; j < models_.size(); ++j) histories_.push_back({{j}, starts[j], 0.0, {}, {}, 0.0, 0.0});
    normalise();
    winner_ = largest(log_weights(), Tie::stay, 0);
    for (const Model& model : models_)
      if (model.components.size() > components_.size()) components_ = model.components;
  }

  void step(double dt) { cycle(dt, nullptr, nullptr); }
  void step(double dt, const Vector& z, const Matrix& R) { cycle(dt, &z, &R); }

  const std::vector<ModeHistory>& histories() const { return histories_; }
  Index winner() const { return winner_; }
  double nis() const { return nis_; }
  double gate_distance() const { return gate_distance_; }

  Vector log_weights() const {
    Vector result;
    for (Index j = 0; j < models_.size(); ++j) {
      Vector own{nothing};
      for (const ModeHistory& each : histories_)
        if (each.modes.back() == j) own.push_back(each.log_weight);
      result.push_back(log_total(own, options_.kind));
    }
    return result;
  }

  /// One estimate for the histories that end in mode j.
  State of_mode(Index j) const {
    Vector logs;
    std::vector<State> states;
    for (const ModeHistory& each : histories_)
      if (each.modes.back() == j) {
        logs.push_back(each.log_weight);
        states.push_back(each.state);
      }
    if (options_.kind == Kind::himm)
      return states[static_cast<Index>(std::max_element(logs.begin(), logs.end()) - logs.begin())];
    return averaged(states, logs);
  }

  /// The mean and the spread of those in the cut, in the components of the largest model; what one lacks is 0 with the
  /// mean square of the scales.
  State estimate() const {
    double top = nothing, square = 0.0;
    for (const ModeHistory& each : histories_) top = std::max(top, each.log_weight);
    for (const double scale : options_.scales) square += scale * scale / static_cast<double>(options_.scales.size());
    Vector logs;
    std::vector<State> states;
    for (const ModeHistory& each : histories_) {
      if (std::exp(each.log_weight - top) < options_.cut) continue;
      logs.push_back(each.log_weight);
      states.push_back(in_components(each.state, models_[each.modes.back()].components, components_, square));
    }
    return averaged(states, logs);
  }

 private:
  static State averaged(const std::vector<State>& states, const Vector& logs) {
    const double total = log_total(logs, Kind::imm);
    const Index n = states.front().mean.size();
    State result{Vector(n, 0.0), Matrix(n, n)};
    for (Index h = 0; h < states.size(); ++h)
      for (Index i = 0; i < n; ++i) result.mean[i] += std::exp(logs[h] - total) * states[h].mean[i];
    for (Index h = 0; h < states.size(); ++h)
      result.covariance =
          result.covariance +
          std::exp(logs[h] - total) * (states[h].covariance + outer(difference(states[h].mean, result.mean)));
    return result;
  }

  static State in_components(const State& state, const std::vector<std::string>& own,
                             const std::vector<std::string>& wanted, double variance) {
    State result{Vector(wanted.size(), 0.0), Matrix(wanted.size(), wanted.size())};
    for (Index a = 0; a < wanted.size(); ++a) {
      const auto from_a = position(own, wanted[a]);
      if (!from_a) {
        result.covariance(a, a) = variance;
        continue;
      }
      result.mean[a] = state.mean[*from_a];
      for (Index b = 0; b < wanted.size(); ++b)
        if (const auto from_b = position(own, wanted[b])) result.covariance(a, b) = state.covariance(*from_a, *from_b);
    }
    return result;
  }

  void normalise() {
    Vector logs;
    for (const ModeHistory& each : histories_) logs.push_back(each.log_weight);
    const double total = log_total(logs, options_.kind);
    for (ModeHistory& each : histories_) each.log_weight -= total;
  }

  std::vector<ModeHistory> branched() const {
    std::vector<ModeHistory> all;
    for (Index j = 0; j < models_.size(); ++j)
      for (const ModeHistory& each : histories_) {
        const Index l = each.modes.back();
        if (transition_(l, j) == 0.0) continue;
        const auto& own = models_[l].components;
        const auto& next = models_[j].components;
        const bool begins =
            std::any_of(next.begin(), next.end(), [&](const auto& name) { return !position(own, name); });
        for (const double scale : begins ? options_.scales : Vector{0.0}) {
          ModeHistory branch = each;
          branch.modes.push_back(j);
          branch.log_weight += std::log(transition_(l, j));
          if (begins && options_.kind == Kind::imm)
            branch.log_weight -= std::log(static_cast<double>(options_.scales.size()));
          branch.state = in_components(each.state, own, next, scale * scale);
          all.push_back(branch);
        }
      }
    return all;
  }

  /// The best of every mode, and then the best.
  void keep(std::vector<ModeHistory> all) {
    std::stable_sort(all.begin(), all.end(),
                     [](const ModeHistory& a, const ModeHistory& b) { return a.log_weight > b.log_weight; });
    std::vector<ModeHistory> rest;
    histories_.clear();
    for (const ModeHistory& each : all) {
      const bool first = std::none_of(histories_.begin(), histories_.end(),
                                      [&](const ModeHistory& kept) { return kept.modes.back() == each.modes.back(); });
      (first ? histories_ : rest).push_back(each);
    }
    for (const ModeHistory& each : rest)
      if (histories_.size() < options_.histories && each.log_weight >= all.front().log_weight + options_.least)
        histories_.push_back(each);
    normalise();
  }

  void cycle(double dt, const Vector* z, const Matrix* R) {
    keep(branched());
    Vector fits;
    for (ModeHistory& each : histories_) {
      const Model& model = models_[each.modes.back()];
      const Matrix F = model.F(dt);
      each.state = {F * each.state.mean, symmetrised(F * each.state.covariance * transposed(F) + model.Q(dt))};
      if (!z) continue;
      const Matrix& H = model.H;
      const Matrix P = each.state.covariance;
      each.before = each.log_weight;
      each.nu = difference(*z, H * each.state.mean);
      each.S = symmetrised(H * P * transposed(H) + *R);
      const Inverse S_inverse = inverse(each.S);
      const Matrix W = P * transposed(H) * S_inverse.matrix;
      const Vector correction = W * each.nu;
      for (Index i = 0; i < correction.size(); ++i) each.state.mean[i] += correction[i];
      const Matrix kept = identity(correction.size()) - W * H;
      each.state.covariance = symmetrised(kept * P * transposed(kept) + W * *R * transposed(W));
      each.distance = dot(each.nu, S_inverse.matrix * each.nu);
      each.log_weight -= options_.tempering * 0.5 *
                         (each.distance + S_inverse.log_determinant +
                          static_cast<double>(z->size()) * std::log(2.0 * std::numbers::pi));
      fits.push_back(each.before - 0.5 * each.distance);
    }
    if (z) {
      gate_distance_ = -2.0 * log_total(fits, options_.kind);
      nis_ = collapsed_nis();
    }
    normalise();
    winner_ = largest(log_weights(), Tie::stay, winner_);
  }

  double collapsed_nis() const {
    Vector logs;
    std::vector<State> innovations;
    for (const ModeHistory& each : histories_) {
      logs.push_back(each.before);
      innovations.push_back({each.nu, each.S});
    }
    const Index best = static_cast<Index>(std::max_element(logs.begin(), logs.end()) - logs.begin());
    const State one = options_.kind == Kind::himm ? innovations[best] : averaged(innovations, logs);
    return dot(one.mean, inverse(one.covariance).matrix * one.mean);
  }

  std::vector<Model> models_;
  Matrix transition_;
  HistoryOptions options_;
  std::vector<ModeHistory> histories_;
  std::vector<std::string> components_;
  Index winner_ = 0;
  double nis_ = 0.0;
  double gate_distance_ = 0.0;
};

}  // namespace restatement
