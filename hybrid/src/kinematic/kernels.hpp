#pragma once

#include <sigmax/hybrid/kinematic_plan.hpp>

namespace sigmax::detail::kinematic {

/// The compiled steps of one instruction set, by axes − 1 and by whether the mode selects.
struct Kernels {
  bool (*step[max_axes][2])(const Plan&, const Track& now, const double* z, const double* R, Track& next, Told&);
  void (*output[max_axes][2])(const Plan&, const Track&, double* mean, double* covariance);
  unsigned (*step_block[max_axes][2])(const Plan&, double* block, const double* measurements);
  int lanes;
};

const Kernels& baseline();
const Kernels& avx2();

}  // namespace sigmax::detail::kinematic
