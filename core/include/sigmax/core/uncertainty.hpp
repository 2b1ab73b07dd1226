#pragma once

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

}  // namespace sigmax
