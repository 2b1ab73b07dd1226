#include <sigmax/hybrid/target.hpp>

#include <gtest/gtest.h>

#include <algorithm>

#include "hybrid/laws.hpp"

namespace sigmax {
namespace {

using namespace support;

/// Position as measured, at rest within 200 m/s and 20 m/s².
State one_point_start(const Gaussian<2>& z) {
  State start{Vector<6>::Zero(), SquareMatrix<6>::Zero()};
  start.mean.head<2>() = z.mean;
  start.covariance.topLeftCorner<2, 2>() = z.covariance;
  start.covariance.diagonal().tail<4>() << 4e4, 4e4, 400.0, 400.0;
  return start;
}

struct Event {
  double time;
  std::optional<Gaussian<2>> z;
};

/// The manoeuvring target at absolute times, no two alike; one measurement in ten is of something else.
std::vector<Event> events(std::size_t count) {
  std::vector<Event> result;
  double time = 0.0;
  for (const Scan& scan : manoeuvring_target(count)) {
    time += std::max(scan.dt, 0.05);
    result.push_back({time, scan.z});
    if (scan.z && result.size() % 10 == 7) result.back().z->mean.array() += 3000.0;
  }
  return result;
}

template <class AnyTarget>
Verdict take(AnyTarget& target, const Event& event) {
  return event.z ? target.take(event.time, *event.z) : target.take(event.time);
}

template <class Order, Uncertainty Kind>
auto target_with(const TargetRules& rules) {
  return Target{vector_filter<Order, Kind>(), 0.0, one_point_start, rules};
}

TEST(Target, TakesWhatIsInsideTheGateAndMissesTheRest) {
  auto target = target_with<Interacting, Random>({0.999, 1000});
  auto filter = vector_filter<Interacting, Random>();
  const double gate = chi_square_quantile(0.999, 2);
  double last = 0.0;
  std::size_t rejected = 0;
  for (const Event& event : events(110)) {
    const Verdict verdict = take(target, event);
    auto missing = filter;
    missing.step(event.time - last);
    if (event.z) {
      filter.step(event.time - last, *event.z);
      ASSERT_EQ(verdict, filter.gate_distance() <= gate ? Verdict::accepted : Verdict::rejected);
      if (verdict == Verdict::rejected) ++rejected;
    } else {
      ASSERT_EQ(verdict, Verdict::missed);
    }
    if (verdict != Verdict::accepted) filter = missing;
    last = event.time;
    require_same<Interacting, Random>(target.filter(), filter);
    ASSERT_EQ(target.time(), event.time);
  }
  EXPECT_GE(rejected, 8U);
}

template <class Order, Uncertainty Kind>
void starts_again_after_rejections() {
  auto target = target_with<Order, Kind>({0.999, 3});
  const Gaussian<2> far{Vector<2>{50e3, 50e3}, 100.0 * SquareMatrix<2>::Identity()};
  EXPECT_EQ(target.take(0.2, far), Verdict::rejected);
  EXPECT_EQ(target.take(0.4), Verdict::missed);
  EXPECT_EQ(target.take(0.6, far), Verdict::rejected);
  EXPECT_EQ(target.accepted_time(), 0.0);
  EXPECT_EQ(target.take(0.8, far), Verdict::restarted);
  EXPECT_EQ(target.accepted_time(), 0.8);
  auto expected = vector_filter<Order, Kind>();
  expected.restart(one_point_start(far));
  require_same<Order, Kind>(target.filter(), expected);
  EXPECT_EQ(target.take(1.0, far), Verdict::accepted);
}

TEST(Target, StartsAgainAfterSoManyRejectionsInARow) {
  starts_again_after_rejections<Interacting, Random>();
  starts_again_after_rejections<SecondOrder, Fuzzy>();
}

TEST(Target, WithoutAGateTakesAllAndWithoutRestartsNeverStartsAgain) {
  const Gaussian<2> far{Vector<2>{50e3, 50e3}, 100.0 * SquareMatrix<2>::Identity()};
  auto open = target_with<Interacting, Random>({1.0});
  auto filter = vector_filter<Interacting, Random>();
  filter.step(0.2, far);
  EXPECT_EQ(open.take(0.2, far), Verdict::accepted);
  require_same<Interacting, Random>(open.filter(), filter);

  auto patient = target_with<Interacting, Random>({0.999, 0});
  filter = vector_filter<Interacting, Random>();
  for (int k = 1; k <= 10; ++k) {
    const double before = patient.time();
    EXPECT_EQ(patient.take(0.2 * k, far), Verdict::rejected);
    filter.step(0.2 * k - before);
  }
  require_same<Interacting, Random>(patient.filter(), filter);
  EXPECT_EQ(patient.rejected(), 10U);
  EXPECT_EQ(patient.starts(), 1U);
  EXPECT_EQ(patient.accepted_time(), 0.0);
}

TEST(Target, AnAcceptedMeasurementForgivesTheRejectionsBefore) {
  auto target = target_with<Interacting, Fuzzy>({0.999, 2});
  const Gaussian<2> far{Vector<2>{50e3, 50e3}, 100.0 * SquareMatrix<2>::Identity()};
  const Gaussian<2> near_by{Vector<2>{12000, 7990}, 1e4 * SquareMatrix<2>::Identity()};
  for (double time = 0.1; time < 1.0; time += 0.2) {
    EXPECT_EQ(target.take(time, far), Verdict::rejected);
    EXPECT_EQ(target.take(time + 0.1, near_by), Verdict::accepted);
  }
}

TEST(Target, StartsAgainAfterAGap) {
  auto target = target_with<Interacting, Random>({0.999, 3, 5.0});
  const Gaussian<2> z{Vector<2>{11500, 7500}, 100.0 * SquareMatrix<2>::Identity()};
  const Gaussian<2> near_by{Vector<2>{12000, 7990}, 1e4 * SquareMatrix<2>::Identity()};
  EXPECT_EQ(target.take(0.5, near_by), Verdict::accepted);
  EXPECT_EQ(target.take(3.0), Verdict::missed);
  EXPECT_EQ(target.take(5.75, z), Verdict::restarted);
  auto expected = vector_filter<Interacting, Random>();
  expected.restart(one_point_start(z));
  require_same<Interacting, Random>(target.filter(), expected);
  EXPECT_EQ(target.take(10.75, z), Verdict::accepted) << "a gap of 5 s is not longer than 5 s";
}

/// Whatever comes late by no more than the buffer: the result is that of the right order, to the bit.
template <class Order, Uncertainty Kind>
void retrodicts() {
  constexpr std::size_t late_by = 4;
  const TargetRules rules{0.999, 2, 1.5, late_by};
  const auto all = events(32);
  const auto fresh = target_with<Order, Kind>(rules);
  auto in_order = fresh;
  for (const Event& event : all) take(in_order, event);
  holds([&] {
    std::vector<std::size_t> order(all.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    for (std::size_t k = 0; k + late_by < order.size(); k += late_by) {  // shuffled within groups
      const auto from = order.begin() + static_cast<std::ptrdiff_t>(k);
      const std::size_t turn = *rc::gen::inRange<std::size_t>(0, late_by);
      std::rotate(from, from + static_cast<std::ptrdiff_t>(turn), from + late_by);
    }
    auto shuffled = fresh;
    for (const std::size_t k : order) take(shuffled, all[k]);
    require_same<Order, Kind>(shuffled.filter(), in_order.filter());
    RC_ASSERT(!testing::Test::HasFatalFailure());
    RC_ASSERT(shuffled.time() == in_order.time());
    RC_ASSERT(shuffled.accepted_time() == in_order.accepted_time());
  });
}

TEST(Target, LateMeasurementsWithinTheBufferGiveWhatTheRightOrderGivesToTheBit) {
  retrodicts<Interacting, Random>();
  retrodicts<SecondOrder, Fuzzy>();
}

/// What comes late changes which rejections stand in a row.
TEST(Target, RejectionsInARowAreCountedInTheOrderOfTheirTimes) {
  const Gaussian<2> far{Vector<2>{50e3, 50e3}, 100.0 * SquareMatrix<2>::Identity()};
  const Gaussian<2> near_by{Vector<2>{12000, 7990}, 1e4 * SquareMatrix<2>::Identity()};
  auto target = target_with<Interacting, Random>({0.999, 3, 1e9, 5});
  target.take(0.1, near_by);
  EXPECT_EQ(target.take(0.2, far), Verdict::rejected);
  EXPECT_EQ(target.take(0.4, far), Verdict::rejected);
  auto other = target;
  EXPECT_EQ(target.take(0.3, near_by), Verdict::accepted) << "between the two";
  EXPECT_EQ(target.take(0.5, far), Verdict::rejected) << "the second in a row now";
  EXPECT_EQ(target.starts(), 1U);
  EXPECT_EQ(target.rejected(), 3U);
  EXPECT_EQ(target.take(0.6, far), Verdict::restarted);

  EXPECT_EQ(other.take(0.3, far), Verdict::rejected);
  EXPECT_EQ(other.starts(), 2U) << "the one of 0.4 s is the third now";
  EXPECT_EQ(other.accepted_time(), 0.4);
  EXPECT_EQ(other.rejected(), 3U);
}

TEST(Target, WhatIsOlderThanTheBufferIsRefusedWithBothTimes) {
  auto target = target_with<Interacting, Random>({0.999, 3, 1e9, 2});
  const Gaussian<2> z{Vector<2>{12000, 7990}, 1e4 * SquareMatrix<2>::Identity()};
  for (const double time : {1.0, 2.0, 3.0, 4.0}) target.take(time, z);
  const auto before = target;
  EXPECT_TRUE(throws<std::invalid_argument>([&] { target.take(1.5, z); }, {"1.5", "4.0", "2.0"}));
  require_same<Interacting, Random>(target.filter(), before.filter());
  EXPECT_NO_THROW(target.take(2.0, z)) << "it goes behind the other of that time";

  auto strict = target_with<Interacting, Random>({});
  strict.take(1.0, z);
  EXPECT_TRUE(throws<std::invalid_argument>([&] { strict.take(0.5, z); }, {"0.5", "1.0"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { strict.take(std::nan("")); }, {"not finite"}));
}

TEST(Target, AFailedMeasurementLeavesItAsItWasLateOrNot) {
  auto target = target_with<Interacting, Fuzzy>({0.999, 3, 1e9, 3});
  const auto all = events(8);
  for (std::size_t k = 0; k < 6; ++k) take(target, all[k]);
  auto before = target;
  Gaussian<2> bad = *all[0].z;
  bad.covariance *= -1e6;
  for (const double time : {all[4].time, all[7].time}) {
    EXPECT_TRUE(throws<std::domain_error>([&] { target.take(time, bad); }, {"not positive"}));
    require_same<Interacting, Fuzzy>(target.filter(), before.filter());
    EXPECT_EQ(target.time(), before.time());
  }
  take(target, all[6]);  // and it goes on, with its buffer
  take(before, all[6]);
  const Gaussian<2> late = *all[4].z;
  target.take(all[4].time, late);
  before.take(all[4].time, late);
  require_same<Interacting, Fuzzy>(target.filter(), before.filter());
}

TEST(Target, RefusesRulesThatMakeNoSense) {
  const auto build = [](double time, const TargetRules& rules) {
    Target{vector_filter<Interacting, Random>(), time, one_point_start, rules};
  };
  EXPECT_TRUE(throws<std::invalid_argument>([&] { build(0.0, {1.5}); }, {"probability"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { build(0.0, {std::nan("")}); }, {"probability"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { build(0.0, {0.99, 1, 0.0}); }, {"gap"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { build(std::nan(""), {}); }, {"not finite"}));
}

}  // namespace
}  // namespace sigmax
