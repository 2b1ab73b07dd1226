#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <sigmax/core/check.hpp>
#include <sigmax/core/variable.hpp>

#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::throws;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double subnormal = std::numeric_limits<double>::denorm_min();

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
  EXPECT_NO_THROW(prove_normalized<Random>(weather, {}, std::vector{subnormal, 0.0, 1.0}));
  EXPECT_NO_THROW(prove_normalized<Fuzzy>(mood, {}, std::vector{1.0, 1.0}));
  EXPECT_NO_THROW(prove_normalized<Fuzzy>(mood, {}, std::vector{-0.0, 1.0}));
}

TEST(Check, RefusesATotalThatIsNotOneByItsNameAndValue) {
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] {
        prove_normalized<Random>(weather, {}, std::vector{0.25, 0.25, 0.25});
      },
      {"sum", "'weather'", "0.75"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] {
        prove_normalized<Fuzzy>(mood, {}, std::vector{0.5, 0.875});
      },
      {"maximum", "'mood'", "0.875"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] {
        prove_normalized<Fuzzy>(mood, {}, std::vector{0.0, 0.0});
      },
      {"maximum", "'mood'", "is 0"}));
}

TEST(Check, NamesTheRowOfAConditionalTable) {
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] {
        prove_normalized<Fuzzy>(mood, {&age, 1}, std::vector{0.5, 0.75});
      },
      {"'mood'", "age", "'old'", "0.75"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] {
        prove_normalized<Fuzzy>(mood, {&age, 0}, std::vector{1.0});
      },
      {"'mood'", "age", "'young'", "2 outcomes", "1 values"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] {
        prove_normalized<Fuzzy>(mood, {&age, 1}, std::vector{1.0, -0.5});
      },
      {"'mood'", "age", "'old'", "'wild'", "-0.5"}));
}

TEST(Check, RefusesWhatIsNoNumberBetweenZeroAndOne) {
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] {
        prove_normalized<Random>(weather, {}, std::vector{0.5, nan, 0.5});
      },
      {"'weather'", "'wet'", "nan"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] {
        prove_normalized<Random>(weather, {}, std::vector{1.5, -0.5, 0.0});
      },
      {"'weather'", "'dry'", "1.5"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] {
        prove_normalized<Random>(weather, {}, std::vector{1.0, -subnormal, 0.0});
      },
      {"'weather'", "'wet'", "-"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] {
        prove_normalized<Fuzzy>(mood, {}, std::vector{1.0, infinity});
      },
      {"'mood'", "'wild'", "inf", "between 0 and 1"}));
}

TEST(Check, SaysWhichVariableWasExpectedWhereAndWhichWasFound) {
  EXPECT_NO_THROW(check::same(mood, mood, "compose"));
  EXPECT_TRUE(throws<std::invalid_argument>([] { check::same(mood, age, "compose"); }, {"compose", "'mood'", "'age'"}));
  EXPECT_TRUE(throws<std::invalid_argument>([] { check::same(mood, FuzzyVariable("mood", 3), "update"); },
                                            {"update", "'mood' with 2 outcomes", "'mood' with 3 outcomes"}));
}

}  // namespace
}  // namespace sigmax
