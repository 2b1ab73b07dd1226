#include "support/sigmax.hpp"

namespace sensors_test {

constexpr double pi = std::numbers::pi;
const auto motion = dwna<3>(2.0);

PROPERTY(Sensors, ARadarSeesWhatToPolarSays) {
  const Vector<3> position = 100.0 * generated_matrix<3, 1>(), origin = 100.0 * generated_matrix<3, 1>();
  const Polar seen = to_polar(position - origin);
  require_near(PolarSensor<3>{origin}.measure(position),
               Vector<3>(seen.range, seen.azimuth.radians(), seen.elevation.radians()), 1e-12);
  const double ground = std::hypot(position(0) - origin(0), position(1) - origin(1));
  require_near(PolarSensor<2>{origin.head<2>()}.measure(position.head<2>()), Vector<2>(ground, seen.azimuth.radians()),
               1e-12);
  require_near(BearingSensor{origin.head<2>()}.measure(position.head<2>())(0), seen.azimuth.radians(), 1e-12);
}

/// Differences over 2h, h small.
template <class Sensor>
void require_derivative(const Sensor& sensor, const Vector<Sensor::seen_size>& x) {
  constexpr double h = 1e-4;
  const auto H = sensor.measurement_jacobian(x);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Vector<Sensor::seen_size> step = h * Vector<Sensor::seen_size>::Unit(i);
    require_near(H.col(i), (sensor.measure(x + step) - sensor.measure(x - step)) / (2.0 * h), 1e-7);
  }
}

PROPERTY(Sensors, JacobiansAreTheDerivatives) {
  const Vector<3> origin = 100.0 * generated_matrix<3, 1>();
  Vector<3> position = origin + 100.0 * generated_matrix<3, 1>();
  position(1) = origin(1) + number_between(10.0, 100.0);
  require_derivative(PolarSensor<2>{origin.head<2>()}, position.head<2>());
  require_derivative(PolarSensor<3>{origin}, position);
  require_derivative(BearingSensor{origin.head<2>()}, position.head<2>());
  const Vector<3> v = 20.0 * generated_matrix<3, 1>();
  require_derivative(DopplerSensor<2>{origin.head<2>()}, Vector<4>(position(0), position(1), v(0), v(1)));
  require_derivative(DopplerSensor<3>{origin}, (Vector<6>() << position, v).finished());
}

TEST(Sensors, DifferencesOfAzimuthsAreWrappedAndNothingElseIs) {
  EXPECT_CLOSE(PolarSensor<3>{}.measurement_difference(Vector<3>(10.0, 3.0, 0.5), Vector<3>(1.0, -3.0, -0.5)),
               (Vector<3>(9.0, 6.0 - 2.0 * pi, 1.0)), 1e-15);
  EXPECT_CLOSE(PolarSensor<2>{}.measurement_difference(Vector<2>(10.0, -3.0), Vector<2>(1.0, 3.0)),
               (Vector<2>(9.0, 2.0 * pi - 6.0)), 1e-15);
  EXPECT_CLOSE(BearingSensor{}.measurement_difference(Vector<1>(3.0), Vector<1>(-3.0))(0), 6.0 - 2.0 * pi, 1e-15);
}

TEST(Sensors, AMeasurementBringsItsVariances) {
  const Polar seen{1000.0, radians(0.1), radians(0.2)}, sigma{10.0, radians(0.002), radians(0.003)};
  const auto z = PolarSensor<3>{}.measurement(seen, sigma).z;
  EXPECT_EQ(z.mean, (Vector<3>(1000.0, 0.1, 0.2)));
  EXPECT_CLOSE(z.covariance, (SquareMatrix<3>{{100, 0, 0}, {0, 4e-6, 0}, {0, 0, 9e-6}}), 1e-18);
  const auto flat = PolarSensor<2>{}.measurement(seen, sigma).z;
  EXPECT_EQ(flat.mean, (Vector<2>(1000.0, 0.1)));
  EXPECT_EQ(flat.covariance, (z.covariance.topLeftCorner<2, 2>()));
}

TEST(Sensors, APositionSensorSeesThePositionItself) {
  const Gaussian<3> z{Vector<3>(1.0, 2.0, 3.0), SquareMatrix<3>::Identity()};
  EXPECT_EQ(PositionSensor<3>{}.measure(z.mean), z.mean);
  EXPECT_EQ(PositionSensor<3>{}.position(z).mean, z.mean);
}

