#include <sigmax/estimation/sensors.hpp>

#include <gtest/gtest.h>

#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/jacobian.hpp>

#include "support/matrices.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::generated_matrix;
using support::holds;
using support::near;
using support::near_matrix;
using support::number_between;
using support::require_near;
using support::require_near_matrix;
using support::throws;

constexpr double pi = std::numbers::pi;

using Dwna1 = IndependentAxes<1, DiscreteWhiteNoise<2>>;
using Dwna3 = IndependentAxes<3, DiscreteWhiteNoise<2>>;
static_assert(LinearSensorOf<PositionSensor<1>, Dwna1> && LinearSensorOf<PositionSensor<2>, Dwna3>);
static_assert(SensorOf<PolarSensor<2>, Dwna3> && !LinearSensorOf<PolarSensor<2>, Dwna3>);
static_assert(SensorOf<PolarSensor<3>, Dwna3>);
static_assert(SensorOf<BearingSensor, Dwna3>);
static_assert(LinearSensorOf<LinearSensor<2, 6>, Dwna3>);

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
void jacobian_is_the_derivative(const Sensor& sensor, const Vector<Sensor::seen_size>& position) {
  constexpr int N = Sensor::seen_size;
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

TEST(Sensors, APositionSensorSeesThePositionItself) {
  const Vector<3> position(1.0, 2.0, 3.0);
  EXPECT_EQ(PositionSensor<3>{}.measure(position), position);
  EXPECT_EQ(measurement_jacobian(dwna<3>(1.0), PositionSensor<3>{}, Vector<6>::Zero()),
            (RectangularMatrix<3, 6>::Identity()));
  const Gaussian<3> z{position, SquareMatrix<3>::Identity()};
  EXPECT_EQ(PositionSensor<3>{}.position(z).mean, position);
}

TEST(Sensors, APositionSensorMayMeasureFewerAxes) {
  holds([] {
    const auto motion = dwna<3>(2.0);
    const auto prior = support::generated_gaussian<6>();
    const auto z = support::generated_gaussian<2>();
    // The third coordinate tells nothing if its variance is immense.
    Gaussian<3> with_altitude{Vector<3>(z.mean(0), z.mean(1), 0.0), SquareMatrix<3>::Zero()};
    with_altitude.covariance.topLeftCorner<2, 2>() = z.covariance;
    with_altitude.covariance(2, 2) = 1e14;
    Gaussian<6> found, expected;
    update(motion, prior, z, PositionSensor<2>{}, found);
    update(motion, prior, with_altitude, expected);
    require_near_matrix(found.mean, expected.mean, 1e-10);
    require_near_matrix(found.covariance, expected.covariance, 1e-10);
  });
}

TEST(Sensors, APositionSensorIsTheLinearSensorWithItsMatrix) {
  holds([] {
    const auto prior = support::generated_gaussian<6>();
    const auto z = support::generated_gaussian<2>();
    RectangularMatrix<2, 3> H = RectangularMatrix<2, 3>::Identity();
    Gaussian<6> found, expected;
    const auto innovation = update(dwna<3>(2.0), prior, z, LinearSensor<2, 3>{H}, found);
    const auto same = update(dwna<3>(2.0), prior, z, PositionSensor<2>{}, expected);
    require_near_matrix(found.mean, expected.mean, 1e-11);
    require_near_matrix(found.covariance, expected.covariance, 1e-11);
    require_near(innovation.log_likelihood, same.log_likelihood, 1e-11);
  });
}

/// Six quantities at once, in another order and unit: the batch of two measurements of three.
TEST(Sensors, PositionAndVelocityAreMeasuredTogether) {
  holds([] {
    const auto prior = support::generated_gaussian<6>();
    const auto first = support::generated_gaussian<3>(), second = support::generated_gaussian<3>();
    RectangularMatrix<6, 6> H = RectangularMatrix<6, 6>::Zero();
    H.topRightCorner<3, 3>() = 2.0 * SquareMatrix<3>::Identity();
    H.bottomLeftCorner<3, 3>().setIdentity();
    Gaussian<6> z{Vector<6>::Zero(), SquareMatrix<6>::Zero()};
    z.mean << first.mean, second.mean;
    z.covariance.topLeftCorner<3, 3>() = first.covariance;
    z.covariance.bottomRightCorner<3, 3>() = second.covariance;
    Gaussian<6> together, one_by_one;
    const auto innovation = update(dwna<3>(2.0), prior, z, LinearSensor<6, 6>{H}, together);
    const auto of_velocity =
        update(dwna<3>(2.0), prior, first, LinearSensor<3, 6>{RectangularMatrix<3, 6>(H.topRows<3>())}, one_by_one);
    const auto of_position = update(dwna<3>(2.0), one_by_one, second, one_by_one);
    require_near_matrix(together.mean, one_by_one.mean, 1e-9);
    require_near_matrix(together.covariance, one_by_one.covariance, 1e-9);
    require_near(innovation.log_likelihood, of_velocity.log_likelihood + of_position.log_likelihood, 1e-9);
  });
}

TEST(Sensors, SomeComponentsAreMeasuredByThemselves) {
  const std::array<int, 3> places{5, 0, 1};
  const ComponentSensor<4> sensor{places};
  const auto motion = dwna<3>(2.0);
  RectangularMatrix<3, 6> H = RectangularMatrix<3, 6>::Zero();
  H(0, 5) = H(1, 0) = H(2, 1) = 1.0;
  EXPECT_EQ(measurement_matrix(motion, sensor), H);
  holds([&] {
    const auto prior = support::generated_gaussian<6>();
    const auto z = support::generated_gaussian<3>();
    Gaussian<6> found, expected;
    const auto innovation = update(motion, prior, {z.mean, z.covariance}, sensor, found);
    const auto same = update(motion, prior, z, LinearSensor<3, 6>{H}, expected);
    require_near_matrix(found.mean, expected.mean, 1e-11);
    require_near_matrix(found.covariance, expected.covariance, 1e-11);
    require_near(innovation.log_likelihood, same.log_likelihood, 1e-11);
  });
  EXPECT_TRUE(throws<std::invalid_argument>([&] { measurement_matrix(dwna<2>(1.0), sensor); }, {"6", "dwna", "4"}));
  EXPECT_TRUE(throws<std::invalid_argument>([] { ComponentSensor<2>{std::span<const int>{}}; }, {"0", "1 to 2"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { ComponentSensor<2>{places}; }, {"3", "1 to 2"}));
}

TEST(Sensors, ComponentsTellAPositionWhereAllAxesLead) {
  const auto z = Gaussian<Eigen::Dynamic, 4>{Vector<4>{1.0, 2.0, 3.0, 4.0}, SquareMatrix<4>::Identity() * 9.0};
  const auto told = [&](std::initializer_list<int> places, int axes) {
    return ComponentSensor<4>(std::span(places.begin(), places.size()), axes).position(z);
  };
  ASSERT_TRUE(told({0, 1, 2, 3}, 2));
  EXPECT_EQ(told({0, 1, 2, 3}, 2)->mean, (Vector<2>{1.0, 2.0}));
  EXPECT_EQ(told({0, 1, 2, 3}, 2)->covariance, (SquareMatrix<2>{{9.0, 0.0}, {0.0, 9.0}}));
  EXPECT_EQ(told({0, 1, 2, 5}, 3)->size(), 3);
  EXPECT_FALSE(told({0, 1, 3, 4}, 3));  // no height
  EXPECT_FALSE(told({2, 3}, 2));        // a velocity
  EXPECT_FALSE(told({1, 0, 2, 3}, 2));
  EXPECT_FALSE(told({0, 1, 2, 3}, 0));  // how many axes there are was not told
}

TEST(Sensors, ARadarTellsThePositionAsTheConversionDoes) {
  const Vector<3> origin(10.0, -20.0, 5.0);
  const Polar seen{1000.0, 0.4, 0.2}, sigma{10.0, 0.002, 0.003};
  const Gaussian<3> expected = to_cartesian(seen, sigma, Conversion::unbiased);
  const auto found = PolarSensor<3>{origin}.position(PolarSensor<3>::measurement(seen, sigma));
  EXPECT_PRED_FORMAT3(near_matrix, found.mean, expected.mean + origin, 1e-15);
  EXPECT_PRED_FORMAT3(near_matrix, found.covariance, expected.covariance, 1e-15);
  const Gaussian<3> flat = to_cartesian({1000.0, 0.4, 0.0}, {10.0, 0.002, 0.0}, Conversion::unbiased);
  const auto in_plane = PolarSensor<2>{}.position(PolarSensor<2>::measurement(seen, sigma));
  EXPECT_PRED_FORMAT3(near_matrix, in_plane.mean, flat.mean.head<2>(), 1e-15);
  EXPECT_PRED_FORMAT3(near_matrix, in_plane.covariance, (flat.covariance.topLeftCorner<2, 2>()), 1e-15);
}

}  // namespace
}  // namespace sigmax
