#pragma once

#include <concepts>

namespace sigmax {

/// A commutative semiring on the unit-interval numbers: how alternatives are summarised (⊕) and how they combine (⊗).
///
/// Laws, for all a, b, c (checked by tests/laws for every algebra):
///   ⊕ and ⊗ are associative and commutative; plus(a, zero()) = a; times(a, one()) = a; times(a, zero()) = zero();
///   times(a, plus(b, c)) = plus(times(a, b), times(a, c)); both are monotone in each argument.
template <class A>
concept Algebra = requires(double a, double b) {
  { A::zero() } -> std::same_as<double>;
  { A::one() } -> std::same_as<double>;
  { A::plus(a, b) } -> std::same_as<double>;
  { A::times(a, b) } -> std::same_as<double>;
  { A::selective } -> std::convertible_to<bool>;
};

/// An algebra whose ⊗ is the product, hence invertible: divide(times(a, b), b) = a for b > 0, and scaling passes
/// through ⊕. What conditions, normalises or works on logarithms needs this.
template <class A>
concept ScalingAlgebra = Algebra<A> && requires(double a, double b) {
  { A::divide(a, b) } -> std::same_as<double>;
};

/// An algebra in which plus(a, b) is always a or b: eliminating a variable then *selects* one of its values.
template <class A>
concept SelectiveAlgebra = Algebra<A> && A::selective;

/// The algebra of probability: alternatives are added, (3), (7).
struct Sigma {
  static constexpr bool selective = false;
  static constexpr double zero() { return 0.0; }
  static constexpr double one() { return 1.0; }
  static constexpr double plus(double a, double b) { return a + b; }
  static constexpr double times(double a, double b) { return a * b; }
  static constexpr double divide(double a, double b) { return a / b; }
};

/// The algebra of possibility: of alternatives the greatest counts, (2), (6).
struct Max {
  static constexpr bool selective = true;
  static constexpr double zero() { return 0.0; }
  static constexpr double one() { return 1.0; }
  static constexpr double plus(double a, double b) { return a < b ? b : a; }
  static constexpr double times(double a, double b) { return a * b; }
  static constexpr double divide(double a, double b) { return a / b; }
};

/// The algebra of qualitative possibility and of max-min composition: only the order of the numbers counts. A semiring
/// that does not scale, because min has no inverse; both operations select, so nothing is ever rounded.
struct MaxMin {
  static constexpr bool selective = true;
  static constexpr double zero() { return 0.0; }
  static constexpr double one() { return 1.0; }
  static constexpr double plus(double a, double b) { return a < b ? b : a; }
  static constexpr double times(double a, double b) { return b < a ? b : a; }
};

}  // namespace sigmax
