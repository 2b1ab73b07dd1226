// How a target starts: from one position or several plots, and what waits meanwhile.
#include <gtest/gtest.h>

#include <sigmax/estimation/any_sensor.hpp>
#include <sigmax/estimation/start.hpp>
#include <sigmax/hybrid/target.hpp>

#include "hybrid/laws.hpp"

namespace sigmax {
namespace {

using namespace support;

using Plots = std::span<const Plot<PositionSensor<2>>>;
using Starts = std::vector<State>;

Gaussian<2> at(double x, double y) { return {Vector<2>(x, y), 100.0 * SquareMatrix<2>::Identity()}; }

/// Each model from as many points as it needs; of the last three that have a measurement.
std::optional<StartAt<Starts>> start_from_three(Plots waiting, std::size_t /*starts*/) {
  std::vector<TimedMeasurement<2>> points;
  for (const auto& plot : waiting)
    if (plot.seen) points.push_back({plot.time, plot.seen->z});
  if (points.size() < 3) return std::nullopt;
  const auto* last = points.data() + points.size() - 3;
  const auto narrow = two_point_start(last[1], last[2]);
  const auto wide = three_point_start(last[0], last[1], last[2]);
  const State calmly{narrow.mean, narrow.covariance};
  return StartAt<Starts>{last[2].time, {calmly, calmly, {wide.mean, wide.covariance}}};
}

template <class Order, Uncertainty Kind>
auto waiting_target(const TargetRules& rules) {
  return Target{vector_filter<Order, Kind>(), start_from_three, rules};
}

/// The filter as it stands after a start from three points.
template <class Order, Uncertainty Kind>
Filter<Order, Kind> started(const std::array<Plot<PositionSensor<2>>, 3>& plots) {
  auto filter = vector_filter<Order, Kind>();
  filter.restart(start_from_three(plots, 0)->estimates);
  return filter;
}

template <class Order, Uncertainty Kind>
void starts_from_three_points() {
  auto target = waiting_target<Order, Kind>({});
  std::vector<std::pair<double, bool>> told;
  const auto take = [&](const Plot<PositionSensor<2>>& plot) {
    return target.take(plot, [&](const auto& each, bool is_start) {
      told.push_back({each.time, is_start});
      EXPECT_TRUE(target.running());
    });
  };
  EXPECT_FALSE(target.running());
  EXPECT_EQ(take({1.0, at(0, 0)}), Verdict::waiting);
  EXPECT_EQ(take(Plot<PositionSensor<2>>(2.0)), Verdict::waiting) << "there was none";
  EXPECT_EQ(take({3.0, at(200, 0)}), Verdict::waiting);
  EXPECT_FALSE(target.running());
  EXPECT_EQ(target.starts(), 0U);
  EXPECT_TRUE(told.empty());
  EXPECT_EQ(take({4.0, at(310, 10)}), Verdict::started);
  EXPECT_EQ(target.time(), 4.0);
  EXPECT_EQ(target.accepted_time(), 4.0);
  EXPECT_EQ(target.starts(), 1U);
  auto expected = started<Order, Kind>({{{1.0, at(0, 0)}, {3.0, at(200, 0)}, {4.0, at(310, 10)}}});
  require_same<Order, Kind>(target.filter(), expected);
  EXPECT_EQ(take({5.0, at(400, 0)}), Verdict::accepted);
  expected.step(1.0, at(400, 0), chi_square_quantile(0.9999, 2));
  require_same<Order, Kind>(target.filter(), expected);
  EXPECT_EQ(told, (std::vector<std::pair<double, bool>>{{4.0, true}, {5.0, false}}));
}

TEST(TargetStart, SeveralPointsWaitUntilTheyAreEnough) {
  starts_from_three_points<Interacting, Random>();
  starts_from_three_points<SecondOrder, Fuzzy>();
}

template <class Order, Uncertainty Kind>
void starts_again_from_what_it_rejected() {
  auto target = waiting_target<Order, Kind>({0.999, 3});
  for (int k = 0; k < 3; ++k) target.take(k, at(100.0 * k, 0.0));
  ASSERT_TRUE(target.running());
  EXPECT_EQ(target.take(3.0, at(50e3, 0)), Verdict::rejected);
  EXPECT_EQ(target.take(4.0), Verdict::missed);
  EXPECT_EQ(target.take(5.0, at(50.4e3, 0)), Verdict::rejected);
  EXPECT_EQ(target.take(6.0, at(50.6e3, 0)), Verdict::restarted);
  EXPECT_EQ(target.starts(), 2U);
  EXPECT_EQ(target.rejected(), 3U);
  require_same<Order, Kind>(target.filter(),
                            started<Order, Kind>({{{3.0, at(50e3, 0)}, {5.0, at(50.4e3, 0)}, {6.0, at(50.6e3, 0)}}}));
  EXPECT_EQ(target.take(7.0, at(50.8e3, 0)), Verdict::accepted);
}

TEST(TargetStart, APolicyThatWantsSeveralIsAskedWithThoseThatWereRejected) {
  starts_again_from_what_it_rejected<Interacting, Random>();
  starts_again_from_what_it_rejected<SecondOrder, Fuzzy>();
}

TEST(TargetStart, WhereTwoRejectionsAreTooFewForAStartItWaitsForTheThird) {
  auto target = waiting_target<Interacting, Random>({0.999, 2});
  for (int k = 0; k < 3; ++k) target.take(k, at(100.0 * k, 0.0));
  EXPECT_EQ(target.take(3.0, at(50e3, 0)), Verdict::rejected);
  EXPECT_EQ(target.take(4.0, at(50.2e3, 0)), Verdict::waiting);
  EXPECT_FALSE(target.running());
  EXPECT_EQ(target.take(5.0, at(50.4e3, 0)), Verdict::restarted);
}

TEST(TargetStart, AfterAGapItWaitsAnew) {
  auto target = waiting_target<Interacting, Random>({0.999, 3, 5.0});
  for (int k = 0; k < 3; ++k) target.take(k, at(100.0 * k, 0.0));
  EXPECT_EQ(target.take(3.0, at(50e3, 0)), Verdict::rejected);
  EXPECT_EQ(target.take(8.0, at(200, 0)), Verdict::waiting);
  EXPECT_EQ(target.take(9.0, at(300, 0)), Verdict::waiting);
  EXPECT_EQ(target.take(10.0, at(400, 0)), Verdict::restarted) << "the rejected one before the gap is forgotten";
}

TEST(TargetStart, WhereThereIsNoRoomAMissGoesFirstAndThenTheOldest) {
  std::vector<std::vector<double>> asked;
  const auto never = [&](Plots waiting, std::size_t) -> std::optional<StartAt<Starts>> {
    asked.emplace_back();
    for (const auto& plot : waiting) asked.back().push_back(plot.time);
    return std::nullopt;
  };
  TargetRules rules;
  rules.waiting = 3;
  Target target{vector_filter<Interacting, Random>(), never, rules};
  target.take(1.0, at(0, 0));
  target.take(2.0);
  target.take(3.0, at(0, 0));
  target.take(4.0, at(0, 0));
  target.take(5.0, at(0, 0));
  EXPECT_EQ(asked, (std::vector<std::vector<double>>{{1}, {1, 2}, {1, 2, 3}, {1, 3, 4}, {3, 4, 5}}));
}

TEST(TargetStart, PlotsThatWaitComeInTheOrderOfTheirTimes) {
  auto strict = waiting_target<Interacting, Random>({});
  strict.take(2.0, at(200, 0));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { strict.take(1.0, at(100, 0)); }, {"1.0", "2.0"}));

