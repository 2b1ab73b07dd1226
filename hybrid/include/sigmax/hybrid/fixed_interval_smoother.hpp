#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include <Eigen/Cholesky>

#include <sigmax/core/logarithm.hpp>
#include <sigmax/core/table.hpp>
#include <sigmax/estimation/rts_smoother.hpp>
#include <sigmax/hybrid/future_evidence.hpp>
#include <sigmax/hybrid/multiple_model_filter.hpp>

namespace sigmax {

/// Fixed-interval smoothing for the multiple-model filters, with a random or a fuzzy mode: what was known at k becomes
/// what is known of k at the end.
///
/// For each pair of a mode i at k and j at k + 1, what came to be known after k in mode j (FutureEvidence) meets the
/// prediction from i by the model of j, and a step back of Rauch, Tung and Striebel takes the result to i. With the
/// evidence Λ_ij of that meeting and the smoothed belief b of k + 1 the pair weighs
///
///   w(i, j) = B(i|j) ⊗ b(j),   B(i|j) ∝ π(j|i) ⊗ b_k(i) ⊗ Λ_ij,   ⊕ᵢ B(i|j) = 1.
///
/// The smoothed belief of k is ⊕ⱼ w(i, j), and the j of each i collapse: moments if the mode is random, selection if it
/// is fuzzy. So one Gaussian a mode is kept backwards, as it is forwards (compare Kim 1994; Helmick, Blair, Hoffman
/// 1995). Ties of the most likely mode are broken by the output rule, whose previous winner is that of k + 1. With one
/// model it is the smoother of Rauch, Tung and Striebel.
template <class Models, Uncertainty Kind>
class FixedIntervalSmoother {
 public:
  using State = HybridEstimate<Models, Kind>;
  using Step = RecordedStep<Models, Kind>;

  /// For what this filter records; its models and rules are taken over.
  explicit FixedIntervalSmoother(const MultipleModelFilter<Models, Kind>& filter)
      : filter_(filter),
        system_(filter.system()),
        starts_(filter.estimates()),
        predictions_(filter.estimates()),
        pairs_(pairs_for(filter.estimates())),
        log_weight_(filter.modes()),
        joint_(filter.modes(), filter.modes()) {}

  /// One step back: `smoothed` is the smoothed state after the step `next`, and becomes that of `filtered`, the state
  /// before it. Allocates nothing.
  /// Throws std::domain_error, naming the model, if what it predicted is not positive definite.
  void step(const State& filtered, const Step& next, State& smoothed) {
    const auto& transition = system_.transition(next.dt);
    for_each_mode(smoothed.estimates, [&](auto j) {
      const auto pair = [&](std::size_t i) { return joint_(i, j); };
      for (std::size_t i = 0; i < modes(); ++i) joint_(i, j) = filtered.belief.log(i) + std::log(transition(i, j));
      if (total(pair) == log_zero || smoothed.belief.log(j) == log_zero) {
        for (std::size_t i = 0; i < modes(); ++i) joint_(i, j) = log_zero;
        return;
      }
      const Evidence evidence(of_any_size(mode(next.predicted, j)), of_any_size(mode(smoothed.estimates, j)), name(j));
      for_each_mode(filtered.estimates, [&](auto i) {
        if (joint_(i, j) != log_zero) joint_(i, j) += smooth_pair(filtered.estimates, i, j, next.dt, evidence);
      });
      const double log_total = total(pair);
      for (std::size_t i = 0; i < modes(); ++i) joint_(i, j) += smoothed.belief.log(j) - log_total;
    });
    merge(filtered, smoothed);
  }

 private:
  // The algebra of a pair is done at run-time size: models of any two sizes then share its code.
  static constexpr int max_size = Bank<Models>::max_state_size;
  using Estimate = Gaussian<Eigen::Dynamic, max_size>;
  using Matrix = SquareMatrix<Eigen::Dynamic, max_size>;
  using Evidence = FutureEvidence<Eigen::Dynamic, max_size>;

  template <int N, int MaxN>
  static Estimate of_any_size(const Gaussian<N, MaxN>& estimate) {
    return {estimate.mean, estimate.covariance};
  }

  std::size_t modes() const { return filter_.modes(); }
  auto name(std::size_t j) const { return system_.mode_variable().label(j); }

  /// log ⊕ exp over the modes, by the mode's own ⊕.
  template <class LogWeight>
  double total(const LogWeight& log_weight) const {
    return log_combine<AlgebraOf<Kind>>(modes(), log_weight, [](std::size_t) { return 1.0; });
  }

