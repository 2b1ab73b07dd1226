#include "hybrid/banks.hpp"

namespace interacting_multiple_model_test {

/// The paper's own pair: equal σ_w and ε = ½, where a reset DWPA predicts what DWNA predicts, and so ties with it.
TEST(InteractingMultipleModel, TheExactTiesOfThePapersPairAreBrokenAsTheRestatementBreaksThem) {
  for (const Tie mixing : every_tie)
    for (const Tie output : every_tie) {
      TargetChoice choice = with(with(chosen(true), Lift::zero), {calm(3.0), turning(3.0)}, {{1.0, 0.5}, {0.5, 1.0}});
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

/// Each model restarts from one estimate of all, `one(filter)`, in every step in which `counts(filter)`.
template <class One, class Counts>
void restarts_from_one(const TargetChoice& choice, const One& one, const Counts& counts) {
  AnyFilter filter(choice, starts()[0]);
  for (const Scan& scan : manoeuvring_target()) {
    const State from = one(filter);
    AnyFilter probe = filter;
    probe.step(scan.dt);
    if (counts(filter))
      for (std::size_t j = 0; j < 3; ++j) {
        State expected;
        predict(model_of(choice.motions[j]), from, scan.dt, expected);
        ASSERT_CLOSE(probe.estimates[j].mean, expected.mean, 1e-12);
        ASSERT_CLOSE(probe.estimates[j].covariance, expected.covariance, 1e-9);
      }
    filter.step(scan);
  }
}

TEST(InteractingMultipleModel, Gpb1RestartsEveryModelFromTheOneCollapsedEstimate) {
  const TargetChoice gpb1 = chosen(false, Scheme::common_start);
  restarts_from_one(
      with(gpb1, {calm(1.0), calm(5.0), calm(20.0)}, gpb1.transition),
      [](const AnyFilter& filter) { return filter.estimate; }, [](const AnyFilter&) { return true; });
}

TEST(InteractingMultipleModel, AnAllOnesTransitionRestartsAllFromTheWinner) {
  TargetChoice choice = with(chosen(true), {calm(1.0), calm(5.0), calm(20.0)}, {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
  choice.mixed_covariance = MixedCovariance::selected;
  std::size_t winners = 0;  // as bits
  restarts_from_one(
      choice, [](const AnyFilter& filter) -> State { return filter.estimates[filter.winner]; },
      [&](const AnyFilter& filter) {  // with a tie, each of the tied ones stays with itself
        if (std::count_if(filter.logs.begin(), filter.logs.end(), [](double log) { return log > -1e-6; }) > 1)
          return false;
        winners |= std::size_t{1} << filter.winner;
        return true;
      });
  EXPECT_GT(std::popcount(winners), 1) << "not always the same model should win";
}

/// A step of no duration shows the mixed starts: nothing moves, and DWNA adds no noise.
TEST(InteractingMultipleModel, MixingPreservesTheMixturesFirstTwoMoments) {
  const TargetChoice imm = chosen(false);
  holds([&] {
    std::vector<Gaussian<4>> start;
    for (int j = 0; j < 3; ++j) start.push_back(generated_gaussian<4>());
    AnyFilter filter(with(imm, {calm(1.0), calm(2.0), calm(3.0)}, imm.transition), Estimates(start));
    for (int k = 0; k < 3; ++k) {
      const State before = filter.estimate;
      filter.step(0.0);
      require_near(filter.estimate.mean, before.mean, 1e-11);
      require_near(filter.estimate.covariance, before.covariance, 1e-11);
    }
  });
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
