#define SIGMAX_LANE_BYTES 64
#define SIGMAX_INSTRUCTIONS avx512
#include "kinematic/instantiate.hpp"
