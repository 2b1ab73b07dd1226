#include <sigmax/estimation/sigma_points.hpp>

#include <gtest/gtest.h>

#include "estimation/quadratic.hpp"

namespace sigmax {
namespace {

using support::generated_gaussian;
using support::generated_scaling;
using support::holds;
using support::Quadratic;
using support::require_near;
using support::require_near_matrix;

static_assert(SigmaPointMember<Unscented<Quadratic<3>>>);
static_assert(SigmaPointMember<Cubature<Quadratic<3>>>);
static_assert(!SigmaPointMember<Extended<Quadratic<3>>>);
static_assert(SigmaPoints<Unscented<Quadratic<3>>>::count == 7);
static_assert(SigmaPoints<Cubature<Quadratic<3>>>::count == 6);

template <class Member>
void has_the_moments(const Member& member) {
  const auto estimate = generated_gaussian<3>();
  const SigmaPoints<Member> points(member, estimate);
  require_near(points.mean_weights().sum(), 1.0, 1e-13);
  require_near_matrix(points.offsets() * points.mean_weights(), Vector<3>::Zero(), 1e-13);
  require_near_matrix(points.covariance(points.offsets(), points.offsets()), estimate.covariance, 1e-12);
}

TEST(SigmaPoints, HaveTheMeanAndTheCovarianceOfTheEstimate) {
  holds([] {
    has_the_moments(Unscented{Quadratic<3>{}, generated_scaling()});
    has_the_moments(Cubature{Quadratic<3>{}});
  });
}

TEST(SigmaPoints, LieAlongTheColumnsOfTheRoot) {
  const Gaussian<3> estimate{Vector<3>(1.0, 2.0, 3.0), SquareMatrix<3>{{4, 2, 0}, {2, 10, 0}, {0, 0, 0}}};
  const SigmaPoints<Cubature<Quadratic<3>>> points(Cubature{Quadratic<3>{}}, estimate);
  const double root = std::sqrt(3.0);
  EXPECT_EQ(points.offsets().col(0), (root * Vector<3>(2.0, 1.0, 0.0)));
  EXPECT_EQ(points.offsets().col(1), (root * Vector<3>(0.0, 3.0, 0.0)));
  EXPECT_EQ(points.offsets().col(2), (Vector<3>::Zero())) << "nothing is unknown of the third";
  EXPECT_EQ(points.offsets().col(3), (-root * Vector<3>(2.0, 1.0, 0.0)));
}

}  // namespace
}  // namespace sigmax
