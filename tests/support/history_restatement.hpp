/// A restatement of the filter over mode histories in the manner of restatement.hpp: every history is the list of its
/// modes with a Kalman filter of its own. Nothing is shared between them, and nothing is kept in place. Where none is
/// dropped, it is the enumeration of all of them.
#pragma once

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
  State innovation = {};
  double before = 0.0;  ///< log weight before the measurement
};

class HistoryFilter {
 public:
  HistoryFilter(std::vector<Model> models, Matrix transition, const std::vector<State>& starts, HistoryOptions options)
      : models_{std::move(models)}, transition_{std::move(transition)}, options_{std::move(options)} {
    for (Index j = 0; j < models_.size(); ++j) histories_.push_back({{j}, starts[j], 0.0});
    normalise();
    winner_ = largest(log_weights(), Tie::stay, 0);
    for (const Model& model : models_)
      if (model.components.size() > components_.size()) components_ = model.components;
  }

  void step(double dt) { cycle(dt, nullptr, {}); }
  void step(double dt, const Vector& z, const Matrix& R) { step(dt, seen_by_matrix(z), R); }
  void step(double dt, const See& see, const Matrix& R) { cycle(dt, &see, R); }

  const std::vector<ModeHistory>& histories() const { return histories_; }
  Index winner() const { return winner_; }
  double nis() const { return nis_; }
  double gate_distance() const { return gate_distance_; }
  double log_evidence() const { return log_evidence_; }
  double log_score() const { return log_score_; }

  /// Of mode j after so many steps, now by default.
  Vector log_weights() const { return log_weights(histories_.front().modes.size() - 1); }
  Vector log_weights(Index step) const {
    Vector result;
    for (Index j = 0; j < models_.size(); ++j) {
      Vector own{nothing};
      for (const ModeHistory& each : histories_)
        if (each.modes[step] == j) own.push_back(each.log_weight);
      result.push_back(log_total(own, options_.kind));
    }
    return result;
  }

  /// One estimate for the histories that end in mode j, and the innovation of the one that was best before it.
  State of_mode(Index j) const {
    Vector logs;
    std::vector<State> states;
    for (const ModeHistory& each : histories_)
      if (each.modes.back() == j) {
        logs.push_back(each.log_weight);
        states.push_back(each.state);
      }
    return collapsed(states, logs);
  }
  State innovation_of_mode(Index j) const {
    const ModeHistory* best = nullptr;
    for (const ModeHistory& each : histories_)
      if (each.modes.back() == j && (!best || each.before > best->before)) best = &each;
    return best->innovation;
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
  static State averaged(const std::vector<State>& states, Vector logs) {
    const double total = log_total(logs, Kind::imm);
    for (double& log : logs) log = std::exp(log - total);
    return moments(states, logs, logs);
  }
  State collapsed(const std::vector<State>& states, const Vector& logs) const {
    if (options_.kind == Kind::imm) return averaged(states, logs);
    return states[static_cast<Index>(std::max_element(logs.begin(), logs.end()) - logs.begin())];
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

  Vector logs() const {
    Vector result;
    for (const ModeHistory& each : histories_) result.push_back(each.log_weight);
    return result;
  }
  void normalise() {
    const double total = log_total(logs(), options_.kind);
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

  void cycle(double dt, const See* see, const Matrix& R) {
    keep(branched());
    Vector fits, evidence;
    for (ModeHistory& each : histories_) {
      const Model& model = models_[each.modes.back()];
      each.state = predicted(model, each.state, dt);
      if (!see) continue;
      const Sighting seen = sighted(each.state, (*see)(model, each.state.mean), R);
      each.state = seen.posterior;
      each.innovation = {seen.nu, seen.S};
      each.before = each.log_weight;
      each.log_weight += options_.tempering * seen.log_density;
      fits.push_back(each.before - 0.5 * seen.squared_distance);
      evidence.push_back(each.before + seen.log_density);
    }
    if (see) {
      Vector before;
      std::vector<State> innovations;
      for (const ModeHistory& each : histories_) {
        before.push_back(each.before);
        innovations.push_back(each.innovation);
      }
      const State one = collapsed(innovations, before);
      nis_ = dot(one.mean, inverse(one.covariance).matrix * one.mean);
      gate_distance_ = -2.0 * log_total(fits, options_.kind);
      log_evidence_ = log_total(evidence, options_.kind);
      log_score_ = log_evidence_ - log_total(before, Kind::imm);
    }
    normalise();
    winner_ = largest(log_weights(), Tie::stay, winner_);
  }

  std::vector<Model> models_;
  Matrix transition_;
  HistoryOptions options_;
  std::vector<ModeHistory> histories_;
  std::vector<std::string> components_;
  Index winner_ = 0;
  double nis_ = 0.0;
  double gate_distance_ = 0.0;
  double log_evidence_ = 0.0;
  double log_score_ = 0.0;
};

}  // namespace restatement
