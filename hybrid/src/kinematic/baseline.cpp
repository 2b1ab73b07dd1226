#define SIGMAX_LANE_BYTES 16
#define SIGMAX_INSTRUCTIONS baseline
#include "kinematic/instantiate.hpp"
