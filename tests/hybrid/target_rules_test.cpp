#include "support/sigmax.hpp"

namespace target_rules_test {

TEST(TargetRules, ByDefaultATargetHasAGateAndIsFoundAgain) {
  const TargetRules rules;
  EXPECT_GT(rules.gate_probability, 0.99);
  EXPECT_LT(rules.gate_probability, 1.0);
  EXPECT_GT(rules.rejections, 0U);
  EXPECT_TRUE(std::isinf(rules.longest_gap));
  EXPECT_EQ(rules.buffer, 0U);
  EXPECT_FALSE(rules.record);
}

}  // namespace target_rules_test
