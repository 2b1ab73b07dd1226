#pragma once

#include <cstddef>
#include <span>

#include <sigmax/hybrid/kinematic_plan.hpp>

namespace sigmax::detail::kinematic {

/// The compiled steps of one instruction set, by axes − 1 and by whether the mode selects.
struct Kernels {
  bool (*step[max_axes][2])(const Plan&, const Track& now, const double* z, const double* R, Told&);
  void (*output[max_axes][2])(const Plan&, const Track&, double* mean, double* covariance);
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