  /// The estimate of mode i given mode j next and all that came to be known in j; returns the evidence.
  template <class I, class J>
  double smooth_pair(const typename Bank<Models>::Estimates& filtered, I i, J j, double dt, const Evidence& evidence) {
    const auto& model = mode(system_.models(), j);
    auto& start = mode(starts_, j);  // the estimate of i in the components of j
    auto& predicted = mode(predictions_, j);
    const Lifted read(mode(filtered, j), mode(filtered, i), filter_.correspondences(j)[i], filter_.interaction().lift);
    start.mean = read.mean();
    start.covariance.setZero();
    read.add_covariance(1.0, start.covariance);
    predict(model, start, dt, predicted);
    const Estimate of_i = of_any_size(mode(filtered, i));
    const Matrix cross = covariance_with(of_any_size(start), of_i, filter_.correspondences(j)[i],
                                         filter_.correspondences(i)[j], prediction_covariance(model, start, dt));
    const Estimate prediction = of_any_size(predicted);
    Estimate smoothed = prediction;
    const double log_evidence = evidence.meet(prediction, smoothed);
    step_back(of_i, cross, prediction, smoothed, model.name(), smoothed);
    mode(pairs_, i)[j] = {smoothed.mean, smoothed.covariance};
    return log_evidence;
  }

  /// The covariance of the state of i with what was predicted from it, where `predicted_with` is that of the start in
  /// the components of j. A component that j lacks is correlated with the prediction through those that j has.
  static Matrix covariance_with(const Estimate& start, const Estimate& of_i, const Correspondence& from_i,
                                const Correspondence& to_j, const Matrix& predicted_with) {
    Matrix cross(of_i.size(), start.size());
    bool all_shared = true;
    for (Eigen::Index a = 0; a < of_i.size(); ++a) {
      const Eigen::Index in_j = to_j.in_source[static_cast<std::size_t>(a)];
      if (in_j >= 0) cross.row(a) = predicted_with.row(in_j);
      all_shared = all_shared && in_j >= 0;
    }
    if (all_shared) return cross;
    const Eigen::LDLT<Matrix> factor(start.covariance);
    const Matrix regression = factor.solve(predicted_with);
    for (Eigen::Index a = 0; a < of_i.size(); ++a) {
      if (to_j.in_source[static_cast<std::size_t>(a)] >= 0) continue;
      cross.row(a).setZero();
      for (Eigen::Index b = 0; b < start.size(); ++b) {
        const Eigen::Index in_i = from_i.in_source[static_cast<std::size_t>(b)];
        if (in_i >= 0) cross.row(a) += of_i.covariance(a, in_i) * regression.row(b);
      }
    }
    return cross;
  }

  /// The belief of k, and for each of its modes one estimate; a mode that leads nowhere keeps its own.
  void merge(const State& filtered, State& smoothed) {
    for (std::size_t i = 0; i < modes(); ++i) log_weight_[i] = total([&](std::size_t j) { return joint_(i, j); });
    smoothed.belief.assign([&](std::size_t i) { return log_weight_[i]; });
    for_each_mode(filtered.estimates, [&](auto i) {
      auto& result = mode(smoothed.estimates, i);
      if (log_weight_[i] == log_zero) {
        result = mode(filtered.estimates, i);
        return;
      }
      const auto log_weight = [&](std::size_t j) { return joint_(i, j) - log_weight_[i]; };
      collapse(
          Collapse<Kind>{}, EstimateMixture<std::decay_t<decltype(result)>>{mode(pairs_, i)},
          [&](std::size_t j) { return std::exp(log_weight(j)); }, select(modes(), log_weight, i, Tie::stay), result);
    });
    smoothed.most_likely_mode = select(
        modes(), [&](std::size_t i) { return smoothed.belief.log(i); }, smoothed.most_likely_mode,
        filter_.interaction().output_tie);
  }

  MultipleModelFilter<Models, Kind> filter_;
  JumpMarkovSystem<Models, Kind> system_;
  typename Bank<Models>::Estimates starts_;       ///< of the pair at hand
  typename Bank<Models>::Estimates predictions_;  ///< of the pair at hand
  typename Bank<Models>::Pairs pairs_;            ///< of mode i: one for each j
  std::vector<double> log_weight_;                ///< of each i
  Table joint_;                                   ///< log w(i, j)
};

/// The smoothed states of a whole interval, one for each record; the last is the filtered one. The record grows with
/// the interval, by two estimates of each model a step. `filter.estimate(state)` gives the output of a smoothed state.
///
///     std::vector record{filter.recorded(0.0)};
///     for (const auto& [dt, z] : measurements) {
///       filter.step(dt, z);
///       record.push_back(filter.recorded(dt));
///     }
///     const auto smoothed = smooth(filter, record);
template <class Models, Uncertainty Kind>
std::vector<HybridEstimate<Models, Kind>> smooth(const MultipleModelFilter<Models, Kind>& filter,
                                                 const std::vector<RecordedStep<Models, Kind>>& record) {
  FixedIntervalSmoother<Models, Kind> smoother(filter);
  std::vector<HybridEstimate<Models, Kind>> smoothed;
  for (const auto& step : record) smoothed.push_back(step.state);
  for (std::size_t k = record.size(); k-- > 1;) {
    smoothed[k - 1] = smoothed[k];
    smoother.step(record[k - 1].state, record[k], smoothed[k - 1]);
  }
  return smoothed;
}

}  // namespace sigmax
