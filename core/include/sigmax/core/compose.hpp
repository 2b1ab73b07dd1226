#pragma once

#include <concepts>
#include <span>
#include <type_traits>
#include <utility>

#include <sigmax/core/belief.hpp>
#include <sigmax/core/induced.hpp>
#include <sigmax/core/kernels/compose.hpp>
#include <sigmax/core/likelihood.hpp>
#include <sigmax/core/relation.hpp>

namespace sigmax {

/// A Relation, or what is induced of one.
template <class T>
concept Conditional = std::derived_from<T, ConditionalTable<typename T::to_kind, typename T::from_kind>>;

/// A Distribution, or what is induced of one.
template <class T>
concept Marginal =
    std::same_as<T, Distribution<typename T::kind>> || std::same_as<T, Induced<Distribution<typename T::kind>>>;

/// `T`, or only Induced<T> where normalisation is lost: if a part was induced already, or if the variable eliminated
/// between Left and Right is not of the result's kind.
template <class Left, class Right, class T>
using InducedBy = std::conditional_t<is_induced<Left> || is_induced<Right> ||
                                         !std::same_as<typename Left::to_kind, typename Left::from_kind>,
                                     Induced<T>, T>;

namespace detail {

/// `left` after `right` by the algebra of the variable between them, written into `result`, which may be one of them.
/// If the result is normalised by law, what has drifted is divided out.
void compose(const AnyAlgebra& middle, const AnyRows& left, const AnyRows& right, bool normalized, AnyRows& result);
Table composed(const AnyAlgebra& middle, const AnyRows& left, const Table& right, bool normalized);

/// The logarithms of a belief one relation further, which are none of `result`. Throws std::domain_error if nothing is
/// left.
void compose_logs(const AnyAlgebra& middle, const AnyRows& left, std::span<const double> right, const Outcomes& to,
                  std::span<double> result);

/// Evidence carried back through a relation.
kernels::UnboundedRow carried_back(const AnyAlgebra& middle, const kernels::Evidence& left, const AnyRows& right);

}  // namespace detail

/// `left` after `right`, eliminating the variable m between them: ⊕ over m of left(to|m) ⊗ right(m|from), where m's
/// kind chooses ⊕.
///
///     compose(speed_given_mood, mood_given_age)   // speed given age
///
/// Of one kind it is (6), (7) and a Relation; else (17), (18) and only Induced. It associates within one kind; with
/// mixed kinds (A∘B)∘C and A∘(B∘C) differ, and the order of the calls is what is meant.
/// Throws std::invalid_argument, naming both, if the variables in the middle are not the same.
template <Conditional Left, Conditional Right>
  requires std::same_as<typename Left::from_kind, typename Right::to_kind>
auto compose(const Left& left, const Right& right) {
  using Composed = InducedBy<Left, Right, Relation<typename Left::to_kind, typename Right::from_kind>>;
  check::same(left.from(), right.to(), "compose");
  AnyRows rows = Table(0, 0);
  detail::compose(detail::algebra_of<typename Left::from_kind>(), left.rows(), right.rows(), !is_induced<Composed>,
                  rows);
  return Composed{left.to(), right.from(), std::move(rows), detail::ByLaw{}};
}

/// The same, written into an existing `result` of the same variables: for dense parts nothing is allocated, unless
/// `result` is one of them.
template <Conditional Left, Conditional Right>
  requires std::same_as<typename Left::from_kind, typename Right::to_kind>
void compose(const Left& left, const Right& right,
             InducedBy<Left, Right, Relation<typename Left::to_kind, typename Right::from_kind>>& result) {
  check::same(left.from(), right.to(), "compose");
  check::same(left.to(), result.to(), "compose");
  check::same(right.from(), result.from(), "compose");
  detail::compose(detail::algebra_of<typename Left::from_kind>(), left.rows(), right.rows(),
                  !is_induced<std::decay_t<decltype(result)>>, result.rows(detail::ByLaw{}));
}

/// The distribution of `left.to()` when its condition has the distribution `right`: (5), (15), (16).
///
///     compose(mood_given_age, age_prior)   // mood
template <Conditional Left, Marginal Right>
  requires std::same_as<typename Left::from_kind, typename Right::kind>
auto compose(const Left& left, const Right& right) {
  using Composed = InducedBy<Left, Right, Distribution<typename Left::to_kind>>;
  check::same(left.from(), right.variable(), "compose");
  const auto& middle = detail::algebra_of<typename Left::from_kind>();
  return Composed{left.to(), detail::composed(middle, left.rows(), right.table(), !is_induced<Composed>),
                  detail::ByLaw{}};
}

/// The belief about the next value of a variable after a transition, (51), (53): log b(j) = log ⊕ᵢ p(j|i) ⊗ exp b(i).
/// `result` may be `right`.
template <Uncertainty Kind>
Belief<Kind> compose(const Relation<Kind, Kind>& left, const Belief<Kind>& right) {
  Belief<Kind> result{uninformative(left.to())};
  compose(left, right, result);
  return result;
}
template <Uncertainty Kind>
void compose(const Relation<Kind, Kind>& left, const Belief<Kind>& right, Belief<Kind>& result) {
  check::same(left.from(), right.variable(), "compose");
  check::same(left.to(), result.variable(), "compose");
  if (&right == &result) {
    compose(left, Belief<Kind>(right), result);
    return;
  }
  detail::compose_logs(detail::algebra_of<Kind>(), left.rows(), right.logs(), left.to(), result.logs(detail::ByLaw{}));
}

/// How well each outcome of `right.from()` explains evidence about `right.to()`, (42), (45). With a random sensor over
/// a fuzzy feature it is the p⁺ of (17), unnormalised as a likelihood should be.
template <Uncertainty Middle, Uncertainty From>
Likelihood<From> compose(const Likelihood<Middle>& left, const Relation<Middle, From>& right) {
  check::same(left.variable(), right.to(), "compose");
  const auto& middle = detail::algebra_of<Middle>();
  return {right.from(), detail::carried_back(middle, left.evidence(), right.rows()), detail::ByLaw{}};
}

}  // namespace sigmax
