#include "support/core.hpp"

namespace hybrid_distribution_test {

// What a law guarantees is a distribution; the rest is only induced.
template <class Outer, class Inner>
using InnerMarginal = decltype(std::declval<const HybridDistribution<Outer, Inner>&>().inner_marginal());
static_assert(std::same_as<InnerMarginal<Fuzzy, Random>, Induced<Distribution<Random>>>);  // p⁺, (15)
static_assert(std::same_as<InnerMarginal<Random, Fuzzy>, Induced<Distribution<Fuzzy>>>);   // π⁺
static_assert(std::same_as<InnerMarginal<Random, Random>, Distribution<Random>>);
static_assert(std::same_as<InnerMarginal<Fuzzy, Fuzzy>, Distribution<Fuzzy>>);  // (5)

const RandomVariable x{"x", 3};

const FuzzyVariable y{"y", 2};
const Relation x_given_y{x, y, {{0.6, 0.3, 0.1}, {0.1, 0.3, 0.6}}};
const Distribution y_prior{y, {1.0, 0.5}};

TEST(HybridDistribution, IsWrittenAsNumbersThatItsOwnOrderNormalizes) {
  const HybridDistribution joint{y, x, {{0.6, 0.3, 0.1}, {0.05, 0.15, 0.3}}};
  static_assert(std::same_as<decltype(joint), const HybridDistribution<Fuzzy, Random>>);
  EXPECT_EQ(joint(1, 2), 0.3);
  EXPECT_CLOSE(joint.beta(), 1.2, 1e-15);
  // The same numbers in the other order are β, not one.
  EXPECT_INVALID(("sum over 'x' of the maximum of 'y'", "1.2, not 1"),
                 HybridDistribution{x, y, {{0.6, 0.05}, {0.3, 0.15}, {0.1, 0.3}}});
}

TEST(HybridDistribution, RefusesRowsThatAreNoJointByVariableRowAndValue) {
  EXPECT_INVALID(("'y'", "'x'", "2 rows", "1"), HybridDistribution{y, x, {{0.6, 0.3, 0.1}}});
  EXPECT_INVALID(("'x' given y = '1'", "3", "2"), HybridDistribution{y, x, {{0.6, 0.3, 0.1}, {0.5, 0.5}}});
  EXPECT_INVALID(("'x' given y = '1'", "'1'", "-0.5"), HybridDistribution{y, x, {{0.6, 0.3, 0.1}, {0.5, -0.5, 0.0}}});
  EXPECT_INVALID(("maximum over 'y' of the sum of 'x'", "0.9, not 1"),
                 HybridDistribution{y, x, {{0.6, 0.3, 0.0}, {0.2, 0.0, 0.0}}});
}

TEST(HybridDistribution, RefusesFactorsThatDoNotMeet) {
  const FuzzyVariable mood{"mood", 2};
  EXPECT_INVALID(("HybridDistribution", "'y'", "'mood'"), HybridDistribution{x_given_y, uninformative(mood)});
  const Relation mood_given_x{mood, x, {{1.0, 1.0}, {1.0, 0.5}, {0.5, 1.0}}};
  // Same outcomes, but these two are of no one joint: max_mood Σ_x is 0.6 + 0.3 + 0.15.
  EXPECT_INVALID(("maximum over 'mood' of the sum of 'x'", "1.05, not 1"),
                 HybridDistribution{mood_given_x, HybridDistribution{x_given_y, y_prior}.inner_marginal()});
}

TEST(HybridDistribution, TakesFactorsThatAreRoundedWithinTheirToleranceAndTheirReexpansion) {
  const RandomVariable third{"third", 3};
  const double rounded = 0.3333333336;  // sums to 1 + 8e-10
  const HybridDistribution joint{Relation{third, y, {{rounded, rounded, rounded}, {1.0, 0.0, 0.0}}},
                                 Distribution{y, {1.0 + 9e-10, 0.5}}};
  const HybridDistribution again{joint.outer_given_inner().relation, joint.inner_marginal()};
  EXPECT_CLOSE(again.table().values(), joint.table().values(), 1e-15);
}

TEST(HybridDistribution, ListsOutcomesWithoutMassAndSaysNothingAboutThem) {
  const HybridDistribution joint{y, x, {{0.5, 0.5, 0.0}, {0.0, 0.0, 0.0}}};
  const auto forward = joint.inner_given_outer();
  EXPECT_EQ(forward.unreachable, (std::vector<std::size_t>{1}));
  EXPECT_CLOSE(forward.relation.row(1), (std::vector{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}), 1e-15);
  const auto backward = joint.outer_given_inner();
  EXPECT_EQ(backward.unreachable, (std::vector<std::size_t>{2}));
  EXPECT_CLOSE(backward.relation.table().values(), (std::vector{1.0, 0.0, 1.0, 0.0, 1.0, 1.0}), 0.0);
}

TEST(HybridDistribution, ConditionsSubnormalMassExactly) {
  const HybridDistribution joint{y, x, {{1.0, 0.0, 0.0}, {0.0, least_subnormal, 3 * least_subnormal}}};
  EXPECT_CLOSE(joint.inner_given_outer().relation.row(1), (std::vector{0.0, 0.25, 0.75}), 0.0);
  EXPECT_TRUE(joint.outer_given_inner().unreachable.empty());
}
}  // namespace hybrid_distribution_test
