#include <sigmax/core/check.hpp>
#include <sigmax/core/variable.hpp>

#include "support/test.hpp"

namespace {

const RandomVariable weather{"weather", {"dry", "wet", "snow"}};
const FuzzyVariable mood{"mood", {"calm", "wild"}};
const FuzzyVariable age{"age", {"young", "old"}};

TEST(Total, IsTheSumOfARandomAndTheMaximumOfAFuzzyVariable) {
  const std::vector<double> values{0.25, 0.5, 0.5, 0.0};
  EXPECT_EQ(total<Random>(values), 1.25);
  EXPECT_EQ(total<Fuzzy>(values), 0.5);
  EXPECT_EQ(total<Random>({}), 0.0);
  EXPECT_EQ(total<Fuzzy>({}), 0.0);
}

TEST(Check, AcceptsWhatIsNormalized) {
  EXPECT_NO_THROW(prove_normalized<Random>(weather, {}, std::vector{0.0, 0.25, 0.75}));
  EXPECT_NO_THROW(prove_normalized<Random>(weather, {}, std::vector{least_subnormal, 0.0, 1.0}));
  EXPECT_NO_THROW(prove_normalized<Fuzzy>(mood, {}, std::vector{1.0, 1.0}));
  EXPECT_NO_THROW(prove_normalized<Fuzzy>(mood, {}, std::vector{-0.0, 1.0}));
}

TEST(Check, RefusesATotalThatIsNotOneByItsNameAndValue) {
  EXPECT_INVALID(("sum", "'weather'", "0.75"), prove_normalized<Random>(weather, {}, std::vector{0.25, 0.25, 0.25}));
  EXPECT_INVALID(("maximum", "'mood'", "0.875"), prove_normalized<Fuzzy>(mood, {}, std::vector{0.5, 0.875}));
  EXPECT_INVALID(("maximum", "'mood'", "is 0"), prove_normalized<Fuzzy>(mood, {}, std::vector{0.0, 0.0}));
}

TEST(Check, NamesTheRowOfAConditionalTable) {
  EXPECT_INVALID(("'mood'", "age", "'old'", "0.75"), prove_normalized<Fuzzy>(mood, {&age, 1}, std::vector{0.5, 0.75}));
  EXPECT_INVALID(("'mood'", "age", "'young'", "2 outcomes", "1 values"),
                 prove_normalized<Fuzzy>(mood, {&age, 0}, std::vector{1.0}));
  EXPECT_INVALID(("'mood'", "age", "'old'", "'wild'", "-0.5"),
                 prove_normalized<Fuzzy>(mood, {&age, 1}, std::vector{1.0, -0.5}));
}

TEST(Check, RefusesWhatIsNoNumberBetweenZeroAndOne) {
  EXPECT_INVALID(("'weather'", "'wet'", "nan"),
                 prove_normalized<Random>(weather, {}, std::vector{0.5, not_a_number, 0.5}));
  EXPECT_INVALID(("'weather'", "'dry'", "1.5"), prove_normalized<Random>(weather, {}, std::vector{1.5, -0.5, 0.0}));
  EXPECT_INVALID(("'weather'", "'wet'", "-"),
                 prove_normalized<Random>(weather, {}, std::vector{1.0, -least_subnormal, 0.0}));
  EXPECT_INVALID(("'mood'", "'wild'", "inf", "between 0 and 1"),
                 prove_normalized<Fuzzy>(mood, {}, std::vector{1.0, infinity}));
}

TEST(Check, SaysWhichVariableWasExpectedWhereAndWhichWasFound) {
  EXPECT_NO_THROW(check::same(mood, mood, "compose"));
  EXPECT_INVALID(("compose", "'mood'", "'age'"), check::same(mood, age, "compose"));
  EXPECT_INVALID(("update", "'mood' with 2 outcomes", "'mood' with 3 outcomes"),
                 check::same(mood, FuzzyVariable("mood", 3), "update"));
}

}  // namespace
