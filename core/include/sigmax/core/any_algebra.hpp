#pragma once

#include <sigmax/core/uncertainty.hpp>

namespace sigmax::detail {

/// An algebra as a value, for what is compiled once. Loops are compiled for each algebra of the library, which goes by
/// its name; any other one is called through its operations.
struct AnyAlgebra {
  enum Name { sigma, max, max_min, other } name;
  bool selective, scales;
  double zero, one;
  double (*plus)(double, double);
  double (*times)(double, double);
  double (*divide)(double, double);  // null if ⊗ does not scale
};

template <Algebra A>
const AnyAlgebra& any_algebra() {
  constexpr auto name = std::same_as<A, Sigma>    ? AnyAlgebra::sigma
                        : std::same_as<A, Max>    ? AnyAlgebra::max
                        : std::same_as<A, MaxMin> ? AnyAlgebra::max_min
                                                  : AnyAlgebra::other;
  static const AnyAlgebra any = [] {
    AnyAlgebra algebra{name, A::selective, ScalingAlgebra<A>, A::zero(), A::one(), nullptr, nullptr, nullptr};
    if constexpr (name == AnyAlgebra::other) {
      algebra.plus = [](double a, double b) { return A::plus(a, b); };
      algebra.times = [](double a, double b) { return A::times(a, b); };
      if constexpr (ScalingAlgebra<A>) algebra.divide = [](double a, double b) { return A::divide(a, b); };
    }
    return algebra;
  }();
  return any;
}

template <Uncertainty Kind>
const AnyAlgebra& algebra_of() {
  return any_algebra<AlgebraOf<Kind>>();
}

}  // namespace sigmax::detail
