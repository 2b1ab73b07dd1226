#include <sigmax/estimation/start.hpp>

#include "support/matrices.hpp"

namespace {

restatement::Position position(const Gaussian<2>& z) { return {entries(z.mean), dense(z.covariance)}; }

/// A measurement in the plane whose axes are alike, but for the sign.
TimedMeasurement<2> at(double time, double z, double R) {
  return {time, {Vector<2>{z, -z}, SquareMatrix<2>{{R, 0.0}, {0.0, R}}}};
}

PROPERTY(Start, AllThreeEqualTheRestatement) {
  const auto z1 = generated_gaussian<2>(), z2 = generated_gaussian<2>(), z3 = generated_gaussian<2>();
  const double t = number_between(-100.0, 100.0);
  const double T = number_between(0.1, 3.0);
  const double U = number_between(0.1, 3.0);
  const auto same = [](const auto& found, const restatement::State& expected) {
    require_near(entries(found.mean), expected.mean, 1e-9);
    require_near_matrix(found.covariance, expected.covariance, 1e-9);
    RC_ASSERT(found.covariance == found.covariance.transpose());
  };
  same(two_point_start<2>({t, z1}, {t + T, z2}), restatement::two_point_start(position(z1), position(z2), T));
  same(three_point_start<2>({t, z1}, {t + T, z2}, {t + T + U, z3}),
       restatement::three_point_start(position(z1), position(z2), position(z3), T, U));
  same(released_start<2>({t, z1}, {t + T, z2}, {t + 2 * T, z3}),
       restatement::released_start(position(z1), position(z2), position(z3), T));
}

PROPERTY(Start, ThreePointsAreExactOnAParabolaWithUnequalSteps) {
  const double x = number_between(-5, 5), v = number_between(-5, 5), a = number_between(-5, 5);
  const double T = number_between(0.1, 3.0), U = number_between(0.1, 3.0);
  const auto seen = [&](double t) { return at(7.0 + t, x + t * v + 0.5 * t * t * a, 1.0); };  // t from the third point
  const auto start = three_point_start<2>(seen(-T - U), seen(-U), seen(0.0));
  require_near(entries(start.mean), std::vector<double>{x, -x, v, -v, a, -a}, 1e-9);
}

TEST(Start, TheReleasedVelocityLagsByHalfAStepOfAcceleration) {
  const auto seen = [](double t) { return at(t, 3.0 * t + 2.0 * t * t, 1.0); };  // a = 4
  const auto unbiased = three_point_start<2>(seen(0.0), seen(0.5), seen(1.0));
  const auto released = released_start<2>(seen(0.0), seen(0.5), seen(1.0));
  EXPECT_CLOSE(unbiased.mean(2), 7.0, 1e-13);
  EXPECT_CLOSE(released.mean(2), 7.0 - 0.5 * 0.5 * 4.0, 1e-13);
  EXPECT_CLOSE(released.mean(4), unbiased.mean(4), 1e-13);
}

TEST(Start, NeedsIncreasingTimes) {
  const auto seen = [](double t) { return at(t, 1.0, 1.0); };
  EXPECT_INVALID(("increasing times"), two_point_start<2>(seen(1.0), seen(1.0)));
  EXPECT_INVALID(("increasing times"), three_point_start<2>(seen(1.0), seen(0.0), seen(2.0)));
  EXPECT_INVALID(("increasing times"), three_point_start<2>(seen(0.0), seen(1.0), seen(1.0)));
  EXPECT_INVALID(("increasing times"), released_start<2>(seen(0.0), seen(2.0), seen(1.0)));
}

}  // namespace