/// A position, components and any matrix are ways to say the same.
TEST(Sensors, LinearOnesAreThoseOfTheirMatrices) {
  const std::array<int, 3> places{0, 1, 2}, others{5, 0, 1};
  RectangularMatrix<3, 6> H = RectangularMatrix<3, 6>::Zero();
  H(0, 5) = H(1, 0) = H(2, 1) = 1.0;
  holds([&] {
    const auto prior = generated_gaussian<6>();
    const auto z = generated_gaussian<3>();
    const auto same = [&](const auto& sensor, const auto& matrix) {
      Gaussian<6> found, expected;
      const auto innovation = update(motion, prior, {z.mean, z.covariance}, sensor, found);
      const auto of_matrix = update(motion, prior, z, matrix, expected);
      require_near(found, expected, 1e-11);
      require_near(innovation.log_likelihood, of_matrix.log_likelihood, 1e-11);
    };
    same(PositionSensor<3>{}, LinearSensor<3, 3>{SquareMatrix<3>::Identity()});
    same(ComponentSensor<4>{places}, LinearSensor<3, 3>{SquareMatrix<3>::Identity()});
    same(ComponentSensor<4>{others}, LinearSensor<3, 6>{H});
  });
}

TEST(Sensors, ComponentsAreCountedAndHaveTheirPlaces) {
  const std::array<int, 3> places{5, 0, 1};
  const std::array<int, 1> none{-1};
  EXPECT_INVALID(("0", "1 to 2"), ComponentSensor<2>{std::span<const int>{}});
  EXPECT_INVALID(("3", "1 to 2"), ComponentSensor<2>{places});
  EXPECT_INVALID(("component 0"), ComponentSensor<2>{none});
  const ComponentSensor<4> sensor{places};
  const Gaussian<4> plane{Vector<4>::Zero(), SquareMatrix<4>::Identity()};
  const Gaussian<6> space{Vector<6>::Zero(), SquareMatrix<6>::Identity()};
  const MeasurementOf<ComponentSensor<4>> two{Vector<2>::Zero(), SquareMatrix<2>::Identity()};
  EXPECT_EQ(sensor.seen(), 6);
  EXPECT_INVALID(("sees 6", "dwna", "4"), update(dwna<2>(1.0), plane, two, sensor));
  EXPECT_INVALID(("of 2 quantities", "of 3"), update(motion, space, two, sensor));
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
  EXPECT_FALSE(told({0, 1}, 3));
  EXPECT_FALSE(told({0, 1, 2, 3}, 0));  // how many axes there are was not told
  EXPECT_INVALID(("of 4 quantities", "of 2"), told({0, 1}, 2));
}

TEST(Sensors, ARadarTellsThePositionAsTheConversionDoes) {
  const Vector<3> origin(10.0, -20.0, 5.0);
  const Polar seen{1000.0, radians(0.4), radians(0.2)}, sigma{10.0, radians(0.002), radians(0.003)};
  const Gaussian<3> expected = to_cartesian(seen, sigma, Conversion::unbiased);
  const auto found = PolarSensor<3>{origin}.position(PolarSensor<3>{}.measurement(seen, sigma).z);
  EXPECT_CLOSE(found.mean, expected.mean + origin, 1e-15);
  EXPECT_CLOSE(found.covariance, expected.covariance, 1e-15);
  EXPECT_EQ(PolarSensor<3>{origin}.origin(), origin);
  EXPECT_EQ(BearingSensor{origin.head<2>()}.origin(), origin.head<2>());
  const Gaussian<2> flat = to_cartesian<2>(seen, sigma, Conversion::unbiased);
  const auto in_plane = PolarSensor<2>{}.position(PolarSensor<2>{}.measurement(seen, sigma).z);
  EXPECT_CLOSE(in_plane.mean, flat.mean, 1e-15);
  EXPECT_CLOSE(in_plane.covariance, flat.covariance, 1e-15);
}

/// Knows that its range is ten too short, and its slope by heart.
struct Biased : PolarSensor<2> {
  using PolarSensor::PolarSensor;
  Vector<2> measure(const Vector<2>& position) const { return PolarSensor::measure(position) - Vector<2>(10.0, 0.0); }
  SquareMatrix<2> measurement_jacobian(const Vector<2>&) const { return SquareMatrix<2>{{0.5, 0.0}, {0.0, 0.25}}; }
};

TEST(Sensors, ADerivedOneIsAskedByItsOwnFunctions) {
  const Gaussian<4> prior{Vector<4>(30.0, 40.0, 0.0, 0.0), SquareMatrix<4>::Identity()};
  const Gaussian<2> z{Vector<2>(40.0, std::atan2(4.0, 3.0)), SquareMatrix<2>::Identity()};
  Gaussian<4> x;
  const auto innovation = update(Extended{dwna<2>(1.0)}, prior, z, Biased{}, x);
  EXPECT_CLOSE(innovation.residual, Vector<2>::Zero(), 1e-14);
  EXPECT_EQ(innovation.covariance, (SquareMatrix<2>{{1.25, 0.0}, {0.0, 1.0625}}));
  EXPECT_NEAR(update(Cubature{dwna<2>(1.0)}, prior, z, Biased{}, x).residual(0), 0.0, 0.1);
}

}  // namespace sensors_test
