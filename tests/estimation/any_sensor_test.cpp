#include <sigmax/estimation/any_sensor.hpp>

#include <gtest/gtest.h>

#include <numbers>

#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/sensors.hpp>

#include "estimation/members.hpp"

namespace sigmax {
namespace {

using support::generated_gaussian;
using support::holds;
using support::near;
using support::require_near;
using support::require_near_gaussian;
using support::require_near_matrix;
using support::with_every_member;

using Any = AnySensor<PositionSensor<2>, PolarSensor<2>, BearingSensor, LinearSensor<3, 4>>;
using Turn = CoordinatedTurn<2>;

static_assert(Sensing<Any> && Any::measurement_size == Eigen::Dynamic && Any::max_measurement_size == 3);
static_assert(SensorOf<Any, Turn> && !LinearSensorOf<Any, Turn>);
static_assert(std::is_convertible_v<BearingSensor, Any> && !std::is_convertible_v<PositionSensor<3>, Any>);

/// Every member updates with the sensor as with that which it is.
template <class Sensor>
void updates_as(const Sensor& sensor) {
  holds([&] {
    constexpr int M = Sensor::measurement_size;
    const Turn turn{0.5, 0.01};
    auto prior = generated_gaussian<5>();
    prior.mean.head<2>() += Vector<2>(400.0, 300.0);  // away from the radar
    auto z = generated_gaussian<M>();
    z.mean += predicted_measurement(turn, sensor, prior.mean);
    const Any any = sensor;
    const MeasurementOf<Any> same{z.mean, z.covariance};
    with_every_member(turn, [&](const auto& member) {
      Gaussian<5> expected, found;
      const auto innovation = update(member, prior, z, sensor, expected);
      const auto of_any = update(member, prior, same, any, found);
      require_near_gaussian(found, expected);
      require_near_matrix(of_any.residual, innovation.residual, 1e-9);
      require_near_matrix(of_any.covariance, innovation.covariance, 1e-9);
      require_near(of_any.log_likelihood, innovation.log_likelihood, 1e-9);
    });
  });
}

TEST(AnySensor, UpdatesAsThePositionSensorThatItIs) { updates_as(PositionSensor<2>{}); }
TEST(AnySensor, UpdatesAsTheRadarThatItIs) { updates_as(PolarSensor<2>{Vector<2>(-30.0, 20.0)}); }
TEST(AnySensor, UpdatesAsTheBearingSensorThatItIs) { updates_as(BearingSensor{Vector<2>(-30.0, 20.0)}); }
TEST(AnySensor, UpdatesAsTheLinearSensorThatItIs) {
  updates_as(LinearSensor<3, 4>{RectangularMatrix<3, 4>{{1, 2, 0, 0}, {0, 1, 1, 0}, {0, 0, 1, -1}}});
}

TEST(AnySensor, WrapsTheAnglesOfTheSensorThatItIs) {
  const Any bearing = BearingSensor{}, position = PositionSensor<2>{};
  const Any::Measured a = Vector<1>(3.0), b = Vector<1>(-3.0);
  EXPECT_PRED_FORMAT3(near, bearing.measurement_difference(a, b)(0), 6.0 - 2.0 * std::numbers::pi, 1e-15);
  const Any::Measured p = Vector<2>(3.0, 0.0), q = Vector<2>(-3.0, 0.0);
  EXPECT_EQ(position.measurement_difference(p, q)(0), 6.0);
}

/// Says that its mean is 1, whatever the points are.
struct OneAlways : BearingSensor {
  using BearingSensor::BearingSensor;
  template <class Points, class Weights>
  Vector<1> measurement_mean(const Points&, const Weights&) const {
    return Vector<1>(1.0);
  }
};

TEST(AnySensor, AveragesAsTheSensorThatItIs) {
  const AnySensor<PositionSensor<2>, OneAlways, BearingSensor> one = OneAlways{}, angle = BearingSensor{},
                                                               position = PositionSensor<2>{};
  const Vector<2> weights(0.25, 0.75);
  const RectangularMatrix<1, 2> angles(3.0, -3.0);
  EXPECT_EQ(one.measurement_mean(angles, weights)(0), 1.0);
  EXPECT_PRED_FORMAT3(near, angle.measurement_mean(angles, weights)(0), 3.0 + 0.75 * (2.0 * std::numbers::pi - 6.0),
                      1e-15);
  const SquareMatrix<2> points{{3.0, -3.0}, {1.0, 5.0}};
  EXPECT_EQ(position.measurement_mean(points, weights), (Vector<2>(-1.5, 4.0)));

  const Gaussian<4> prior{Vector<4>(100.0, 50.0, 0.0, 0.0), SquareMatrix<4>::Identity()};
  Gaussian<4> x;
  const Gaussian<Eigen::Dynamic, 2> z{Vector<1>(0.5), SquareMatrix<1>(0.01)};
  EXPECT_PRED_FORMAT3(near, update(Unscented{dwna<2>(1.0)}, prior, z, one, x).residual(0), -0.5, 1e-15);
}

TEST(AnySensor, TellsThePositionIfTheSensorThatItIsDoes) {
  const MeasurementOf<Any> z{Vector<2>(100.0, 0.5), SquareMatrix<2>{{4.0, 0.0}, {0.0, 1e-4}}};
  const Any position = PositionSensor<2>{}, radar = PolarSensor<2>{Vector<2>(5.0, 6.0)}, bearing = BearingSensor{};
  EXPECT_EQ(position.position(z)->mean, (Vector<2>(100.0, 0.5)));
  const Gaussian<2> expected = PolarSensor<2>{Vector<2>(5.0, 6.0)}.position({z.mean, z.covariance});
  EXPECT_EQ(radar.position(z)->mean, expected.mean);
  EXPECT_EQ(radar.position(z)->covariance, expected.covariance);
  EXPECT_FALSE(bearing.position({Vector<1>(0.5), SquareMatrix<1>(1e-4)}).has_value());
}

}  // namespace
}  // namespace sigmax
