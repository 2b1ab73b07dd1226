#include "laws/generate.hpp"

namespace mixed_kinds_test {

/// The laws of compositions and updates over one random and one fuzzy variable, (12)–(20). `Kind` is that of the
/// result, `Other` that of what is eliminated: Random for (15)–(17), (19), Fuzzy for (18), (20).
TYPED_SUITE(MixedLaws, Random, Fuzzy);

template <class Kind>
using Other = std::conditional_t<std::is_same_v<Kind, Random>, Fuzzy, Random>;

TYPED_PROPERTY(MixedLaws, InducedNumbersAreTheirRestatement) {
  using Eliminated = Other<TypeParam>;
  const auto [x, m, y, left, right] = AnyRelations<TypeParam, Eliminated, Eliminated>{};
  const auto prior = any_distribution(m);
  const Rows left_rows = rows_of(left.table());
  require_near(rows_of(compose(left, right).table()),
               plain::compose(by_kind<Eliminated>, left_rows, rows_of(right.table())));
  require_near(compose(left, prior).values(),
               plain::compose(by_kind<Eliminated>, left_rows, numbers_of(prior.values())));
}

TYPED_PROPERTY(MixedLaws, NormalizedDividesEveryRowByItsBeta) {
  using Eliminated = Other<TypeParam>;
  const auto [x, m, y, left, right] = AnyRelations<TypeParam, Eliminated, Eliminated>{};
  const auto induced = compose(left, right);
  const auto normalized = induced.normalized();
  for (std::size_t i = 0; i < y.size(); ++i) {
    double beta = 0.0;
    for (const double value : induced.row(i))
      beta = by_kind<TypeParam> == By::sum ? beta + value : std::max(beta, value);
    require_near(induced.betas()[i], beta);
    for (std::size_t k = 0; k < x.size(); ++k) require_near(normalized(i, k), induced(i, k) / beta);
  }
}

TYPED_PROPERTY(MixedLaws, NoBetaIsDividedAwayOnTheWay) {
  using Eliminated = Other<TypeParam>;
  const auto x = any_variable<TypeParam>("x");
  const auto m = any_variable<Eliminated>("m"), y = any_variable<Eliminated>("y"), z = any_variable<Eliminated>("z");
  const auto a = any_relation(x, m);
  const auto b = any_relation(m, y);
  const auto c = any_relation(y, z);
  const Rows plain_ab = plain::compose(by_kind<Eliminated>, rows_of(a.table()), rows_of(b.table()));
  require_near(rows_of(compose(compose(a, b), c).table()),
               plain::compose(by_kind<Eliminated>, plain_ab, rows_of(c.table())));
  require_near(rows_of(compose(compose(a, b), c).table()), rows_of(compose(a, compose(b, c)).table()));
}

TYPED_PROPERTY(MixedLaws, UpdateAcrossKindsIsItsRestatement) {  // (19) for a random, (20) for a fuzzy observation
  using Unknown = Other<TypeParam>;
  const auto [x, y, relation, prior] = AnyJoint<TypeParam, Unknown>{};
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Numbers likelihood = plain::column(rows_of(relation.table()), k);
    if (plain::evidence(by_kind<Unknown>, numbers_of(prior.values()), likelihood) > 0)
      require_near(update(prior, relation.likelihood(k)).values(),
                   plain::update(by_kind<Unknown>, numbers_of(prior.values()), likelihood));
  }
}

TYPED_PROPERTY(MixedLaws, UpdateAcrossKindsDoesNotDependOnBeta) {
  using Unknown = Other<TypeParam>;
  const auto [x, y, relation, prior] = AnyJoint<TypeParam, Unknown>{};
  const double scale = 1e-3 + any_unit_number();
  Rows scaled = rows_of(relation.table());
  for (Numbers& row : scaled)
    for (double& value : row) value *= scale;
  const Induced<Relation<TypeParam, Unknown>> induced{x, y, table_of(scaled), detail::ByLaw{}};
  for (std::size_t k = 0; k < x.size(); ++k)
    if (plain::evidence(by_kind<Unknown>, numbers_of(prior.values()), plain::column(scaled, k)) > 1e-200L)
      require_near(update(prior, induced.likelihood(k)).values(), update(prior, relation.likelihood(k)).values());
}

TYPED_PROPERTY(MixedLaws, TheOtherConditionalRecoversWhatTheJointWasBuiltFrom) {
  // (12) → (14) → (12): from p(x|y), π(y) to π(y|x), p⁺(x) and, by (20), back; and the same from (13).
  using Condition = Other<TypeParam>;
  const auto [x, y, relation, prior] = AnyJoint<TypeParam, Condition>{};
  const auto induced = compose(relation, prior);
  const auto back = invert(relation, prior).relation;  // (19)
  for (std::size_t i = 0; i < y.size(); ++i)
    for (std::size_t k = 0; k < x.size(); ++k) require_near(back(k, i) * induced[k], relation(i, k) * prior[i]);

  const auto again = invert(back, induced.normalized()).relation;  // (20): β cancels
  for (std::size_t i = 0; i < y.size(); ++i)
    if (prior[i] > 1e-200) require_near(again.row(i), relation.row(i));
}

