#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <sigmax/core/algebra.hpp>
#include <sigmax/core/logarithm.hpp>

namespace sigmax {

/// The scale on which evidence of an algebra adds up without loss. Where ⊗ does not scale, it is the numbers
/// themselves: none of them is ever rounded.
template <Algebra A>
struct Weight {
  static constexpr double excluded = A::zero();
  static constexpr double greatest_value = A::one();  ///< that a likelihood may have

  static double of(double value) { return value; }
  static double value(double weight) { return weight; }
  static double times(double a, double b) { return A::times(a, b); }

  /// ⊕_i factor(i) ⊗ weight(i).
  template <class WeightAt, class Factor>
  static double combine(std::size_t n, const WeightAt& weight, const Factor& factor) {
    double sum = A::zero();
    for (std::size_t i = 0; i < n; ++i) sum = A::plus(sum, A::times(factor(i), weight(i)));
    return sum;
  }

  /// Turns weights, not all excluded, into numbers in proportion to what they weigh.
  static void to_values(std::span<double>) {}
};

/// Where ⊗ is the product, it is their logarithms: no product underflows.
template <ScalingAlgebra A>
struct Weight<A> {
  static constexpr double excluded = log_zero;
  static constexpr double greatest_value = std::numeric_limits<double>::max();

  static double of(double value) { return std::log(value); }
  static double value(double weight) { return std::exp(weight); }
  static double times(double a, double b) { return a + b; }

  template <class WeightAt, class Factor>
  static double combine(std::size_t n, const WeightAt& weight, const Factor& factor) {
    return log_combine<A>(n, weight, factor);
  }

  static void to_values(std::span<double> weights) {
    const double greatest = *std::max_element(weights.begin(), weights.end());
    for (double& weight : weights) weight = std::exp(weight - greatest);
  }
};

}  // namespace sigmax
