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
