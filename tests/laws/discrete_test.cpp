#include "laws/generate.hpp"

namespace discrete_test {

/// The laws of the discrete calculus within one kind: probability and possibility alike.
TYPED_SUITE(DiscreteLaws, Random, Fuzzy);

/// Cases that exclude every outcome are for the tests of update itself.
template <class Kind>
void require_possible(const Distribution<Kind>& prior, const Numbers& likelihood) {
  RC_PRE(plain::evidence(by_kind<Kind>, numbers_of(prior.values()), likelihood) > 0);
}

/// A prior and evidence that do not exclude each other.
template <class Kind>
struct AnyEvidence {
  Variable<Kind> x = any_variable<Kind>("x");
  Distribution<Kind> prior = any_distribution(x);
  Numbers likelihood = any_unit_numbers(x.size());
  AnyEvidence() { require_possible(prior, likelihood); }
};

template <class Kind>
Likelihood<Kind> log_product(const Likelihood<Kind>& a, const Likelihood<Kind>& b) {
  Likelihood<Kind> result{a.variable()};
  for (std::size_t i = 0; i < a.size(); ++i) result.set_log(i, a.log(i) + b.log(i));
  return result;
}

// Composition, (5), (6), (7).

TYPED_PROPERTY(DiscreteLaws, CompositionIsItsRestatement) {
  const auto [x, m, y, left, right] = AnyRelations<TypeParam, TypeParam, TypeParam>{};
  const auto prior = any_distribution(m);
  const Rows left_rows = rows_of(left.table());
  require_near(rows_of(compose(left, right).table()),
               plain::compose(by_kind<TypeParam>, left_rows, rows_of(right.table())));
  require_near(compose(left, prior).values(),
               plain::compose(by_kind<TypeParam>, left_rows, numbers_of(prior.values())));
}

TYPED_PROPERTY(DiscreteLaws, CompositionIsAssociative) {
  const auto x = any_variable<TypeParam>("x"), m = any_variable<TypeParam>("m"), l = any_variable<TypeParam>("l"),
             y = any_variable<TypeParam>("y");
  const auto a = any_relation(x, m);
  const auto b = any_relation(m, l);
  const auto c = any_relation(l, y);
  const auto prior = any_distribution(l);
  require_near(rows_of(compose(compose(a, b), c).table()), rows_of(compose(a, compose(b, c)).table()));
  require_near(compose(compose(a, b), prior).values(), compose(a, compose(b, prior)).values());
}

TYPED_PROPERTY(DiscreteLaws, ABeliefIsPredictedAsItsDistribution) {
  const auto [x, y, relation, prior] = AnyJoint<TypeParam, TypeParam>{};
  require_near(compose(relation, Belief{prior}).distribution().values(),
               plain::compose(by_kind<TypeParam>, rows_of(relation.table()), numbers_of(prior.values())));
}

TYPED_PROPERTY(DiscreteLaws, ALikelihoodIsCarriedBackAsItsRestatement) {
  const auto x = any_variable<TypeParam>("x"), y = any_variable<TypeParam>("y");
  const auto relation = any_relation(x, y);
  const Numbers values = any_unit_numbers(x.size());
  const auto carried = compose(Likelihood{x, values}, relation);
  for (std::size_t i = 0; i < y.size(); ++i)
    require_near(carried[i],
                 static_cast<double>(plain::evidence(by_kind<TypeParam>, numbers_of(relation.row(i)), values)));
}

// Update, (8), (41), (44).

TYPED_PROPERTY(DiscreteLaws, UpdateIsItsRestatement) {
  const AnyEvidence<TypeParam> drawn;
  const auto& [x, prior, likelihood] = drawn;
  const Numbers expected = plain::update(by_kind<TypeParam>, numbers_of(prior.values()), likelihood);
  require_near(update(prior, Likelihood{x, likelihood}).values(), expected);

  Belief belief{prior};
  const double log_evidence = update(belief, Likelihood{x, likelihood}, belief);
  require_near(
      log_evidence,
      static_cast<double>(std::log(plain::evidence(by_kind<TypeParam>, numbers_of(prior.values()), likelihood))));
}

TYPED_PROPERTY(DiscreteLaws, TheOrderOfEvidenceDoesNotMatterAndABatchIsTheSame) {
  const auto x = any_variable<TypeParam>("x");
  const auto prior = any_distribution(x);
  const Likelihood first{x, any_unit_numbers(x.size())}, second{x, any_unit_numbers(x.size())};
  Likelihood both = log_product(first, second);
  bool possible = false;
  for (std::size_t i = 0; i < x.size(); ++i) possible = possible || std::log(prior[i]) + both.log(i) > log_zero;
  RC_PRE(possible);
  const Numbers batch = numbers_of(update(prior, both).values());
  require_near(update(update(Belief{prior}, first), second).distribution().values(), batch);
  require_near(update(update(Belief{prior}, second), first).distribution().values(), batch);
}

// Inversion, (43), (46).

TYPED_PROPERTY(DiscreteLaws, InversionIsItsRestatement) {
  const auto [x, y, relation, prior] = AnyJoint<TypeParam, TypeParam>{};
  const Numbers prior_values = numbers_of(prior.values());
  const auto inverse = invert(relation, prior);
  const Rows expected = plain::invert(by_kind<TypeParam>, rows_of(relation.table()), prior_values);
  std::vector<std::size_t> unreachable;
  for (std::size_t to = 0; to < x.size(); ++to) {
    const Numbers row = numbers_of(inverse.relation.row(to));
    require_near(total<TypeParam>(row), 1.0);
    if (expected[to].empty()) {
      unreachable.push_back(to);
      require_near(row, uninformative(y).values());
      continue;
    }
    require_near(row, expected[to]);
  }
  RC_ASSERT(inverse.unreachable == unreachable);
}

}  // namespace discrete_test
