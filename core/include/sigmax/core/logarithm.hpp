#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include <sigmax/core/algebra.hpp>

namespace sigmax {

/// The logarithm of nothing: the weight of an outcome that is excluded.
inline constexpr double log_zero = -std::numeric_limits<double>::infinity();

namespace detail {

/// log ⊕_i factor(i) ⊗ exp(log_weight(i)), without underflow or overflow: everything is scaled by the greatest weight
/// that a positive factor meets. `log_zero` if there is none.
template <class A, class LogWeight, class Factor>
double log_combine(A algebra, std::size_t n, const LogWeight& log_weight, const Factor& factor) {
  double greatest = log_zero;
  for (std::size_t i = 0; i < n; ++i)
    if (factor(i) > 0.0 && log_weight(i) > greatest) greatest = log_weight(i);
  if (greatest == log_zero) return log_zero;
  double sum = algebra.zero();
  for (std::size_t i = 0; i < n; ++i)
    if (factor(i) > 0.0) sum = algebra.plus(sum, algebra.times(factor(i), std::exp(log_weight(i) - greatest)));
  return greatest + std::log(sum);
}
template <ScalingAlgebra A, class LogWeight, class Factor>
double log_combine(std::size_t n, const LogWeight& log_weight, const Factor& factor) {
  return log_combine(A{}, n, log_weight, factor);
}

}  // namespace detail

}  // namespace sigmax
