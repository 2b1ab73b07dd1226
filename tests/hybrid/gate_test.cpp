// What gates compare, that a gate does not starve a filter of a hard turn, and that no number is too far off for one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <sigmax/estimation/chi_square.hpp>
#include <sigmax/estimation/start.hpp>
#include <sigmax/hybrid/target.hpp>

#include "hybrid/laws.hpp"

namespace sigmax {
namespace {

using namespace support;

/// −2 log ⊕ⱼ w_j ⊗ exp(−d_j²/2), from what the filter shows after the same step without a measurement.
template <Uncertainty Kind>
double restated_gate_distance(const Filter<Interacting, Kind>& missed, const Gaussian<2>& z) {
  double total = 0.0;
  for (std::size_t j = 0; j < missed.modes(); ++j) {
    const auto& estimate = missed.estimates()[j];
    const double a = z.mean(0) - estimate.mean(0), b = z.mean(1) - estimate.mean(1);
    const double xx = estimate.covariance(0, 0) + z.covariance(0, 0),
                 yy = estimate.covariance(1, 1) + z.covariance(1, 1);
    const double xy = estimate.covariance(0, 1) + z.covariance(0, 1);
    const double squared = (yy * a * a - 2.0 * xy * a * b + xx * b * b) / (xx * yy - xy * xy);
    const double fit = std::exp(missed.belief().log(j) - 0.5 * squared);
    total = std::is_same_v<Kind, Random> ? total + fit : std::max(total, fit);
  }
  return -2.0 * std::log(total);
}

template <Uncertainty Kind>
void gates_on_all_that_was_thought_possible() {
  auto filter = vector_filter<Interacting, Kind>();
  std::size_t taken = 0, rejected = 0;
  for (const Scan& scan : manoeuvring_target()) {
    auto missed = filter;
    missed.step(scan.dt);
    if (!scan.z) {
      filter = missed;
      continue;
    }
    const double expected = restated_gate_distance<Kind>(missed, *scan.z);
    auto gated = filter;
    gated.step(scan.dt, *scan.z, 2.0);
    ASSERT_PRED_FORMAT3(near, gated.gate_distance(), expected, 1e-9);
    ASSERT_EQ(gated.measured(), expected <= 2.0);
    ++(gated.measured() ? taken : rejected);
    filter.step(scan.dt, *scan.z);
    ASSERT_PRED_FORMAT3(near, filter.gate_distance(), expected, 1e-9);
    for (std::size_t j = 0; j < filter.modes(); ++j)  // no mode is worse than its weight makes it
      ASSERT_LE(expected, filter.innovations()[j].squared_distance - 2.0 * missed.belief().log(j) + 1e-9);
  }
  EXPECT_GT(taken, 20U);
  EXPECT_GT(rejected, 10U);
}

TEST(Gate, ComparesTheDistanceFromAllThatWasThoughtPossible) {
  gates_on_all_that_was_thought_possible<Random>();
  gates_on_all_that_was_thought_possible<Fuzzy>();
}

/// A target that flies straight for 40 s, turns by so many m/s² for 15 s and flies straight again, seen every second
/// without an error.
Vector<2> hard_turn(double t, double acceleration) {
  const double turning = std::clamp(t - 40.0, 0.0, 15.0);
  return {100.0 * t, 0.5 * acceleration * turning * turning + 15.0 * acceleration * std::max(t - 55.0, 0.0)};
}
Gaussian<2> measured_turn(double t, double acceleration) {
  return {hard_turn(t, acceleration), 100.0 * SquareMatrix<2>::Identity()};
}

template <class Order, Uncertainty Kind>
Filter<Order, Kind> two_models(double acceleration) {
  const auto point = [&](double t) { return TimedMeasurement<2>{t, measured_turn(t, acceleration)}; };
  const Gaussian<4> narrow = two_point_start(point(1.0), point(2.0));
  const Gaussian<6> wide = three_point_start(point(0.0), point(1.0), point(2.0));
  return {VectorBank{calm(3.0), turning(3.0)},
          std::is_same_v<Kind, Random> ? transition_by<Kind>({{0.95, 0.05}, {0.05, 0.95}})
                                       : transition_by<Kind>({{1.0, 0.5}, {0.5, 1.0}}),
          std::vector<State>{{narrow.mean, narrow.covariance}, {wide.mean, wide.covariance}}};
}

template <class Order, Uncertainty Kind>
void does_not_starve() {
  const double gate = chi_square_quantile(0.999, 2);
  auto filter = two_models<Order, Kind>(20.0);
  std::size_t in_a_row = 0, longest = 0;
  for (double t = 3.0; t <= 100.0; t += 1.0) {
    filter.step(1.0, measured_turn(t, 20.0), gate);
    in_a_row = filter.measured() ? 0 : in_a_row + 1;
    longest = std::max(longest, in_a_row);
  }
  EXPECT_LE(longest, 3U);
  EXPECT_LT((filter.estimate().mean.template head<2>() - hard_turn(100.0, 20.0)).norm(), 50.0);
}

TEST(Gate, DoesNotStarveAFilterOfATurnOfTwoG) {
  {
    SCOPED_TRACE("IMM");
    does_not_starve<Interacting, Random>();
  }
  {
    SCOPED_TRACE("HIMM");
    does_not_starve<Interacting, Fuzzy>();
  }
  {
    SCOPED_TRACE("GPB2");
    does_not_starve<SecondOrder, Random>();
  }
  {
    SCOPED_TRACE("Viterbi");
    does_not_starve<SecondOrder, Fuzzy>();
  }
}

/// Position as measured, at rest within 500 m/s and 50 m/s².
State anywhere(const Gaussian<2>& z) {
  State start{Vector<6>::Zero(), SquareMatrix<6>::Zero()};
  start.mean.head<2>() = z.mean;
  start.covariance.topLeftCorner<2, 2>() = z.covariance;
  start.covariance.diagonal().tail<4>() << 25e4, 25e4, 2500.0, 2500.0;
  return start;
}

template <class Order, Uncertainty Kind>
void finds_the_target_again() {
  Target target{two_models<Order, Kind>(40.0), 2.0, anywhere, TargetRules{0.999, 3}};
  std::size_t in_a_row = 0, longest = 0;
  for (double t = 3.0; t <= 100.0; t += 1.0) {
    const Verdict verdict = target.take(t, measured_turn(t, 40.0));
    in_a_row = verdict == Verdict::rejected ? in_a_row + 1 : 0;
    longest = std::max(longest, in_a_row);
  }
  EXPECT_LE(longest, 2U) << "the third in a row starts it again";
  EXPECT_LT((target.filter().estimate().mean.template head<2>() - hard_turn(100.0, 40.0)).norm(), 50.0);
}

TEST(Gate, ATargetThatTurnsByFourGIsFoundAgain) {
  finds_the_target_again<Interacting, Random>();
  finds_the_target_again<Interacting, Fuzzy>();
  finds_the_target_again<SecondOrder, Random>();
  finds_the_target_again<SecondOrder, Fuzzy>();
}

/// Numbers whose squares are none, as a missing value is sometimes written.
template <class Order, Uncertainty Kind>
void rejects_what_is_beyond_all_numbers() {
  auto filter = vector_filter<Order, Kind>();
  for (const Scan& scan : manoeuvring_target(20)) step(filter, scan);
  const double gate = chi_square_quantile(0.999999, 2);
  for (const double far : {1e155, 1e160, -1e160, 1.797e308, -1.797e308})
    for (const double sigma : {1e-3, 10.0}) {
      auto missed = filter;
      missed.step(0.2);
      for (const Vector<2>& at : {Vector<2>(far, far), Vector<2>(far, 8000.0), Vector<2>(far, -far)}) {
        auto gated = filter;
        gated.step(0.2, {at, sigma * sigma * SquareMatrix<2>::Identity()}, gate);
        EXPECT_FALSE(gated.measured());
        EXPECT_GT(gated.gate_distance(), gate);
        require_same<Order, Kind>(gated, missed);
      }
      Target target{filter, 0.0, anywhere, TargetRules{0.999, 0}};
      EXPECT_EQ(target.take(0.2, {Vector<2>(far, far), sigma * sigma * SquareMatrix<2>::Identity()}),
                Verdict::rejected);
      require_same<Order, Kind>(target.filter(), missed);
    }
}

TEST(Gate, RejectsWhatIsBeyondAllNumbers) {
  rejects_what_is_beyond_all_numbers<Interacting, Random>();
  rejects_what_is_beyond_all_numbers<Interacting, Fuzzy>();
  rejects_what_is_beyond_all_numbers<SecondOrder, Random>();
  rejects_what_is_beyond_all_numbers<SecondOrder, Fuzzy>();
}

}  // namespace
}  // namespace sigmax
