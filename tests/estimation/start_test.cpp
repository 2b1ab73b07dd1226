#include <sigmax/estimation/start.hpp>

#include <gtest/gtest.h>

#include "support/matrices.hpp"
#include "support/restatement.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::entries;
using support::generated_gaussian;
using support::holds;
using support::near_matrix;
using support::number_between;
using support::require_near;
using support::require_near_matrix;
using support::throws;

template <int M>
restatement::Position position(const Gaussian<M>& z) {
  return {entries(z.mean), restatement::Matrix(M, M, entries(z.covariance))};
}

Gaussian<1> scalar(double z, double R) { return {Vector<1>{z}, SquareMatrix<1>{R}}; }

TEST(Start, TwoPointsByHand) {
  const auto start = two_point_start<1>({3.0, scalar(10.0, 4.0)}, {5.0, scalar(16.0, 9.0)});
  EXPECT_EQ(start.mean, (Vector<2>{16.0, 3.0}));
  EXPECT_EQ(start.covariance, (SquareMatrix<2>{{9.0, 4.5}, {4.5, 3.25}}));
}

TEST(Start, ThreePointsByHand) {
  // v = (3·16 − 4·10 + 6)/4, a = (16 − 20 + 6)/4; weights [1/4, −1, 3/4] and [1/4, −1/2, 1/4] on R = 16, 4, 8.
  const auto start = three_point_start<1>({1.0, scalar(6.0, 16.0)}, {3.0, scalar(10.0, 4.0)}, {5.0, scalar(16.0, 8.0)});
  EXPECT_PRED_FORMAT3(near_matrix, start.mean, (Vector<3>{16.0, 3.5, 0.5}), 1e-15);
  EXPECT_PRED_FORMAT3(near_matrix, start.covariance,
                      (SquareMatrix<3>{{8.0, 6.0, 2.0}, {6.0, 9.5, 4.5}, {2.0, 4.5, 2.5}}), 1e-15);
}

TEST(Start, TheReleasedOneHasThePrintedCovariance) {
  const double T = 0.2;
  const auto start = released_start<1>({0.0, scalar(6.0, 16.0)}, {T, scalar(10.0, 4.0)}, {2 * T, scalar(16.0, 1.0)});
  EXPECT_PRED_FORMAT3(near_matrix, start.mean, (Vector<3>{16.0, 30.0, 50.0}), 1e-12);
  EXPECT_PRED_FORMAT3(near_matrix, start.covariance,
                      (SquareMatrix<3>{{1.0, 5.0, 25.0}, {5.0, 50.0, 375.0}, {25.0, 375.0, 3750.0}}), 1e-12);
}

TEST(Start, AllThreeEqualTheRestatement) {
  holds([] {
    const auto z1 = generated_gaussian<3>(), z2 = generated_gaussian<3>(), z3 = generated_gaussian<3>();
    const double t = number_between(-100.0, 100.0);
    const double T = number_between(0.1, 3.0);
    const double U = number_between(0.1, 3.0);
    const auto same = [](const auto& found, const restatement::State& expected) {
      require_near(entries(found.mean), expected.mean, 1e-9);
      require_near(entries(found.covariance), expected.covariance.values, 1e-9);
      RC_ASSERT(found.covariance == found.covariance.transpose());
    };
    same(two_point_start<3>({t, z1}, {t + T, z2}), restatement::two_point_start(position(z1), position(z2), T));
    same(three_point_start<3>({t, z1}, {t + T, z2}, {t + T + U, z3}),
         restatement::three_point_start(position(z1), position(z2), position(z3), T, U));
    same(released_start<3>({t, z1}, {t + T, z2}, {t + 2 * T, z3}),
         restatement::released_start(position(z1), position(z2), position(z3), T));
  });
}

TEST(Start, ThreePointsAreExactOnAParabolaWithUnequalSteps) {
  holds([] {
    const Vector<2> x{number_between(-5, 5), 1.0}, v{number_between(-5, 5), -2.0}, a{number_between(-5, 5), 3.0};
    const double T = number_between(0.1, 3.0), U = number_between(0.1, 3.0);
    const auto at = [&](double t) {  // seconds from the third point
      return TimedMeasurement<2>{7.0 + t, {x + t * v + 0.5 * t * t * a, SquareMatrix<2>::Identity()}};
    };
    const auto start = three_point_start<2>(at(-T - U), at(-U), at(0.0));
    Vector<6> expected;
    expected << x, v, a;
    require_near_matrix(start.mean, expected, 1e-9);
  });
}

TEST(Start, TheReleasedVelocityLagsByHalfAStepOfAcceleration) {
  const auto at = [](double t) { return TimedMeasurement<1>{t, scalar(3.0 * t + 2.0 * t * t, 1.0)}; };  // a = 4
  const auto unbiased = three_point_start<1>(at(0.0), at(0.5), at(1.0));
  const auto released = released_start<1>(at(0.0), at(0.5), at(1.0));
  EXPECT_PRED_FORMAT3(near_matrix, unbiased.mean, (Vector<3>{5.0, 7.0, 4.0}), 1e-13);
  EXPECT_PRED_FORMAT3(near_matrix, released.mean, (Vector<3>{5.0, 7.0 - 0.5 * 0.5 * 4.0, 4.0}), 1e-13);
}

TEST(Start, NeedsIncreasingTimes) {
  const auto at = [](double t) { return TimedMeasurement<1>{t, scalar(1.0, 1.0)}; };
  EXPECT_TRUE(throws<std::invalid_argument>([&] { two_point_start<1>(at(1.0), at(1.0)); }, {"increasing times"}));
  EXPECT_TRUE(
      throws<std::invalid_argument>([&] { three_point_start<1>(at(1.0), at(0.0), at(2.0)); }, {"increasing times"}));
  EXPECT_TRUE(
      throws<std::invalid_argument>([&] { three_point_start<1>(at(0.0), at(1.0), at(1.0)); }, {"increasing times"}));
  EXPECT_TRUE(
      throws<std::invalid_argument>([&] { released_start<1>(at(0.0), at(2.0), at(1.0)); }, {"increasing times"}));
}

}  // namespace
}  // namespace sigmax
