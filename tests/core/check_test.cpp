#include "support/core.hpp"

namespace check_test {

const RandomVariable weather{"weather", {"dry", "wet", "snow"}};
const FuzzyVariable mood{"mood", {"calm", "wild"}};

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

TEST(Check, RefusesWhatIsNoNumberBetweenZeroAndOne) {
  EXPECT_INVALID(("'weather'", "'wet'", "nan"),
                 prove_normalized<Random>(weather, {}, std::vector{0.5, not_a_number, 0.5}));
  EXPECT_INVALID(("'weather'", "'dry'", "1.5"), prove_normalized<Random>(weather, {}, std::vector{1.5, -0.5, 0.0}));
  EXPECT_INVALID(("'weather'", "'wet'", "-"),
                 prove_normalized<Random>(weather, {}, std::vector{1.0, -least_subnormal, 0.0}));
  EXPECT_INVALID(("'mood'", "'wild'", "inf", "between 0 and 1"),
                 prove_normalized<Fuzzy>(mood, {}, std::vector{1.0, infinity}));
}

}  // namespace check_test
