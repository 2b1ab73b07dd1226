#define SIGMAX_LANE_BYTES 32
#define SIGMAX_KERNELS avx2_kernels
#include "kernels/kalman_kernels.hpp"
