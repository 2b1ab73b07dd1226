#include "kernels/kernels.hpp"

namespace sigmax::detail {

std::span<const Kernels* const> available_kernels() {
  static const Kernels* const all[]{&baseline_kernels(),
#ifdef SIGMAX_X86_KERNELS
                                    &avx2_kernels()
#endif
  };
#ifdef SIGMAX_X86_KERNELS
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return {all, 1};
#endif
  return all;
}

const Kernels& kernels() {
  static const Kernels& best = *available_kernels().back();
  return best;
}

}  // namespace sigmax::detail
