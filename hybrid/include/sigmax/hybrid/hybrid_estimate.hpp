#pragma once

#include <cstddef>
#include <vector>

#include <sigmax/core/belief.hpp>
#include <sigmax/hybrid/estimates.hpp>
#include <sigmax/hybrid/future_evidence.hpp>
#include <sigmax/hybrid/history_set.hpp>

namespace sigmax {

/// The estimate of a jump Markov system at one time: for each mode the estimate of the state given that mode, and the
/// belief in the modes.
template <ScalableUncertainty Kind>
struct HybridEstimate {
  Estimates estimates;
  Belief<Kind> belief;
  std::size_t most_likely_mode = 0;  ///< (64), where the output rule has broken ties
  HistorySet histories = {};         ///< of a filter that keeps them
};

/// What one step of a multiple-model filter left, for smoothing.
template <ScalableUncertainty Kind>
struct RecordedStep {
  double dt;  ///< since the step before, in s; ignored in the first record
  HybridEstimate<Kind> state;
  std::vector<FutureEvidence> seen;  ///< the measurement's information on each mode's estimate; empty if it was missed
};

}  // namespace sigmax
