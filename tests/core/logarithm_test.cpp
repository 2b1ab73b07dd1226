#include "support/core.hpp"

namespace logarithm_test {

template <ScalingAlgebra A>
double combined(const std::vector<double>& log_weights, const std::vector<double>& factors) {
  return detail::log_combine<A>(
      log_weights.size(), [&](std::size_t i) { return log_weights[i]; }, [&](std::size_t i) { return factors[i]; });
}

TEST(LogCombine, OfNothingIsNothing) {
  EXPECT_EQ(combined<Sigma>({}, {}), log_zero);
  EXPECT_EQ(combined<Sigma>({0.0, -1.0}, {0.0, 0.0}), log_zero);
  EXPECT_EQ(combined<Sigma>({log_zero, log_zero}, {1.0, 1.0}), log_zero);
  EXPECT_EQ(combined<Max>({log_zero, 0.0}, {1.0, 0.0}), log_zero);
}

TEST(LogCombine, IsScaledByTheGreatestWeightThatAPositiveFactorMeets) {
  // The greatest weight meets a zero; relative to it the others would underflow.
  EXPECT_CLOSE(combined<Sigma>({0.0, -2000.0, -2000.0}, {0.0, 0.5, 0.5}), -2000.0, 1e-14);
  EXPECT_CLOSE(combined<Max>({0.0, -2000.0, -2001.0}, {0.0, 1.0, 1.0}), -2000.0, 1e-14);
}

TEST(LogCombine, SurvivesHugeGapsWithoutNaN) {
  constexpr double lowest = std::numeric_limits<double>::lowest();
  EXPECT_EQ(combined<Sigma>({0.0, lowest}, {1.0, 1.0}), 0.0);
  EXPECT_EQ(combined<Max>({lowest, 0.0}, {1.0, 1.0}), 0.0);
  EXPECT_EQ(combined<Sigma>({lowest, log_zero}, {1.0, 1.0}), lowest);
  EXPECT_EQ(combined<Sigma>({1e300, -1e300, log_zero}, {1.0, 1.0, 1.0}), 1e300);
  EXPECT_CLOSE(combined<Sigma>({800.0, 800.0}, {1.0, 1.0}), 800.0 + std::log(2.0), 1e-14);
}

TEST(LogCombine, KeepsALoneSubnormalFactor) {
  EXPECT_CLOSE(combined<Sigma>({-5.0, 0.0}, {least_subnormal, 0.0}), std::log(least_subnormal) - 5.0, 1e-14);
  EXPECT_CLOSE(combined<Max>({-5.0, 0.0}, {least_subnormal, 0.0}), std::log(least_subnormal) - 5.0, 1e-14);
}

}  // namespace logarithm_test
