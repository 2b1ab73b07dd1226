#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include <sigmax/core/logarithm.hpp>
#include <sigmax/core/table.hpp>
#include <sigmax/estimation/covariance_root.hpp>
#include <sigmax/estimation/rts_smoother.hpp>
#include <sigmax/hybrid/evidence_collapse.hpp>
#include <sigmax/hybrid/multiple_model_filter.hpp>

namespace sigmax {

/// Fixed-interval smoothing for the multiple-model filters, with a random or a fuzzy mode: what was known at k becomes
/// what is known of k at the end.
///
/// What came to be known from k + 1 on in mode j is a likelihood (FutureEvidence). For each pair of a mode i at k and j
/// at k + 1 the model of j carries it back to k, where it meets the estimate of i. With the evidence Λ_ij of that
/// meeting and the smoothed belief b of k + 1 the pair weighs
///
///   w(i, j) = B(i|j) ⊗ b(j),   B(i|j) ∝ π(j|i) ⊗ b_k(i) ⊗ Λ_ij,   ⊕ᵢ B(i|j) = 1.
///
/// The smoothed belief of k is ⊕ⱼ w(i, j), and the j of each i collapse: moments if the mode is random, selection if it
/// is fuzzy. What then makes of the filtered estimate of i the smoothed one, with the measurement of k, is the evidence
/// that k − 1 gets. So one Gaussian a mode is kept backwards, as it is forwards (compare Kim 1994; Helmick, Blair,
/// Hoffman 1995). Ties of the most likely mode are broken by the output rule, whose previous winner is that of k + 1.
/// With one model it is the smoother of Rauch, Tung and Striebel.
///
///     FixedIntervalSmoother smoother(filter);
///     smoother.begin(record.back());
///     for (std::size_t k = record.size() - 1; k-- > 0;) smoother.step(record[k]);   // smoother.state() is of k
///
/// The reference that `state` returns lives as long as the smoother, and shows what the last step left.
template <class Models, ScalableUncertainty Kind>
class FixedIntervalSmoother {
 public:
  using State = HybridEstimate<Models, Kind>;
  using Step = RecordedStep<Models, Kind>;

  /// For what this filter records; its models and rules are taken over.
  explicit FixedIntervalSmoother(const MultipleModelFilter<Models, Kind>& filter);

  /// Begins at the last step: its smoothed state is the filtered one.
  void begin(const Step& last);

  /// One step back, to the step before the last that it saw. Allocates nothing.
  /// Throws std::domain_error, naming the model, if a covariance is not positive semi-definite.
  void step(const Step& before);

  /// The smoothed state of the last step that it saw.
  const State& state() const { return state_; }

  /// log w(i, j) of the last step back: mode i at the step it went to, j at the one after.
  const Table& log_pairs() const { return joint_; }

 private:
  // The algebra of a pair is done at run-time size: models of any two sizes then share its code.
  static constexpr int max_size = Bank<Models>::max_state_size;
  using Matrix = SquareMatrix<Eigen::Dynamic, max_size>;
  using Evidence = FutureEvidence<max_size>;
  using Noise = RectangularMatrix<Eigen::Dynamic, Eigen::Dynamic, max_size, 2 * max_size>;

  std::size_t modes() const { return filter_.modes(); }

  /// log ⊕ exp over the modes, by the mode's own ⊕.
  template <class LogWeight>
  double total(const LogWeight& log_weight) const {
    return detail::log_combine<AlgebraOf<Kind>>(modes(), log_weight, [](std::size_t) { return 1.0; });
  }

  template <class I>
  void roots_of(I i, const State& filtered) {
    roots_[i] = detail::covariance_root(mode(filtered.estimates, i).covariance, mode(system_.models(), i).name());
  }

