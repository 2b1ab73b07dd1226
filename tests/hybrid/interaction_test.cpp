#include <sigmax/hybrid/interaction.hpp>

#include <gtest/gtest.h>

namespace sigmax {
namespace {

/// The readings that docs/readings.md argues for.
TEST(Interaction, ByDefaultIsThatOfTheReadings) {
  const Interaction<Random> random;
  const Interaction<Fuzzy> fuzzy;
  EXPECT_EQ(random.lift, Lift::borrowed_variance);
  EXPECT_EQ(fuzzy.lift, Lift::borrowed_variance);
  EXPECT_EQ(random.collapse.mixing_weights, MixingWeights::correct);
  EXPECT_EQ(random.collapse.output_spread, OutputSpread::included);
  EXPECT_EQ(fuzzy.collapse.mixed_covariance, MixedCovariance::own_recentred);
  EXPECT_EQ(fuzzy.collapse.mixing_tie, Tie::stay);
  EXPECT_EQ(random.output_tie, Tie::stay);
  EXPECT_EQ(random.mixed_start, MixedStart::of_each_mode);
  EXPECT_EQ(fuzzy.likelihood, LikelihoodForm::density);
}

}  // namespace
}  // namespace sigmax
