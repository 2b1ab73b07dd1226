#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <sigmax/core/table.hpp>
#include <sigmax/hybrid/any_target.hpp>

namespace sigmax {

/// How well a target with this choice predicts each of the plots, its log_score, by their tags 0, 1, …: the sum is the
/// prequential log-likelihood. NaN for plots that are no step with a measurement: misses, and what the start took.
///
///     double sum = 0.0;
///     for (const double score : log_scores(choice, plots)) sum += std::isnan(score) ? 0.0 : score;
///
/// Throws as AnyTarget does, std::invalid_argument for a tag that is not below the number of plots.
std::vector<double> log_scores(const TargetChoice& choice, std::span<const AnyPlot> plots);

/// A log_score that no measurement can spoil alone: a share of all measurements are stray ones, of a density whose
/// logarithm is log_stray here, whatever the settings. It is log((1 − share) exp(log_score) + share exp(log_stray)),
/// the contaminated-normal likelihood, at least log(share) + log_stray.
double robust_log_score(double log_score, double share, double log_stray);

/// How often modes changed, in what smoothing knows of recordings: one step of EM for the transition.
///
/// With a random mode the smoothed weights of each pair add up (Baum and Welch). With a fuzzy mode the best path is
/// counted, the modes that were most possible at the end and back from there; with half a count for each pair, so that
/// what was not seen is not impossible.
class TransitionCounts {
 public:
  TransitionCounts(std::size_t modes, bool fuzzy) : fuzzy_(fuzzy), counts_(modes, modes), seconds_(modes) {}

  /// Takes what `AnyTarget::smoothed` tells, in its order. A step that does not count only leads the path on.
  void add(const ModePairs& pairs, bool counts = true);

  /// Adds the counts of another one, which may have been collected elsewhere.
  void add(const TransitionCounts& other);

  /// Of steps from mode i to j.
  double operator()(std::size_t i, std::size_t j) const { return counts_(i, j); }

  /// The transition per step that explains the counts best: rows that sum to one, or divided by their maximum. Where a
  /// mode never was, its row is that of `otherwise`.
  std::vector<std::vector<double>> transition(const std::vector<std::vector<double>>& otherwise) const;

  /// The mean sojourn times that explain the counts best, s: the time in each mode for each departure. Where there was
  /// none, that of `otherwise`.
  std::vector<double> sojourns(const std::vector<double>& otherwise) const;

 private:
  bool fuzzy_;
  Table counts_;
  std::vector<double> seconds_;  ///< in each mode
  std::size_t next_ = 0;         ///< the mode of the best path after the step to come
};

/// Smooths the plots of one target and counts; `counts(tag)` says whether the step to a plot counts.
void count_transitions(const TargetChoice& choice, std::span<const AnyPlot> plots,
                       const std::function<bool(std::size_t tag)>& counts, TransitionCounts& result);

}  // namespace sigmax