PROPERTY(MixedKinds, InducedProbabilityIsAtMostTheSumProductOfTheSameNumbers) {
  const auto [x, m, y, left, right] = AnyRelations<Random, Fuzzy, Fuzzy>{};
  const auto induced = compose(left, right);
  const Rows summed = plain::compose(By::sum, rows_of(left.table()), rows_of(right.table()));
  for (std::size_t i = 0; i < y.size(); ++i)
    for (std::size_t k = 0; k < x.size(); ++k) RC_ASSERT(induced(i, k) <= summed[i][k] * (1.0 + 1e-12));
}

PROPERTY(MixedKinds, BetaOfAnInducedProbabilityIsInItsRange) {  // [1, min(|X|, Σ π)]
  const auto [x, y, relation, prior] = AnyJoint<Random, Fuzzy>{};
  const double sum = total<Random>(prior.values());
  const double beta = compose(relation, prior).beta();
  require_near(HybridDistribution{relation, prior}.beta(), beta);
  RC_ASSERT(beta >= 1.0 - 1e-9);
  RC_ASSERT(beta <= std::min(static_cast<double>(x.size()), sum) + 1e-9);
}

PROPERTY(MixedKinds, BetaOfAnInducedPossibilityIsInItsRange) {  // [max(1/|Y|, max p), 1]
  const auto [y, x, relation, prior] = AnyJoint<Fuzzy, Random>{};
  const double beta = compose(relation, prior).beta();
  require_near(HybridDistribution{relation, prior}.beta(), beta);
  const double greatest = prior[index_of_greatest(prior.values())];
  RC_ASSERT(beta >= std::max(1.0 / static_cast<double>(y.size()), greatest) - 1e-9);
  RC_ASSERT(beta <= 1.0 + 1e-9);
}

TYPED_PROPERTY(MixedLaws, ADeltaRelationOnlyRenames) {  // (17) and (18) then reduce to their inputs, with β = 1
  using Eliminated = Other<TypeParam>;
  const auto x = any_variable<TypeParam>("x");
  const auto m = any_variable<Eliminated>("m"), y = any_variable<Eliminated>("y");
  const auto left = any_relation(x, m);
  Rows delta(y.size(), Numbers(m.size(), 0.0)), expected;
  for (Numbers& row : delta) {
    const std::size_t image = any([&](rc::Random& random) { return random.next() % m.size(); });
    row[image] = 1.0;
    expected.push_back(numbers_of(left.row(image)));
  }
  const auto composed = compose(left, Relation<Eliminated, Eliminated>{m, y, delta});
  RC_ASSERT(rows_of(composed.table()) == expected);
  require_near(composed.betas(), Numbers(y.size(), 1.0));
}

TYPED_PROPERTY(MixedLaws, ABijectiveReadingOnlyRenames) {  // a delta on the left, one outcome of x for each of m
  using Eliminated = Other<TypeParam>;
  const auto m = any_variable<Eliminated>("m"), y = any_variable<Eliminated>("y");
  const Variable<TypeParam> x{"x", m.size()};
  const auto right = any_relation(m, y);
  const auto image = any_order(m.size());
  Rows delta(m.size(), Numbers(x.size(), 0.0));
  for (std::size_t i = 0; i < m.size(); ++i) delta[i][image[i]] = 1.0;
  const auto composed = compose(Relation<TypeParam, Eliminated>{x, m, delta}, right);
  for (std::size_t from = 0; from < y.size(); ++from)
    for (std::size_t i = 0; i < m.size(); ++i) RC_ASSERT(composed(from, image[i]) == right(from, i));
}

TEST(MixedKinds, MixedKindsDoNotAssociate) {
  const RandomVariable x{"x", 2};
  const FuzzyVariable fuzzy{"fuzzy", 2};
  const RandomVariable random{"random", 2};
  const RandomVariable y{"y", 1};
  const Relation a{x, fuzzy, {{0.5, 0.5}, {0.5, 0.5}}};
  const Relation b{fuzzy, random, {{1.0, 0.0}, {0.0, 1.0}}};
  const Relation c{random, y, {{0.5, 0.5}}};
  // max first, then sum: Σ_r ½ max_f ½ b(f|r) = ½; sum first, then max: max_f ½ Σ_r b(f|r) ½ = ¼.
  EXPECT_EQ(compose(compose(a, b), c)(0, 0), 0.5);
  EXPECT_EQ(compose(a, compose(b, c))(0, 0), 0.25);
}

}  // namespace mixed_kinds_test
