// What tiled.cpp and exponential.cpp define, in a library that is built without Highway: the plain loops are left to do
// the work.

#include <sigmax/core/kernels/exponential.hpp>
#include <sigmax/core/kernels/tiled.hpp>

namespace sigmax::kernels {

bool compose_tiled(Sigma, const DenseParts&) { return false; }
bool compose_tiled(Max, const DenseParts&) { return false; }
bool compose_tiled(MaxMin, const DenseParts&) { return false; }
bool compose_tiled(Max, const DenseParts&, Winner*) { return false; }
bool compose_tiled(MaxMin, const DenseParts&, Winner*) { return false; }
double tiled_sum_of_exponentials(const double*, std::size_t) { return -1.0; }

}  // namespace sigmax::kernels
