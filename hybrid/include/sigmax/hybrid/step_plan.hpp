#pragma once

#include <array>
#include <cstddef>

#include <sigmax/estimation/refs.hpp>
#include <sigmax/hybrid/interaction.hpp>

namespace sigmax::detail {

/// What the kernels of a FastPath know: up to four models that move along the same axes, the rules in force, and the
/// step in hand.
struct StepPlan {
  static constexpr int max_modes = 4;

  int axes = 0;
  int modes = 0;
  std::array<int, max_modes> order{};  ///< of each model, 2 or 3
  const AxisLaw* law = nullptr;        ///< of each model
  const double* transition = nullptr;  ///< to j from i, at i · modes + j
  StateAugmentation augmentation{};
  MixedCovariance mixed_covariance{};
  Tie mixing_tie{};
  Tie output_tie{};
  LikelihoodForm likelihood{};

  int order_of(int j) const { return order[static_cast<std::size_t>(j)]; }
};

}  // namespace sigmax::detail
