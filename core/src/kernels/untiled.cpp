// What tiled.cpp defines, in a library that is built without Highway: the plain loops are left to do the work.

#include <sigmax/core/kernels/tiled.hpp>

namespace sigmax::kernels {

bool compose_tiled(Sigma, const DenseParts&) { return false; }
bool compose_tiled(Max, const DenseParts&) { return false; }
bool compose_tiled(MaxMin, const DenseParts&) { return false; }
bool compose_tiled(Max, const DenseParts&, Winner*) { return false; }
bool compose_tiled(MaxMin, const DenseParts&, Winner*) { return false; }

}  // namespace sigmax::kernels
