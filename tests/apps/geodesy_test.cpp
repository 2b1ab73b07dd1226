#include "support/geodesy.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace sigmax::apps {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double equatorial_radius = 6378137.0;
constexpr double polar_radius = 6356752.314245179;

double dms(double degrees, double minutes, double seconds) { return degrees + minutes / 60.0 + seconds / 3600.0; }

double distance(const Ecef& a, const Ecef& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

void expect_near(const Ecef& point, double x, double y, double z, double tolerance) {
  EXPECT_NEAR(point.x, x, tolerance);
  EXPECT_NEAR(point.y, y, tolerance);
  EXPECT_NEAR(point.z, z, tolerance);
}

void expect_near(const EastNorthUp& point, double east, double north, double up, double tolerance) {
  EXPECT_NEAR(point.east, east, tolerance);
  EXPECT_NEAR(point.north, north, tolerance);
  EXPECT_NEAR(point.up, up, tolerance);
}

// The worked examples of methods 9602 and 9837 in IOGP Guidance Note 7-2, printed to a millimetre.
const Geodetic epsg_point = Geodetic::from_degrees(dms(53, 48, 33.820), dms(2, 7, 46.380), 73.0);
const Geodetic epsg_origin = Geodetic::from_degrees(55.0, 5.0, 200.0);

TEST(Geodesy, AgreesWithTheWorkedExamplesOfEpsg) {
  expect_near(to_ecef(epsg_point), 3771793.968, 140253.342, 5124304.349, 6e-4);
  expect_near(to_ecef(epsg_origin), 3652755.3058, 319574.6799, 5201547.3536, 6e-5);
  expect_near(LocalFrame{epsg_origin}.to_local(epsg_point), -189013.869, -128642.040, -4220.171, 6e-4);

  const Geodetic back = to_geodetic({3771793.968, 140253.342, 5124304.349});
  EXPECT_NEAR(back.latitude_deg(), epsg_point.latitude_deg(), 1e-8);
  EXPECT_NEAR(back.longitude_deg(), epsg_point.longitude_deg(), 1e-8);
  EXPECT_NEAR(back.altitude, 73.0, 1e-3);
}

TEST(Geodesy, PutsTheAxesWhereTheEllipsoidEnds) {
  expect_near(to_ecef(Geodetic::from_degrees(0, 0, 0)), equatorial_radius, 0, 0, 1e-9);
  expect_near(to_ecef(Geodetic::from_degrees(0, 90, 10)), 0, equatorial_radius + 10, 0, 1e-8);
  expect_near(to_ecef(Geodetic::from_degrees(0, -180, 0)), -equatorial_radius, 0, 0, 1e-8);
  expect_near(to_ecef(Geodetic::from_degrees(90, 0, 0)), 0, 0, polar_radius, 1e-8);
  expect_near(to_ecef(Geodetic::from_degrees(-90, 33, 5)), 0, 0, -polar_radius - 5, 1e-8);
}

TEST(Geodesy, ForwardPointsLieOnTheEllipsoidAndItsNormal) {
  for (double latitude_deg = -85; latitude_deg <= 85; latitude_deg += 17) {
    const Geodetic ground = Geodetic::from_degrees(latitude_deg, 41, 0);
    const Ecef foot = to_ecef(ground);
    const double x = foot.x / equatorial_radius;
    const double y = foot.y / equatorial_radius;
    const double z = foot.z / polar_radius;
    EXPECT_NEAR(x * x + y * y + z * z, 1.0, 1e-14);

    // The gradient of the ellipsoid's equation is its normal; h metres along it is the point of altitude h.
    const double gx = x / equatorial_radius;
    const double gy = y / equatorial_radius;
    const double gz = z / polar_radius;
    const double scale = 12345.0 / std::hypot(gx, gy, gz);
    const Ecef above = to_ecef({ground.latitude, ground.longitude, 12345.0});
    expect_near(above, foot.x + scale * gx, foot.y + scale * gy, foot.z + scale * gz, 1e-8);
  }
}

TEST(Geodesy, InverseUndoesForward) {
  for (const double altitude : {-5e6, -1e4, -100.0, 0.0, 73.0, 1.2e4, 4e5, 3.6e7, 4e8})
    for (double latitude_deg = -90; latitude_deg <= 90; latitude_deg += 2.5)
      for (double longitude_deg = -180; longitude_deg < 180; longitude_deg += 45) {
        const Geodetic point = Geodetic::from_degrees(latitude_deg, longitude_deg, altitude);
        const Geodetic back = to_geodetic(to_ecef(point));
        EXPECT_NEAR(back.latitude, point.latitude, 1e-13) << latitude_deg << ' ' << altitude;
        EXPECT_NEAR(back.altitude, altitude, 1e-15 * std::abs(altitude) + 4e-9) << latitude_deg << ' ' << altitude;
        if (std::abs(latitude_deg) < 90) {
          const double turn = back.longitude - point.longitude;
          EXPECT_NEAR(std::remainder(turn, 2 * pi), 0.0, 1e-15);
        }
      }
}

TEST(Geodesy, InverseHoldsBesideThePolesAndTheEquator) {
  for (const double angle : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3})
    for (const double altitude : {0.0, 1e4}) {
      // At a point `angle` from the pole the distance from the axis is the meridian's radius a²/b times the angle.
      const Geodetic polar = to_geodetic(to_ecef({pi / 2 - angle, 1.0, altitude}));
      EXPECT_NEAR(polar.latitude, pi / 2 - angle, 3e-16);
      EXPECT_NEAR(polar.altitude, altitude, 2e-9);
      const Geodetic equatorial = to_geodetic(to_ecef({-angle, 1.0, altitude}));
      EXPECT_NEAR(equatorial.latitude, -angle, 3e-16);
      EXPECT_NEAR(equatorial.altitude, altitude, 2e-9);
    }
  const Geodetic pole = to_geodetic({0, 0, -polar_radius - 7});
  EXPECT_EQ(pole.latitude, -pi / 2);
  EXPECT_EQ(pole.longitude, 0.0);
  EXPECT_NEAR(pole.altitude, 7.0, 2e-9);
}

