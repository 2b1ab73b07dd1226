// Prediction and update of every member allocate nothing.
#include <gtest/gtest.h>

#include <sigmax/estimation/any_member.hpp>
#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/estimation/any_sensor.hpp>
#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/ornstein_uhlenbeck.hpp>
#include <sigmax/estimation/sensors.hpp>

#include "estimation/members.hpp"
#include "support/allocations.hpp"

namespace sigmax {
namespace {

using support::allocations_of;

template <class Filter, class Sensor>
void nothing_is_allocated(const Filter& filter, const EstimateOf<Filter>& start, const MeasurementOf<Sensor>& z,
                          const Sensor& sensor) {
  EstimateOf<Filter> x = start;
  EXPECT_EQ(allocations_of([&] { predict(filter, x, 0.5, x); }), 0U) << filter.name();
  EXPECT_EQ(allocations_of([&] { update(filter, x, z, sensor, x); }), 0U) << filter.name();
  EXPECT_EQ(allocations_of([&] { prediction_covariance(filter, x, 0.5); }), 0U) << filter.name();
}

const auto radar = PolarSensor<3>::measurement({1e4, 0.7, 0.1}, {10.0, 0.002, 0.002});

template <class Moves>
void with_a_radar(const Moves& motion) {
  const Eigen::Index n = motion.size();
  EstimateOf<Moves> start;
  start.mean.setZero(n);
  start.mean.template head<3>() << 8e3, 6e3, 1e3;
  start.covariance.setIdentity(n, n);
  const PolarSensor<3> sensor;
  nothing_is_allocated(Extended{motion}, start, radar, sensor);
  nothing_is_allocated(Unscented{motion}, start, radar, sensor);
  nothing_is_allocated(Cubature{motion}, start, radar, sensor);
  const AnySensor<PositionSensor<3>, PolarSensor<3>, BearingSensor> any = sensor;
  const MeasurementOf<decltype(any)> z{radar.mean, radar.covariance};
  nothing_is_allocated(AnyMember<Moves>{Extended{motion}}, start, z, any);
  nothing_is_allocated(AnyMember<Moves>{Unscented{motion}}, start, z, any);
}

TEST(MemberAllocation, OverLinearMotionsIsNone) {
  with_a_radar(dwpa<3>(1.0));
  with_a_radar(singer<3>(0.1, 1.0));
  with_a_radar(AnyMotion<10, IndependentAxes<3, DiscreteWhiteNoise<3>>, CoordinatedTurn<3>>{dwpa<3>(1.0)});
}

TEST(MemberAllocation, OverATurnIsNone) {
  with_a_radar(CoordinatedTurn<3>{1.0, 0.01});
  with_a_radar(
      AnyMotion<10, IndependentAxes<3, DiscreteWhiteNoise<3>>, CoordinatedTurn<3>>{CoordinatedTurn<3>{1.0, 0.01}});
}

/// Have no Jacobians, so they are differentiated automatically.
struct HiddenTurn : CoordinatedTurn<3> {
  using CoordinatedTurn<3>::CoordinatedTurn;
  void transition_jacobian() const {}
};
struct HiddenRadar : PolarSensor<3> {
  using PolarSensor<3>::PolarSensor;
  void measurement_jacobian() const {}
};
template <class Moves>
concept GivesTransitionJacobian = requires(const Moves& motion, const StateOf<Moves>& x) {
  motion.transition_jacobian(x, 1.0);
};
template <class Sensor>
concept GivesMeasurementJacobian = requires(const Sensor& sensor, const Vector<3>& p) {
  sensor.measurement_jacobian(p);
};
static_assert(!GivesTransitionJacobian<HiddenTurn> && !GivesMeasurementJacobian<HiddenRadar>);

TEST(MemberAllocation, OfAutomaticDifferentiationIsNone) {
  const Gaussian<7> start{Vector<7>(8e3, 6e3, 1e3, 10.0, 20.0, 1.0, 0.1), SquareMatrix<7>::Identity()};
  nothing_is_allocated(Extended{HiddenTurn{1.0, 0.01}}, start, radar, HiddenRadar{});
}

TEST(MemberAllocation, OfTheKalmanFilterIsNone) {
  Gaussian<9> start{Vector<9>::Zero(), SquareMatrix<9>::Identity()};
  nothing_is_allocated(singer<3>(0.1, 1.0), start, Gaussian<3>{Vector<3>(1.0, 2.0, 3.0), SquareMatrix<3>::Identity()},
                       PositionSensor<3>{});
  nothing_is_allocated(singer<3>(0.1, 1.0), start, Gaussian<2>{Vector<2>(1.0, 2.0), SquareMatrix<2>::Identity()},
                       LinearSensor<2, 6>{RectangularMatrix<2, 6>::Ones()});
}

}  // namespace
}  // namespace sigmax
