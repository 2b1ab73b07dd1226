#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include <sigmax/core/compose.hpp>
#include <sigmax/core/kernels/long_row.hpp>

namespace sigmax {

/// What is left after a long row of compositions and updates, without a division on the way and without underflow: a
/// number for each outcome of the current variable, with an exponent that has no bounds.
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
template <Uncertainty Kind>
class Chain {
 public:
  using kind = Kind;
  using Row = kernels::RowThroughChain<AlgebraOf<Kind>>;

  explicit Chain(const Distribution<Kind>& start) : Chain(start.variable(), Row(start.values())) {}
  Chain(Variable<Kind> variable, Row row) : variable_(std::move(variable)), row_(std::move(row)) {}

  const Variable<Kind>& variable() const& { return variable_; }
  Variable<Kind> variable() const&& { return variable_; }
  std::size_t size() const { return row_.size(); }

  /// The logarithm of the number of one outcome; −∞ if it is excluded.
  double log(std::size_t index) const { return row_.log(index); }

  /// The logarithm of the ⊕ of all numbers: the evidence; or β, if the kinds alternated. −∞ if nothing is left.
  double log_total() const { return row_.template log_total<AlgebraOf<Kind>>(); }

  /// Index of the outcome with the greatest number, the lowest on a tie.
  std::size_t winner() const { return row_.greatest(); }

  /// The distribution reading, (16): divided by the ⊕. Throws std::domain_error if nothing is left.
  Distribution<Kind> normalized() const {
    if (row_.is_zero()) check::excluded(variable_);
    Table values(1, size());
    row_.to_values(values.values());
    condition<AlgebraOf<Kind>>(values.values());
    return {variable_, std::move(values), detail::ByLaw{}};
  }

  /// The row of numbers, for the verbs.
  const Row& row() const { return row_; }
  Row& row(detail::ByLaw) { return row_; }

 private:
  Variable<Kind> variable_;
  Row row_;
};

/// The chain one relation further: ⊕ over its current outcome of left(to|·) ⊗ it, (5), (15), (16), (51), (53).
template <Conditional Left, Uncertainty Kind>
  requires std::same_as<typename Left::from_kind, Kind> Chain<typename Left::to_kind> compose(const Left& left,
                                                                                              Chain<Kind> right) {
    check::same(left.from(), right.variable(), "compose");
    auto row = std::move(right.row(detail::ByLaw{}));
    std::visit([&](const auto& rows) { row.template compose<AlgebraOf<Kind>>(rows); }, left.rows());
    return {left.to(), std::move(row)};
  }

/// The chain with evidence about its current outcome: multiplied by the likelihood, not divided by anything, (8).
/// Throws std::domain_error if that excludes every outcome.
template <Uncertainty Kind>
Chain<Kind> update(Chain<Kind> prior, const Likelihood<Kind>& likelihood) {
  check::same(prior.variable(), likelihood.variable(), "update");
  auto& row = prior.row(detail::ByLaw{});
  for (std::size_t i = 0; i < row.size(); ++i) row.multiply(i, likelihood.weight(i));
  if (row.is_zero()) check::excluded(prior.variable());
  return prior;
}

/// Label of the outcome with the greatest number; on a tie the first declared.
template <Uncertainty Kind>
std::string most_likely(const Chain<Kind>& chain) {
  return chain.variable().label(chain.winner());
}

}  // namespace sigmax
