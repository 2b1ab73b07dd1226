#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/core/relation.hpp>
#include <sigmax/core/tie.hpp>

namespace sigmax {

/// The same name and outcomes under the other interpretation (section IV.A).
template <Uncertainty Kind>
Variable<Kind> interpreted_as(const Outcomes& outcomes) {
  if (outcomes == Outcomes{outcomes.name(), outcomes.size()}) return {outcomes.name(), outcomes.size()};
  std::vector<std::string> labels(outcomes.size());
  for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = outcomes.label(i);
  return {outcomes.name(), std::move(labels)};
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

  std::vector<double> possibilities(std::span<const double> p) const {
    return powers(p, *std::max_element(p.begin(), p.end()), exponent);
  }
  std::vector<double> probabilities(std::span<const double> pi) const { return powers(pi, 1.0, 1.0 / exponent); }

 private:
  std::vector<double> powers(std::span<const double> values, double greatest, double power) const {
    if (!(exponent > 0.0 && std::isfinite(exponent)))
      throw std::invalid_argument("RatioScale needs an exponent that is positive and finite, not " +
                                  std::to_string(exponent));
    std::vector<double> result(values.begin(), values.end());
    for (double& value : result) value = std::pow(value / greatest, power);
    return result;
  }
};

namespace detail {

/// One of the distinct values of a distribution, from the least upwards; values that tie are one.
struct Level {
  double value;       ///< the level itself: the least of those that tie
  double gap;         ///< how far it lies above the previous one, or above zero
  std::size_t here;   ///< how many outcomes have this value
  std::size_t above;  ///< how many have this value or a greater one
};

/// Gives every outcome the sum of step(level) over the levels up to its own: ties stay ties. O(n log n).
template <class Step>
std::vector<double> sum_over_levels(std::span<const double> values, const Step& step) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> result(values.size());
  double sum = 0.0, below = 0.0;
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    const double value = values[order[first]];
    while (last < order.size() && detail::numbers_tie(value, values[order[last]])) ++last;
    sum += step(Level{value, value - below, last - first, order.size() - first});
    for (std::size_t k = first; k < last; ++k) result[order[k]] = sum;
    below = value;
  }
  return result;
}

}  // namespace detail

/// The optimal transform of Dubois and Prade: π_i = Σ {p_j : p_j ≤ p_i}, the most specific possibility that is
/// consistent with p and keeps its order.
///
/// Preserves the order strictly, ties included, and Π(A) ≥ P(A) for every event. Does not preserve ratios. No inverse
/// is offered: applied to any other possibility it would not keep the order.
/// Source: Dubois, Foulloy, Mauris, Prade, Probability-possibility transformations (2004), with equal π for equal p.
struct DuboisPrade {
  std::vector<double> possibilities(std::span<const double> p) const {
    return detail::sum_over_levels(p, [](const detail::Level& at) { return at.value * static_cast<double>(at.here); });
  }
};

/// The symmetric transform of Dubois, Prade and Sandri, π_i = Σ_j min(p_i, p_j), and its inverse, the pignistic
/// probability: each cut {x : π(x) ≥ λ} shares its dλ equally among its outcomes.
///
/// Preserves the order, ties included, and Π(A) ≥ P(A) for every event, both ways; each direction is the exact inverse
/// of the other. Does not preserve ratios, and is less specific than `DuboisPrade`.
/// Source: Dubois, Prade, Sandri, On possibility/probability transformations (1993).
struct DuboisPradeSandri {
  std::vector<double> possibilities(std::span<const double> p) const {
    return detail::sum_over_levels(p, [](const detail::Level& at) { return at.gap * static_cast<double>(at.above); });
  }
  std::vector<double> probabilities(std::span<const double> pi) const {
    return detail::sum_over_levels(pi, [](const detail::Level& at) { return at.gap / static_cast<double>(at.above); });
  }
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

/// Makes every row the distribution in proportion to method(row). Rows that store only some of their numbers go on
/// doing so, for a transform gives zero for zero. `from` is what the rows are given, for messages, if there is one
/// variable.
template <Algebra A, class Method>
void transform_rows(AnyRows& all, const Outcomes& to, const Outcomes* from, const Method& method) {
  const auto transform = [&](auto& rows) {
    for_each_stored_row(rows, [&](std::size_t r) {
      const check::Row at = from ? check::Row{from, r} : check::Row{};
      const std::span<double> row = rows.values(r);
      const std::vector<double> weights = method(std::span<const double>(row));
      check::size(to, at, to.size() - row.size() + weights.size());
      prove_weights<A>(to, at, weights);
      std::copy(weights.begin(), weights.end(), row.begin());
      condition<A>(row);
    });
  };
  std::visit(transform, all);
}

/// A relation whose every row is in proportion to method(row).
template <Uncertainty To, Uncertainty Old, Uncertainty From, class Method>
Relation<To, From> transformed(const Relation<Old, From>& relation, const Variable<To>& to, const Method& method) {
  AnyRows rows = relation.rows();
  transform_rows<AlgebraOf<To>>(rows, to, &relation.from(), method);
  return {to, relation.from(), std::move(rows), ByLaw{}};
}

}  // namespace detail

/// The same row by row: the condition stays as it is.
template <Uncertainty From, PossibilityTransform Method>
Relation<Fuzzy, From> to_possibility(const Relation<Random, From>& p, const Method& method) {
  return detail::transformed(p, as_fuzzy(p.to()), [&](auto row) { return method.possibilities(row); });
}
template <Uncertainty From, ProbabilityTransform Method>
Relation<Random, From> to_probability(const Relation<Fuzzy, From>& pi, const Method& method) {
  return detail::transformed(pi, as_random(pi.to()), [&](auto row) { return method.probabilities(row); });
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
