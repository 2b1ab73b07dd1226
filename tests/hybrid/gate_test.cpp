// A gate does not starve a filter of a hard turn, and no number is too far off for one.

#include "hybrid/targets.hpp"

namespace gate_test {

/// A target that flies straight for 40 s, turns by so many m/s² for 15 s and flies straight again, seen every second
/// without an error.
Vector<2> hard_turn(double t, double acceleration) {
  const double turning = std::clamp(t - 40.0, 0.0, 15.0);
  return {100.0 * t, 0.5 * acceleration * turning * turning + 15.0 * acceleration * std::max(t - 55.0, 0.0)};
}
Gaussian<2> measured_turn(double t, double acceleration) {
  return {hard_turn(t, acceleration), 100.0 * SquareMatrix<2>::Identity()};
}

/// IMM, GPB2, HIMM and Viterbi of two models, with their start.
template <class Act>
void of_two_models(double acceleration, const Act& act) {
  const auto point = [&](double t) { return TimedMeasurement<2>{t, measured_turn(t, acceleration)}; };
  Estimates start;
  start.add(two_point_start(point(1.0), point(2.0)));
  start.add(three_point_start(point(0.0), point(1.0), point(2.0)));
  for_each(every_filter(), [&](const TargetChoice& any) {
    if (any.scheme == Scheme::histories) return;
    act(AnyFilter(with(any, {calm(3.0), turning(3.0)},
                       any.fuzzy ? Rows{{1.0, 0.5}, {0.5, 1.0}} : Rows{{0.95, 0.05}, {0.05, 0.95}}),
                  start));
  });
}

/// A number alone does not say whether it is a probability or a distance.
template <class Limit>
concept LimitsAStep = requires(InteractingMultipleModel<std::vector<AnyModel>, Random>& filter, Limit limit) {
  filter.step(1.0, {Vector<2>(), SquareMatrix<2>()}, limit);
};
static_assert(LimitsAStep<Gate> && !LimitsAStep<double>);

TEST(Gate, LetsASquaredDistancePassOrItsProbability) {
  for (int m = 1; m <= max_measurement_size; ++m) {
    EXPECT_EQ(Gate{}.limit(m), std::numeric_limits<double>::infinity());
    EXPECT_EQ(Gate::probability(1.0).limit(m), std::numeric_limits<double>::infinity());
    EXPECT_EQ(Gate::squared_distance(13.8).limit(m), 13.8);
    EXPECT_EQ(Gate::probability(0.999).limit(m), chi_square_quantile(0.999, m));
  }
  EXPECT_INVALID(("between 0 and 1"), Gate::probability(0.0));
  EXPECT_INVALID(("squared distance", "negative"), Gate::squared_distance(-1.0));
}

TEST(Gate, DoesNotStarveAFilterOfATurnOfTwoG) {
  const Gate gate = Gate::probability(0.999);
  of_two_models(20.0, [&](AnyFilter filter) {
    std::size_t in_a_row = 0, longest = 0;
    for (double t = 3.0; t <= 100.0; t += 1.0) {
      filter.step({1.0, measured_turn(t, 20.0)}, gate);
      in_a_row = filter.measured ? 0 : in_a_row + 1;
      longest = std::max(longest, in_a_row);
    }
    EXPECT_LE(longest, 3U);
    EXPECT_LT((filter.estimate.mean.head<2>() - hard_turn(100.0, 20.0)).norm(), 50.0);
  });
}

/// Position as measured, at rest within 500 m/s and 50 m/s².
Gaussian<6> anywhere(const Gaussian<Eigen::Dynamic, 3>& z) {
  Gaussian<6> start = one_point_start(z);
  start.covariance.diagonal().tail<4>() << 25e4, 25e4, 2500.0, 2500.0;
  return start;
}

TEST(Gate, ATargetThatTurnsByFourGIsFoundAgain) {
  of_two_models(40.0, [&](AnyFilter any) {
    any.do_with([](const auto& filter) {
      Target target{filter, 2.0, anywhere, TargetRules{0.999, 3}};
      std::size_t in_a_row = 0, longest = 0;
      for (double t = 3.0; t <= 100.0; t += 1.0) {
        const Verdict verdict = target.take(Detection(t, measured_turn(t, 40.0)));
        in_a_row = verdict == Verdict::rejected ? in_a_row + 1 : 0;
        longest = std::max(longest, in_a_row);
      }
      EXPECT_LE(longest, 2U) << "the third in a row starts it again";
      EXPECT_LT((target.filter().estimate().mean.template head<2>() - hard_turn(100.0, 40.0)).norm(), 50.0);
    });
  });
}

/// Numbers whose squares are none, as a missing value is sometimes written.
TEST(Gate, RejectsWhatIsBeyondAllNumbers) {
  const Gate gate = Gate::probability(0.999999);
  for_each(every_filter(), [&](const TargetChoice& choice) {
    AnyFilter filter(choice);
    for (const Scan& scan : manoeuvring_target(20)) filter.step(scan);
    auto missed = filter;
    missed.step(0.2);
    for (const double far : {1e155, 1e160, -1e160, 1.797e308, -1.797e308})
      for (const double variance : {1e-6, 100.0}) {
        for (const Vector<2>& where : {Vector<2>(far, far), Vector<2>(far, 8000.0), Vector<2>(far, -far)}) {
          auto gated = filter;
          gated.step({0.2, at(where.x(), where.y(), variance)}, gate);
          EXPECT_FALSE(gated.measured);
          EXPECT_GT(gated.gate_distance, chi_square_quantile(0.999999, 2));
          EXPECT_PRED_FORMAT3(same_state, gated, missed, 0.0);
        }
        filter.do_with([&](const auto& one) {
          Target target{one, 0.0, anywhere, TargetRules{0.999, 0}};
          EXPECT_EQ(target.take(Detection(0.2, at(far, far, variance))), Verdict::rejected);
          EXPECT_PRED_FORMAT3(same_state, shown(target.filter()), missed, 0.0);
        });
      }
  });
}

}  // namespace gate_test
