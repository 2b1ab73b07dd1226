#include "hybrid/targets.hpp"

namespace target_test {

auto target_with(const TargetRules& rules) { return Target{imm(), 0.0, one_point_start, rules}; }

TEST(Target, TakesWhatIsInsideTheGateAndMissesTheRest) {
  auto target = target_with({0.999, 1000});
  auto filter = imm();
  const double gate = chi_square_quantile(0.999, 2);
  double last = 0.0;
  std::size_t rejected = 0;
  for (const Detection& detection : detections(110)) {
    const Verdict verdict = target.take(detection);
    auto missing = filter;
    missing.step(detection.time - last);
    if (detection.seen()) {
      filter.step(detection.time - last, *detection.position<Eigen::Dynamic>());
      ASSERT_EQ(verdict, filter.gate_distance() <= gate ? Verdict::accepted : Verdict::rejected);
      if (verdict == Verdict::rejected) ++rejected;
    } else {
      ASSERT_EQ(verdict, Verdict::missed);
    }
    if (verdict != Verdict::accepted) filter = missing;
    last = detection.time;
    ASSERT_PRED_FORMAT2(same_filter, target.filter(), filter);
    ASSERT_EQ(target.time(), detection.time);
  }
  EXPECT_GE(rejected, 8U);
  EXPECT_EQ(target.rejected(), rejected);
}

TEST(Target, StartsAgainAfterSoManyRejectionsInARow) {
  with_every_filter([](auto& filter) {
    Target target{filter, 0.0, one_point_start, TargetRules{0.999, 3}};
    EXPECT_EQ(target.take(Detection(0.2, far_off)), Verdict::rejected);
    EXPECT_EQ(target.take(0.4), Verdict::missed);
    EXPECT_EQ(target.take(Detection(0.6, far_off)), Verdict::rejected);
    EXPECT_EQ(target.accepted_time(), 0.0);
    EXPECT_EQ(target.take(Detection(0.8, far_off)), Verdict::restarted);
    EXPECT_EQ(target.accepted_time(), 0.8);
    filter.restart(one_point_start({far_off.mean, far_off.covariance}));
    EXPECT_PRED_FORMAT2(same_filter, target.filter(), filter);
    EXPECT_EQ(target.take(1.0, {far_off.mean, far_off.covariance}), Verdict::accepted);
  });
}

TEST(Target, WithoutAGateTakesAllAndWithoutRestartsNeverStartsAgain) {
  auto open = target_with({1.0});
  auto filter = imm();
  filter.step(0.2, far_off, PositionSensor<2>{});
  EXPECT_EQ(open.take(Detection(0.2, far_off)), Verdict::accepted);
  EXPECT_PRED_FORMAT2(same_filter, open.filter(), filter);

  auto patient = target_with({0.999, 0});
  filter = imm();
  for (int k = 1; k <= 10; ++k) {
    const double before = patient.time();
    EXPECT_EQ(patient.take(Detection(0.2 * k, far_off)), Verdict::rejected);
    filter.step(0.2 * k - before);
  }
  EXPECT_PRED_FORMAT2(same_filter, patient.filter(), filter);
  EXPECT_EQ(patient.rejected(), 10U);
  EXPECT_EQ(patient.starts(), 1U);
  EXPECT_EQ(patient.accepted_time(), 0.0);
}

TEST(Target, AnAcceptedMeasurementForgivesTheRejectionsBefore) {
  auto target = target_with({0.999, 2});
  for (double time = 0.1; time < 1.0; time += 0.2) {
    EXPECT_EQ(target.take(Detection(time, far_off)), Verdict::rejected);
    EXPECT_EQ(target.take(Detection(time + 0.1, near_by)), Verdict::accepted);
  }
}

TEST(Target, StartsAgainAfterAGap) {
  auto target = target_with({0.999, 3, 5.0});
  const Gaussian<2> z = at(11500, 7500);
  EXPECT_EQ(target.take(Detection(0.5, near_by)), Verdict::accepted);
  EXPECT_EQ(target.take(3.0), Verdict::missed);
  EXPECT_EQ(target.take(Detection(5.75, z)), Verdict::restarted);
  auto expected = imm();
  expected.restart(one_point_start({z.mean, z.covariance}));
  EXPECT_PRED_FORMAT2(same_filter, target.filter(), expected);
  EXPECT_EQ(target.take(Detection(10.75, z)), Verdict::accepted) << "a gap of 5 s is not longer than 5 s";
}

/// What comes late changes which rejections stand in a row.
TEST(Target, RejectionsInARowAreCountedInTheOrderOfTheirTimes) {
  auto target = target_with({0.999, 3, 1e9, 5});
  target.take(Detection(0.1, near_by));
  EXPECT_EQ(target.take(Detection(0.2, far_off)), Verdict::rejected);
  EXPECT_EQ(target.take(Detection(0.4, far_off)), Verdict::rejected);
  auto other = target;
  EXPECT_EQ(target.take(Detection(0.3, near_by)), Verdict::accepted) << "between the two";
  EXPECT_EQ(target.take(Detection(0.5, far_off)), Verdict::rejected) << "the second in a row now";
  EXPECT_EQ(target.starts(), 1U);
  EXPECT_EQ(target.rejected(), 3U);
  EXPECT_EQ(target.take(Detection(0.6, far_off)), Verdict::restarted);

  EXPECT_EQ(other.take(Detection(0.3, far_off)), Verdict::rejected);
  EXPECT_EQ(other.starts(), 2U) << "the one of 0.4 s is the third now";
  EXPECT_EQ(other.accepted_time(), 0.4);
  EXPECT_EQ(other.rejected(), 3U);
}

TEST(Target, WhatIsOlderThanTheBufferIsRefusedWithBothTimes) {
  auto target = target_with({0.999, 3, 1e9, 2});
  for (const double time : {1.0, 2.0, 3.0, 4.0}) target.take(Detection(time, near_by));
  const auto before = target;
  EXPECT_INVALID(("1.5", "4.0", "2.0"), target.take(Detection(1.5, near_by)));
  EXPECT_PRED_FORMAT2(same_filter, target.filter(), before.filter());
  EXPECT_NO_THROW(target.take(Detection(2.0, near_by))) << "it goes behind the other of that time";

  auto strict = target_with({});
  strict.take(Detection(1.0, near_by));
  EXPECT_INVALID(("0.5", "1.0"), strict.take(Detection(0.5, near_by)));
  EXPECT_INVALID(("not finite"), strict.take(not_a_number));
}

TEST(Target, AFailedMeasurementLeavesItAsItWasLateOrNot) {
  auto target = target_with({.gate_probability = 0.999, .buffer = 3, .record = true});
  const auto all = detections(8);
  for (std::size_t k = 0; k < 6; ++k) target.take(all[k]);
  const auto tags_of = [](const auto& one) {
    std::vector<std::size_t> tags;
    one.smoothed([&](const auto& kept, const auto&) { tags.push_back(kept.tag); });
    return tags;
  };
  auto before = target;
  for (const double time : {all[4].time, all[7].time}) {
    EXPECT_REFUSED(std::domain_error, ("not positive"), target.take(Detection(time, at(12000, 7990, -1e6))));
    EXPECT_PRED_FORMAT2(same_filter, target.filter(), before.filter());
    EXPECT_EQ(target.time(), before.time());
    EXPECT_EQ(tags_of(target), tags_of(before));
  }
  for (auto* each : {&target, &before}) {  // and it goes on, with its buffer
    each->take(all[6]);
    each->take(all[4]);
  }
  EXPECT_PRED_FORMAT2(same_filter, target.filter(), before.filter());
}

TEST(Target, RefusesRulesThatMakeNoSense) {
  EXPECT_INVALID(("probability"), target_with({1.5}));
  EXPECT_INVALID(("probability"), target_with({not_a_number}));
  EXPECT_INVALID(("gap"), target_with({0.99, 1, 0.0}));
  EXPECT_INVALID(("not finite"), Target{imm(), not_a_number, one_point_start, TargetRules{}});
}

/// The same of models whose types are known.
TEST(Target, OfATupleStartsFromAPositionAlongItsAxes) {
  const FuzzyVariable mode{"mode", 1};
  const Gaussian<4> start{Vector<4>::Zero(), SquareMatrix<4>::Identity()};
  Target target{InteractingMultipleModel{std::tuple{dwna<2>(1.0)}, Relation{mode, mode, {{1.0}}}, start},
                [&](const Gaussian<2>& z) {
                  Gaussian<4> result = start;
                  result.mean.head<2>() = z.mean;
                  return result;
                }};
  EXPECT_EQ(target.take({0.5, {Vector<1>(7.0), SquareMatrix<1>(1.0)}, LinearSensor<1, 1>(SquareMatrix<1>(1.0))}),
            Verdict::waiting);
  EXPECT_EQ(target.take(1.0, at(5.0, 6.0)), Verdict::started);
  EXPECT_EQ(target.filter().estimates()[0].mean, (Vector<4>(5.0, 6.0, 0.0, 0.0)));
}

}  // namespace target_test