TEST(Geodesy, InverseAgreesWithBisection) {
  // p tan φ − z = e² N sin φ holds on the normal through the point; solved without any iteration of Bowring's.
  constexpr double e2 = 1.0 - (polar_radius / equatorial_radius) * (polar_radius / equatorial_radius);
  for (const Ecef& point : {Ecef{4e6, 1e6, 5e6}, Ecef{6.4e6, 0, 1e3}, Ecef{2e5, -3e5, 6.4e6}, Ecef{3e7, 2e7, 2e7}}) {
    const double p = std::hypot(point.x, point.y);
    double low = 0.0;
    double high = pi / 2;
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      const double s = std::sin(middle);
      const double normal = equatorial_radius / std::sqrt(1 - e2 * s * s);
      (p * s < (point.z + e2 * normal * s) * std::cos(middle) ? low : high) = middle;
    }
    EXPECT_NEAR(to_geodetic(point).latitude, low, 1e-15);
  }
}

TEST(LocalFrame, AxesAreTheDirectionsInWhichTheCoordinatesGrow) {
  const LocalFrame frame{epsg_origin};
  constexpr double step = 1e-6;
  const auto slope = [&](Geodetic more, Geodetic less, double by) {
    const EastNorthUp a = frame.to_local(more);
    const EastNorthUp b = frame.to_local(less);
    return EastNorthUp{(a.east - b.east) / by, (a.north - b.north) / by, (a.up - b.up) / by};
  };
  const auto& [latitude, longitude, altitude] = epsg_origin;
  // The radii of curvature: across the meridian N, along it M.
  const double e2 = 1.0 - (polar_radius / equatorial_radius) * (polar_radius / equatorial_radius);
  const double w2 = 1.0 - e2 * std::sin(latitude) * std::sin(latitude);
  const double N = equatorial_radius / std::sqrt(w2);
  const double M = N * (1.0 - e2) / w2;
  expect_near(slope({latitude, longitude + step, altitude}, {latitude, longitude - step, altitude}, 2 * step),
              (N + altitude) * std::cos(latitude), 0, 0, 5e-3);
  expect_near(slope({latitude + step, longitude, altitude}, {latitude - step, longitude, altitude}, 2 * step), 0,
              M + altitude, 0, 5e-3);
  expect_near(slope({latitude, longitude, altitude + 1}, {latitude, longitude, altitude - 1}, 2), 0, 0, 1, 1e-9);
}

