#include "support/sigmax.hpp"

namespace any_target_test {

TargetChoice choice(bool fuzzy, Scheme scheme, int axes = 3) {
  TargetChoice result;
  result.axes = axes;
  result.fuzzy = fuzzy;
  result.scheme = scheme;
  result.motions = {{"dwna"}, {"dwpa"}};
  result.models = {"dwna", "dwpa"};
  result.transition = fuzzy ? std::vector<std::vector<double>>{{1.0, 0.5}, {0.5, 1.0}}
                            : std::vector<std::vector<double>>{{0.95, 0.05}, {0.05, 0.95}};
  return result;
}

AnyDetection at(double time, double x, double y, std::size_t tag = 0, double sigma = 10.0) {
  const double variance = sigma * sigma;
  AnyDetection detection =
      AnyDetection::position(time, std::array{x, y, 100.0}, std::array{variance, variance, variance});
  detection.tag = tag;
  return detection;
}

/// Flies straight, then turns at 2 m/s².
AnyDetection turning(double t) {
  const double turn = std::clamp(t - 40.0, 0.0, 15.0);
  return at(t, 100.0 * t, turn * turn + 30.0 * std::max(t - 55.0, 0.0), static_cast<std::size_t>(t));
}

TEST(AnyTarget, StartsFromThreePointsAndTellsTheTagOfEveryStep) {
  AnyTarget target{choice(false, Scheme::interacting)};
  std::vector<std::size_t> steps, starts;
  const auto stepped = [&](std::size_t tag, bool is_start) { (is_start ? starts : steps).push_back(tag); };
  EXPECT_EQ(target.take(at(0.0, 0.0, 0.0, 10), stepped), Verdict::waiting);
  EXPECT_EQ(target.take(at(1.0, 100.0, 0.0, 11), stepped), Verdict::waiting);
  EXPECT_FALSE(target.running());
  EXPECT_EQ(target.take(at(2.0, 200.0, 0.0, 12), stepped), Verdict::started);
  EXPECT_EQ(target.take(at(3.0, 300.0, 0.0, 13), stepped), Verdict::accepted);
  EXPECT_EQ(target.take({.time = 4.0, .tag = 14}, stepped), Verdict::missed);
  EXPECT_EQ(starts, (std::vector<std::size_t>{12}));
  EXPECT_EQ(steps, (std::vector<std::size_t>{13, 14}));
  const TargetPoint point = target.output();
  EXPECT_EQ(target.components(), (std::vector<std::string>{"x", "y", "z", "vx", "vy", "vz", "ax", "ay", "az"}));
  EXPECT_NEAR(point.mean[0], 400.0, 1e-6);
  EXPECT_EQ(point.covariance.size(), 81U);
  EXPECT_FALSE(point.nis);
}

TEST(AnyTarget, FollowsDetectionsAndTellsWhatIsKnownAfterEach) {
  AnyTarget target{choice(false, Scheme::interacting)}, other = target;
  std::vector<AnyDetection> detections;
  for (int k = 0; k < 6; ++k) detections.push_back(at(k, 100.0 * k, 0.0, static_cast<std::size_t>(10 + k)));
  std::vector<std::size_t> tags;
  target.follow(detections, [&](const TargetPoint& point) {
    tags.push_back(point.tag);
    EXPECT_EQ(point.is_start, point.tag == 12);
    EXPECT_EQ(point.time, static_cast<double>(point.tag) - 10.0);
    EXPECT_NEAR(point.mean[0], 100.0 * point.time, 1e-6);
  });
  EXPECT_EQ(tags, (std::vector<std::size_t>{12, 13, 14, 15}));
  for (const AnyDetection& detection : detections) other.take(detection);
  EXPECT_EQ(target.output().mean, other.output().mean);
}

TEST(AnyTarget, CopiedGoesItsOwnWayAndMovedGoesOn) {
  for (const bool fuzzy : {false, true})
    for (const Scheme scheme : {Scheme::interacting, Scheme::second_order, Scheme::histories}) {
      AnyTarget target{choice(fuzzy, scheme)};
      for (int k = 0; k < 4; ++k) target.take(at(k, 100.0 * k, 0.0));
      AnyTarget copy = target, other{choice(!fuzzy, Scheme::interacting)};
      copy.take(at(4.0, 400.0, 50.0));
      EXPECT_EQ(target.time(), 3.0);
      EXPECT_EQ(copy.time(), 4.0);
      target.take(at(4.0, 400.0, 50.0));
      EXPECT_EQ(target.output().mean, copy.output().mean);
      other = copy;
      EXPECT_EQ(other.output().mean, copy.output().mean);
      EXPECT_EQ(other.starts(), 1U);
      EXPECT_EQ(other.rejected(), 0U);

      AnyTarget moved = std::move(copy);
      EXPECT_EQ(moved.output().log_score, target.output().log_score);
      other = std::move(moved);
      std::vector<std::size_t> told;
      for (const int k : {5, 6}) {
        target.take(at(k, 100.0 * k, 100.0));
        other.take(at(k, 100.0 * k, 100.0, static_cast<std::size_t>(k)),
                   [&](std::size_t tag, bool) { told.push_back(tag); });
        EXPECT_EQ(other.output().mean, target.output().mean);
        EXPECT_EQ(other.output().log_score, target.output().log_score);
      }
      EXPECT_EQ(told, (std::vector<std::size_t>{5, 6}));
    }
}

TEST(AnyTarget, AGivenStartWaitsForTheSecondDetectionAndTakesBoth) {
  TargetChoice given = choice(true, Scheme::interacting);
  given.start = StartRule::given;
  given.start_mean = {-100.0, 0, 100.0, 100.0, 0, 0, 0, 0, 0};
  given.start_covariance_diagonal = {100, 100, 100, 100, 100, 100, 1, 1, 1};
  AnyTarget target{given};
  std::vector<std::size_t> steps;
  const auto stepped = [&](std::size_t tag, bool is_start) {
    if (!is_start) steps.push_back(tag);
  };
  EXPECT_EQ(target.take(at(0.0, 0.0, 0.0, 1), stepped), Verdict::waiting);
  EXPECT_EQ(target.take(at(1.0, 100.0, 0.0, 2), stepped), Verdict::started);
  EXPECT_EQ(steps, (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(target.time(), 1.0);
}

TEST(AnyTarget, TakesWhatSeveralSensorsSee) {
  AnyTarget target{choice(false, Scheme::interacting)};
  for (int k = 0; k < 5; ++k) target.take(at(k, 100.0 * k + 5000.0, 0.0));
  EXPECT_EQ(target.take(AnyDetection::components(5.0, std::array{2}, std::array{100.0}, std::array{1e-4})),
            Verdict::accepted);
  EXPECT_NEAR(target.output().covariance[2 * 9 + 2], 1e-4, 1e-6);
  const std::array doppler{5500.9, 0.0, 0.01818, 100.0};
  EXPECT_EQ(target.take(AnyDetection::doppler(5.0, doppler, std::array{1.0, 1e-6, 1e-6, 1.0})), Verdict::accepted)
      << "two sensors may see at one time";
  AnyDetection bearing = AnyDetection::bearing(6.0, Angle{}, radians(1e-3));
  EXPECT_EQ(target.take(bearing), Verdict::accepted);
  bearing.size = 2;
  EXPECT_INVALID(("2 measured quantities", "1"), target.take(bearing));
}

/// Two stations see it at the same times; six bearings tell an acceleration too, four are enough without.
TEST(AnyTarget, StartsFromBearingsThatCross) {
  const std::array<std::array<double, 3>, 2> stations{{{0.0, 0.0, 0.0}, {5000.0, 0.0, 0.0}}};
  const auto seen = [&](int k, std::size_t by) {
    const double t = k, x = 1000.0 + 40.0 * t, y = 4000.0 - 10.0 * t;
    return AnyDetection::bearing(t, radians(std::atan2(y, x - stations[by][0])), radians(1e-3), stations[by]);
  };
  for (const bool accelerates : {false, true}) {
    TargetChoice two = choice(true, Scheme::interacting, 2);
    if (!accelerates) two.motions[1].name = "ct";
    AnyTarget crossed{two}, alone{two};
    const int enough = accelerates ? 3 : 2;
    for (int k = 0; k < 2 * enough; ++k) {
      EXPECT_EQ(crossed.take(seen(k / 2, k % 2 == 0 ? 0 : 1)), k + 1 < 2 * enough ? Verdict::waiting : Verdict::started)
          << k;
      EXPECT_EQ(alone.take(seen(k, 1)), Verdict::waiting);
    }
    const TargetPoint start = crossed.output();
    EXPECT_EQ(start.time, enough - 1.0);
    EXPECT_CLOSE(start.mean[0], 1000.0 + 40.0 * start.time, 1e-9);
    EXPECT_CLOSE(start.mean[1], 4000.0 - 10.0 * start.time, 1e-9);
    EXPECT_CLOSE(start.mean[2], 40.0, 1e-7);
    EXPECT_CLOSE(start.mean[3], -10.0, 1e-7);
    EXPECT_EQ(crossed.take(seen(enough, 0)), Verdict::accepted);
    for (int k = 2 * enough; k < 40; ++k) alone.take(seen(k, 1));
    EXPECT_FALSE(alone.running());
  }
}

TEST(AnyTarget, ATurnedWorldGivesTheTurnedTrack) {
  for (const int axes : {2, 3}) {
    TargetChoice some = choice(true, Scheme::interacting, axes);
    some.motions[1].name = "ct";
    some.rules.record = true;
    const auto seen = [&](int t, bool turned) {  // x → −y + 7, y → x − 3
      AnyDetection detection = turning(t);
      if (turned) detection.z = {-detection.z[1] + 7.0, detection.z[0] - 3.0, detection.z[2]};
      if (axes == 2) detection = AnyDetection::position(t, std::span(detection.z).first(2), std::array{100.0, 100.0});
      return detection;
    };
    const std::vector<double> b{7, -3, 0}, A = axes == 2
                                                   ? std::vector<double>{0, -1, 1, 0}
                                                   : std::vector<double>{0, -1, 0, 1, 0, 0, 0, 0, 1};  // row by row
    AnyTarget whole{some}, moved{some};
    for (int t = 0; t < 60; ++t) {
      whole.take(seen(t, true));
      if (t == 30) EXPECT_TRUE(moved.transform(A, std::span(b).first(static_cast<std::size_t>(axes))));
      moved.take(seen(t, t >= 30));
    }
    EXPECT_INVALID((std::to_string(axes) + " axes"), moved.transform(b, b));
    std::vector<TargetPoint> expected;
    whole.smoothed([&](const TargetPoint& point) { expected.push_back(point); });
    std::size_t k = 0;
    moved.smoothed([&](const TargetPoint& point) {
      ASSERT_LT(k, expected.size());
      EXPECT_CLOSE(point.mean, expected[k].mean, 1e-6);
      ++k;
    });
    EXPECT_EQ(k, expected.size());
  }
}

TEST(AnyTarget, RefusesAChoiceThatMakesNoSense) {
  const auto refuses = [](const auto& spoil, std::string_view word) {
    TargetChoice bad = choice(false, Scheme::interacting);
    spoil(bad);
    EXPECT_INVALID((word), AnyTarget{bad});
  };
  refuses([](TargetChoice& bad) { bad.motions[1].name = "warp"; }, "warp");
  refuses([](TargetChoice& bad) { bad.axes = 0; }, "0 axes");
  refuses([](TargetChoice& bad) { bad.axes = 4; }, "4 axes");
  refuses([](TargetChoice& bad) { bad.models.pop_back(); }, "2 motions");
  refuses([](TargetChoice& bad) { bad.motions.clear(); }, "0 motions");
  refuses([](TargetChoice& bad) { bad.start = StartRule::given; }, "nine");
}

TEST(AnyTarget, AlongOneAxisThereIsNoTurnAndNoRadar) {
  for (const Scheme scheme : {Scheme::interacting, Scheme::second_order, Scheme::histories})
    for (const bool fuzzy : {false, true}) {
      AnyTarget target{choice(fuzzy, scheme, 1)};
      const auto on_line = [](double time, double x) {
        return AnyDetection::position(time, std::array{x}, std::array{100.0});
      };
      for (int k = 0; k < 6; ++k) target.take(on_line(k, 10.0 * k));
      EXPECT_EQ(target.components(), (std::vector<std::string>{"x", "vx", "ax"}));
      EXPECT_NEAR(target.output().mean[1], 10.0, 1e-9);
      EXPECT_EQ(
          target.take(AnyDetection::components(6.0, std::array{0, 1}, std::array{60.0, 10.0}, std::array{100.0, 1.0})),
          Verdict::accepted);
      AnyDetection range = on_line(7.0, 70.0);
      range.sensor = AnyDetection::Sensor::polar;
      EXPECT_INVALID(("one axis", "plane"), target.take(range));
    }
  TargetChoice turning = choice(false, Scheme::interacting, 1);
  turning.motions[1].name = "ct";
  EXPECT_INVALID(("ct", "one axis"), AnyTarget{turning});
}

}  // namespace any_target_test