  /// The estimate of mode i given mode j next and all that came to be known in j, and what that tells of i; returns the
  /// logarithm of the evidence.
  template <class I, class J>
  double smooth_pair(const typename Bank<Models>::Estimates& filtered, I i, J j) {
    const auto& model = mode(system_.models(), j);
    auto& start = mode(starts_, j);  // the estimate of i in the components of j
    const auto& from_i = filter_.correspondences(j)[i].in_source;
    const Lifted read(mode(filter_.lenders(filtered), j), mode(filtered, i), filter_.correspondences(j)[i],
                      filter_.interaction().lift);
    start.mean = read.mean();
    start.covariance.setZero();
    read.add_covariance(1.0, start.covariance);
    const auto linear = linearised_step(model, start, dt_);

    const Eigen::Index n = start.size();
    typename Evidence::Rows B = Evidence::Rows::Zero(n, mode(filtered, i).size());
    Noise A(n, 2 * n);
    Eigen::Index noises = 0;
    const auto add_noise = [&](const Matrix& root) {
      for (Eigen::Index a = 0; a < n; ++a)
        if (!root.col(a).isZero(0.0)) A.col(noises++) = root.col(a);
    };
    add_noise(detail::covariance_root(linear.Q, model.name()));
    bool all = true;
    for (Eigen::Index b = 0; b < n; ++b) {
      const Eigen::Index in_i = from_i[static_cast<std::size_t>(b)];
      if (in_i >= 0)
        B.col(in_i) = linear.F.col(b);
      else
        all = false;
    }
    if (!all) {
      for (Eigen::Index b = 0; b < n; ++b)
        if (from_i[static_cast<std::size_t>(b)] >= 0) {
          start.covariance.row(b).setZero();
          start.covariance.col(b).setZero();
        }
      add_noise(linear.F * detail::covariance_root(start.covariance, model.name()));
    }
    A.conservativeResize(n, noises);
    auto& part = parts_[i][j];
    double log_evidence = evidence_[j].carry_back(linear.mean - means_[j], B, A, part);
    Gaussian<Eigen::Dynamic, max_size> pair{mode(filtered, i).mean, roots_[i]};
    log_evidence += part.meet(roots_[i], pair);
    mode(pairs_, i)[j] = {pair.mean, pair.covariance};
    return log_evidence;
  }

  /// The belief of k, and for each of its modes one estimate; a mode that leads nowhere keeps its own.
  void merge(const Step& before);

