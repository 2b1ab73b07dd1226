// `step` allocates nothing: every operator new of this program is counted.

#include "hybrid/targets.hpp"
#include "support/allocations.hpp"

namespace allocation_test {

/// Steps, outputs, and steps back, over a flight.
template <class Filter>
void allocates_nothing(Filter& filter) {
  auto other = filter;
  const Gate gate = Gate::squared_distance(100.0);
  for (const Scan& scan : manoeuvring_target(40)) {
    const Gaussian<2> z = scan.z.value_or(Gaussian<2>{});
    ASSERT_EQ(allocations_of([&] {
                scan.z ? filter.step(scan.dt, z, PositionSensor<2>{}, gate) : filter.step(scan.dt);
                if (scan.z) filter.nis();
                filter.estimate();
                filter.most_likely_estimate();
                other.restore(filter.state());
              }),
              0U);
  }
}

TEST(Allocation, AStepOrAStepBackOfAnyFilterAllocatesNothingNorDoesItsOutput) {
  auto choices = every_reading();
  for (const bool fuzzy : {false, true}) choices.push_back(chosen(fuzzy, Scheme::histories));
  for_each(choices, [](const TargetChoice& choice) {
    AnyFilter filter(choice);
    filter.do_with([](auto& one) { allocates_nothing(one); });
  });
}

TEST(Allocation, AHimmByTheEnvelopeAllocatesNothingAfterTheFirstStepOfItsThread) {
  TargetChoice choice = chosen(true);
  choice.mixed_covariance = MixedCovariance::envelope;
  AnyFilter(choice).step(0.1);
  AnyFilter filter(choice);
  filter.do_with([](auto& one) { allocates_nothing(one); });
}

TEST(Allocation, ATupleOfTypedModelsAllocatesNothing) {
  const RandomVariable mode{"mode", 3};
  Gaussian<7> start{Vector<7>(12e3, 8e3, -100.0, -100.0, 0.0, 0.0, 0.01), 100.0 * SquareMatrix<7>::Identity()};
  start.covariance(6, 6) = 1e-4;
  const CoordinatedTurn<2> turn{1.0, 1e-4};
  InteractingMultipleModel filter{std::tuple{dwpa<2>(4.0), Extended{turn}, Unscented{turn}},
                                  Relation{mode, mode, chosen(false).transition}, start};
  allocates_nothing(filter);
}

TEST(Allocation, AStepOfTheSmootherAllocatesNothing) {
  with_every_filter([](auto& filter) {
    std::vector record{filter.recorded(0.0)};
    for (const Scan& scan : manoeuvring_target(20)) {
      scan.z ? filter.step(scan.dt, *scan.z, PositionSensor<2>{}) : filter.step(scan.dt);
      record.push_back(scan.z ? filter.recorded(scan.dt, *scan.z, PositionSensor<2>{}) : filter.recorded(scan.dt));
    }
    FixedIntervalSmoother smoother{filter};
    smoother.begin(record.back());
    for (std::size_t k = record.size() - 1; k-- > 0;) ASSERT_EQ(allocations_of([&] { smoother.step(record[k]); }), 0U);
  });
}

TEST(Allocation, ATargetAllocatesNothingWhateverBecomesOfAMeasurement) {
  const TargetChoice choice = chosen(true);
  const InteractingMultipleModel filter{models_of(choice), transition_of<Fuzzy>(choice), starts()};
  Target target{filter, 0.0, one_point_start, TargetRules{0.999, 2, 1e9, 3}};
  const Gaussian<2> z = near_by, far = far_off;
  std::vector<Verdict> verdicts;
  verdicts.reserve(16);
  for (const Detection& detection : {Detection(1.0, z), Detection(2.0, z), Detection(1.5, z), Detection(3.0, far),
                                     Detection(4.0, far), Detection(5.0)}) {
    const std::size_t allocations = allocations_of([&] { verdicts.push_back(target.take(detection)); });
    if (verdicts.back() != Verdict::restarted) ASSERT_EQ(allocations, 0U);
  }
  EXPECT_EQ(verdicts, (std::vector{Verdict::accepted, Verdict::accepted, Verdict::accepted, Verdict::rejected,
                                   Verdict::restarted, Verdict::missed}));
}

TEST(Allocation, AnAnyTargetAllocatesNothingOnceItsOutputHasRoom) {
  for_each(every_filter(), [](TargetChoice choice) {
    choice.rules = {.gate_probability = 0.999, .rejections = 0};
    AnyTarget target(choice);
    TargetPoint point;
    double time = 0.0;
    for (const Scan& scan : manoeuvring_target(30)) {
      time += scan.dt + 0.01;
      const auto detection =
          scan.z ? AnyDetection::position(time, {scan.z->mean.data(), 2}, {scan.z->covariance.data(), 4})
                 : AnyDetection::missed(time);
      const auto take = [&] {
        target.take(detection);
        target.output(point);
      };
      const std::size_t allocations = allocations_of(take);
      if (time > 1.0) ASSERT_EQ(allocations, 0U);
    }
    EXPECT_TRUE(target.running());
  });
}

TEST(Allocation, AnUnreachableModeAllocatesNothing) {
  AnyFilter filter(with(chosen(true), chosen(true).motions, {{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}));
  filter.do_with([](auto& one) {
    for (int k = 0; k < 3; ++k) ASSERT_EQ(allocations_of([&] { one.step(0.2); }), 0U);
  });
}

TEST(Allocation, ATransitionOverAnyTimeAllocatesNothing) {
  const FuzzyVariable motion{"motion", 4};
  const TimedTransition transition{motion, rates_of_sojourns({20.0, 5.0, 3.0, 1.0})};
  Relation relation = transition(1.0);
  for (const double dt : {0.2, 0.0, 50.0}) ASSERT_EQ(allocations_of([&] { transition(dt, relation); }), 0U);
}

}  // namespace allocation_test
