#include "estimation/restated.hpp"

namespace any_sensor_test {

static_assert(Sensing<AnySensor> && SensorOf<AnySensor, AnyModel> && SensorOf<AnySensor, CoordinatedTurn<2>>);
static_assert(AnySensor::measurement_size == Eigen::Dynamic && AnySensor::max_measurement_size == 6);
static_assert(std::is_convertible_v<BearingSensor, AnySensor>);
static_assert(!std::is_convertible_v<LinearSensor<7, 9>, AnySensor>, "more than six quantities");

const EstimateOf<AnyModel> start{Vector<5>(400.0, 300.0, 5.0, -3.0, 0.1), SquareMatrix<5>{{9.0, 1.0, 0.5, 0.0, 0.1},
                                                                                          {1.0, 8.0, 0.0, 0.3, 0.0},
                                                                                          {0.5, 0.0, 4.0, 0.0, 0.1},
                                                                                          {0.0, 0.3, 0.0, 3.0, 0.0},
                                                                                          {0.1, 0.0, 0.1, 0.0, 0.2}}};

/// Every member updates with the sensor as with that which it is.
template <class Sensor>
void expect_as(const Sensor& sensor, const MeasurementOf<Sensor>& z) {
  const AnySensor any = sensor;
  const MeasurementOf<AnySensor> same{z.mean, z.covariance};
  for (const AnyModel& member : every_member(CoordinatedTurn<2>{0.5, 0.01})) {
    EstimateOf<AnyModel> expected, found;
    const auto innovation = update(member, start, z, sensor, expected);
    const auto of_any = update(member, start, same, any, found);
    EXPECT_CLOSE(found, expected, 0.0);
    EXPECT_EQ(of_any.residual, innovation.residual);
    EXPECT_EQ(of_any.covariance, innovation.covariance);
    EXPECT_EQ(of_any.log_likelihood, innovation.log_likelihood);
    const auto linear = linearised_measurement(member, start, z, sensor);
    EXPECT_EQ(linearised_measurement(member, start, same, any).H, linear.H);

    // A measurement of another number of quantities is refused.
    const Vector<Eigen::Dynamic, 6> fewer = same.mean.head(z.size() - 1);
    const Vector<Eigen::Dynamic, 6> more = Vector<Eigen::Dynamic, 6>::Zero(z.size() + 1);
    for (const auto& other : {fewer, more}) {
      const MeasurementOf<AnySensor> wrong{other,
                                           SquareMatrix<Eigen::Dynamic, 6>::Identity(other.size(), other.size())};
      const std::string words =
          "a measurement of " + std::to_string(other.size()) + " quantities by a sensor of " + std::to_string(z.size());
      EXPECT_INVALID((words), update(member, start, wrong, any, found));
      EXPECT_INVALID((words), linearised_measurement(member, start, wrong, any));
    }
  }
}

/// Large, and sees the first component.
struct Large {
  static constexpr int seen_size = 1;
  static constexpr int measurement_size = 1;
  std::array<double, 9> numbers{2.0};
  Vector<1> measure(const Vector<1>& x) const { return numbers[0] * x; }
  SquareMatrix<1> measurement_jacobian(const Vector<1>&) const { return SquareMatrix<1>(numbers[0]); }
};

TEST(AnySensor, UpdatesAsTheSensorThatItIs) {
  const std::array<int, 2> places{3, 0};
  const Vector<2> origin(-30.0, 20.0);
  const Gaussian<1> angle{Vector<1>(0.6), SquareMatrix<1>(1e-3)}, number{Vector<1>(0.02), SquareMatrix<1>(0.1)};
  const Gaussian<2> position{Vector<2>(403.0, 298.0), SquareMatrix<2>{{4.0, 0.5}, {0.5, 2.0}}};
  const Gaussian<2> polar{Vector<2>(510.0, 0.6), SquareMatrix<2>{{4.0, 0.0}, {0.0, 1e-3}}};
  const Gaussian<3> three{Vector<3>(505.0, 0.6, 2.0), SquareMatrix<3>{{4.0, 0, 0}, {0, 1e-3, 0}, {0, 0, 1.0}}};
  expect_as(PositionSensor<2>{}, position);
  expect_as(PolarSensor<2>{origin}, polar);
  expect_as(BearingSensor{origin}, angle);
  expect_as(DopplerSensor<2>{origin}, three);
  expect_as(LinearSensor<3, 4>{RectangularMatrix<3, 4>{{1, 2, 0, 0}, {0, 1, 1, 0}, {0, 0, 1, -1}}}, three);
  expect_as(ComponentSensor<2>{places}, {Vector<2>(2.0, 401.0), position.covariance});
  expect_as(SquaredLast{}, number);
  expect_as(Large{}, Gaussian<1>{Vector<1>(800.0), SquareMatrix<1>(3.0)});
}

TEST(AnySensor, MayBeAskedWithATypedModelUnlessItAsksBack) {
  const CoordinatedTurn<2> turn{0.5, 0.01};
  const Gaussian<5> prior{start.mean, start.covariance};
  const MeasurementOf<AnySensor> z{Vector<1>(0.6), SquareMatrix<1>(1e-3)};
  EXPECT_EQ(update(Extended{turn}, prior, z, AnySensor{BearingSensor{}}).mean,
            update(Extended{turn}, prior, {z.mean, z.covariance}, BearingSensor{}).mean);
  EXPECT_INVALID(("asks its model", "AnyModel"), update(Extended{turn}, prior, z, AnySensor{SquaredLast{}}));
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
  EstimateOf<AnyModel> x;
  const MeasurementOf<AnySensor> z{Vector<1>(0.5), SquareMatrix<1>(0.01)};
  const auto innovation =
      update(AnyModel{Unscented{CoordinatedTurn<2>{0.5, 0.01}}}, start, z, AnySensor{OneAlways{}}, x);
  EXPECT_CLOSE(innovation.residual(0), -0.5, 1e-15);
}

TEST(AnySensor, TellsThePositionIfTheSensorThatItIsDoes) {
  const MeasurementOf<AnySensor> z{Vector<2>(100.0, 0.5), SquareMatrix<2>{{4.0, 0.0}, {0.0, 1e-4}}};
  const PolarSensor<2> radar{Vector<2>(5.0, 6.0)};
  const Gaussian<2> polar = radar.position({z.mean, z.covariance});
  Vector<3> mean;
  double covariance[9];
  const auto told = [&](const AnySensor& sensor) { return sensor.position(detail::view(z), mean.data(), covariance); };
  ASSERT_EQ(told(PositionSensor<2>{}), 2);
  EXPECT_EQ(mean.head<2>(), z.mean);
  ASSERT_EQ(told(radar), 2);
  EXPECT_EQ(mean.head<2>(), polar.mean);
  EXPECT_EQ((Eigen::Map<const SquareMatrix<2>>(covariance)), polar.covariance);
  const std::array<int, 2> both{0, 1}, velocity{2, 3};
  EXPECT_EQ(told(ComponentSensor<2>(both, 2)), 2);
  EXPECT_EQ(told(ComponentSensor<2>(velocity, 2)), 0);
  EXPECT_EQ(told(LinearSensor<2, 2>{SquareMatrix<2>::Identity()}), 0);
  EXPECT_INVALID(("of 2 quantities", "of 3"), told(PositionSensor<3>{}));
  EXPECT_INVALID(("of 2 quantities", "of 1"), told(PositionSensor<1>{}));
}

}  // namespace any_sensor_test
