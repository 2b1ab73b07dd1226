#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <sigmax/core/belief.hpp>
#include <sigmax/core/likelihood.hpp>
#include <sigmax/core/relation.hpp>

namespace sigmax {

namespace detail {

/// Posterior logarithms, written into `result`, and the logarithm of their ⊕ before it was divided out; a posterior
/// row. Throw std::domain_error if nothing is left.
double update_logs(const Outcomes& variable, std::span<const double> prior, std::span<const double> likelihood,
                   const AnyAlgebra& algebra, std::span<double> result);
Table updated(const Outcomes& variable, std::span<const double> prior, const kernels::Evidence& likelihood,
              const AnyAlgebra& algebra);

/// Conditions every row of a joint. A row without mass becomes uninformative and is listed in `unreachable`.
void condition_rows(const AnyAlgebra& algebra, Table& rows, std::vector<std::size_t>& unreachable);

/// What every `invert` does; of the prior either the numbers are given, or their logarithms.
struct Prior {
  std::span<const double> numbers, logs;
};
void invert(const AnyRows& rows, const Prior& prior, const AnyAlgebra& algebra, AnyRows& result,
            std::vector<std::size_t>& unreachable);

}  // namespace detail

/// Posterior belief: the prior times the likelihood, divided by its own ⊕. (8), (19), (20), (41), (44), (62), (63).
/// `result` may be `prior`. Returns the logarithm of that ⊕: the evidence.
/// Throws std::domain_error if the evidence excludes every outcome that the prior left; `result` is then unchanged.
template <Uncertainty Kind>
double update(const Belief<Kind>& prior, const Likelihood<Kind>& likelihood, Belief<Kind>& result) {
  check::same(prior.variable(), likelihood.variable(), "update");
  check::same(prior.variable(), result.variable(), "update");
  return detail::update_logs(prior.variable(), prior.logs(), likelihood.logs(), detail::algebra_of<Kind>(),
                             result.logs(detail::ByLaw{}));
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
  check::same(prior.variable(), likelihood.variable(), "update");
  return {prior.variable(),
          detail::updated(prior.variable(), prior.values(), likelihood.evidence(), detail::algebra_of<Kind>()),
          detail::ByLaw{}};
}

/// What `invert` gives: "from given to", and the outcomes of `to` that nothing reaches.
template <Uncertainty From, Uncertainty To>
struct Inverse {
  Relation<From, To> relation;
  std::vector<std::size_t> unreachable;  ///< their rows in `relation` are uninformative
};

namespace detail {

template <Uncertainty To, Uncertainty From>
Inverse<From, To> inverse(const Relation<To, From>& relation, const Prior& prior) {
  AnyRows rows = Table(0, 0);
  std::vector<std::size_t> unreachable;
  invert(relation.rows(), prior, algebra_of<From>(), rows, unreachable);
  return {{relation.from(), relation.to(), std::move(rows), ByLaw{}}, std::move(unreachable)};
}

}  // namespace detail

/// The relation read backwards under a prior of its condition, each row an update: (43), (46), (52), (54).
///
///     from given to  =  relation(to|from) ⊗ prior(from) / ⊕ over from of the same
///
/// An outcome of `to` that no possible `from` reaches gets the uninformative row and is listed.
template <Uncertainty To, Uncertainty From>
Inverse<From, To> invert(const Relation<To, From>& relation, const Distribution<From>& prior) {
  check::same(relation.from(), prior.variable(), "invert");
  return detail::inverse(relation, {prior.values(), {}});
}
template <Uncertainty To, Uncertainty From>
Inverse<From, To> invert(const Relation<To, From>& relation, const Belief<From>& prior) {
  check::same(relation.from(), prior.variable(), "invert");
  return detail::inverse(relation, {{}, prior.logs()});
}

/// The same, written into an existing `result` of the same variables.
template <Uncertainty To, Uncertainty From>
void invert(const Relation<To, From>& relation, const Belief<From>& prior, Inverse<From, To>& result) {
  check::same(relation.from(), result.relation.to(), "invert");
  check::same(relation.to(), result.relation.from(), "invert");
  check::same(relation.from(), prior.variable(), "invert");
  detail::invert(relation.rows(), {{}, prior.logs()}, detail::algebra_of<From>(), result.relation.rows(detail::ByLaw{}),
                 result.unreachable);
}

}  // namespace sigmax
