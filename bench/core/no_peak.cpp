// The peaks of peak.cpp where there is no Highway to measure them by: none.

#include "core/peak.hpp"

namespace sigmax::bench {

double peak(Operation) { return 0.0; }
double read_bandwidth(std::size_t) { return 0.0; }
double triad_bandwidth(std::size_t) { return 0.0; }

}  // namespace sigmax::bench
