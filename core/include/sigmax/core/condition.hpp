#pragma once

#include <cstddef>
#include <span>

#include <sigmax/core/uncertainty.hpp>

namespace sigmax {

/// How far the ⊕ of a composition may lie from one before it is divided out.
inline constexpr double drift_tolerance = 1e-12;

namespace detail {

double total(const AnyAlgebra& algebra, std::span<const double> values);
void condition(const AnyAlgebra& algebra, std::span<double> joint);
double equal_share(const AnyAlgebra& algebra, std::size_t n);

}  // namespace detail

/// Turns a joint, finite numbers that are not all zero, into the conditional: the greatest c with c ⊗ (⊕ joint) =
/// joint.
///
/// Where ⊗ has an inverse that is division by the ⊕, (8), (14), (19), (20). For `MaxMin` it is the residuum: 1 where
/// the joint equals its maximum, the joint elsewhere.
template <Algebra A>
void condition(std::span<double> joint) {
  detail::condition(detail::any_algebra<A>(), joint);
}

/// Each of n equal numbers, conditioned: 1/n if they are added, else one.
template <Algebra A>
double equal_share(std::size_t n) {
  return detail::equal_share(detail::any_algebra<A>(), n);
}

}  // namespace sigmax
