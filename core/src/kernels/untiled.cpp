// What tiled.cpp and exponential.cpp define, in a library that is built without Highway: the plain loops are left to do
// the work.

#include "kernels/exponential.hpp"
#include "kernels/tiled.hpp"

namespace sigmax::kernels {

bool compose_tiled(const AnyAlgebra&, const DenseParts&) { return false; }
double tiled_sum_of_exponentials(const double*, std::size_t) { return -1.0; }

}  // namespace sigmax::kernels
