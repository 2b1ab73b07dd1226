#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/core/check.hpp>
#include <sigmax/core/distribution.hpp>
#include <sigmax/core/kernels/forward_backward.hpp>
#include <sigmax/core/likelihood.hpp>
#include <sigmax/core/relation.hpp>

namespace sigmax {

/// What a chain says of its variable at every time, given the evidence of all times: before, then, and after.
template <Uncertainty Kind>
class ChainPosteriors {
 public:
  using kind = Kind;

  ChainPosteriors(Variable<Kind> variable, Table table, double log_total, detail::ByLaw)
      : variable_(std::move(variable)), table_(std::move(table)), log_total_(log_total) {}

  const Variable<Kind>& variable() const& { return variable_; }
  Variable<Kind> variable() const&& { return variable_; }

  /// How many times there are: the start, and one after every relation.
  std::size_t size() const { return table_.rows(); }

  /// A row for every time, each a distribution.
  const Table& table() const& { return table_; }
  Table table() && { return std::move(table_); }

  /// The distribution at one time, 0 being the start. Throws std::invalid_argument if there is no such time.
  Distribution<Kind> at(std::size_t time) const {
    if (time >= size())
      throw std::invalid_argument("time " + std::to_string(time) + " of a chain of " + std::to_string(size()) +
                                  " times");
    Table row(1, table_.columns());
    std::copy_n(table_.row(time).begin(), row.columns(), row.data());
    return {variable_, std::move(row), detail::ByLaw{}};
  }

  /// The logarithm of the evidence, as `Chain` has it.
  double log_total() const { return log_total_; }

 private:
  Variable<Kind> variable_;
  Table table_;
  double log_total_;
};

namespace detail {

template <Uncertainty Kind, class Transition>
ChainPosteriors<Kind> forward_backward(const Distribution<Kind>& start, const Transition& transition,
                                       const std::vector<Likelihood<Kind>>& reports) {
  using A = AlgebraOf<Kind>;
  for (const auto& report : reports) check::same(start.variable(), report.variable(), "forward_backward");
  for (std::size_t t = 0; t < reports.size(); ++t) {
    check::same(start.variable(), transition(t).from(), "forward_backward");
    check::same(start.variable(), transition(t).to(), "forward_backward");
  }
  const auto stored = [&](std::size_t t) -> const AnyRows& { return transition(t).rows(); };
  const auto begin = [&] {
    Table table(reports.size() + 1, start.size());
    std::copy(start.begin(), start.end(), table.row(0).begin());
    return table;
  };
  Table table = begin();
  ScaledNumber total;
  if (!kernels::ForwardBackward<A>{}.run(stored, reports, table, total))
    kernels::forward_backward_without_bounds<A>(stored, reports, table = begin(), total);
  if (total.is_zero()) check::excluded(start.variable());
  return {start.variable(), std::move(table), total.log(), ByLaw{}};
}

}  // namespace detail

/// The distributions of a variable at the start and after every step through `transition`, each given all reports,
/// reports[t] being evidence about it after step t + 1: the sums of the forward–backward recursion, or its maxima.
///
///     const auto posteriors = forward_backward(prior, next, reports);   // reports.size() + 1 times
///     posteriors.at(17);
///
/// It takes two products of the transition with a row a report, in plain doubles; where these do not hold everything,
/// all is done again with an exponent for each number. Throws std::domain_error if the reports exclude every outcome,
/// std::invalid_argument if the variables differ.
template <Uncertainty Kind>
ChainPosteriors<Kind> forward_backward(const Distribution<Kind>& start, const Relation<Kind, Kind>& transition,
                                       const std::vector<Likelihood<Kind>>& reports) requires
    ScalingAlgebra<AlgebraOf<Kind>> {
  const auto same = [&](std::size_t) -> const Relation<Kind, Kind>& { return transition; };
  return detail::forward_backward(start, same, reports);
}

/// The same with a transition for every report; std::invalid_argument, too, if there are not as many.
template <Uncertainty Kind>
ChainPosteriors<Kind> forward_backward(
    const Distribution<Kind>& start, const std::vector<Relation<Kind, Kind>>& transitions,
    const std::vector<Likelihood<Kind>>& reports) requires ScalingAlgebra<AlgebraOf<Kind>> {
  if (transitions.size() != reports.size())
    throw std::invalid_argument("forward_backward: " + std::to_string(transitions.size()) + " transitions, but " +
                                std::to_string(reports.size()) + " reports");
  const auto each = [&](std::size_t t) -> const Relation<Kind, Kind>& { return transitions[t]; };
  return detail::forward_backward(start, each, reports);
}

}  // namespace sigmax
