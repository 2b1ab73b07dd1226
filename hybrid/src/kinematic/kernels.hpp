#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <sigmax/estimation/filtering.hpp>
#include <sigmax/hybrid/step_plan.hpp>

namespace sigmax::detail::kinematic {

/// What one step of one track writes: for each model the estimate, the mean before the measurement, and the innovation
/// if there was one; the weights of the modes before and after it, and the most likely one.
struct Result {
  View estimate[StepPlan::max_modes];
  double* predicted[StepPlan::max_modes];
  InnovationView innovation[StepPlan::max_modes];
  double* log_prior;
  double* log_posterior;
  std::size_t most_likely;
};

/// The functions for so many axes and a kind of mode. A block holds the numbers of so many tracks as there are lanes,
/// or of one, in an order of its own: for each model the estimate, then the linear weights of the modes, and the most
/// likely one.
struct Functions {
  /// One step of one track with the measurement z, if there is one, into another block. False if the short forms would
  /// not be as good as the general step, which is then to be taken.
  bool (*step)(const StepPlan&, const double* now, std::size_t most_likely, double* next, const ConstView* z, Result&);
  /// The output of one track, (64)–(68), in the components of the largest model.
  void (*output)(const StepPlan&, const double* block, std::size_t most_likely, View);
  /// Writes the estimates of one track into a block; returns where its weights are to be.
  double* (*write)(const StepPlan&, const ConstView* estimates, double* block);
  /// One step of a block of tracks, in place. Estimates are the mean and the lower triangle of the covariance row by
  /// row; each number is that of all lanes. Measurements are z, the columns of R, and whether there is one (one or
  /// zero). Returns a bit for each track that must take the general step, and is as it was.
  unsigned (*step_block)(const StepPlan&, double* block, const double* measurements);
  unsigned (*step_block_of_floats)(const StepPlan&, float* block, const float* measurements);
};

/// A weight without its last bits: then it is that of its logarithm, and a step depends on what is in a state alone, to
/// the bit.
static inline double kept_weight(double weight) {
  const std::uint64_t last = weight < 0x1p-8 ? 0xfff : 0x3f;
  return __builtin_bit_cast(double, (__builtin_bit_cast(std::uint64_t, weight) + (last + 1) / 2) & ~last);
}

/// Those by whether the mode's algebra selects, and whether there are two modes, as is usual; by axes − 1, the compiled
/// ones of an instruction set.
struct ByKind {
  Functions of[2][2];
};
struct Kernels {
  ByKind by_axes[3];
  std::size_t lane_bytes;
};

const Kernels& baseline();
const Kernels& avx2();
const Kernels& avx512();

/// Those that this processor can run, the best one last.
std::span<const Kernels* const> available();

/// Which of them take the steps to come, by default the best. For tests: what a filter or a bank holds is of one of
/// them.
void choose(const Kernels& kernels);

}  // namespace sigmax::detail::kinematic
