#include "support/sigmax.hpp"

namespace doppler_sensor_test {

static_assert(SensorOf<DopplerSensor<2>, IndependentAxes<2, DiscreteWhiteNoise<2>>>);
static_assert(SensorOf<DopplerSensor<3>, IndependentAxes<3, DiscreteWhiteNoise<3>>>);
static_assert(!SensorOf<DopplerSensor<3>, IndependentAxes<2, DiscreteWhiteNoise<3>>>);

PROPERTY(DopplerSensor, SeesWhatARadarSeesAndHowFastTheRangeGrows) {
  const Vector<3> origin = 100.0 * generated_matrix<3, 1>();
  Vector<6> x = 20.0 * generated_matrix<6, 1>();
  x.head<3>() = origin + 100.0 * generated_matrix<3, 1>();
  x(1) += 200.0;
  const DopplerSensor<3> sensor{origin};
  const Vector<4> seen = sensor.measure(x);
  require_near(seen.head<3>(), PolarSensor<3>{origin}.measure(x.head<3>()), 1e-12);
  constexpr double h = 1e-4;  // s, on either side
  const auto range_in = [&](double dt) { return (x.head<3>() + dt * x.tail<3>() - origin).norm(); };
  require_near(seen(3), (range_in(h) - range_in(-h)) / (2.0 * h), 1e-7);
}

PROPERTY(SlantSensor, SeesTheRangeAndTheAzimuthOfARadar) {
  const Vector<3> origin = 100.0 * generated_matrix<3, 1>(), x = origin + 100.0 * generated_matrix<3, 1>();
  if ((x - origin).head<2>().norm() < 1.0) return;
  double z[2], H[6], all_z[3], all_H[9];
  SlantSensor{origin}.compute(x.data(), 2, z, H);
  PolarSensor<3>{origin}.compute(x.data(), 3, all_z, all_H);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(z[i], all_z[i]);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(H[i + 2 * k], all_H[i + 3 * k]);
  }
}

TEST(DopplerSensor, ATargetThatComesStraightInHasItsSpeedAndOneThatCirclesNone) {
  const DopplerSensor<2> sensor{Vector<2>(0.0, 100.0)};
  EXPECT_CLOSE(sensor.measure(Vector<4>(300.0, 500.0, -30.0, -40.0)), (Vector<3>(500.0, std::atan2(4.0, 3.0), -50.0)),
               1e-14);
  EXPECT_CLOSE(sensor.measure(Vector<4>(300.0, 500.0, -40.0, 30.0))(2), 0.0, 1e-14);
}

TEST(DopplerSensor, DifferencesOfAzimuthsAreWrappedAndNothingElseIs) {
  EXPECT_CLOSE(DopplerSensor<2>{}.measurement_difference(Vector<3>(10.0, 3.0, 9.0), Vector<3>(1.0, -3.0, -9.0)),
               (Vector<3>(9.0, 6.0 - 2.0 * std::numbers::pi, 18.0)), 1e-15);
}

TEST(DopplerSensor, TellsThePositionAsARadarDoes) {
  const Gaussian<3> z{Vector<3>(1000.0, 0.4, -20.0),
                      SquareMatrix<3>{{100.0, 0.0, 0.0}, {0.0, 4e-6, 0.0}, {0.0, 0.0, 1.0}}};
  const Vector<2> origin(10.0, -20.0);
  const Gaussian<2> expected = PolarSensor<2>{origin}.position({z.mean.head<2>(), z.covariance.topLeftCorner<2, 2>()});
  EXPECT_EQ(DopplerSensor<2>{origin}.position(z).mean, expected.mean);
  EXPECT_EQ(DopplerSensor<2>{origin}.position(z).covariance, expected.covariance);
  EXPECT_EQ(DopplerSensor<2>{origin}.origin(), origin);
}

}  // namespace doppler_sensor_test
