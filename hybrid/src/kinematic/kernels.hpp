#pragma once

#include <cstddef>
#include <span>

#include <sigmax/hybrid/kinematic_plan.hpp>

namespace sigmax::detail::kinematic {

/// The compiled steps of one instruction set, by axes − 1 and by whether the mode selects.
struct Kernels {
  /// One step of one track with the measurement z and R, a whole matrix, if there is one (else null). False, and
  /// nothing told, if the short forms would not be as good as the general step, which is then to be taken.
  bool (*step[max_axes][2])(const Plan&, const Track& now, const double* z, const double* R, Told&);
  /// The output, (64)–(68), in the components of the largest model; the covariance a whole matrix.
  void (*output[max_axes][2])(const Plan&, const Track&, double* mean, double* covariance);
  /// One step of a block of tracks, in place; each of its numbers is that of all lanes, in this order: for each model
  /// the mean, and the lower triangle of the covariance row by row; the linear weights of the modes; and the most
  /// likely one. Measurements are z, the columns of R, and whether there is one (one or zero). Returns a bit for each
  /// track that must take the general step, and is as it was.
  unsigned (*step_block[max_axes][2])(const Plan&, double* block, const double* measurements);
  unsigned (*step_block_of_floats[max_axes][2])(const Plan&, float* block, const float* measurements);
  std::size_t lane_bytes;
};

const Kernels& baseline();
const Kernels& avx2();
const Kernels& avx512();

/// Those that this processor can run, the best one last.
std::span<const Kernels* const> available();

/// Which of them take the steps to come, by default the best. For tests: what a FilterBank holds is of one of them.
void choose(const Kernels& kernels);

}  // namespace sigmax::detail::kinematic
