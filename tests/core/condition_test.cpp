#include "support/core.hpp"

namespace condition_test {

template <Algebra A>
std::vector<double> conditioned(std::vector<double> joint) {
  condition<A>(joint);
  return joint;
}

TEST(Condition, DividesByTheSumOrTheMaximumWhatScales) {
  EXPECT_CLOSE(conditioned<Sigma>({0.25, 0.5, 0.0, 0.25}), (std::vector{0.25, 0.5, 0.0, 0.25}), 0.0);
  EXPECT_CLOSE(conditioned<Sigma>({1.0, 3.0}), (std::vector{0.25, 0.75}), 1e-15);
  EXPECT_CLOSE(conditioned<Max>({0.25, 0.5}), (std::vector{0.5, 1.0}), 0.0);
}

TEST(Condition, IsAResiduumWhereMinCombines) {
  EXPECT_CLOSE(conditioned<MaxMin>({0.25, 0.5, 0.5, 0.0}), (std::vector{0.25, 1.0, 1.0, 0.0}), 0.0);
}

TEST(Condition, NeitherOverflowsNorLosesALoneNumber) {
  const double huge = std::numeric_limits<double>::max();
  EXPECT_CLOSE(conditioned<Sigma>({huge, huge}), (std::vector{0.5, 0.5}), 0.0);
  EXPECT_CLOSE(conditioned<Sigma>({0.0, least_subnormal}), (std::vector{0.0, 1.0}), 0.0);
  EXPECT_CLOSE(conditioned<Max>({2 * least_subnormal, least_subnormal}), (std::vector{1.0, 0.5}), 0.0);
  EXPECT_CLOSE(conditioned<MaxMin>({least_subnormal, 0.0}), (std::vector{1.0, 0.0}), 0.0);
}

TEST(EqualShare, IsWhatEqualNumbersAreConditionedTo) {
  EXPECT_EQ(equal_share<Sigma>(4), 0.25);
  EXPECT_EQ(equal_share<Max>(4), 1.0);
  EXPECT_EQ(equal_share<MaxMin>(4), 1.0);
}

}  // namespace condition_test
