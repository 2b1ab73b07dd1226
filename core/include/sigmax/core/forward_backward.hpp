#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <sigmax/core/likelihood.hpp>
#include <sigmax/core/relation.hpp>

namespace sigmax {

namespace detail {

/// Posteriors, a row for every time, and the logarithm of the evidence. transitions[t] leads from time t to t + 1,
/// where reports[t] is about the variable.
struct Posteriors {
  Table table;
  double log_total;
};
Posteriors forward_backward(const Outcomes& variable, std::span<const double> start,
                            std::span<const AnyRows* const> transitions, std::span<const kernels::Evidence> reports,
                            const AnyAlgebra& algebra);

Table row_at(const Table& table, std::size_t time);
void check_reports(std::size_t transitions, std::size_t reports);

}  // namespace detail

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
  Distribution<Kind> at(std::size_t time) const { return {variable_, detail::row_at(table_, time), detail::ByLaw{}}; }

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
  std::vector<const AnyRows*> transitions;
  std::vector<kernels::Evidence> evidence;
  for (const auto& report : reports) {
    const Relation<Kind, Kind>& relation = transition(transitions.size());
    check::same(start.variable(), report.variable(), "forward_backward");
    check::same(start.variable(), relation.from(), "forward_backward");
    check::same(start.variable(), relation.to(), "forward_backward");
    transitions.push_back(&relation.rows());
    evidence.push_back(report.evidence());
  }
  auto [table, log_total] =
      forward_backward(start.variable(), start.values(), transitions, evidence, algebra_of<Kind>());
  return {start.variable(), std::move(table), log_total, ByLaw{}};
}

}  // namespace detail

/// Distributions of a variable, given all reports, at the start and after every step through `transition`. They come
/// from the forward–backward recursion by sums or maxima. Evidence about the variable after step t + 1 is reports[t].
///
///     const auto posteriors = forward_backward(prior, next, reports);   // reports.size() + 1 times
///     posteriors.at(17);
///
/// It takes two products of the transition with a row a report, in plain doubles; where these do not hold everything,
/// all is done again with an exponent for each number. Throws std::domain_error, naming the step, if the reports up
/// to it exclude every outcome, std::invalid_argument if the variables differ.
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
  detail::check_reports(transitions.size(), reports.size());
  const auto each = [&](std::size_t t) -> const Relation<Kind, Kind>& { return transitions[t]; };
  return detail::forward_backward(start, each, reports);
}

}  // namespace sigmax
