#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <sigmax/core/induced.hpp>
#include <sigmax/core/kernels/compose.hpp>
#include <sigmax/core/update.hpp>

namespace sigmax {

/// The joint distribution of two variables of any kinds, pπ(x y) of (9). The template order is the elimination order:
/// ⊕ over Outer of ⊕ over Inner is one. With y fuzzy and x random,
///
///     HybridDistribution{x_given_y, y_prior}   // <Fuzzy, Random>, (12): p(x|y) π(y)
///     HybridDistribution{y_given_x, x_prior}   // <Random, Fuzzy>, (13): π(y|x) p(x)
///
/// satisfy one of (10), (11) each, and the other only up to β, the ⊕ in the other order:
///
///     built by (12):  max_y Σ_x = 1, and β = Σ_x max_y ∈ [1, min(|X|, Σ π)]
///     built by (13):  Σ_x max_y = 1, and β = max_y Σ_x ∈ [max(1/|Y|, max p), 1]
///
/// Of one kind it is the ordinary joint (4): both orders agree and β = 1. A product below the smallest double is zero
/// here; `compose` and `invert` say the same of the factors, without forming it.
template <Uncertainty Outer, Uncertainty Inner>
  requires ScalingAlgebra<AlgebraOf<Outer>> && ScalingAlgebra<AlgebraOf<Inner>>
class HybridDistribution {
 public:
  using outer_kind = Outer;
  using inner_kind = Inner;

  /// Conditional ⊗ marginal, (4), (12), (13). Throws std::invalid_argument, naming both variables, if they do not meet.
  HybridDistribution(const Relation<Inner, Outer>& conditional, const Distribution<Outer>& marginal)
      : HybridDistribution(conditional.from(), conditional.to()) {
    check::same(conditional.from(), marginal.variable(), "HybridDistribution");
    for (std::size_t o = 0; o < outer_.size(); ++o)
      for (std::size_t i = 0; i < inner_.size(); ++i)
        table_(o, i) = AlgebraOf<Outer>::times(conditional(o, i), marginal[o]);
  }

  /// The re-expansion (14) read backwards: from π(y|x) and the induced p⁺(x) the joint of (12) again, and from p(x|y)
  /// and π⁺(y) that of (13). Throws std::invalid_argument if they meet in no joint that is normalised in this order.
  HybridDistribution(const Relation<Outer, Inner>& conditional, const Induced<Distribution<Inner>>& marginal)
      : HybridDistribution(conditional.to(), conditional.from()) {
    check::same(conditional.from(), marginal.variable(), "HybridDistribution");
    for (std::size_t o = 0; o < outer_.size(); ++o)
      for (std::size_t i = 0; i < inner_.size(); ++i)
        table_(o, i) = AlgebraOf<Outer>::times(conditional(i, o), marginal[i]);
    prove(3.0 * normalization_tolerance);  // each factor has its own
  }

  /// The joint as numbers, a row per outcome of `outer`; stored unchanged.
  /// Throws std::invalid_argument, naming variable, row and value, unless ⊕ over outer of ⊕ over inner is one.
  HybridDistribution(Variable<Outer> outer, Variable<Inner> inner, const std::vector<std::vector<double>>& rows)
      : HybridDistribution(std::move(outer), std::move(inner)) {
    if (rows.size() != outer_.size())
      throw std::invalid_argument("the joint of '" + outer_.name() + "' and '" + inner_.name() + "' needs " +
                                  std::to_string(outer_.size()) + " rows, but " + std::to_string(rows.size()) +
                                  " were given");
    for (std::size_t o = 0; o < rows.size(); ++o) {
      check::size(inner_, {&outer_, o}, rows[o].size());
      std::copy(rows[o].begin(), rows[o].end(), table_.row(o).begin());
    }
    prove(normalization_tolerance);
  }

  const Variable<Outer>& outer() const& { return outer_; }
  Variable<Outer> outer() const&& { return outer_; }
  const Variable<Inner>& inner() const& { return inner_; }
  Variable<Inner> inner() const&& { return inner_; }
  const Table& table() const& { return table_; }
  Table table() && { return std::move(table_); }
  double operator()(std::size_t outer, std::size_t inner) const { return table_(outer, inner); }

  /// What is left of `outer`, (5): the marginal that the joint was built from.
  Distribution<Outer> outer_marginal() const {
    Table sums(1, outer_.size());
    for (std::size_t o = 0; o < outer_.size(); ++o) sums(0, o) = sigmax::total<Inner>(table_.row(o));
    return {outer_, std::move(sums), detail::ByLaw{}};
  }

  /// What is left of `inner`: of one kind a distribution, (5); else only induced, p⁺ or π⁺ of (15), whose `.beta()` and
  /// `.normalized()` are β and (16).
  auto inner_marginal() const {
    using Marginal = std::conditional_t<std::same_as<Outer, Inner>, Distribution<Inner>, Induced<Distribution<Inner>>>;
    Table sums(1, inner_.size());
    kernels::compose<AlgebraOf<Outer>>(table_, Table(1, outer_.size(), 1.0), sums);
    return Marginal{inner_, std::move(sums), detail::ByLaw{}};
  }

  /// ⊕ over outer of ⊕ over inner: one. (11) if outer is fuzzy and inner random, (10) if it is the other way round.
  double total() const {
    double sum = AlgebraOf<Outer>::zero();
    for (std::size_t o = 0; o < outer_.size(); ++o)
      sum = AlgebraOf<Outer>::plus(sum, sigmax::total<Inner>(table_.row(o)));
    return sum;
  }

  /// ⊕ over inner of ⊕ over outer, the other one of (10) and (11): the β of (14) and (16).
  double beta() const { return sigmax::total<Inner>(inner_marginal().values()); }

  /// The conditional that the joint was built from: each row of it divided by its ⊕. An outcome of `outer` without
  /// mass gets the uninformative row and is listed.
  Inverse<Inner, Outer> inner_given_outer() const { return conditioned(inner_, outer_, table_); }

  /// The other conditional, (14), (19), (20): each column divided by its ⊕. With `inner_marginal()` it is the joint
  /// again. An outcome of `inner` without mass gets the uninformative row and is listed.
  Inverse<Outer, Inner> outer_given_inner() const {
    Table columns(inner_.size(), outer_.size());
    for (std::size_t o = 0; o < outer_.size(); ++o)
      for (std::size_t i = 0; i < inner_.size(); ++i) columns(i, o) = table_(o, i);
    return conditioned(outer_, inner_, std::move(columns));
  }

 private:
  HybridDistribution(Variable<Outer> outer, Variable<Inner> inner)
      : outer_(std::move(outer)), inner_(std::move(inner)), table_(outer_.size(), inner_.size()) {}

  void prove(double tolerance) const {
    for (std::size_t o = 0; o < outer_.size(); ++o)
      check::values(inner_, {&outer_, o}, table_.row(o), 1.0 + normalization_tolerance);
    if (std::abs(total() - 1.0) > tolerance)
      check::total(inner_, {}, total(),
                   std::string(Outer::total) + " over '" + outer_.name() + "' of the " + std::string(Inner::total));
  }

  template <Uncertainty To, Uncertainty From>
  static Inverse<To, From> conditioned(const Variable<To>& to, const Variable<From>& from, Table rows) {
    std::vector<std::size_t> unreachable;
    detail::condition_rows(detail::algebra_of<To>(), rows, unreachable);
    return {{to, from, std::move(rows), detail::ByLaw{}}, std::move(unreachable)};
  }

  Variable<Outer> outer_;
  Variable<Inner> inner_;
  Table table_;
};

}  // namespace sigmax
