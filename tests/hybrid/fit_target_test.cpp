#include "hybrid/two_speeds.hpp"

namespace fit_target_test {

TEST(LogScores, AreThoseOfTheTargetStepByStep) {
  const TargetChoice choice = two_speeds(true);
  Simulated target = simulate(choice, 5.0, 30, 1);
  believe(target.detections, 5.0);
  target.detections[10].sensor = AnyDetection::Sensor::none;
  const auto scores = log_scores(choice, target.detections);
  ASSERT_EQ(scores.size(), 30U);
  AnyTarget same(choice);
  for (const AnyDetection& detection : target.detections) {
    same.take(detection);
    const TargetPoint point = same.output();
    if (detection.tag < 3 || detection.tag == 10) {
      EXPECT_TRUE(std::isnan(scores[detection.tag])) << detection.tag;
      EXPECT_FALSE(point.log_score);
      continue;
    }
    EXPECT_EQ(scores[detection.tag], point.log_score);
    EXPECT_GE(*point.log_evidence, *point.log_score);  // the weights of a fuzzy mode sum to one or more
    double squares = 0.0;
    for (const double number : point.normalized_innovation) squares += number * number;
    EXPECT_CLOSE(squares, *point.nis, 1e-12);
  }
  target.detections[3].tag = 30;
  EXPECT_INVALID(("tag 30", "30"), log_scores(choice, target.detections));
}

TEST(LogScores, OfAMeasurementThatTheGateRejectedAreKnown) {
  TargetChoice choice = two_speeds(false);
  Simulated target = simulate(choice, 5.0, 12, 2);
  believe(target.detections, 5.0);
  target.detections[8].z[0] += 1e4;
  const double open = log_scores(choice, target.detections)[8];
  choice.rules.gate_probability = 0.999;
  EXPECT_EQ(log_scores(choice, target.detections)[8], open);
  EXPECT_LT(open, -100.0);
}

TEST(RobustLogScore, IsThatOfTheContaminatedDensityAndBounded) {
  for (const double own : {-3.0, -12.0, -30.0})
    EXPECT_CLOSE(robust_log_score(own, 0.02, -9.0), std::log(0.98 * std::exp(own) + 0.02 * std::exp(-9.0)), 1e-12);
  for (const double own : {-1e9, -infinity}) EXPECT_EQ(robust_log_score(own, 0.02, -9.0), std::log(0.02) - 9.0);
}

/// Pairs of three steps, told backwards, whose best path is known by going through all of them.
}  // namespace fit_target_test
