#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <sigmax/core/relation.hpp>

namespace sigmax {

/// The same name and outcomes under the other interpretation (section IV.A).
template <Uncertainty Kind>
Variable<Kind> interpreted_as(const Outcomes& outcomes) {
  return Variable<Kind>(outcomes);
}
inline FuzzyVariable as_fuzzy(const Outcomes& variable) { return interpreted_as<Fuzzy>(variable); }
inline RandomVariable as_random(const Outcomes& variable) { return interpreted_as<Random>(variable); }

/// A way from probabilities to possibilities in proportion to what it returns.
template <class Method>
concept PossibilityTransform = requires(const Method& method, std::span<const double> probabilities) {
  { method.possibilities(probabilities) } -> std::same_as<std::vector<double>>;
};

/// A way from possibilities to probabilities in proportion to what it returns.
template <class Method>
concept ProbabilityTransform = requires(const Method& method, std::span<const double> possibilities) {
  { method.probabilities(possibilities) } -> std::same_as<std::vector<double>>;
};

/// Klir's ratio scale: π ∝ p^α, (34), and p ∝ π^(1/α), (35); α = 1 is the paper's.
///
/// Preserves the order strictly, and with α = 1 all ratios, so that it commutes with `update`. Each direction is the
/// exact inverse of the other. Does not preserve consistency: for α ≤ 1 every π(x) ≥ p(x), but an event may have
/// Π(A) < P(A), as the last two outcomes of p = (.6, .2, .2).
/// Throws std::invalid_argument, when used, unless α is positive and finite.
struct RatioScale {
  double exponent = 1.0;

  std::vector<double> possibilities(std::span<const double> p) const;
  std::vector<double> probabilities(std::span<const double> pi) const;
};

/// The optimal transform of Dubois and Prade: π_i = Σ {p_j : p_j ≤ p_i}, the most specific possibility that is
/// consistent with p and keeps its order.
///
/// Preserves the order strictly, ties included, and Π(A) ≥ P(A) for every event. Does not preserve ratios. No inverse
/// is offered: applied to any other possibility it would not keep the order.
/// Source: Dubois, Foulloy, Mauris, Prade, Probability-possibility transformations (2004), with equal π for equal p.
struct DuboisPrade {
  std::vector<double> possibilities(std::span<const double> p) const;
};

/// The symmetric transform of Dubois, Prade and Sandri, π_i = Σ_j min(p_i, p_j), and its inverse, the pignistic
/// probability: each cut {x : π(x) ≥ λ} shares its dλ equally among its outcomes.
///
/// Preserves the order, ties included, and Π(A) ≥ P(A) for every event, both ways; each direction is the exact inverse
/// of the other. Does not preserve ratios, and is less specific than `DuboisPrade`.
/// Source: Dubois, Prade, Sandri, On possibility/probability transformations (1993).
struct DuboisPradeSandri {
  std::vector<double> possibilities(std::span<const double> p) const;
  std::vector<double> probabilities(std::span<const double> pi) const;
};

/// The possibility distribution that a method makes of a probability distribution, of the same outcomes read as fuzzy.
///
///     to_possibility(weather, DuboisPrade{})
///     to_possibility(weather, RatioScale{.exponent = 0.5})
template <PossibilityTransform Method>
Distribution<Fuzzy> to_possibility(const Distribution<Random>& p, const Method& method) {
  return normalized(as_fuzzy(p.variable()), method.possibilities(p.values()));
}

/// The probability distribution that a method makes of a possibility distribution.
///
///     to_probability(mood, DuboisPradeSandri{})   // pignistic
template <ProbabilityTransform Method>
Distribution<Random> to_probability(const Distribution<Fuzzy>& pi, const Method& method) {
  return normalized(as_random(pi.variable()), method.probabilities(pi.values()));
}

namespace detail {

/// Makes the stored numbers of a row the distribution in proportion to weights.
void assign_weights(const Outcomes& variable, check::Row row, std::span<double> values,
                    const std::vector<double>& weights, const AnyAlgebra& algebra);

/// Rows in proportion to method(row); `from`, which may be null, is for messages. Those that store only some of their
/// numbers go on doing so, for a transform gives zero for zero.
template <Uncertainty To, class Method>
AnyRows transformed(AnyRows rows, const Outcomes& to, const Outcomes* from, const Method& method) {
  for (const std::size_t r : stored_rows(rows)) {
    const std::span<double> row = values_of(rows, r);
    assign_weights(to, from ? check::Row{from, r} : check::Row{}, row, method(std::span<const double>(row)),
                   algebra_of<To>());
  }
  return rows;
}

}  // namespace detail

/// The same row by row: the condition stays as it is.
template <Uncertainty From, PossibilityTransform Method>
Relation<Fuzzy, From> to_possibility(const Relation<Random, From>& p, const Method& method) {
  const FuzzyVariable to = as_fuzzy(p.to());
  const auto possibilities = [&](auto row) { return method.possibilities(row); };
  return {to, p.from(), detail::transformed<Fuzzy>(p.rows(), to, &p.from(), possibilities), detail::ByLaw{}};
}
template <Uncertainty From, ProbabilityTransform Method>
Relation<Random, From> to_probability(const Relation<Fuzzy, From>& pi, const Method& method) {
  const RandomVariable to = as_random(pi.to());
  const auto probabilities = [&](auto row) { return method.probabilities(row); };
  return {to, pi.from(), detail::transformed<Random>(pi.rows(), to, &pi.from(), probabilities), detail::ByLaw{}};
}

/// The same rows, with the condition read as fuzzy or as random: nothing needs normalising, a row says nothing of it.
///
///     with_fuzzy_condition(to_possibility(transition, RatioScale{}))   // (49) as (50)
template <Uncertainty To, Uncertainty From>
Relation<To, Fuzzy> with_fuzzy_condition(const Relation<To, From>& relation) {
  return {relation.to(), as_fuzzy(relation.from()), relation.rows(), detail::ByLaw{}};
}
template <Uncertainty To, Uncertainty From>
Relation<To, Random> with_random_condition(const Relation<To, From>& relation) {
  return {relation.to(), as_random(relation.from()), relation.rows(), detail::ByLaw{}};
}

}  // namespace sigmax
