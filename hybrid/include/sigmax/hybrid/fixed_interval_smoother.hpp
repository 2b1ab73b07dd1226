#pragma once

#include <cstddef>
#include <vector>

#include <sigmax/core/table.hpp>
#include <sigmax/hybrid/multiple_model_filter.hpp>

namespace sigmax {

/// Fixed-interval smoothing for the multiple-model filters, with a random or a fuzzy mode: the estimate of step k
/// given all measurements.
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
template <ScalableUncertainty Kind>
class FixedIntervalSmoother {
 public:
  using State = HybridEstimate<Kind>;
  using Step = RecordedStep<Kind>;

  /// For what this filter records; its models and rules are taken over.
  explicit FixedIntervalSmoother(const MultipleModelFilter<Kind>& filter);

  /// Begins at the last step: its smoothed state is the filtered one.
  void begin(const Step& last);

  /// One step back, to the step before the last that it saw. Allocates nothing.
  /// Throws std::domain_error, naming the model, if a covariance is not positive semi-definite.
  void step(const Step& before);

  /// Begins at the last of the steps `at(k)`, first ≤ k < end, and goes back to the first; calls visit(k) at each.
  template <class At, class Visit>
  void back_over(std::size_t first, std::size_t end, const At& at, const Visit& visit) {
    begin(at(end - 1));
    visit(end - 1);
    for (std::size_t k = end - 1; k-- > first;) {
      step(at(k));
      visit(k);
    }
  }

  /// The smoothed state of the last step that it saw.
  const State& state() const { return state_; }

 private:
  std::size_t modes() const { return system_.models().size(); }
  double smooth_pair(const Estimates& filtered, std::size_t i, std::size_t j);
  void merge(const Step& before);

  JumpMarkovSystem<Kind> system_;
  Interaction<Kind> interaction_;
  detail::Components components_;
  Estimates entries_;  ///< what StateAugmentation::prior lends
  State state_;
  Estimates pairs_;                                 ///< of mode i: one for each j, at i · modes + j
  std::vector<FutureEvidence> evidence_;            ///< of each j, about the mean of its filtered estimate
  std::vector<FutureEvidence> nothing_;             ///< what a missed measurement tells of each i
  std::vector<std::vector<FutureEvidence>> parts_;  ///< what j tells of i, at [i][j]
  Estimates filtered_;                              ///< of the last step that it saw, whose means these are
  std::vector<std::vector<double>> roots_;          ///< of the covariances of each i
  std::vector<double> log_weight_;                  ///< of each i
  std::vector<double> weights_;                     ///< of each j, for the i at hand
  Table joint_;                                     ///< log w(i, j)
  double dt_ = 0.0;                                 ///< from the step before to the last that it saw
};

extern template class FixedIntervalSmoother<Random>;
extern template class FixedIntervalSmoother<Fuzzy>;

/// The smoothed states of a whole interval, one for each record; the last is the filtered one. The record grows with
/// the interval. `filter.estimate(state)` gives the output of a smoothed state.
///
///     std::vector record{filter.recorded(0.0)};
///     for (const auto& [dt, z] : measurements) {
///       filter.step(dt, z);
///       record.push_back(filter.recorded(dt, z));
///     }
///     const auto smoothed = smooth(filter, record);
template <ScalableUncertainty Kind>
std::vector<HybridEstimate<Kind>> smooth(const MultipleModelFilter<Kind>& filter,
                                         const std::vector<RecordedStep<Kind>>& record) {
  FixedIntervalSmoother<Kind> smoother(filter);
  std::vector<HybridEstimate<Kind>> smoothed(record.size(), smoother.state());
  if (!record.empty())
    smoother.back_over(
        0, record.size(), [&](std::size_t k) -> const auto& { return record[k]; },
        [&](std::size_t k) { smoothed[k] = smoother.state(); });
  return smoothed;
}

}  // namespace sigmax
