#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/core/belief.hpp>
#include <sigmax/core/kernels/transpose.hpp>
#include <sigmax/core/likelihood.hpp>
#include <sigmax/core/relation.hpp>

namespace sigmax {

/// Posterior belief: the prior times the likelihood, divided by its own ⊕. (8), (19), (20), (41), (44), (62), (63).
/// `result` may be `prior`. Returns the logarithm of that ⊕: the evidence.
/// Throws std::domain_error if the evidence excludes every outcome that the prior left; `result` is then unchanged.
template <Uncertainty Kind>
double update(const Belief<Kind>& prior, const Likelihood<Kind>& likelihood, Belief<Kind>& result) {
  check::same(prior.variable(), likelihood.variable(), "update");
  check::same(prior.variable(), result.variable(), "update");
  const double *const prior_logs = prior.logs().data(), *const likelihood_logs = likelihood.logs().data();
  return result.assign([=](std::size_t i) { return prior_logs[i] + likelihood_logs[i]; });
}
template <Uncertainty Kind>
Belief<Kind> update(const Belief<Kind>& prior, const Likelihood<Kind>& likelihood) {
  Belief<Kind> result = prior;
  update(prior, likelihood, result);
  return result;
}

namespace detail {

/// values(k) = prior(k) · likelihood(k) up to a common power of two, by plain arithmetic: if all of them lie so close
/// together that no product underflows. Else false, and the values are unspecified.
template <Uncertainty Kind>
bool assign_plain_products(const Distribution<Kind>& prior, const Likelihood<Kind>& likelihood,
                           std::span<double> values) {
  constexpr std::int64_t depth = 450;  // of each of the two
  const std::span<const ScaledNumber> numbers = likelihood.numbers();
  if (numbers.empty()) return false;
  std::int64_t greatest = std::numeric_limits<std::int64_t>::min() / 4,
               least = std::numeric_limits<std::int64_t>::max() / 4;
  for (const ScaledNumber number : numbers) {
    greatest = std::max(greatest, number.exponent());
    least = std::min(least, number.is_zero() ? least : number.exponent());
  }
  double least_prior = 1.0;
  const double* const priors = prior.begin();
  for (std::size_t i = 0; i < values.size(); ++i)
    least_prior = priors[i] < least_prior && priors[i] > 0.0 ? priors[i] : least_prior;
  if (greatest - least > depth || least_prior < 0x1p-450) return false;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = priors[i] * numbers[i].normal_value_in_units_of(greatest);
  return true;
}

/// values(k) = product(k) of a scaling algebra, up to a common power of two, so that none underflows for being small.
template <class Product>
void assign_in_proportion(std::span<double> values, const Product& product) {
  ScaledNumber top;
  for (std::size_t k = 0; k < values.size(); ++k) top = std::max(top, product(k));
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = product(k).value_in_units_of(top.exponent());
}

}  // namespace detail

/// Posterior distribution, (8), (19), (20).
///
///     update(uninformative(age), speed_given_age.likelihood("fast"))
template <Uncertainty Kind>
Distribution<Kind> update(const Distribution<Kind>& prior, const Likelihood<Kind>& likelihood) {
  using A = AlgebraOf<Kind>;
  check::same(prior.variable(), likelihood.variable(), "update");
  Table joint(1, prior.size());
  if constexpr (ScalingAlgebra<A>) {
    if (!detail::assign_plain_products(prior, likelihood, joint.values()))
      detail::assign_in_proportion(joint.values(),
                                   [&](std::size_t i) { return ScaledNumber{prior[i]} * likelihood.number(i); });
  } else {
    for (std::size_t i = 0; i < joint.size(); ++i) joint(0, i) = A::times(prior[i], likelihood.number(i));
  }
  const std::span<const double> numbers = joint.values();
  if (std::all_of(numbers.begin(), numbers.end(), [](double number) { return number == A::zero(); }))
    check::excluded(prior.variable());
  condition<A>(joint.values());
  return {prior.variable(), std::move(joint), detail::ByLaw{}};
}

/// What `invert` gives: "from given to", and the outcomes of `to` that nothing reaches.
template <Uncertainty From, Uncertainty To>
struct Inverse {
  Relation<From, To> relation;
  std::vector<std::size_t> unreachable;  ///< their rows in `relation` are uninformative
};

namespace detail {

/// Multiplies the numbers of a row by those of the prior, up to a common factor, so that none underflows.
template <Uncertainty Kind, class Entries>
void weigh(const Distribution<Kind>& prior, const Entries& row, std::span<double> values) {
  using A = AlgebraOf<Kind>;
  if constexpr (ScalingAlgebra<A>)
    assign_in_proportion(values,
                         [&](std::size_t k) { return ScaledNumber{prior[row.index(k)]} * ScaledNumber{row.value(k)}; });
  else
    for (std::size_t k = 0; k < row.size(); ++k) values[k] = A::times(prior[row.index(k)], row.value(k));
}
template <Uncertainty Kind, class Entries>
void weigh(const Belief<Kind>& prior, const Entries& row, std::span<double> values) {
  double greatest = log_zero;
  for (std::size_t k = 0; k < row.size(); ++k) {
    values[k] = prior.log(row.index(k)) + std::log(row.value(k));
    greatest = std::max(greatest, values[k]);
  }
  for (double& value : values) value = value == log_zero ? 0.0 : std::exp(value - greatest);
}

/// What every `invert` does.
template <Uncertainty To, Uncertainty From, class Prior>
void invert_into(const Relation<To, From>& relation, const Prior& prior, AnyRows& result,
                 std::vector<std::size_t>& unreachable) {
  check::same(relation.from(), prior.variable(), "invert");
  kernels::transpose(relation.rows(), result);
  unreachable.clear();
  std::visit(
      [&]<class Rows>(Rows& rows) {
        if constexpr (!std::same_as<Rows, BandedRows>) {  // which columns never are
          for (std::size_t to = 0; to < rows.rows(); ++to) weigh(prior, rows.entries(to), rows.values(to));
          condition_rows<AlgebraOf<From>>(rows, unreachable);
        }
      },
      result);
}

template <Uncertainty To, Uncertainty From, class Prior>
Inverse<From, To> inverse(const Relation<To, From>& relation, const Prior& prior) {
  AnyRows rows = Table(0, 0);
  std::vector<std::size_t> unreachable;
  invert_into(relation, prior, rows, unreachable);
  return {{relation.from(), relation.to(), std::move(rows), ByLaw{}}, std::move(unreachable)};
}

}  // namespace detail

/// The relation read backwards under a prior of its condition, each row an update: (43), (46), (52), (54).
///
///     from given to  =  relation(to|from) ⊗ prior(from) / ⊕ over from of the same
///
/// An outcome of `to` that no possible `from` reaches gets the uninformative row and is listed.
template <Uncertainty To, Uncertainty From>
Inverse<From, To> invert(const Relation<To, From>& relation, const Belief<From>& prior) {
  return detail::inverse(relation, prior);
}
template <Uncertainty To, Uncertainty From>
Inverse<From, To> invert(const Relation<To, From>& relation, const Distribution<From>& prior) {
  return detail::inverse(relation, prior);
}

/// The same, written into an existing `result` of the same variables.
template <Uncertainty To, Uncertainty From>
void invert(const Relation<To, From>& relation, const Belief<From>& prior, Inverse<From, To>& result) {
  check::same(relation.from(), result.relation.to(), "invert");
  check::same(relation.to(), result.relation.from(), "invert");
  detail::invert_into(relation, prior, result.relation.rows(detail::ByLaw{}), result.unreachable);
}

}  // namespace sigmax