  TargetRules rules;
  rules.buffer = 3;
  auto target = waiting_target<Interacting, Random>(rules);
  auto in_order = target;
  EXPECT_EQ(target.take(2.0, at(200, 0)), Verdict::waiting);
  EXPECT_EQ(target.take(3.0, at(310, 0)), Verdict::waiting);
  target.take(1.0, at(100, 0));
  EXPECT_TRUE(target.running());
  for (const double t : {1.0, 2.0, 3.0}) in_order.take(t, at(t == 3.0 ? 310.0 : 100.0 * t, 0));
  require_same<Interacting, Random>(target.filter(), in_order.filter());
}

TEST(TargetStart, AGivenStartTakesThePlotsThatWaitedAsSteps) {
  const State given = starts()[2];
  std::vector<std::size_t> asked_after;
  const auto start = [&](Plots waiting, std::size_t starts) -> std::optional<StartAt<State>> {
    asked_after.push_back(starts);
    if (waiting.size() < 2) return std::nullopt;
    return StartAt<State>{waiting.front().time - 0.5, given, false};
  };
  Target target{vector_filter<Interacting, Random>(), start, TargetRules{1.0}};
  std::vector<std::pair<double, bool>> told;
  const auto tell = [&](const auto& plot, bool is_start) { told.push_back({plot.time, is_start}); };
  EXPECT_EQ(target.take({1.0, at(12000, 8000)}, tell), Verdict::waiting);
  EXPECT_EQ(target.take({2.0, at(11900, 7900)}, tell), Verdict::started);
  auto expected = vector_filter<Interacting, Random>();
  expected.restart(given);
  expected.step(0.5, at(12000, 8000));
  expected.step(1.0, at(11900, 7900));
  require_same<Interacting, Random>(target.filter(), expected);
  EXPECT_EQ(target.time(), 2.0);
  ASSERT_EQ(told.size(), 3U);
  EXPECT_TRUE(told[0].second);
  EXPECT_EQ(told[1], (std::pair{1.0, false}));
  EXPECT_EQ(told[2], (std::pair{2.0, false}));
  EXPECT_EQ(asked_after, (std::vector<std::size_t>{0, 0}));
}

