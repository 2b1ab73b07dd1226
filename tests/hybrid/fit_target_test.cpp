#include "hybrid/two_speeds.hpp"

namespace fit_target_test {

TEST(LogScores, AreThoseOfTheTargetStepByStep) {
  const TargetChoice choice = two_speeds(true);
  Simulated target = simulate(choice, 5.0, 30, 1);
  believe(target.plots, 5.0);
  target.plots[10].sensor = AnyPlot::Sensor::none;
  const auto scores = log_scores(choice, target.plots);
  ASSERT_EQ(scores.size(), 30U);
  AnyTarget same(choice);
  for (const AnyPlot& plot : target.plots) {
    same.take(plot);
    const TargetPoint point = same.output();
    if (plot.tag < 3 || plot.tag == 10) {
      EXPECT_TRUE(std::isnan(scores[plot.tag])) << plot.tag;
      EXPECT_FALSE(point.log_score);
      continue;
    }
    EXPECT_EQ(scores[plot.tag], point.log_score);
    EXPECT_GE(*point.log_evidence, *point.log_score);  // the weights of a fuzzy mode sum to one or more
    double squares = 0.0;
    for (const double number : point.normalized_innovation) squares += number * number;
    EXPECT_CLOSE(squares, *point.nis, 1e-12);
  }
  target.plots[3].tag = 30;
  EXPECT_INVALID(("tag 30", "30"), log_scores(choice, target.plots));
}

TEST(LogScores, OfAMeasurementThatTheGateRejectedAreKnown) {
  TargetChoice choice = two_speeds(false);
  Simulated target = simulate(choice, 5.0, 12, 2);
  believe(target.plots, 5.0);
  target.plots[8].z[0] += 1e4;
  const double open = log_scores(choice, target.plots)[8];
  choice.rules.gate_probability = 0.999;
  EXPECT_EQ(log_scores(choice, target.plots)[8], open);
  EXPECT_LT(open, -100.0);
}

TEST(RobustLogScore, IsThatOfTheContaminatedDensityAndBounded) {
  for (const double own : {-3.0, -12.0, -30.0})
    EXPECT_CLOSE(robust_log_score(own, 0.02, -9.0), std::log(0.98 * std::exp(own) + 0.02 * std::exp(-9.0)), 1e-12);
  for (const double own : {-1e9, -infinity}) EXPECT_EQ(robust_log_score(own, 0.02, -9.0), std::log(0.02) - 9.0);
}

TEST(TransitionCounts, OfARandomModeAddUpTheSmoothedPairs) {
  const TargetChoice choice = two_speeds(false);
  Simulated target = simulate(choice, 5.0, 60, 3);
  believe(target.plots, 5.0);
  TargetChoice recorded = choice;
  recorded.rules.record = true;
  AnyTarget smoothed(recorded);
  for (const AnyPlot& plot : target.plots) smoothed.take(plot);
  std::map<std::size_t, std::vector<double>> weights;
  TransitionCounts counts(2, false);
  std::size_t steps = 0, last = 60;
  smoothed.smoothed([&](const TargetPoint& point) { weights[point.tag] = point.weights; }, {});
  smoothed.smoothed({}, [&](const ModePairs& pairs) {
    ASSERT_EQ(pairs.tag, --last);  // backwards
    ASSERT_EQ(pairs.is_last, pairs.tag == 59);
    for (std::size_t i = 0; i < 2; ++i) {  // the pairs' margins are the smoothed modes before and after
      EXPECT_CLOSE(std::exp(pairs.log_weights[2 * i]) + std::exp(pairs.log_weights[2 * i + 1]),
                   weights[pairs.tag - 1][i], 1e-9);
      EXPECT_CLOSE(std::exp(pairs.log_weights[i]) + std::exp(pairs.log_weights[2 + i]), weights[pairs.tag][i], 1e-9);
    }
    counts.add(pairs, pairs.tag != 30);
    ++steps;
  });
  ASSERT_EQ(steps, 57U);  // the start is of the third plot
  double sum = 0.0;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) sum += counts(i, j);
  EXPECT_CLOSE(sum, 56.0, 1e-9);
  TransitionCounts same(2, false);
  count_transitions(
      choice, target.plots, [](std::size_t tag) { return tag != 30; }, same);
  EXPECT_EQ(same(0, 1), counts(0, 1));
  const auto rows = counts.transition(choice.transition);
  EXPECT_CLOSE(rows[0][1], counts(0, 1) / (counts(0, 0) + counts(0, 1)), 1e-12);
  EXPECT_CLOSE(counts.sojourns({1.0, 1.0})[0], (counts(0, 0) + counts(0, 1)) / counts(0, 1), 1e-12);
}

/// Pairs of three steps, told backwards, whose best path is known by going through all of them.
TEST(TransitionCounts, OfAFuzzyModeCountTheBestPath) {
  const std::vector<std::array<double, 4>> steps = {                           // from the last: (i, j) at 2 i + j
                                                    {-1.0, -2.0, 0.0, -0.5},   // best end 0, which came from 1
                                                    {-3.0, 0.0, -1.0, -0.2},   // into 1 from 0
                                                    {-0.1, -4.0, 0.0, -2.0}};  // into 0 from 1
  TransitionCounts counts(2, true);
  for (std::size_t k = 0; k < 3; ++k)
    counts.add({.tag = 3 - k, .dt = 2.0, .is_last = k == 0, .log_weights = steps[k]}, k != 1);
  EXPECT_EQ(counts(1, 0), 2.0);
  EXPECT_EQ(counts(0, 1), 0.0);  // that step only leads the path on
  TransitionCounts twice(2, true);
  twice.add(counts);
  twice.add(counts);
  EXPECT_EQ(twice(1, 0), 4.0);
  const std::vector<std::vector<double>> otherwise = {{1.0, 0.7}, {0.3, 1.0}};
  EXPECT_EQ(twice.transition(otherwise)[0], otherwise[0]);
  EXPECT_EQ(twice.transition(otherwise)[1], (std::vector<double>{1.0, 0.5 / 4.5}));
  EXPECT_EQ(twice.sojourns({9.0, 9.0}), (std::vector<double>{9.0, 8.0 / 4.5}));
  EXPECT_INVALID(("0 weights", "4"), counts.add({.log_weights = {}}));
}

}  // namespace fit_target_test
