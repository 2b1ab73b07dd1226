#include <sigmax/estimation/radar.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "support/matrices.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::dense;
using support::fixed;
using support::holds;
using support::near;
using support::near_matrix;
using support::number_between;
using support::require_near;
using support::require_near_matrix;
using support::throws;

constexpr double degree = std::numbers::pi / 180.0;

TEST(Radar, AzimuthTurnsFromXToYAndElevationRisesFromTheGround) {
  EXPECT_PRED_FORMAT3(near_matrix, to_cartesian(Polar{100.0, 0.0, 0.0}), (Vector<3>{100, 0, 0}), 1e-12);
  EXPECT_PRED_FORMAT3(near_matrix, to_cartesian(Polar{100.0, 90 * degree, 0.0}), (Vector<3>{0, 100, 0}), 1e-12);
  EXPECT_PRED_FORMAT3(near_matrix, to_cartesian(Polar{100.0, 0.3, 90 * degree}), (Vector<3>{0, 0, 100}), 1e-12);
  EXPECT_PRED_FORMAT3(near_matrix, to_cartesian(Polar{2.0, 45 * degree, 45 * degree}),
                      (Vector<3>{1, 1, std::sqrt(2.0)}), 1e-15);
}

TEST(Radar, PolarAndCartesianAreInverse) {
  holds([] {
    const Polar seen{number_between(1.0, 1e5), number_between(-3.1, 3.1), number_between(-1.5, 1.5)};
    const Polar again = to_polar(to_cartesian(seen));
    require_near(again.range, seen.range, 1e-12);
    require_near(again.azimuth, seen.azimuth, 1e-12);
    require_near(again.elevation, seen.elevation, 1e-12);
  });
}

TEST(Radar, ItsCovarianceIsThePrintedOneElementByElement) {
  holds([] {
    const Polar seen{number_between(1.0, 2e5), number_between(-3.2, 3.2), number_between(-1.6, 1.6)};
    const Polar sigma{number_between(0.0, 200.0), number_between(0.0, 0.03), number_between(0.0, 0.03)};
    const auto found = to_cartesian(seen, sigma);
    const auto printed = restatement::standard_conversion(seen.range, seen.azimuth, seen.elevation, sigma.range,
                                                          sigma.azimuth, sigma.elevation);
    require_near(support::entries(found.mean), printed.z, 1e-9);
    // Entries cancel, so the largest of them sets the scale.
    const double scale = std::max(1.0, found.covariance.cwiseAbs().maxCoeff());
    require_near_matrix(found.covariance / scale, (1.0 / scale) * printed.R, 1e-12);
    RC_ASSERT(found.covariance == found.covariance.transpose());
  });
}

TEST(Radar, OnTheXAxisTheErrorsAreThoseOfTheCoordinates) {
  const auto converted = to_cartesian(Polar{1000.0, 0.0, 0.0}, Polar{10.0, 0.002, 0.003});
  EXPECT_PRED_FORMAT3(near_matrix, converted.mean, (Vector<3>{1000, 0, 0}), 1e-15);
  EXPECT_PRED_FORMAT3(near_matrix, converted.covariance, (SquareMatrix<3>{{100, 0, 0}, {0, 4, 0}, {0, 0, 9}}), 1e-13);
}

TEST(Radar, TurningTheTargetTurnsTheCovariance) {
  const double turn = 0.7;
  const Polar sigma{10.0, 0.002, 0.003};
  const auto here = to_cartesian(Polar{5000.0, 0.2, 0.4}, sigma);
  const auto there = to_cartesian(Polar{5000.0, 0.2 + turn, 0.4}, sigma);
  const double c = std::cos(turn), s = std::sin(turn);
  const restatement::Matrix rotation(3, 3, {c, -s, 0, s, c, 0, 0, 0, 1});
  EXPECT_PRED_FORMAT3(near_matrix, there.mean, (fixed<3, 1>(rotation * dense(here.mean))), 1e-12);
  EXPECT_PRED_FORMAT3(near_matrix, there.covariance,
                      (fixed<3, 3>(rotation * dense(here.covariance) * restatement::transposed(rotation))), 1e-12);
}

TEST(Radar, TheValidityOfTheConversionIsThatOfTheScenarios) {
  const double near_range = Vector<3>{12e3, 8e3, 1e3}.norm();
  const double far_range = Vector<3>{120e3, 80e3, 20e3}.norm();
  EXPECT_NEAR(conversion_validity(near_range, {10.0, 0.1 * degree, 0.1 * degree}), 0.0044, 5e-5);
  EXPECT_NEAR(conversion_validity(far_range, {100.0, 0.9 * degree, 0.9 * degree}), 0.36, 5e-3);
  EXPECT_NEAR(conversion_validity(far_range, {200.0, 1.8 * degree, 1.8 * degree}), 0.72, 5e-3);
}

TEST(Radar, RefusesARangeThatIsNotPositive) {
  const Polar sigma{10.0, 0.001, 0.001};
  EXPECT_TRUE(throws<std::invalid_argument>([&] { to_cartesian({0.0, 0.1, 0.1}, sigma); }, {"range", "0.0"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { to_cartesian({-5.0, 0.1, 0.1}, sigma); }, {"range", "-5.0"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] {
        to_cartesian({std::numeric_limits<double>::quiet_NaN(), 0.1, 0.1}, sigma);
      },
      {"range", "nan"}));
}

TEST(Radar, RefusesANegativeDeviation) {
  for (const Polar& sigma : {Polar{-1.0, 0.0, 0.0}, Polar{1.0, -1e-3, 0.0}, Polar{1.0, 0.0, -1e-3}})
    EXPECT_TRUE(throws<std::invalid_argument>([&] { to_cartesian({10.0, 0.1, 0.1}, sigma); }, {"deviations"}));
}

}  // namespace
}  // namespace sigmax
