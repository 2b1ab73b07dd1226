#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include <sigmax/core/algebra.hpp>

namespace sigmax {

/// Turns a joint, finite numbers that are not all zero, into the conditional: the greatest c with c ⊗ (⊕ joint) =
/// joint.
///
/// Where ⊗ has an inverse that is division by the ⊕, (8), (14), (19), (20). For `MaxMin` it is the residuum: 1 where
/// the joint equals its maximum, the joint elsewhere.
template <Algebra A>
void condition(std::span<double> joint) {
  if constexpr (ScalingAlgebra<A>) {
    // Divided by the greatest first, so that their ⊕ neither overflows nor rounds a lone number away from one.
    const double greatest = *std::max_element(joint.begin(), joint.end());
    for (double& value : joint) value /= greatest;
  }
  double sum = A::zero();
  for (const double value : joint) sum = A::plus(sum, value);
  for (double& value : joint)
    if constexpr (ScalingAlgebra<A>)
      value = A::divide(value, sum);
    else
      value = value == sum ? A::one() : value;
}

/// Each of n equal numbers, conditioned: 1/n if they are added, else one.
template <Algebra A>
double equal_share(std::size_t n) {
  double sum = A::zero();
  for (std::size_t i = 0; i < n; ++i) sum = A::plus(sum, A::one());
  if constexpr (ScalingAlgebra<A>)
    return A::divide(A::one(), sum);
  else
    return A::one();
}

}  // namespace sigmax
