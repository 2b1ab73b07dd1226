#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <sigmax/hybrid/fixed_interval_smoother.hpp>

namespace sigmax {

/// Smoothing while the measurements still come: each step as it is known `lag` steps later. It keeps lag + 1 steps and
/// goes back over them at every one, so a step costs `lag` steps of FixedIntervalSmoother; with a lag of the whole
/// interval it is that one.
///
///     FixedLagSmoother smoother(filter, 10);
///     for (const auto& [dt, z] : measurements) {
///       filter.step(dt, z);
///       if (const auto* state = smoother.take(filter.recorded(dt, z))) …   // of the tenth step before this
///     }
///     for (const auto& state : smoother.rest()) …                          // of the last ten
template <ScalableUncertainty Kind>
class FixedLagSmoother {
 public:
  using State = HybridEstimate<Kind>;
  using Step = RecordedStep<Kind>;

  /// For what this filter records.
  FixedLagSmoother(const MultipleModelFilter<Kind>& filter, std::size_t lag) : smoother_(filter), lag_(lag) {}

  /// Takes the next step; returns the smoothed state of the one `lag` before it, if there is one.
  const State* take(Step step) {
    if (window_.size() > lag_) window_.erase(window_.begin());
    window_.push_back(std::move(step));
    if (window_.size() <= lag_) return nullptr;
    back_to(0, [](std::size_t) {});
    return &smoother_.state();
  }

  /// The smoothed states of the last steps, which `take` has not returned yet, in order.
  std::vector<State> rest() {
    const std::size_t returned = window_.size() > lag_ ? 1 : 0;
    std::vector<State> states(window_.size() - returned, smoother_.state());
    if (!states.empty()) back_to(returned, [&](std::size_t k) { states[k - returned] = smoother_.state(); });
    return states;
  }

 private:
  template <class Visit>
  void back_to(std::size_t earliest, const Visit& visit) {
    smoother_.back_over(
        earliest, window_.size(), [&](std::size_t k) -> const Step& { return window_[k]; }, visit);
  }

  FixedIntervalSmoother<Kind> smoother_;
  std::size_t lag_;
  std::vector<Step> window_;  ///< the oldest step first
};

}  // namespace sigmax
