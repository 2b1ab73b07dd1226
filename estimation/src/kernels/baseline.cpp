#define SIGMAX_LANE_BYTES 16
#define SIGMAX_KERNELS baseline_kernels
#include "kernels/kalman_kernels.hpp"
