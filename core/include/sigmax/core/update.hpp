#pragma once

#include <algorithm>
#include <cstddef>
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
  return {prior.variable(), std::move(row), detail::ByLaw{}};
}

/// What `invert` gives: "from given to", and the outcomes of `to` that nothing reaches.
template <Uncertainty From, Uncertainty To>
struct Inverse {
  Relation<From, To> relation;
  std::vector<std::size_t> unreachable;  ///< their rows in `relation` are uninformative
};

/// What every `invert` does; `prior_weight(i)` is on the scale of Weight<AlgebraOf<From>>.
template <Uncertainty To, Uncertainty From, class PriorWeight>
void invert_into(const Relation<To, From>& relation, const Variable<From>& prior, const PriorWeight& prior_weight,
                 AnyRows& result, std::vector<std::size_t>& unreachable) {
  using Scale = Weight<AlgebraOf<From>>;
  check::same(relation.from(), prior, "invert");
  kernels::transpose(relation.rows(), result);
  unreachable.clear();
  const auto invert_rows = [&](auto& rows) {
    for (std::size_t to = 0; to < rows.rows(); ++to) {
      const auto row = rows.entries(to);
      const auto weights = rows.values(to);
      bool reached = false;
      for (std::size_t k = 0; k < weights.size(); ++k) {
        weights[k] = Scale::times(prior_weight(row.index(k)), Scale::of(weights[k]));
        reached = reached || weights[k] != Scale::excluded;
      }
      if (!reached) {
        unreachable.push_back(to);
        continue;
      }
      Scale::to_values(weights);
      condition<AlgebraOf<From>>(weights);
    }
    rows.fill_rows(unreachable, equal_share<AlgebraOf<From>>(prior.size()));
  };
  std::visit(invert_rows, result);
}

/// The relation read backwards under a prior of its condition, each row an update: (43), (46), (52), (54).
///
///     from given to  =  relation(to|from) ⊗ prior(from) / ⊕ over from of the same
///
/// An outcome of `to` that no possible `from` reaches gets the uninformative row and is listed.
template <Uncertainty To, Uncertainty From>
Inverse<From, To> invert(const Relation<To, From>& relation, const Belief<From>& prior) {
  AnyRows rows = Table(0, 0);
  std::vector<std::size_t> unreachable;
  const auto weight = [&](std::size_t i) { return prior.log(i); };
  invert_into(relation, prior.variable(), weight, rows, unreachable);
  return {{relation.from(), relation.to(), std::move(rows), detail::ByLaw{}}, std::move(unreachable)};
}
template <Uncertainty To, Uncertainty From>
Inverse<From, To> invert(const Relation<To, From>& relation, const Distribution<From>& prior) {
  AnyRows rows = Table(0, 0);
  std::vector<std::size_t> unreachable;
  const auto weight = [&](std::size_t i) { return Weight<AlgebraOf<From>>::of(prior[i]); };
  invert_into(relation, prior.variable(), weight, rows, unreachable);
  return {{relation.from(), relation.to(), std::move(rows), detail::ByLaw{}}, std::move(unreachable)};
}

/// The same, written into an existing `result` of the same variables.
template <Uncertainty To, Uncertainty From>
void invert(const Relation<To, From>& relation, const Belief<From>& prior, Inverse<From, To>& result) {
  check::same(relation.from(), result.relation.to(), "invert");
  check::same(relation.to(), result.relation.from(), "invert");
  const auto weight = [&](std::size_t i) { return prior.log(i); };
  invert_into(relation, prior.variable(), weight, result.relation.rows(detail::ByLaw{}), result.unreachable);
}

}  // namespace sigmax
