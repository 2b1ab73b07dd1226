#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include <sigmax/core/compose.hpp>
#include <sigmax/core/kernels/unbounded_row.hpp>

namespace sigmax {

/// Result of many compositions and updates in a row: a number for each outcome of the current variable. Nothing is
/// divided on the way, and nothing underflows, since the exponents of the numbers have no bounds.
///
///     Chain chain{prior};
///     for (const Report& report : reports)
///       chain = update(compose(transition, std::move(chain)), report);   // moved, so nothing is allocated
///     most_likely(chain);      // the winner, after everything that was observed
///     chain.log_total();       // the log evidence, (8): ⊕ over all ways that lead here
///
/// The relations may alternate between kinds, each eliminated by its own ⊕ in the order of the calls; the chain is then
/// induced throughout, (15)–(18), and `log_total` is log β. The numbers are those of plain arithmetic to the last bit
/// where that stays above 2^−900. An ordinal chain keeps its grades, which cannot underflow.
///
/// A verb that throws leaves the chain that was moved into it as it was.
template <Uncertainty Kind>
class Chain {
 public:
  using kind = Kind;
  using Row = kernels::UnboundedRow;

  explicit Chain(const Distribution<Kind>& start) : Chain(start.variable(), Row(start.values()), detail::ByLaw{}) {}
  Chain(Variable<Kind> variable, Row row, detail::ByLaw) : variable_(std::move(variable)), row_(std::move(row)) {}

  Chain(const Chain&) = default;
  Chain& operator=(const Chain&) = default;
  // NOLINTBEGIN(performance-move-constructor-init): what is left keeps its variable
  Chain(Chain&& other) noexcept
      : variable_(other.variable_), row_(std::move(other.row_)), room_(std::move(other.room_)) {}
  // NOLINTEND(performance-move-constructor-init)

  /// Keeps the memory of what it was for the next relation.
  Chain& operator=(Chain&& other) noexcept {
    variable_ = other.variable_;
    std::swap(row_, other.row_);
    room_ = std::move(other.room_.capacity() > 0 ? other.room_ : other.row_);
    return *this;
  }

  const Variable<Kind>& variable() const& { return variable_; }
  Variable<Kind> variable() const&& { return variable_; }
  std::size_t size() const { return row_.size(); }

  /// The logarithm of the number of one outcome; −∞ if it is excluded.
  double log(std::size_t index) const { return row_.log(index, detail::algebra_of<Kind>()); }

  /// The logarithm of the ⊕ of all numbers: the evidence; or β, if the kinds alternated. −∞ if nothing is left.
  double log_total() const { return row_.log_total(detail::algebra_of<Kind>()); }

  /// Index of the outcome with the greatest number, the lowest on a tie.
  std::size_t winner() const { return row_.greatest(); }

  /// The distribution reading, (16): divided by the ⊕. Throws std::domain_error if nothing is left.
  Distribution<Kind> normalized() const {
    if (row_.is_zero()) check::excluded(variable_);
    return {variable_, row_.conditioned(detail::algebra_of<Kind>()), detail::ByLaw{}};
  }

  /// The row of numbers, and memory for another one, for the verbs.
  const Row& row() const& { return row_; }
  Row& row(detail::ByLaw) & { return row_; }
  Row take_room(detail::ByLaw) { return std::move(room_); }

 private:
  Variable<Kind> variable_;
  Row row_, room_;
};

namespace detail {

/// One relation further, in the memory of `row`; `winners` may be null.
template <Conditional Left, Uncertainty Kind>
Chain<typename Left::to_kind> further(const Left& left, const Chain<Kind>& chain, kernels::UnboundedRow row,
                                      kernels::Winners* winners = nullptr) {
  check::same(left.from(), chain.variable(), "compose");
  row.assign_composition(left.rows(), chain.row(), algebra_of<Kind>(), winners);
  return {left.to(), std::move(row), ByLaw{}};
}

}  // namespace detail

/// The chain one relation further: ⊕ over its current outcome of left(to|·) ⊗ it, (5), (15), (16), (51), (53).
template <Conditional Left, Uncertainty Kind>
  requires std::same_as<typename Left::from_kind, Kind>
auto compose(const Left& left, const Chain<Kind>& right) { return detail::further(left, right, {}); }

/// The same without allocation: in the memory that `right` keeps beside its numbers, which stay as they are.
template <Conditional Left, Uncertainty Kind>
  requires std::same_as<typename Left::from_kind, Kind>
auto compose(const Left& left, Chain<Kind>&& right) {
  return detail::further(left, right, right.take_room(detail::ByLaw{}));
}

/// The chain with evidence about its current outcome: multiplied by the likelihood, not divided by anything, (8).
/// Throws std::domain_error if that excludes every outcome; `prior` is then as it was.
template <Uncertainty Kind>
Chain<Kind> update(Chain<Kind>&& prior, const Likelihood<Kind>& likelihood) {
  check::same(prior.variable(), likelihood.variable(), "update");
  if (!prior.row(detail::ByLaw{}).take(likelihood.evidence(), detail::algebra_of<Kind>()))
    check::excluded(prior.variable());
  return std::move(prior);
}
template <Uncertainty Kind>
Chain<Kind> update(const Chain<Kind>& prior, const Likelihood<Kind>& likelihood) {
  return update(Chain<Kind>{prior}, likelihood);
}

/// Label of the outcome with the greatest number; on a tie the first declared.
template <Uncertainty Kind>
std::string most_likely(const Chain<Kind>& chain) {
  return chain.variable().label(chain.winner());
}

}  // namespace sigmax
