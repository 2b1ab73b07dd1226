// How a target starts: from one position or several detections, and what waits meanwhile.

#include "hybrid/targets.hpp"

namespace target_start_test {

using Detections = std::span<const Detection>;
using Starts = std::vector<State>;

/// Each model from as many points as it needs; of the last three that have a measurement.
std::optional<StartAt<Starts>> start_from_three(Detections waiting, std::size_t /*starts*/) {
  std::vector<TimedMeasurement<2>> points;
  for (const Detection& detection : waiting)
    if (detection.seen()) points.push_back({detection.time, *detection.position<2>()});
  if (points.size() < 3) return std::nullopt;
  const auto* last = points.data() + points.size() - 3;
  const auto narrow = two_point_start(last[1], last[2]);
  const auto wide = three_point_start(last[0], last[1], last[2]);
  const State calmly{narrow.mean, narrow.covariance};
  return StartAt<Starts>{last[2].time, {calmly, calmly, {wide.mean, wide.covariance}}};
}

auto waiting_target(const TargetRules& rules) { return Target{imm(), start_from_three, rules}; }

/// A filter as it stands after a start from three points.
template <class Filter>
Filter started(Filter filter, const std::array<Detection, 3>& detections) {
  filter.restart(start_from_three(detections, 0)->estimates);
  return filter;
}

TEST(TargetStart, SeveralPointsWaitUntilTheyAreEnough) {
  with_every_filter([](const auto& filter) {
    Target target{filter, start_from_three};
    std::vector<std::pair<double, bool>> told;
    const auto take = [&](const Detection& detection) {
      return target.take(detection, [&](const Detection& each, bool is_start) {
        told.push_back({each.time, is_start});
        EXPECT_TRUE(target.running());
      });
    };
    EXPECT_FALSE(target.running());
    EXPECT_EQ(take({1.0, at(0, 0)}), Verdict::waiting);
    EXPECT_EQ(take(Detection(2.0)), Verdict::waiting) << "there was none";
    EXPECT_EQ(take({3.0, at(200, 0)}), Verdict::waiting);
    EXPECT_FALSE(target.running());
    EXPECT_EQ(target.starts(), 0U);
    EXPECT_TRUE(told.empty());
    EXPECT_EQ(take({4.0, at(310, 10)}), Verdict::started);
    EXPECT_EQ(target.time(), 4.0);
    EXPECT_EQ(target.accepted_time(), 4.0);
    EXPECT_EQ(target.starts(), 1U);
    auto expected =
        started(filter, {Detection(1.0, at(0, 0)), Detection(3.0, at(200, 0)), Detection(4.0, at(310, 10))});
    EXPECT_PRED_FORMAT2(same_filter, target.filter(), expected);
    EXPECT_EQ(take({5.0, at(400, 0)}), Verdict::accepted);
    expected.step(1.0, at(400, 0), PositionSensor<2>{});
    EXPECT_PRED_FORMAT2(same_filter, target.filter(), expected);
    EXPECT_EQ(told, (std::vector<std::pair<double, bool>>{{4.0, true}, {5.0, false}}));
  });
}

TEST(TargetStart, APolicyThatWantsSeveralIsAskedWithThoseThatWereRejected) {
  auto target = waiting_target({0.999, 3});
  for (int k = 0; k < 3; ++k) target.take(Detection(k, at(100.0 * k, 0.0)));
  ASSERT_TRUE(target.running());
  EXPECT_EQ(target.take(Detection(3.0, at(50e3, 0))), Verdict::rejected);
  EXPECT_EQ(target.take(4.0), Verdict::missed);
  EXPECT_EQ(target.take(Detection(5.0, at(50.4e3, 0))), Verdict::rejected);
  EXPECT_EQ(target.take(Detection(6.0, at(50.6e3, 0))), Verdict::restarted);
  EXPECT_EQ(target.starts(), 2U);
  EXPECT_EQ(target.rejected(), 3U);
  EXPECT_PRED_FORMAT2(
      same_filter, target.filter(),
      started(imm(), {Detection(3.0, at(50e3, 0)), Detection(5.0, at(50.4e3, 0)), Detection(6.0, at(50.6e3, 0))}));
  EXPECT_EQ(target.take(Detection(7.0, at(50.8e3, 0))), Verdict::accepted);
}

TEST(TargetStart, WhereTwoRejectionsAreTooFewForAStartItWaitsForTheThird) {
  auto target = waiting_target({0.999, 2});
  for (int k = 0; k < 3; ++k) target.take(Detection(k, at(100.0 * k, 0.0)));
  EXPECT_EQ(target.take(Detection(3.0, at(50e3, 0))), Verdict::rejected);
  EXPECT_EQ(target.take(Detection(4.0, at(50.2e3, 0))), Verdict::waiting);
  EXPECT_FALSE(target.running());
  EXPECT_EQ(target.take(Detection(5.0, at(50.4e3, 0))), Verdict::restarted);
}

TEST(TargetStart, AfterAGapItWaitsAnew) {
  auto target = waiting_target({0.999, 3, 5.0});
  for (int k = 0; k < 3; ++k) target.take(Detection(k, at(100.0 * k, 0.0)));
  EXPECT_EQ(target.take(Detection(3.0, at(50e3, 0))), Verdict::rejected);
  EXPECT_EQ(target.take(Detection(8.0, at(200, 0))), Verdict::waiting);
  EXPECT_EQ(target.take(Detection(9.0, at(300, 0))), Verdict::waiting);
  EXPECT_EQ(target.take(Detection(10.0, at(400, 0))), Verdict::restarted)
      << "the rejected one before the gap is forgotten";
}

TEST(TargetStart, WhereThereIsNoRoomAMissGoesFirstAndThenTheOldest) {
  std::vector<std::vector<double>> asked;
  const auto never = [&](Detections waiting, std::size_t) -> std::optional<StartAt<Starts>> {
    asked.emplace_back();
    for (const Detection& detection : waiting) asked.back().push_back(detection.time);
    return std::nullopt;
  };
  TargetRules rules;
  rules.waiting = 3;
  Target target{imm(), never, rules};
  for (const Detection& detection : {Detection(1.0, near_by), Detection(2.0), Detection(3.0, near_by),
                                     Detection(4.0, near_by), Detection(5.0, near_by)})
    target.take(detection);
  EXPECT_EQ(asked, (std::vector<std::vector<double>>{{1}, {1, 2}, {1, 2, 3}, {1, 3, 4}, {3, 4, 5}}));
}

TEST(TargetStart, DetectionsThatWaitComeInTheOrderOfTheirTimes) {
  auto strict = waiting_target({});
  strict.take(Detection(2.0, at(200, 0)));
  EXPECT_INVALID(("1.0", "2.0"), strict.take(Detection(1.0, at(100, 0))));

  TargetRules rules;
  rules.buffer = 3;
  auto target = waiting_target(rules), in_order = target;
  const std::vector all{Detection(1.0, at(100, 0)), Detection(2.0, at(200, 0)), Detection(3.0, at(310, 0))};
  EXPECT_EQ(target.take(all[1]), Verdict::waiting);
  EXPECT_EQ(target.take(all[2]), Verdict::waiting);
  target.take(all[0]);
  EXPECT_TRUE(target.running());
  for (const Detection& detection : all) in_order.take(detection);
  EXPECT_PRED_FORMAT2(same_filter, target.filter(), in_order.filter());
}

TEST(TargetStart, AGivenStartTakesTheDetectionsThatWaitedAsSteps) {
  const State given = starts()[2];
  std::vector<std::size_t> asked_after;
  const auto start = [&](Detections waiting, std::size_t starts) -> std::optional<StartAt<State>> {
    asked_after.push_back(starts);
    if (waiting.size() < 2) return std::nullopt;
    return StartAt<State>{waiting.front().time - 0.5, given, false};
  };
  Target target{imm(), start, TargetRules{1.0}};
  std::vector<std::pair<double, bool>> told;
  const auto tell = [&](const Detection& detection, bool is_start) { told.push_back({detection.time, is_start}); };
  EXPECT_EQ(target.take({1.0, at(12000, 8000)}, tell), Verdict::waiting);
  EXPECT_EQ(target.take({2.0, at(11900, 7900)}, tell), Verdict::started);
  auto expected = imm();
  expected.restart(given);
  expected.step(0.5, at(12000, 8000), PositionSensor<2>{});
  expected.step(1.0, at(11900, 7900), PositionSensor<2>{});
  EXPECT_PRED_FORMAT2(same_filter, target.filter(), expected);
  EXPECT_EQ(target.time(), 2.0);
  ASSERT_EQ(told.size(), 3U);
  EXPECT_TRUE(told[0].second);
  EXPECT_EQ(told[1], (std::pair{1.0, false}));
  EXPECT_EQ(told[2], (std::pair{2.0, false}));
  EXPECT_EQ(asked_after, (std::vector<std::size_t>{0, 0}));
}

TEST(TargetStart, OnePositionComesFromWhateverSensorTellsIt) {
  Target target{imm(), one_point_start};
  const PolarSensor<2> radar{Vector<2>(5000.0, 0.0)};
  const Gaussian<2> polar{Vector<2>(9000.0, 1.2), SquareMatrix<2>{{100.0, 0.0}, {0.0, 1e-6}}};
  EXPECT_EQ(target.take({1.0, {Vector<1>(0.3), SquareMatrix<1>(1e-6)}, BearingSensor{}}), Verdict::waiting)
      << "a bearing alone is nowhere";
  EXPECT_EQ(target.take({2.0, polar, radar}), Verdict::started);
  auto expected = imm();
  const auto position = radar.position(polar);
  expected.restart(one_point_start({position.mean, position.covariance}));
  EXPECT_PRED_FORMAT2(same_filter, target.filter(), expected);
}

/// Of a bearing the gate is a quantile of χ² with one degree of freedom, of a radar with two.
TEST(TargetStart, AGateIsAsWideAsItsSensorAsks) {
  const Target target{imm(), 0.0, one_point_start, TargetRules{0.9, 0}};
  std::size_t taken = 0, rejected = 0, between = 0;
  for (double off = 0.0; off < 0.01; off += 0.0002) {
    const auto distance = [&](const auto& z, const auto& sensor, double quantile) {
      auto filter = imm();
      filter.step(0.2, z, sensor);
      auto fresh = target;
      EXPECT_EQ(fresh.take({0.2, z, sensor}),
                filter.gate_distance() <= quantile ? Verdict::accepted : Verdict::rejected);
      return filter.gate_distance();
    };
    const Vector<2> place(12000.0 - 20.0, 8000.0 - 20.0);
    const Gaussian<1> z1{Vector<1>(std::atan2(place(1), place(0)) + off), SquareMatrix<1>(1e-6)};
    const Gaussian<2> z2{Vector<2>(place.norm(), z1.mean(0)), SquareMatrix<2>{{100.0, 0.0}, {0.0, 1e-6}}};
    const double one = 2.7055434540954, two = 4.6051701859881;  // χ² quantiles of 0.9, from tables
    const double found = distance(z1, BearingSensor{}, one);
    distance(z2, PolarSensor<2>{}, two);
    ++(found <= one ? taken : rejected);
    if (found > one && found <= two) ++between;
  }
  EXPECT_GT(taken, 3U);
  EXPECT_GT(rejected, 3U);
  EXPECT_GT(between, 0U) << "the two gates should differ";
}

}  // namespace target_start_test
