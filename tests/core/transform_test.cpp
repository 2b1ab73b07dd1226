#include "support/core.hpp"

namespace transform_test {

static_assert(PossibilityTransform<RatioScale> && ProbabilityTransform<RatioScale>);
static_assert(PossibilityTransform<DuboisPrade> && !ProbabilityTransform<DuboisPrade>);
static_assert(PossibilityTransform<DuboisPradeSandri> && ProbabilityTransform<DuboisPradeSandri>);

const RandomVariable weather{"weather", {"dry", "wet", "snow"}};

const Distribution forecast{weather, {0.5, 0.3, 0.2}};

TEST(AsFuzzy, KeepsNameAndOutcomes) {
  const FuzzyVariable fuzzy = as_fuzzy(weather);
  EXPECT_EQ(fuzzy.name(), "weather");
  EXPECT_EQ(fuzzy.label(2), "snow");
  EXPECT_EQ(fuzzy, (FuzzyVariable{"weather", {"dry", "wet", "snow"}}));
  EXPECT_EQ(as_random(fuzzy), weather);
  EXPECT_EQ(as_fuzzy(fuzzy), fuzzy);
}

TEST(AsFuzzy, OfAVariableWithoutLabelsHasNone) {
  EXPECT_EQ(as_fuzzy(RandomVariable("cell", 100000)), FuzzyVariable("cell", 100000));
}

TEST(RatioScale, RefusesAnExponentThatIsNotPositive) {
  for (const double exponent : {0.0, -1.0, infinity, not_a_number}) {
    EXPECT_INVALID(("RatioScale", "exponent", std::to_string(exponent)),
                   to_possibility(forecast, RatioScale{exponent}));
    EXPECT_THROW(to_probability(uninformative(as_fuzzy(weather)), RatioScale{exponent}), std::invalid_argument);
  }
}

TEST(RatioScale, OfALargeExponentDoesNotUnderflow) {
  const Distribution equal = to_possibility(uninformative(RandomVariable{"x", 4}), RatioScale{600.0});
  for (const double value : equal) EXPECT_EQ(value, 1.0);
  const Distribution p{RandomVariable{"x", 3}, {0.25, 0.5, 0.25}};
  const Distribution possible = to_possibility(p, RatioScale{600.0});
  EXPECT_EQ(possible[1], 1.0);
  EXPECT_EQ(possible[0], std::pow(0.5, 600.0));
  EXPECT_GT(possible[0], 0.0);
  EXPECT_CLOSE(to_probability(possible, RatioScale{600.0})[0], 0.25, 1e-12);
}

TEST(DuboisPrade, TakesWhatRoundingAlonePartsForATie) {
  const RandomVariable x{"x", 3};
  for (const std::vector<double>& p : {std::vector{0.1 + 0.2, 0.3, 0.4}, std::vector{0.3, 0.1 + 0.2, 0.4}}) {
    const Distribution possible = to_possibility(Distribution{x, p}, DuboisPrade{});
    EXPECT_CLOSE(possible[0], 0.6, 1e-12);
    EXPECT_EQ(possible[0], possible[1]);
    EXPECT_EQ(possible[2], 1.0);
  }
}

TEST(Transform, KeepsSubnormalProbabilitiesApart) {
  const Distribution rare{weather, {1.0, least_subnormal, 3 * least_subnormal}};
  EXPECT_CLOSE(to_possibility(rare, DuboisPrade{}).values(), (std::vector{1.0, least_subnormal, 4 * least_subnormal}),
               0.0);
  EXPECT_EQ(to_possibility(rare, DuboisPrade{})[2], 4 * least_subnormal);
  EXPECT_EQ(to_possibility(rare, RatioScale{})[1], least_subnormal);
  EXPECT_EQ(to_possibility(rare, DuboisPradeSandri{})[1], 3 * least_subnormal);
}

TEST(Transform, OfATransitionTakesItsConditionAlong) {  // (49) as (50)
  const RandomVariable mode{"mode", {"straight", "turn"}};
  const Relation transition{mode, mode, {{0.95, 0.05}, {0.05, 0.95}}};
  const Relation<Fuzzy, Fuzzy> possible = with_fuzzy_condition(to_possibility(transition, RatioScale{}));
  EXPECT_EQ(possible.to(), possible.from());
  EXPECT_CLOSE(possible.table().values(), (std::vector{1.0, 1.0 / 19.0, 1.0 / 19.0, 1.0}), 1e-15);
  const Relation<Random, Random> back = with_random_condition(to_probability(possible, RatioScale{}));
  EXPECT_EQ(back.from(), mode);
  EXPECT_CLOSE(back.table().values(), transition.table().values(), 1e-15);
}

/// A transform of one's own: only the most probable outcomes are possible.
struct Winners {
  std::vector<double> possibilities(std::span<const double> p) const {
    std::vector<double> result;
    for (const double value : p) result.push_back(value == *std::max_element(p.begin(), p.end()) ? 1.0 : 0.0);
    return result;
  }
};

TEST(Transform, MayBeOnesOwn) {
  EXPECT_CLOSE(to_possibility(forecast, Winners{}).values(), (std::vector{1.0, 0.0, 0.0}), 0.0);
}

}  // namespace transform_test