  MultipleModelFilter<Models, Kind> filter_;
  JumpMarkovSystem<Models, Kind> system_;
  State state_;
  typename Bank<Models>::Estimates starts_;   ///< of the pair at hand
  typename Bank<Models>::Pairs pairs_;        ///< of mode i: one for each j
  std::vector<Evidence> evidence_;            ///< of each j, about the mean of its filtered estimate
  std::vector<std::vector<Evidence>> parts_;  ///< what j tells of i, at [i][j]
  std::vector<Vector<Eigen::Dynamic, max_size>> means_;
  std::vector<Matrix> roots_ = std::vector<Matrix>(modes());
  EvidenceCollapse<max_size> collapse_;
  std::vector<double> log_weight_;  ///< of each i
  std::vector<double> weights_;     ///< of each j, for the i at hand
  Table joint_;                     ///< log w(i, j)
  double dt_ = 0.0;                 ///< from the step before to the last that it saw
};

template <class Models, ScalableUncertainty Kind>
FixedIntervalSmoother<Models, Kind>::FixedIntervalSmoother(const MultipleModelFilter<Models, Kind>& filter)
    : filter_(filter),
      system_(filter.system()),
      state_(filter.state()),
      starts_(filter.estimates()),
      pairs_(detail::pairs_for(filter.estimates())),
      evidence_(modes()),
      parts_(modes(), std::vector<Evidence>(modes())),
      means_(modes()),
      collapse_(modes()),
      log_weight_(modes()),
      weights_(modes()),
      joint_(modes(), modes()) {}

template <class Models, ScalableUncertainty Kind>
void FixedIntervalSmoother<Models, Kind>::begin(const Step& last) {
  state_ = last.state;
  for_each_mode(last.state.estimates, [&](auto j) {
    evidence_[j].clear(mode(last.state.estimates, j).size());
    if (!last.seen.empty()) evidence_[j].add(last.seen[j].R, last.seen[j].r);
    means_[j] = mode(last.state.estimates, j).mean;
  });
  dt_ = last.dt;
}

template <class Models, ScalableUncertainty Kind>
void FixedIntervalSmoother<Models, Kind>::step(const Step& before) {
  const State& filtered = before.state;
  const auto& transition = system_.transition(dt_);
  for_each_mode(filtered.estimates, [&](auto i) { roots_of(i, filtered); });
  for_each_mode(state_.estimates, [&](auto j) {
    const auto pair = [&](std::size_t i) { return joint_(i, j); };
    for (std::size_t i = 0; i < modes(); ++i) joint_(i, j) = filtered.belief.log(i) + std::log(transition(i, j));
    if (total(pair) == log_zero || state_.belief.log(j) == log_zero) {
      for (std::size_t i = 0; i < modes(); ++i) joint_(i, j) = log_zero;
      return;
    }
    for_each_mode(filtered.estimates, [&](auto i) {
      if (joint_(i, j) != log_zero) joint_(i, j) += smooth_pair(filtered.estimates, i, j);
    });
    const double log_total = total(pair);
    for (std::size_t i = 0; i < modes(); ++i) joint_(i, j) += state_.belief.log(j) - log_total;
  });
  merge(before);
  dt_ = before.dt;
}

template <class Models, ScalableUncertainty Kind>
void FixedIntervalSmoother<Models, Kind>::merge(const Step& before) {
  const State& filtered = before.state;
  for (std::size_t i = 0; i < modes(); ++i) log_weight_[i] = total([&](std::size_t j) { return joint_(i, j); });
  state_.belief.assign([&](std::size_t i) { return log_weight_[i]; });
  for_each_mode(filtered.estimates, [&](auto i) {
    auto& result = mode(state_.estimates, i);
    means_[i] = mode(filtered.estimates, i).mean;
    evidence_[i].clear(means_[i].size());
    if (log_weight_[i] == log_zero) {
      result = mode(filtered.estimates, i);
      return;
    }
    const auto log_weight = [&](std::size_t j) { return joint_(i, j) - log_weight_[i]; };
    for (std::size_t j = 0; j < modes(); ++j) weights_[j] = std::exp(log_weight(j));
    const auto weight = [&](std::size_t j) { return weights_[j]; };
    const std::size_t best = detail::select(modes(), log_weight, i, Tie::stay);
    collapse(Collapse<Kind>{}, EstimateMixture<std::decay_t<decltype(result)>>{mode(pairs_, i)}, weight, best, result);
    Evidence seen;
    seen.clear(means_[i].size());
    if (!before.seen.empty()) seen = before.seen[i];
    if constexpr (SelectiveAlgebra<AlgebraOf<Kind>>) {
      evidence_[i] = parts_[i][best];
      evidence_[i].add(seen.R, seen.r);
    } else {
      collapse_(parts_[i], weights_, roots_[i], seen, evidence_[i]);
    }
  });
  state_.most_likely_mode = detail::select(
      modes(), [&](std::size_t i) { return state_.belief.log(i); }, state_.most_likely_mode,
      filter_.interaction().output_tie);
}

/// The smoothed states of a whole interval, one for each record; the last is the filtered one. The record grows with
/// the interval. `filter.estimate(state)` gives the output of a smoothed state.
///
///     std::vector record{filter.recorded(0.0)};
///     for (const auto& [dt, z] : measurements) {
///       filter.step(dt, z);
///       record.push_back(filter.recorded(dt, z));
///     }
///     const auto smoothed = smooth(filter, record);
template <class Models, ScalableUncertainty Kind>
std::vector<HybridEstimate<Models, Kind>> smooth(const MultipleModelFilter<Models, Kind>& filter,
                                                 const std::vector<RecordedStep<Models, Kind>>& record) {
  FixedIntervalSmoother<Models, Kind> smoother(filter);
  std::vector<HybridEstimate<Models, Kind>> smoothed;
  for (const auto& step : record) smoothed.push_back(step.state);
  if (record.empty()) return smoothed;
  smoother.begin(record.back());
  for (std::size_t k = record.size() - 1; k-- > 0;) {
    smoother.step(record[k]);
    smoothed[k] = smoother.state();
  }
  return smoothed;
}

}  // namespace sigmax
