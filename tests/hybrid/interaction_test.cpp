#include "support/sigmax.hpp"

namespace interaction_test {

/// The readings that docs/readings.md argues for.
TEST(Interaction, ByDefaultIsThatOfTheReadings) {
  const Interaction<Random> random;
  const Interaction<Fuzzy> fuzzy;
  EXPECT_EQ(random.augmentation, StateAugmentation::borrowed_variance);
  EXPECT_EQ(fuzzy.augmentation, StateAugmentation::borrowed_variance);
  EXPECT_EQ(random.collapse.mixing_weights, MixingWeights::correct);
  EXPECT_EQ(random.collapse.output_spread, OutputSpread::included);
  EXPECT_EQ(fuzzy.collapse.mixed_covariance, MixedCovariance::own_recentred);
  EXPECT_EQ(fuzzy.collapse.mixing_tie, Tie::stay);
  EXPECT_EQ(random.output_tie, Tie::stay);
  EXPECT_EQ(random.mixed_start, MixedStart::of_each_mode);
  EXPECT_EQ(fuzzy.likelihood, LikelihoodForm::density);
}

/// What docs/multiple_models.md says of the first step of GPB1.
TEST(Interaction, ACommonStartIsCollapsedBeforeTheFirstStepToo) {
  const RandomVariable mode{"mode", 2};
  const Relation<Random, Random> transition = {mode, mode, {{0.9, 0.1}, {0.1, 0.9}}};
  const Gaussian<3> start{Vector<3>::Zero(), Vector<3>{1.0, 4.0, 100.0}.asDiagonal()};
  const auto variance_after_no_time = [&](StateAugmentation augmentation, MixedStart mixed_start) {
    InteractingMultipleModel filter{std::tuple{dwna<1>(1e-6), dwpa<1>(1e-6)}, transition, start,
                                    Interaction<Random>{.augmentation = augmentation, .mixed_start = mixed_start}};
    filter.step(0.0);
    return filter.estimates()[1].covariance(2, 2);
  };
  EXPECT_NEAR(variance_after_no_time(StateAugmentation::zero, MixedStart::common), 50.0, 1e-9);
  EXPECT_NEAR(variance_after_no_time(StateAugmentation::borrowed_variance, MixedStart::common), 100.0, 1e-9);
  EXPECT_NEAR(variance_after_no_time(StateAugmentation::zero, MixedStart::of_each_mode), 90.0, 1e-9);
}

}  // namespace interaction_test