TEST(LocalFrame, TheOriginIsZero) { expect_near(LocalFrame{epsg_origin}.to_local(epsg_origin), 0, 0, 0, 0); }

TEST(LocalFrame, InverseUndoesForwardAndKeepsDistances) {
  for (const double latitude_deg : {-90.0, -89.9999, -33.0, 0.0, 52.0, 90.0}) {
    const LocalFrame frame{Geodetic::from_degrees(latitude_deg, 151.0, 30.0)};
    for (const EastNorthUp& point :
         {EastNorthUp{0, 0, 0}, {20000, -10000, 3000}, {-3e5, 4e5, 1e4}, {1e-3, 2e-3, -3e-3}}) {
      const EastNorthUp back = frame.to_local(frame.to_ecef(point));
      expect_near(back, point.east, point.north, point.up, 3e-9);
      const EastNorthUp around = frame.to_local(frame.to_geodetic(point));
      expect_near(around, point.east, point.north, point.up, 1e-8);
      EXPECT_NEAR(distance(frame.to_ecef(point), frame.to_ecef({0, 0, 0})),
                  std::hypot(point.east, point.north, point.up), 2e-9);
    }
  }
}

TEST(LocalFrame, StraightUpIsAltitude) {
  const LocalFrame frame{epsg_origin};
  const Geodetic above = frame.to_geodetic(EastNorthUp{0, 0, 5000});
  EXPECT_NEAR(above.latitude, epsg_origin.latitude, 1e-15);
  EXPECT_NEAR(above.longitude, epsg_origin.longitude, 1e-15);
  EXPECT_NEAR(above.altitude, epsg_origin.altitude + 5000, 3e-9);
}

TEST(LocalFrame, TheSurfaceIsFoundFromEastAndNorth) {
  for (const double altitude : {0.0, 2000.0, -50.0}) {
    const LocalFrame frame{Geodetic::from_degrees(50.8, -1.1, altitude)};
    for (const double north_deg : {0.0, 0.01, -0.3, 4.0, -20.0})
      for (const double east_deg : {0.0, -0.02, 0.5, 15.0}) {
        const Geodetic point = Geodetic::from_degrees(50.8 + north_deg, -1.1 + east_deg, 0.0);
        const EastNorthUp local = frame.to_local(point);
        const Geodetic found = frame.to_surface(local.east, local.north);
        EXPECT_NEAR(found.latitude, point.latitude, 1e-14) << north_deg << ' ' << east_deg;
        EXPECT_NEAR(found.longitude, point.longitude, 1e-14) << north_deg << ' ' << east_deg;
        EXPECT_EQ(found.altitude, 0.0);
      }
  }
}

TEST(Geodetic, RefusesWhatIsNoPlace) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Geodetic::from_degrees(90.001, 0, 0), std::invalid_argument);
  EXPECT_THROW(Geodetic::from_degrees(nan, 0, 0), std::invalid_argument);
  EXPECT_THROW(Geodetic::from_degrees(0, -361, 0), std::invalid_argument);
  EXPECT_THROW(Geodetic::from_degrees(0, nan, 0), std::invalid_argument);
  EXPECT_THROW(Geodetic::from_degrees(0, 0, nan), std::invalid_argument);
}

}  // namespace
}  // namespace sigmax::apps
