#pragma once

#include <concepts>
#include <string_view>

#include <sigmax/core/algebra.hpp>

namespace sigmax {

/// The kind of an uncertain variable; it alone chooses the algebra by which the variable is eliminated.
template <class Kind>
concept Uncertainty = Algebra<typename Kind::Algebra> && requires {
  { Kind::name } -> std::convertible_to<std::string_view>;     // "random"
  { Kind::measure } -> std::convertible_to<std::string_view>;  // "probability"
  { Kind::total } -> std::convertible_to<std::string_view>;    // "sum"
};

/// The algebra of a kind of variable.
template <Uncertainty Kind>
using AlgebraOf = typename Kind::Algebra;

/// A random variable's outcomes exclude each other: its probabilities sum to one (Definition 2.1).
struct Random {
  using Algebra = Sigma;
  static constexpr std::string_view name = "random";
  static constexpr std::string_view measure = "probability";
  static constexpr std::string_view total = "sum";
};

/// A fuzzy variable's outcomes overlap: the greatest of its possibilities is one (Definition 2.2).
struct Fuzzy {
  using Algebra = Max;
  static constexpr std::string_view name = "fuzzy";
  static constexpr std::string_view measure = "possibility";
  static constexpr std::string_view total = "maximum";
};

/// An ordinal variable is a fuzzy one of whose possibilities only the order is known: they combine by their minimum.
struct Ordinal {
  using Algebra = MaxMin;
  static constexpr std::string_view name = "ordinal";
  static constexpr std::string_view measure = "possibility";
  static constexpr std::string_view total = "maximum";
};

/// A kind measured on a ratio scale, whose numbers may be divided: all but `Ordinal`. Beliefs, classifiers and filters
/// need one.
template <class Kind>
concept ScalableUncertainty = Uncertainty<Kind> && ScalingAlgebra<AlgebraOf<Kind>>;

/// Kinds that may meet in one relation: the same, or both measured on a ratio scale. So `Ordinal` meets only itself.
template <class A, class B>
concept Mixable = Uncertainty<A> && Uncertainty<B> &&
    (std::same_as<A, B> || (ScalableUncertainty<A> && ScalableUncertainty<B>));

namespace detail {

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

}  // namespace detail

}  // namespace sigmax
