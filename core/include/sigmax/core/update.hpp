#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <sigmax/core/belief.hpp>
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
  return result.assign([&](std::size_t i) { return prior.log(i) + likelihood.log(i); });
}
template <Uncertainty Kind>
Belief<Kind> update(const Belief<Kind>& prior, const Likelihood<Kind>& likelihood) {
  Belief<Kind> result = prior;
  update(prior, likelihood, result);
  return result;
}

/// Posterior distribution, (8), (19), (20).
///
///     update(uninformative(age), speed_given_age.likelihood("fast"))
template <Uncertainty Kind>
Distribution<Kind> update(const Distribution<Kind>& prior, const Likelihood<Kind>& likelihood) {
  return update(Belief<Kind>{prior}, likelihood).distribution();
}

/// What `invert` gives: "from given to", and the outcomes of `to` that nothing reaches.
template <Uncertainty From, Uncertainty To>
struct Inverse {
  Relation<From, To> relation;
  std::vector<std::size_t> unreachable;  ///< their rows in `relation` are uninformative
};

/// The relation read backwards under a prior of its condition, each row an update: (43), (46), (52), (54).
///
///     from given to  =  relation(to|from) ⊗ prior(from) / ⊕ over from of the same
///
/// An outcome of `to` that no possible `from` reaches gets the uninformative row and is listed.
template <Uncertainty To, Uncertainty From>
Inverse<From, To> invert(const Relation<To, From>& relation, const Belief<From>& prior) {
  Inverse<From, To> result{
      {relation.from(), relation.to(), Table(relation.to().size(), relation.from().size()), ByLaw{}}, {}};
  invert(relation, prior, result);
  return result;
}
template <Uncertainty To, Uncertainty From>
Inverse<From, To> invert(const Relation<To, From>& relation, const Distribution<From>& prior) {
  return invert(relation, Belief<From>{prior});
}

/// The same, written into an existing `result` of the same variables.
template <Uncertainty To, Uncertainty From>
void invert(const Relation<To, From>& relation, const Belief<From>& prior, Inverse<From, To>& result) {
  using Algebra = AlgebraOf<From>;
  check::same(relation.from(), prior.variable(), "invert");
  check::same(relation.from(), result.relation.to(), "invert");
  check::same(relation.to(), result.relation.from(), "invert");
  const std::size_t n = prior.size();
  Table& rows = result.relation.table(ByLaw{});
  result.unreachable.clear();
  for (std::size_t to = 0; to < relation.to().size(); ++to) {
    // Through logarithms and scaled by the greatest, so that nothing that leads here is lost to underflow.
    const auto row = rows.row(to);
    for (std::size_t from = 0; from < n; ++from) row[from] = prior.log(from) + std::log(relation(from, to));
    const double greatest = row[index_of_greatest(row)];
    if (greatest == log_zero) result.unreachable.push_back(to);
    double sum = Algebra::zero();
    for (double& value : row) {
      value = greatest == log_zero ? 1.0 : std::exp(value - greatest);
      sum = Algebra::plus(sum, value);
    }
    for (double& value : row) value = Algebra::divide(value, sum);
  }
}

}  // namespace sigmax
