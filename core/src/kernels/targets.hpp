// Which instruction sets the kernels are compiled for. Those left out would make no code of another speed: they add to
// another set what the kernels do not use, or have vectors of a size that is not known when they are compiled.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
