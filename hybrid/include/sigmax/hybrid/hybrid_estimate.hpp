#pragma once

#include <cstddef>

#include <sigmax/core/belief.hpp>
#include <sigmax/hybrid/bank.hpp>

namespace sigmax {

/// What is known of a jump Markov system at one time: for each mode the estimate of the state if it is that mode, and
/// what is believed of the mode.
template <class Models, Uncertainty Kind>
struct HybridEstimate {
  typename Bank<Models>::Estimates estimates;
  Belief<Kind> belief;
  std::size_t most_likely_mode = 0;  ///< (64), where the output rule has broken ties
};

}  // namespace sigmax
