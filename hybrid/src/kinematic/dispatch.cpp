#include "kinematic/kernels.hpp"

namespace sigmax::detail::kinematic {
namespace {

/// The best that this processor has.
const Kernels& best() {
#ifdef SIGMAX_X86_KERNELS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2();
#endif
  return baseline();
}

const Kernels& kernels() {
  static const Kernels& chosen = best();
  return chosen;
}

}  // namespace

bool step(const Plan& plan, bool selects, const Track& now, const double* z, const double* R, Track& next, Told& told) {
  return kernels().step[plan.axes - 1][selects](plan, now, z, R, next, told);
}

void output(const Plan& plan, bool selects, const Track& track, double* mean, double* covariance) {
  kernels().output[plan.axes - 1][selects](plan, track, mean, covariance);
}

int lanes() { return kernels().lanes; }

unsigned step_block(const Plan& plan, bool selects, double* block, const double* measurements) {
  return kernels().step_block[plan.axes - 1][selects](plan, block, measurements);
}

}  // namespace sigmax::detail::kinematic
