#include "kinematic/kernels.hpp"

#include <array>

namespace sigmax::detail::kinematic {
namespace {

struct Available {
  std::array<const Kernels*, 3> kernels{&baseline()};
  std::size_t count = 1;

  Available() {
#ifdef SIGMAX_X86_KERNELS
    const bool fma = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (fma) kernels[count++] = &avx2();
    if (fma && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq"))
      kernels[count++] = &avx512();
#endif
  }
};

const Kernels*& chosen() {
  static const Kernels* kernels = available().back();
  return kernels;
}

const Kernels& kernels() { return *chosen(); }

}  // namespace

std::span<const Kernels* const> available() {
  static const Available all;
  return {all.kernels.data(), all.count};
}

void choose(const Kernels& kernels) { chosen() = &kernels; }

bool step(const Plan& plan, bool selects, const Track& now, const double* z, const double* R, Told& told) {
  return kernels().step[plan.axes - 1][selects](plan, now, z, R, told);
}

void output(const Plan& plan, bool selects, const Track& track, double* mean, double* covariance) {
  kernels().output[plan.axes - 1][selects](plan, track, mean, covariance);
}

std::size_t lane_bytes() { return kernels().lane_bytes; }

unsigned step_block(const Plan& plan, bool selects, double* block, const double* measurements) {
  return kernels().step_block[plan.axes - 1][selects](plan, block, measurements);
}
unsigned step_block(const Plan& plan, bool selects, float* block, const float* measurements) {
  return kernels().step_block_of_floats[plan.axes - 1][selects](plan, block, measurements);
}

}  // namespace sigmax::detail::kinematic
