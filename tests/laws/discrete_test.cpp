#include "laws/generate.hpp"

namespace discrete_test {

/// The laws of the discrete calculus within one kind: probability and possibility alike.
TYPED_SUITE(DiscreteLaws, Random, Fuzzy);

template <class Kind>
Relation<Kind, Kind> identity(const Variable<Kind>& variable) {
  Rows rows(variable.size(), Numbers(variable.size(), 0.0));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i][i] = 1.0;
  return {variable, variable, rows};
}

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

/// The same distribution under other names: outcome order[i] of it is outcome i of `variable`.
Numbers reordered(std::span<const double> values, const std::vector<std::size_t>& order) {
  Numbers result;
  for (const std::size_t i : order) result.push_back(values[i]);
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

TYPED_PROPERTY(DiscreteLaws, CompositionKeepsNormalization) {
  const auto x = any_variable<TypeParam>("x"), m = any_variable<TypeParam>("m"), y = any_variable<TypeParam>("y");
  const auto composed = compose(any_relation(x, m), any_relation(m, y));
  for (std::size_t i = 0; i < y.size(); ++i) require_near(total<TypeParam>(composed.row(i)), 1.0);
  const auto marginal = compose(composed, any_distribution(y));
  require_near(total<TypeParam>(marginal.values()), 1.0);
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

TYPED_PROPERTY(DiscreteLaws, IdentityIsNeutral) {
  const auto [x, y, relation, prior] = AnyJoint<TypeParam, TypeParam>{};
  RC_ASSERT(rows_of(compose(identity(x), relation).table()) == rows_of(relation.table()));
  RC_ASSERT(rows_of(compose(relation, identity(y)).table()) == rows_of(relation.table()));
  RC_ASSERT(numbers_of(compose(identity(y), prior).values()) == numbers_of(prior.values()));
}

TYPED_PROPERTY(DiscreteLaws, ScalingARowPassesThroughCompositionAndVanishesInNormalization) {
  const auto [x, m, y, left, right] = AnyRelations<TypeParam, TypeParam, TypeParam>{};
  Rows scaled = rows_of(right.table()), expected = rows_of(compose(left, right).table());
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double factor = 1e-3 + any_unit_number();
    for (double& value : scaled[i]) value *= factor;
    for (double& value : expected[i]) value *= factor;
  }
  const Induced<Relation<TypeParam, TypeParam>> induced{m, y, table_of(scaled), detail::ByLaw{}};
  require_near(rows_of(compose(left, induced).table()), expected);
  require_near(rows_of(compose(left, induced).normalized().table()), rows_of(compose(left, right).table()));
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

TYPED_PROPERTY(DiscreteLaws, EvidenceIsTheSameCarriedForwardOrBack) {
  const auto x = any_variable<TypeParam>("x"), y = any_variable<TypeParam>("y");
  const auto relation = any_relation(x, y);
  const Belief prior{any_distribution(y)};
  const Likelihood likelihood{x, any_unit_numbers(x.size())};
  Belief forward = compose(relation, prior), back = prior;
  bool forward_possible = true, back_possible = true;
  double forward_evidence = 0.0, back_evidence = 0.0;
  try {
    forward_evidence = update(forward, likelihood, forward);
  } catch (const std::domain_error&) {
    forward_possible = false;
  }
  try {
    back_evidence = update(prior, compose(likelihood, relation), back);
  } catch (const std::domain_error&) {
    back_possible = false;
  }
  RC_ASSERT(forward_possible == back_possible);
  require_near(std::exp(forward_evidence), std::exp(back_evidence));
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

TYPED_PROPERTY(DiscreteLaws, UpdateKeepsNormalization) {
  const AnyEvidence<TypeParam> drawn;
  const auto& [x, prior, likelihood] = drawn;
  require_near(total<TypeParam>(update(prior, Likelihood{x, likelihood}).values()), 1.0);
}

TYPED_PROPERTY(DiscreteLaws, UpdateDoesNotChangeWithTheScaleOfTheLikelihood) {
  const AnyEvidence<TypeParam> drawn;
  const auto& [x, prior, values] = drawn;
  const Likelihood likelihood{x, values};
  const double log_scale = 1e6 * (any_unit_number() - 0.5);
  Likelihood scaled{x};
  for (std::size_t i = 0; i < x.size(); ++i) scaled.set_log(i, likelihood.log(i) + log_scale);
  require_near(update(prior, scaled).values(), update(prior, likelihood).values());
}

TYPED_PROPERTY(DiscreteLaws, AConstantLikelihoodSaysNothing) {
  const auto x = any_variable<TypeParam>("x");
  const auto prior = any_distribution(x);
  const double constant = any_unit_number();
  RC_PRE(constant > 0.0);
  require_near(update(prior, Likelihood{x, Numbers(x.size(), constant)}).values(), prior.values());
  require_near(update(prior, Likelihood{x}).values(), prior.values());
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

TYPED_PROPERTY(DiscreteLaws, UpdateByCrispEvidenceIsIdempotent) {
  const auto x = any_variable<TypeParam>("x");
  const auto prior = any_distribution(x);
  Numbers crisp = any_unit_numbers(x.size());
  for (double& value : crisp) value = value >= 0.5 ? 1.0 : 0.0;
  require_possible(prior, crisp);
  const Likelihood likelihood{x, crisp};
  const auto once = update(prior, likelihood);
  require_near(update(once, likelihood).values(), once.values());
}

TYPED_TEST(DiscreteLaws, UpdateByOtherEvidenceIsNot) {
  const Variable<TypeParam> x{"x", {"a", "b"}};
  const Likelihood likelihood{x, {1.0, 0.5}};
  const auto once = update(uninformative(x), likelihood), twice = update(once, likelihood);
  const double normal = total<TypeParam>(Numbers{1.0, 0.5}), normal_twice = total<TypeParam>(Numbers{1.0, 0.25});
  EXPECT_CLOSE(once["b"], 0.5 / normal, 1e-12);
  EXPECT_CLOSE(twice["b"], 0.25 / normal_twice, 1e-12);
}

TYPED_PROPERTY(DiscreteLaws, SupportShrinksToWhatEvidenceAllows) {
  const AnyEvidence<TypeParam> drawn;
  const auto& [x, prior, likelihood] = drawn;
  const auto posterior = update(Belief{prior}, Likelihood{x, likelihood});
  for (std::size_t i = 0; i < x.size(); ++i)
    RC_ASSERT((posterior.log(i) > log_zero) == (prior[i] > 0.0 && likelihood[i] > 0.0));
}

TYPED_PROPERTY(DiscreteLaws, ADominatedOutcomeIsNeverPreferred) {
  const auto x = any_variable<TypeParam>("x");
  const std::size_t less = any([&](rc::Random& random) { return random.next() % x.size(); });
  const std::size_t more = any([&](rc::Random& random) { return random.next() % x.size(); });
  Belief belief{uninformative(x)};
  for (int report = 0; report < 5; ++report) {
    Numbers likelihood = any_unit_numbers(x.size());
    if (likelihood[less] > likelihood[more]) std::swap(likelihood[less], likelihood[more]);
    likelihood[more] = std::max(likelihood[more], 1e-9);  // never excluded altogether
    if (less == more) likelihood[less] = likelihood[more];
    update(belief, Likelihood{x, likelihood}, belief);
    RC_ASSERT(belief.log(less) <= belief.log(more));
  }
}

TYPED_PROPERTY(DiscreteLaws, RelabellingOutcomesRelabelsAnswers) {
  const auto x = any_variable<TypeParam>("x"), y = any_variable<TypeParam>("y");
  const auto prior = any_distribution(y);
  const auto relation = any_relation(x, y);
  const auto x_order = any_order(x.size()), y_order = any_order(y.size());

  const Distribution<TypeParam> other_prior{y, reordered(prior.values(), y_order)};
  Rows rows;
  for (const std::size_t from : y_order) rows.push_back(reordered(relation.row(from), x_order));
  const Relation<TypeParam, TypeParam> other_relation{x, y, rows};

  const auto marginal = compose(relation, prior), other_marginal = compose(other_relation, other_prior);
  require_near(other_marginal.values(), reordered(marginal.values(), x_order));
  const auto back = invert(relation, prior).relation, other_back = invert(other_relation, other_prior).relation;
  for (std::size_t to = 0; to < x.size(); ++to)
    require_near(other_back.row(to), reordered(back.row(x_order[to]), y_order));
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

TYPED_PROPERTY(DiscreteLaws, TheJointIsRebuiltFromMarginalAndConditional) {
  const auto [x, y, relation, prior] = AnyJoint<TypeParam, TypeParam>{};
  const auto marginal = compose(relation, prior);
  const auto back = invert(relation, prior).relation;
  for (std::size_t i = 0; i < y.size(); ++i)
    for (std::size_t k = 0; k < x.size(); ++k) require_near(back(k, i) * marginal[k], relation(i, k) * prior[i]);
}

// Possibility alone: the greatest of a row is exactly one.

PROPERTY(FuzzyLaws, ARouteOfPossibilityOneExists) {
  std::vector<FuzzyVariable> stage;
  for (const char* name : {"a", "b", "c", "d"}) stage.push_back(any_variable<Fuzzy>(name));
  const auto first = any_relation(stage[1], stage[0]);
  const auto second = any_relation(stage[2], stage[1]);
  const auto third = any_relation(stage[3], stage[2]);
  const auto all = compose(third, compose(second, first));
  for (std::size_t start = 0; start < stage[0].size(); ++start) {
    // The route that takes the most possible step at each stage is as possible as the composition says, one.
    const std::size_t b = index_of_greatest(first.row(start));
    const std::size_t c = index_of_greatest(second.row(b));
    const std::size_t d = index_of_greatest(third.row(c));
    RC_ASSERT(first(start, b) * second(b, c) * third(c, d) == 1.0);
    RC_ASSERT(all(start, d) == 1.0);
  }
}

PROPERTY(FuzzyLaws, PowersOfAUnitDiagonalTransitionGrowAndSettle) {
  const auto mode = any_variable<Fuzzy>("mode");
  Rows rows = any_unit_rows(mode.size(), mode.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i][i] = 1.0;
  const Relation<Fuzzy, Fuzzy> transition{mode, mode, rows};
  Relation<Fuzzy, Fuzzy> power = transition;
  for (std::size_t m = 1; m + 1 < mode.size(); ++m) {
    const Relation<Fuzzy, Fuzzy> next = compose(power, transition);
    for (std::size_t i = 0; i < next.table().size(); ++i) RC_ASSERT(power.table().data()[i] <= next.table().data()[i]);
    power = next;
  }
  require_near(rows_of(compose(power, transition).table()), rows_of(power.table()));  // Π^M = Π^(M−1)
}

}  // namespace discrete_test
