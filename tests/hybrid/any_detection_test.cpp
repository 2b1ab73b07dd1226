#include "support/sigmax.hpp"

namespace any_detection_test {

TEST(AnyDetection, HoldsWhatWasMeasuredWithItsCovarianceOrItsVariancesAlone) {
  const AnyDetection two = AnyDetection::position(0.5, Numbers{1.0, 2.0}, Numbers{4.0, 1.0, 1.0, 9.0});
  EXPECT_EQ(two.time, 0.5);
  EXPECT_EQ(two.tag, 0U);
  EXPECT_EQ(two.sensor, AnyDetection::Sensor::position);
  EXPECT_EQ(two.size, 2);
  EXPECT_EQ(two.z, (std::array<double, 6>{1.0, 2.0}));
  EXPECT_EQ(two.covariance, (std::array<double, 36>{4.0, 1.0, 1.0, 9.0}));
  EXPECT_EQ(two.variance(1), 9.0);
  const AnyDetection three = AnyDetection::position(0.0, Numbers{1.0, 2.0, 3.0}, Numbers{4.0, 9.0, 16.0});
  EXPECT_EQ(three.covariance, (std::array<double, 36>{4.0, 0.0, 0.0, 0.0, 9.0, 0.0, 0.0, 0.0, 16.0}));
  EXPECT_EQ(AnyDetection::position(0.5, Numbers{1.0}, Numbers{4.0}).variance(0), 4.0);
}

TEST(AnyDetection, OfARadarAndOfABearingKnowWhereTheSensorStands) {
  const std::array<double, 3> radar = {7.0, 8.0, 9.0};
  const AnyDetection polar = AnyDetection::polar(1.0, Numbers{100.0, 0.1, 0.2}, Numbers{1.0, 2.0, 3.0}, radar);
  EXPECT_EQ(polar.sensor, AnyDetection::Sensor::polar);
  EXPECT_EQ(polar.origin, radar);
  const AnyDetection doppler = AnyDetection::doppler(1.0, Numbers{100.0, 0.1, 5.0}, Numbers{1.0, 2.0, 3.0}, radar);
  EXPECT_EQ(doppler.sensor, AnyDetection::Sensor::doppler);
  EXPECT_EQ(doppler.size, 3);
  EXPECT_EQ(doppler.origin, radar);
  const AnyDetection bearing = AnyDetection::bearing(1.0, radians(0.1), radians(0.5), radar);
  EXPECT_EQ(bearing.sensor, AnyDetection::Sensor::bearing);
  EXPECT_EQ(bearing.size, 1);
  EXPECT_EQ(bearing.z[0], 0.1);
  EXPECT_EQ(bearing.variance(0), 0.25);
  EXPECT_EQ(bearing.origin, radar);
  EXPECT_EQ(AnyDetection::polar(1.0, Numbers{100.0, 0.1}, Numbers{1.0, 2.0}).origin, (std::array<double, 3>{}));
}

TEST(AnyDetection, OfComponentsSaysWhichTheyAre) {
  const AnyDetection detection =
      AnyDetection::components(2.0, std::array{2, 3}, Numbers{100.0, 5.0}, Numbers{25.0, 1.0});
  EXPECT_EQ(detection.sensor, AnyDetection::Sensor::components);
  EXPECT_EQ(detection.places, (std::array<int, 6>{2, 3}));
  EXPECT_EQ(detection.variance(1), 1.0);
}

TEST(AnyDetection, OfAMissedMeasurementHasATimeAlone) {
  const AnyDetection detection = AnyDetection::missed(3.0);
  EXPECT_EQ(detection.time, 3.0);
  EXPECT_EQ(detection.sensor, AnyDetection::Sensor::none);
  EXPECT_EQ(detection.size, 0);
}

TEST(AnyDetection, RefusesWhatNoSensorMeasures) {
  const Numbers none, one(1), two(2), three(3), four(4), five(5), seven(7);
  EXPECT_INVALID(("0 measured quantities", "1 to 3"), AnyDetection::position(0.0, none, none));
  EXPECT_INVALID(("4 measured quantities", "1 to 3"), AnyDetection::position(0.0, four, four));
  EXPECT_INVALID(("1 measured", "2 to 3"), AnyDetection::polar(0.0, one, one));
  EXPECT_INVALID(("2 measured", "3 to 4"), AnyDetection::doppler(0.0, two, two));
  EXPECT_INVALID(("7 measured", "1 to 6"), AnyDetection::components(0.0, std::array<int, 7>{}, seven, seven));
  EXPECT_INVALID(("1 places", "2 measured"), AnyDetection::components(0.0, std::array{0}, two, two));
  EXPECT_INVALID(("5 numbers", "3 variances or 9"), AnyDetection::position(0.0, three, five));
}

}  // namespace any_detection_test
