// Prediction and update of every member allocate nothing.
#include <gtest/gtest.h>

#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/kinematic_model.hpp>
#include <sigmax/estimation/observed.hpp>
#include <sigmax/estimation/ornstein_uhlenbeck.hpp>
#include <sigmax/estimation/sensors.hpp>

#include "estimation/members.hpp"
#include "support/allocations.hpp"

namespace sigmax {
namespace {

using support::allocations_of;

template <class Filter, class Estimate, class Measurement>
void nothing_is_allocated(const Filter& filter, const Estimate& start, const Measurement& z) {
  Estimate x = start;
  EXPECT_EQ(allocations_of([&] { predict(filter, x, 0.5, x); }), 0U) << filter.name();
  EXPECT_EQ(allocations_of([&] { update(filter, x, z, x); }), 0U) << filter.name();
  EXPECT_EQ(allocations_of([&] { prediction_covariance(filter, x, 0.5); }), 0U) << filter.name();
}

const auto radar = PolarSensor<3>::measurement({1e4, 0.7, 0.1}, {10.0, 0.002, 0.002});

template <class Motion>
void with_a_radar(const Motion& motion) {
  const Eigen::Index n = motion.size();
  EstimateOf<Motion> start;
  start.mean.setZero(n);
  start.mean.template head<3>() << 8e3, 6e3, 1e3;
  start.covariance.setIdentity(n, n);
  const Observed model{motion, PolarSensor<3>{}};
  nothing_is_allocated(Extended{model}, start, radar);
  nothing_is_allocated(Unscented{model}, start, radar);
  nothing_is_allocated(Cubature{model}, start, radar);
}

TEST(MemberAllocation, OverLinearMotionsIsNone) {
  with_a_radar(dwpa<3>(1.0));
  with_a_radar(singer<3>(0.1, 1.0));
  with_a_radar(KinematicModel<3, Eigen::Dynamic>{dwna<3>(1.0)});
  with_a_radar(AnyMotion<10, KinematicModel<3, 3>, CoordinatedTurn<3>>{dwpa<3>(1.0)});
}

TEST(MemberAllocation, OverATurnIsNone) {
  with_a_radar(CoordinatedTurn<3>{1.0, 0.01});
  with_a_radar(AnyMotion<10, KinematicModel<3, 3>, CoordinatedTurn<3>>{CoordinatedTurn<3>{1.0, 0.01}});
}

/// Has no Jacobians, so they are differentiated automatically.
struct Hidden : CoordinatedTurn<3> {
  using CoordinatedTurn<3>::CoordinatedTurn;
  void transition_jacobian() const {}
  void measurement_jacobian() const {}
};

TEST(MemberAllocation, OfAutomaticDifferentiationIsNone) {
  static_assert(!detail::GivesTransitionJacobian<Hidden> && !detail::GivesMeasurementJacobian<Hidden>);
  const Gaussian<7> start{Vector<7>(8e3, 6e3, 1e3, 10.0, 20.0, 1.0, 0.1), SquareMatrix<7>::Identity()};
  nothing_is_allocated(Extended{Hidden{1.0, 0.01}}, start,
                       Gaussian<3>{Vector<3>(8e3, 6e3, 1e3), SquareMatrix<3>::Identity()});
}

TEST(MemberAllocation, OfTheKalmanFilterIsNone) {
  Gaussian<9> start{Vector<9>::Zero(), SquareMatrix<9>::Identity()};
  nothing_is_allocated(singer<3>(0.1, 1.0), start, Gaussian<3>{Vector<3>(1.0, 2.0, 3.0), SquareMatrix<3>::Identity()});
}

}  // namespace
}  // namespace sigmax
