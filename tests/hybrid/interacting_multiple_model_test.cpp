#include "hybrid/banks.hpp"

namespace interacting_multiple_model_test {

/// The paper's own pair: equal σ_w and ε = ½, where a reset DWPA predicts what DWNA predicts, and so ties with it.
TEST(InteractingMultipleModel, TheExactTiesOfThePapersPairAreBrokenAsTheRestatementBreaksThem) {
  for (const Tie mixing : every_tie)
    for (const Tie output : every_tie) {
      TargetChoice choice =
          with(with(chosen(true), StateAugmentation::zero), {calm(3.0), turning(3.0)}, {{1.0, 0.5}, {0.5, 1.0}});
      choice.mixed_covariance = MixedCovariance::selected;
      choice.mixing_tie = mixing;
      choice.output_tie = output;
      AnyFilter filter(choice);
      auto expected = restated(choice, starts(choice));
      std::size_t tied = 0;
      for (const Scan& scan : manoeuvring_target(120)) {
        filter.step(scan);
        step(expected, scan);
        ASSERT_TRUE(agrees(filter, expected)) << name_of(choice);
        // DWPA next comes as likely from DWNA, at ½ · 1, as from itself, at 1 · ½.
        if (std::abs(filter.logs[0] - std::log(2.0) - filter.logs[1]) <= 1e-9) ++tied;
      }
      EXPECT_GT(tied, 20U);
    }
}

TEST(InteractingMultipleModel, OneStartServesAllModels) {
  const State start = starts()[2];
  const AnyFilter filter(chosen(true), start);
  EXPECT_EQ(filter.components, (std::vector<std::string>{"x", "y", "vx", "vy", "ax", "ay"}));
  EXPECT_EQ(filter.estimates[0].mean, start.mean.head(4));
  EXPECT_EQ(filter.estimates[0].covariance, start.covariance.topLeftCorner(4, 4));
  EXPECT_EQ(filter.estimates[2].mean, start.mean);
  EXPECT_EQ(filter.estimates[2].covariance, start.covariance);
  EXPECT_EQ(filter.winner, 0U);
  EXPECT_FALSE(filter.measured);
}

}  // namespace interacting_multiple_model_test
