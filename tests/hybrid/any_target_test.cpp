#include <sigmax/hybrid/any_target.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::throws;

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

AnyPlot at(double time, double x, double y, std::size_t tag = 0, double sigma = 10.0) {
  const double variance = sigma * sigma;
  AnyPlot plot = AnyPlot::position(time, std::array{x, y, 100.0}, std::array{variance, variance, variance});
  plot.tag = tag;
  return plot;
}

/// Flies straight, then turns hard at so many m/s².
AnyPlot turning(double t, double acceleration) {
  const double turn = std::min(std::max(t - 40.0, 0.0), 15.0);
  return at(t, 100.0 * t, 0.5 * acceleration * turn * turn + acceleration * 15.0 * std::max(t - 55.0, 0.0),
            static_cast<std::size_t>(t));
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

TEST(AnyTarget, FollowsPlotsAndTellsWhatIsKnownAfterEach) {
  AnyTarget target{choice(false, Scheme::interacting)}, other = target;
  std::vector<AnyPlot> plots;
  for (int k = 0; k < 6; ++k) plots.push_back(at(k, 100.0 * k, 0.0, static_cast<std::size_t>(10 + k)));
  std::vector<std::size_t> tags;
  target.follow(plots, [&](const TargetPoint& point) {
    tags.push_back(point.tag);
    EXPECT_EQ(point.is_start, point.tag == 12);
    EXPECT_EQ(point.time, static_cast<double>(point.tag) - 10.0);
    EXPECT_NEAR(point.mean[0], 100.0 * point.time, 1e-6);
  });
  EXPECT_EQ(tags, (std::vector<std::size_t>{12, 13, 14, 15}));
  for (const AnyPlot& plot : plots) other.take(plot);
  EXPECT_EQ(target.output().mean, other.output().mean);
}

TEST(AnyTarget, ACopyGoesOnByItself) {
  AnyTarget target{choice(true, Scheme::interacting)};
  for (int k = 0; k < 4; ++k) target.take(at(k, 100.0 * k, 0.0), {});
  AnyTarget copy = target, other{choice(false, Scheme::interacting)};
  copy.take(at(4.0, 400.0, 50.0), {});
  EXPECT_EQ(target.time(), 3.0);
  EXPECT_EQ(copy.time(), 4.0);
  target.take(at(4.0, 400.0, 50.0), {});
  EXPECT_EQ(target.output().mean, copy.output().mean);
  other = copy;
  EXPECT_EQ(other.output().mean, copy.output().mean);
  EXPECT_EQ(other.starts(), 1U);
  EXPECT_EQ(other.rejected(), 0U);
  const double turn[] = {0, 1, 0, -1, 0, 0, 0, 0, 1}, shift[] = {0, 0, 7};
  EXPECT_TRUE(other.transform(turn, shift));
  EXPECT_NEAR(other.output().mean[0], copy.output().mean[1], 1e-9);
  EXPECT_NEAR(other.output().mean[1], -copy.output().mean[0], 1e-9);
  EXPECT_NEAR(other.output().mean[2], copy.output().mean[2] + 7.0, 1e-9);
  EXPECT_TRUE(throws<std::invalid_argument>([&] { other.transform(shift, shift); }, {"3 axes"}));
}

TEST(AnyTarget, AGivenStartWaitsForTheSecondPlotAndTakesBoth) {
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

TEST(AnyTarget, NoSchemeStarvesAtAHardTurnBehindAGate) {
  for (const double acceleration : {20.0, 40.0})
    for (const bool fuzzy : {false, true})
      for (const Scheme scheme : {Scheme::interacting, Scheme::second_order}) {
        TargetChoice gated = choice(fuzzy, scheme);
        gated.rules = {.gate_probability = 0.999, .rejections = 5};
        AnyTarget target{gated};
        for (int t = 0; t < 100; ++t) target.take(turning(t, acceleration));
        const TargetPoint last = target.output();
        const AnyPlot truth = turning(99.0, acceleration);
        EXPECT_LT(std::hypot(last.mean[0] - truth.z[0], last.mean[1] - truth.z[1]), 50.0)
            << acceleration << " m/s², fuzzy: " << fuzzy << ", rejected: " << target.rejected();
        if (acceleration == 20.0 && fuzzy) EXPECT_LE(target.rejected(), 5U);
      }
}

TEST(AnyTarget, TakesWhatSeveralSensorsSee) {
  AnyTarget target{choice(false, Scheme::interacting)};
  for (int k = 0; k < 5; ++k) target.take(at(k, 100.0 * k + 5000.0, 0.0));
  EXPECT_EQ(target.take(AnyPlot::components(5.0, std::array{2}, std::array{100.0}, std::array{1e-4})),
            Verdict::accepted);
  EXPECT_NEAR(target.output().covariance[2 * 9 + 2], 1e-4, 1e-6);
  const std::array doppler{5500.9, 0.0, 0.01818, 100.0};
  EXPECT_EQ(target.take(AnyPlot::doppler(5.0, doppler, std::array{1.0, 1e-6, 1e-6, 1.0})), Verdict::accepted)
      << "two sensors may see at one time";
  AnyPlot bearing = AnyPlot::bearing(6.0, 0.0, 1e-6);
  EXPECT_EQ(target.take(bearing), Verdict::accepted);
  bearing.size = 2;
  EXPECT_TRUE(throws<std::invalid_argument>([&] { target.take(bearing); }, {"2 measured quantities", "1"}));
}

TEST(AnyTarget, AMeasurementBeyondAllBoundsIsRejected) {
  for (const bool fuzzy : {false, true}) {
    TargetChoice gated = choice(fuzzy, Scheme::interacting);
    gated.rules = {.gate_probability = 0.999, .rejections = 0};
    AnyTarget target{gated};
    for (int k = 0; k < 5; ++k) target.take(at(k, 100.0 * k, 0.0));
    for (const double far : {1e155, 1.797e308}) {
      EXPECT_EQ(target.take(at(target.time() + 1.0, far, 0.0)), Verdict::rejected);
      EXPECT_TRUE(std::isfinite(target.output().mean[0]));
    }
  }
}

TEST(AnyTarget, ATurnedWorldGivesTheTurnedTrack) {
  for (const int axes : {2, 3}) {
    TargetChoice some = choice(true, Scheme::interacting, axes);
    some.motions = {{"dwna"}, {"ct"}};
    some.models = {"dwna", "ct"};
    some.rules.record = true;
    const auto shaped = [&](AnyPlot plot) {
      if (axes == 2) {
        plot.size = 2;
        plot.covariance = {100.0, 0.0, 0.0, 100.0};
      }
      return plot;
    };
    const auto turned = [&](AnyPlot plot) {  // x → −y + 7, y → x − 3
      const double x = plot.z[0];
      plot.z[0] = -plot.z[1] + 7.0;
      plot.z[1] = x - 3.0;
      return plot;
    };
    AnyTarget whole{some}, moved{some};
    for (int t = 0; t < 60; ++t) {
      whole.take(turned(shaped(turning(t, 2.0))));
      if (t == 30) {
        const std::vector<double> A2{0, -1, 1, 0}, A3{0, -1, 0, 1, 0, 0, 0, 0, 1};
        const std::vector<double> b2{7, -3}, b3{7, -3, 0};
        EXPECT_TRUE(axes == 2 ? moved.transform(A2, b2) : moved.transform(A3, b3));
      }
      moved.take(t < 30 ? shaped(turning(t, 2.0)) : turned(shaped(turning(t, 2.0))));
    }
    std::vector<TargetPoint> expected, found;
    whole.smoothed([&](const TargetPoint& point) { expected.push_back(point); });
    moved.smoothed([&](const TargetPoint& point) { found.push_back(point); });
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k)
      for (std::size_t i = 0; i < found[k].mean.size(); ++i)
        EXPECT_NEAR(found[k].mean[i], expected[k].mean[i], 1e-6 * std::max(1.0, std::abs(expected[k].mean[i])));
  }
}

TEST(AnyTarget, ACopyGoesItsOwnWay) {
  AnyTarget target{choice(false, Scheme::interacting)};
  for (int k = 0; k < 5; ++k) target.take(at(k, 100.0 * k, 0.0));
  AnyTarget copy = target;
  copy.take(at(5.0, 600.0, 0.0));
  EXPECT_EQ(target.time(), 4.0);
  EXPECT_EQ(copy.time(), 5.0);
}

TEST(AnyTarget, RefusesAChoiceThatMakesNoSense) {
  TargetChoice bad = choice(false, Scheme::interacting);
  bad.motions[1].name = "warp";
  EXPECT_TRUE(throws<std::invalid_argument>([&] { AnyTarget{bad}; }, {"warp"}));
  bad = choice(false, Scheme::interacting);
  for (const int axes : {0, 4}) {
    bad.axes = axes;
    EXPECT_TRUE(throws<std::invalid_argument>([&] { AnyTarget{bad}; }, {std::to_string(axes) + " axes"}));
  }
  bad = choice(false, Scheme::interacting);
  bad.models.pop_back();
  EXPECT_TRUE(throws<std::invalid_argument>([&] { AnyTarget{bad}; }, {"2 motions"}));
  bad = choice(false, Scheme::interacting);
  bad.start = StartRule::given;
  EXPECT_TRUE(throws<std::invalid_argument>([&] { AnyTarget{bad}; }, {"nine"}));
}

TEST(AnyTarget, AlongOneAxisThereIsNoTurnAndNoRadar) {
  for (const Scheme scheme : {Scheme::interacting, Scheme::second_order, Scheme::histories})
    for (const bool fuzzy : {false, true}) {
      AnyTarget target{choice(fuzzy, scheme, 1)};
      const auto on_line = [](double time, double x) {
        return AnyPlot::position(time, std::array{x}, std::array{100.0});
      };
      for (int k = 0; k < 6; ++k) target.take(on_line(k, 10.0 * k));
      EXPECT_EQ(target.components(), (std::vector<std::string>{"x", "vx", "ax"}));
      EXPECT_NEAR(target.output().mean[1], 10.0, 1e-9);
      EXPECT_EQ(target.take(AnyPlot::components(6.0, std::array{0, 1}, std::array{60.0, 10.0}, std::array{100.0, 1.0})),
                Verdict::accepted);
      AnyPlot range = on_line(7.0, 70.0);
      range.sensor = AnyPlot::Sensor::polar;
      EXPECT_TRUE(throws<std::invalid_argument>([&] { target.take(range); }, {"one axis", "plane"}));
    }
  TargetChoice turning = choice(false, Scheme::interacting, 1);
  turning.motions[1].name = "ct";
  EXPECT_TRUE(throws<std::invalid_argument>([&] { AnyTarget{turning}; }, {"ct", "one axis"}));
}

TEST(MotionChoice, KnowsItsMotions) {
  EXPECT_EQ(known_motions().size(), 9U);
  EXPECT_EQ(known_motion("singer")->derivatives, 3);
  EXPECT_TRUE(known_motion("singer")->has_parameter(MotionParameter::tau));
  EXPECT_FALSE(known_motion("dwna")->has_parameter(MotionParameter::tau));
  EXPECT_FALSE(known_motion("ct")->linear);
  EXPECT_EQ(known_motion("ct")->derivatives, 2);
  EXPECT_EQ(known_motion("ct")->least_axes, 2);
  EXPECT_EQ(known_motion("singer")->least_axes, 1);
  EXPECT_TRUE(known_motion("ct")->manoeuvres);
  EXPECT_EQ(known_motion("ou_position")->derivatives, 1);
  EXPECT_EQ(known_motion("warp"), nullptr);
  EXPECT_EQ(motion_parameters()[static_cast<std::size_t>(MotionParameter::tau)].key, "tau_s");
}

}  // namespace
}  // namespace sigmax
