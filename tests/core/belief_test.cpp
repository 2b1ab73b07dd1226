#include "support/core.hpp"

namespace belief_test {

const RandomVariable mode{"mode", {"straight", "turn", "climb"}};
const FuzzyVariable intent{"intent", {"friendly", "hostile"}};

static_assert(!std::convertible_to<Distribution<Random>, Belief<Random>>);

/// Assigns a list of log weights.
template <class Kind>
double assign(Belief<Kind>& belief, const std::vector<double>& log_weights) {
  return belief.assign([&](std::size_t i) { return log_weights[i]; });
}

TEST(Belief, OfADistributionIsThatDistribution) {
  const Belief belief{Distribution{mode, {0.5, 0.5, 0.0}}};
  EXPECT_EQ(belief.log(2), log_zero);
  EXPECT_CLOSE(belief[0], 0.5, 1e-15);
  EXPECT_CLOSE(belief.distribution().values(), (std::vector{0.5, 0.5, 0.0}), 1e-15);
}

TEST(Belief, IsNormalizedByWhateverItIsGivenAndReturnsTheLogarithmOfTheTotal) {
  Belief belief{uninformative(mode)};
  EXPECT_CLOSE(assign(belief, {std::log(1.0), std::log(2.0), std::log(5.0)}), std::log(8.0), 1e-15);
  EXPECT_CLOSE(belief.distribution().values(), (std::vector{0.125, 0.25, 0.625}), 1e-15);

  Belief possible{uninformative(intent)};
  EXPECT_CLOSE(assign(possible, {std::log(0.2), std::log(0.1)}), std::log(0.2), 1e-15);
  EXPECT_CLOSE(possible.distribution().values(), (std::vector{1.0, 0.5}), 1e-15);
}

TEST(Belief, IsNormalizedToRoundingHoweverFarTheWeightsAreFromZero) {
  for (const double far : {-1e15, -5e11, 5e11, 1e15}) {  // as of an outlier a million standard deviations away
    Belief belief{uninformative(mode)};
    EXPECT_CLOSE(assign(belief, {far, far, far - 8.0}), far + std::log(2.0 + std::exp(-8.0)), 1e-15);
    const double total_weight = 2.0 + std::exp(-8.0);
    EXPECT_CLOSE(belief.distribution().values(),
                 (std::vector{1.0 / total_weight, 1.0 / total_weight, std::exp(-8.0) / total_weight}), 1e-14);
  }
}

TEST(Belief, LosesNoOutcomeThatANumberWouldLose) {
  Belief belief{uninformative(mode)};
  assign(belief, {0.0, -5000.0, log_zero});
  EXPECT_EQ(belief.distribution()["turn"], 0.0);
  EXPECT_EQ(belief.log(1), -5000.0);
  EXPECT_EQ(belief.log(2), log_zero);
}

TEST(Belief, OfNothingLeftIsRefusedAndStaysAsItWas) {
  Belief belief{Distribution{mode, {0.5, 0.25, 0.25}}};
  EXPECT_REFUSED(std::domain_error, ("'mode'"), assign(belief, {log_zero, log_zero, log_zero}));
  EXPECT_CLOSE(belief.distribution().values(), (std::vector{0.5, 0.25, 0.25}), 1e-15);
}

TEST(Belief, IsMostLikelyWhereItsLogarithmIsGreatest) {
  Belief belief{uninformative(mode)};
  EXPECT_EQ(most_likely(belief), "straight");  // the first declared on a tie
  assign(belief, {-2000.0, -2000.0, -1999.0});
  EXPECT_EQ(most_likely(belief), "climb");
}

}  // namespace belief_test
