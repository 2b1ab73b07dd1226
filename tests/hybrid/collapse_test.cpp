#include "support/sigmax.hpp"

namespace collapse_test {

static_assert(std::is_same_v<Collapse<Random>, MomentMatching>);
static_assert(std::is_same_v<Collapse<Fuzzy>, Selection>);

std::size_t selected(const std::vector<double>& logs, std::size_t current, Tie tie) {
  return detail::select(
      logs.size(), [&](std::size_t i) { return logs[i]; }, current, tie);
}

TEST(Select, TheGreatestWeightWinsUnderEveryRule) {
  for (const Tie tie : {Tie::stay, Tie::first, Tie::last})
    for (const std::size_t current : {0U, 1U, 2U}) {
      EXPECT_EQ(selected({-1.0, 0.0, -2.0}, current, tie), 1U);
      EXPECT_EQ(selected({log_zero, -3.0, -1e300}, current, tie), 1U);
    }
}

TEST(Select, ATieIsBrokenAsTheRuleSays) {
  const std::vector<double> logs{-1.0, 0.0, 0.0, -5.0, 0.0};
  EXPECT_EQ(selected(logs, 2, Tie::first), 1U);
  EXPECT_EQ(selected(logs, 2, Tie::last), 4U);
  EXPECT_EQ(selected(logs, 2, Tie::stay), 2U);
  EXPECT_EQ(selected(logs, 3, Tie::stay), 1U) << "who is not among the winners cannot stay";
}

TEST(Select, WeightsWithinTheToleranceOfTheGreatestAreEqual) {
  EXPECT_EQ(selected({-0.9e-9, 0.0}, 0, Tie::stay), 0U);
  EXPECT_EQ(selected({-0.9e-9, 0.0}, 1, Tie::first), 0U);
  EXPECT_EQ(selected({0.0, -0.9e-9}, 0, Tie::last), 1U);
  EXPECT_EQ(selected({-1.1e-9, 0.0}, 0, Tie::stay), 1U);
  EXPECT_EQ(selected({-1.1e-9, 0.0}, 0, Tie::first), 1U);
  // Equality is with the greatest, not from neighbour to neighbour.
  EXPECT_EQ(selected({-1.6e-9, -0.8e-9, 0.0}, 0, Tie::stay), 1U);
}

}  // namespace collapse_test