using Any = AnySensor<PositionSensor<2>, PolarSensor<2>, BearingSensor>;
using Z = MeasurementOf<Any>;

State one_point_start(const Gaussian<2>& z) {
  State start{Vector<6>::Zero(), SquareMatrix<6>::Zero()};
  start.mean.head<2>() = z.mean;
  start.covariance.topLeftCorner<2, 2>() = z.covariance;
  start.covariance.diagonal().tail<4>() << 4e4, 4e4, 400.0, 400.0;
  return start;
}

TEST(TargetStart, OnePositionComesFromWhateverSensorTellsIt) {
  using Imm = Filter<Interacting, Random>;
  Target<Imm, decltype(&one_point_start), Any> target{vector_filter<Interacting, Random>(), &one_point_start};
  const PolarSensor<2> radar{Vector<2>(5000.0, 0.0)};
  const Gaussian<2> polar{Vector<2>(9000.0, 1.2), SquareMatrix<2>{{100.0, 0.0}, {0.0, 1e-6}}};
  EXPECT_EQ(target.take({1.0, Z{Vector<1>(0.3), SquareMatrix<1>(1e-6)}, BearingSensor{}}), Verdict::waiting)
      << "a bearing alone is nowhere";
  EXPECT_EQ(target.take({2.0, Z{polar.mean, polar.covariance}, radar}), Verdict::started);
  auto expected = vector_filter<Interacting, Random>();
  expected.restart(one_point_start(radar.position(polar)));
  require_same<Interacting, Random>(target.filter(), expected);
}

/// Of a bearing the gate is a quantile of χ² with one degree of freedom, of a radar with two.
TEST(TargetStart, AGateIsAsWideAsItsSensorAsks) {
  using Imm = Filter<Interacting, Random>;
  const BearingSensor camera{Vector<2>(0.0, 0.0)};
  const PolarSensor<2> radar;
  const TargetRules rules{0.9, 0};
  std::size_t taken = 0, rejected = 0, between = 0;
  for (double off = 0.0; off < 0.01; off += 0.0002) {
    const auto filter = vector_filter<Interacting, Random>();
    Target<Imm, decltype(&one_point_start), Any> target{filter, 0.0, &one_point_start, rules};
    const auto verdict_of = [&](const auto& z, const auto& sensor) {
      auto fresh = target;
      return fresh.take({0.2, Z{z.mean, z.covariance}, sensor});
    };
    const Vector<2> place(12000.0 - 20.0, 8000.0 - 20.0);
    const Gaussian<1> z1{Vector<1>(std::atan2(place(1), place(0)) + off), SquareMatrix<1>(1e-6)};
    const Gaussian<2> z2{Vector<2>(place.norm(), z1.mean(0)), SquareMatrix<2>{{100.0, 0.0}, {0.0, 1e-6}}};
    auto probe = filter;
    probe.step(0.2, z1, camera);
    const bool passes_1 = probe.gate_distance() <= 2.7055434540954;  // χ² quantiles of 0.9, from tables
    ASSERT_EQ(verdict_of(z1, camera), passes_1 ? Verdict::accepted : Verdict::rejected);
    if (!passes_1 && probe.gate_distance() <= 4.6051701859881) ++between;
    ++(passes_1 ? taken : rejected);
    probe = filter;
    probe.step(0.2, z2, radar);
    ASSERT_EQ(verdict_of(z2, radar), probe.gate_distance() <= 4.6051701859881 ? Verdict::accepted : Verdict::rejected);
  }
  EXPECT_GT(taken, 3U);
  EXPECT_GT(rejected, 3U);
  EXPECT_GT(between, 0U) << "the two gates should differ";
}

}  // namespace
}  // namespace sigmax
