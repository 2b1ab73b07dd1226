#include <sigmax/estimation/sensors.hpp>

#include <gtest/gtest.h>

#include <sigmax/estimation/jacobian.hpp>
#include <sigmax/estimation/observed.hpp>

#include "support/matrices.hpp"

namespace sigmax {
namespace {

using support::generated_matrix;
using support::holds;
using support::near;
using support::near_matrix;
using support::number_between;
using support::require_near;
using support::require_near_matrix;

constexpr double pi = std::numbers::pi;

static_assert(PositionSensing<PositionSensor<1>>);
static_assert(PositionSensing<PolarSensor<2>>);
static_assert(PositionSensing<PolarSensor<3>>);
static_assert(PositionSensing<BearingSensor>);

TEST(Sensors, AnAngleIsWrapped) {
  EXPECT_PRED_FORMAT3(near, wrapped(3.5), 3.5 - 2.0 * pi, 1e-15);
  EXPECT_PRED_FORMAT3(near, wrapped(-3.5), 2.0 * pi - 3.5, 1e-15);
  EXPECT_EQ(wrapped(-1.0), -1.0);
  EXPECT_PRED_FORMAT3(near, wrapped(1.0 + 20.0 * pi), 1.0, 1e-13);
}

TEST(Sensors, ARadarSeesWhatToPolarSays) {
  holds([] {
    const Vector<3> position = 100.0 * generated_matrix<3, 1>(), origin = 100.0 * generated_matrix<3, 1>();
    const Polar seen = to_polar(position - origin);
    require_near_matrix(PolarSensor<3>{origin}.measure(position), Vector<3>(seen.range, seen.azimuth, seen.elevation),
                        1e-12);
    const Polar flat = to_polar({position(0) - origin(0), position(1) - origin(1), 0.0});
    require_near_matrix(PolarSensor<2>{origin.head<2>()}.measure(Vector<2>(position.head<2>())),
                        Vector<2>(flat.range, flat.azimuth), 1e-12);
    require_near_matrix(BearingSensor{origin.head<2>()}.measure(Vector<2>(position.head<2>())), Vector<1>(flat.azimuth),
                        1e-12);
  });
}

template <class Sensor>
void jacobian_is_the_derivative(const Sensor& sensor, const Vector<Sensor::axes>& position) {
  constexpr int N = Sensor::axes;
  constexpr int M = Sensor::measurement_size;
  const auto derivative =
      jacobian<M, M, N, N>([&](const DifferentiableVector<N>& p) { return sensor.measure(p); }, position);
  require_near_matrix(sensor.measurement_jacobian(position), derivative, 1e-12);
}

TEST(Sensors, JacobiansAreTheDerivatives) {
  holds([] {
    const Vector<3> origin = 100.0 * generated_matrix<3, 1>();
    Vector<3> position = origin + 100.0 * generated_matrix<3, 1>();
    position(1) = origin(1) + number_between(1.0, 100.0);
    jacobian_is_the_derivative(PositionSensor<3>{}, position);
    jacobian_is_the_derivative(PolarSensor<2>{origin.head<2>()}, position.head<2>());
    jacobian_is_the_derivative(PolarSensor<3>{origin}, position);
    jacobian_is_the_derivative(BearingSensor{origin.head<2>()}, position.head<2>());
  });
}

TEST(Sensors, DifferencesOfAzimuthsAreWrappedAndNothingElseIs) {
  EXPECT_PRED_FORMAT3(near_matrix,
                      PolarSensor<3>{}.measurement_difference(Vector<3>(10.0, 3.0, 0.5), Vector<3>(1.0, -3.0, -0.5)),
                      (Vector<3>(9.0, 6.0 - 2.0 * pi, 1.0)), 1e-15);
  EXPECT_PRED_FORMAT3(near_matrix, PolarSensor<2>{}.measurement_difference(Vector<2>(10.0, -3.0), Vector<2>(1.0, 3.0)),
                      (Vector<2>(9.0, 2.0 * pi - 6.0)), 1e-15);
  EXPECT_PRED_FORMAT3(near, BearingSensor{}.measurement_difference(Vector<1>(3.0), Vector<1>(-3.0))(0), 6.0 - 2.0 * pi,
                      1e-15);
}

TEST(Sensors, AMeasurementBringsItsVariances) {
  const auto z = PolarSensor<3>::measurement({1000.0, 0.1, 0.2}, {10.0, 0.002, 0.003});
  EXPECT_EQ(z.mean, (Vector<3>(1000.0, 0.1, 0.2)));
  EXPECT_PRED_FORMAT3(near_matrix, z.covariance, (SquareMatrix<3>{{100, 0, 0}, {0, 4e-6, 0}, {0, 0, 9e-6}}), 1e-18);
  const auto flat = PolarSensor<2>::measurement({1000.0, 0.1, 0.2}, {10.0, 0.002, 0.003});
  EXPECT_EQ(flat.mean, (Vector<2>(1000.0, 0.1)));
  EXPECT_EQ(flat.covariance, (z.covariance.topLeftCorner<2, 2>()));
}

}  // namespace
}  // namespace sigmax
