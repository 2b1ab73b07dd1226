#include "support/sigmax.hpp"

namespace radar_test {

TEST(Radar, AzimuthTurnsFromXToYAndElevationRisesFromTheGround) {
  EXPECT_CLOSE(to_cartesian(Polar{100.0}), (Vector<3>{100, 0, 0}), 1e-12);
  EXPECT_CLOSE(to_cartesian(Polar{100.0, degrees(90)}), (Vector<3>{0, 100, 0}), 1e-12);
  EXPECT_CLOSE(to_cartesian(Polar{100.0, radians(0.3), degrees(90)}), (Vector<3>{0, 0, 100}), 1e-12);
  EXPECT_CLOSE(to_cartesian(Polar{2.0, degrees(45), degrees(45)}), (Vector<3>{1, 1, std::sqrt(2.0)}), 1e-15);
}

PROPERTY(Radar, PolarAndCartesianAreInverse) {
  const Polar seen{number_between(1.0, 1e5), radians(number_between(-3.1, 3.1)), radians(number_between(-1.5, 1.5))};
  const Polar again = to_polar(to_cartesian(seen));
  require_near(again.range, seen.range, 1e-12);
  require_near(again.azimuth.radians(), seen.azimuth.radians(), 1e-12);
  require_near(again.elevation.radians(), seen.elevation.radians(), 1e-12);
}

PROPERTY(Radar, ItsCovarianceIsThePrintedOneElementByElement) {
  const Polar seen{number_between(1.0, 2e5), radians(number_between(-3.2, 3.2)), radians(number_between(-1.6, 1.6))};
  const Polar sigma{number_between(0.0, 200.0), radians(number_between(0.0, 0.03)), radians(number_between(0.0, 0.03))};
  const auto found = to_cartesian(seen, sigma);
  const auto printed =
      restatement::standard_conversion(seen.range, seen.azimuth.radians(), seen.elevation.radians(), sigma.range,
                                       sigma.azimuth.radians(), sigma.elevation.radians());
  require_near(entries(found.mean), printed.z, 1e-9);
  // Entries cancel, so the largest of them sets the scale.
  const double scale = std::max(1.0, found.covariance.cwiseAbs().maxCoeff());
  require_near(found.covariance / scale, (1.0 / scale) * printed.R, 1e-12);
  RC_ASSERT(found.covariance == found.covariance.transpose());
  RC_ASSERT(found.covariance == to_cartesian(seen, sigma, Conversion::standard).covariance);
}

TEST(Radar, TheValidityOfTheConversionIsThatOfTheScenarios) {
  const double near_range = Vector<3>{12e3, 8e3, 1e3}.norm();
  const double far_range = Vector<3>{120e3, 80e3, 20e3}.norm();
  EXPECT_NEAR(conversion_validity(near_range, {10.0, degrees(0.1), degrees(0.1)}), 0.0044, 5e-5);
  EXPECT_NEAR(conversion_validity(far_range, {100.0, degrees(0.9), degrees(0.9)}), 0.36, 5e-3);
  EXPECT_NEAR(conversion_validity(far_range, {200.0, degrees(1.8), degrees(1.8)}), 0.72, 5e-3);
}

/// In the plane what a radar sees is the same whatever its elevation; a bare number is no angle.
TEST(Radar, InThePlaneThereIsNoElevation) {
  const Polar seen{1000.0, degrees(30), degrees(10)}, sigma{5.0, degrees(1), degrees(2)};
  EXPECT_CLOSE(to_cartesian<2>(seen), (Vector<2>{500.0 * std::sqrt(3.0), 500.0}), 1e-12);
  const Gaussian<3> flat = to_cartesian({1000.0, degrees(30)}, {5.0, degrees(1)}, Conversion::debiased);
  const Gaussian<2> found = to_cartesian<2>(seen, sigma, Conversion::debiased);
  EXPECT_EQ(found.mean, flat.mean.head<2>());
  EXPECT_EQ(found.covariance, (flat.covariance.topLeftCorner<2, 2>()));
  static_assert(!std::is_constructible_v<Angle, double> && !std::is_convertible_v<double, Angle>);
  EXPECT_CLOSE(degrees(90).radians(), std::numbers::pi / 2, 1e-15);
  EXPECT_CLOSE(radians(1.0).degrees(), 180.0 / std::numbers::pi, 1e-15);
}

TEST(Radar, RefusesARangeThatIsNotPositiveAndANegativeDeviation) {
  const Polar there{10.0, radians(0.1), radians(0.1)}, good{10.0, radians(0.001), radians(0.001)};
  for (const auto how : {Conversion::standard, Conversion::unbiased, Conversion::debiased}) {
    for (const double range : {0.0, -5.0, not_a_number})
      EXPECT_INVALID(("range", std::to_string(range)), to_cartesian({range, radians(0.1), radians(0.1)}, good, how));
    for (const Polar& sigma : {Polar{-1.0}, Polar{1.0, radians(-1e-3)}, Polar{1.0, Angle{}, radians(-1e-3)}})
      EXPECT_INVALID(("deviations"), to_cartesian(there, sigma, how));
  }
}

}  // namespace radar_test
