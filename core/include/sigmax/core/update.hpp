#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
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
  using Scale = Weight<AlgebraOf<Kind>>;
  check::same(prior.variable(), likelihood.variable(), "update");
  Table row(1, prior.size());
  for (std::size_t i = 0; i < row.size(); ++i) row(0, i) = Scale::times(Scale::of(prior[i]), likelihood.weight(i));
  if (row(0, index_of_greatest(row.values())) == Scale::excluded) check::excluded(prior.variable());
  Scale::to_values(row.values());
  condition<AlgebraOf<Kind>>(row.values());
  return {prior.variable(), std::move(row), ByLaw{}};
}

/// What `invert` gives: "from given to", and the outcomes of `to` that nothing reaches.
template <Uncertainty From, Uncertainty To>
struct Inverse {
  Relation<From, To> relation;
  std::vector<std::size_t> unreachable;  ///< their rows in `relation` are uninformative
};

/// An inverse of the right shape, not yet computed.
template <Uncertainty To, Uncertainty From>
Inverse<From, To> inverse_of(const Relation<To, From>& relation) {
  return {{relation.from(), relation.to(), Table(relation.to().size(), relation.from().size()), ByLaw{}}, {}};
}

/// What every `invert` does; `prior_weight(i)` is on the scale of Weight<AlgebraOf<From>>.
template <Uncertainty To, Uncertainty From, class PriorWeight>
void invert_by_weights(const Relation<To, From>& relation, const Variable<From>& prior, const PriorWeight& prior_weight,
                       Inverse<From, To>& result) {
  using Scale = Weight<AlgebraOf<From>>;
  check::same(relation.from(), prior, "invert");
  check::same(relation.from(), result.relation.to(), "invert");
  check::same(relation.to(), result.relation.from(), "invert");
  Table& rows = result.relation.table(ByLaw{});
  result.unreachable.clear();
  for (std::size_t to = 0; to < rows.rows(); ++to) {
    const auto row = rows.row(to);
    for (std::size_t from = 0; from < row.size(); ++from)
      row[from] = Scale::times(prior_weight(from), Scale::of(relation(from, to)));
    if (row[index_of_greatest(row)] == Scale::excluded) {
      result.unreachable.push_back(to);
      std::fill(row.begin(), row.end(), Scale::of(1.0));
    }
    Scale::to_values(row);
    condition<AlgebraOf<From>>(row);
  }
}

/// The relation read backwards under a prior of its condition, each row an update: (43), (46), (52), (54).
///
///     from given to  =  relation(to|from) ⊗ prior(from) / ⊕ over from of the same
///
/// An outcome of `to` that no possible `from` reaches gets the uninformative row and is listed.
template <Uncertainty To, Uncertainty From>
Inverse<From, To> invert(const Relation<To, From>& relation, const Belief<From>& prior) {
  auto result = inverse_of(relation);
  invert(relation, prior, result);
  return result;
}
template <Uncertainty To, Uncertainty From>
Inverse<From, To> invert(const Relation<To, From>& relation, const Distribution<From>& prior) {
  auto result = inverse_of(relation);
  invert_by_weights(
      relation, prior.variable(), [&](std::size_t i) { return Weight<AlgebraOf<From>>::of(prior[i]); }, result);
  return result;
}

/// The same, written into an existing `result` of the same variables.
template <Uncertainty To, Uncertainty From>
void invert(const Relation<To, From>& relation, const Belief<From>& prior, Inverse<From, To>& result) {
  invert_by_weights(
      relation, prior.variable(), [&](std::size_t i) { return prior.log(i); }, result);
}

}  // namespace sigmax
