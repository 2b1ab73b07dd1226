#define SIGMAX_LANE_BYTES 32
#define SIGMAX_INSTRUCTIONS avx2
#include "kinematic/instantiate.hpp"
