#pragma once

#include <sigmax/hybrid/collapse.hpp>
#include <sigmax/hybrid/state_augmentation.hpp>

namespace sigmax {

/// The mixture from which a model starts its step.
enum class MixedStart {
  of_each_mode,  ///< one for each mode, by what moves into it, (55)–(59): IMM and HIMM
  common         ///< one for all, by the belief before the step: GPB1; of a fuzzy mode one global arg max in (55)
};

/// How well a model explains a measurement with innovation ν and its covariance S.
enum class LikelihoodForm {
  density,     ///< N(ν; 0, S), which also blames a model for a wide S
  possibility  ///< exp(−νᵀS⁻¹ν/2), the possibility (33) of ν: a wide S costs nothing
};

/// The choices that the paper leaves open; the defaults are argued in docs/readings.md.
template <ScalableUncertainty Kind>
struct Interaction {
  StateAugmentation augmentation = StateAugmentation::borrowed_variance;
  Collapse<Kind> collapse = {};
  Tie output_tie = Tie::stay;
  MixedStart mixed_start = MixedStart::of_each_mode;
  LikelihoodForm likelihood = LikelihoodForm::density;
  EntryPrior entry = {};  ///< of StateAugmentation::prior
};

}  // namespace sigmax
