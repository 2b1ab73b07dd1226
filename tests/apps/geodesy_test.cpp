#include "support/geodesy.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace sigmax::apps {
namespace {

double dms(double degrees, double minutes, double seconds) { return degrees + minutes / 60.0 + seconds / 3600.0; }

void expect_near(const Geodetic& a, const Geodetic& b, double tolerance_m) {
  EXPECT_NEAR(a.latitude_deg, b.latitude_deg, tolerance_m * 9e-6);
  EXPECT_NEAR(std::remainder(a.longitude_deg - b.longitude_deg, 360.0) * std::cos(a.latitude_deg * 0.017453292519943),
              0.0, tolerance_m * 9e-6);
  EXPECT_NEAR(a.altitude_m, b.altitude_m, tolerance_m);
}

// The worked example of method 9837 in IOGP Guidance Note 7-2, printed to a millimetre.
const Geodetic epsg_point{dms(53, 48, 33.820), dms(2, 7, 46.380), 73.0};
const Geodetic epsg_origin{55.0, 5.0, 200.0};

TEST(LocalFrame, AgreesWithTheWorkedExampleOfEpsg) {
  const Vector<3> local = LocalFrame<3>(epsg_origin).to_local(epsg_point);
  EXPECT_NEAR(local.x(), -189013.869, 6e-4);
  EXPECT_NEAR(local.y(), -128642.040, 6e-4);
  EXPECT_NEAR(local.z(), -4220.171, 6e-4);
}

// The radii of curvature of WGS 84: across the meridian N, along it M.
TEST(LocalFrame, AxesAreTheDirectionsInWhichTheCoordinatesGrow) {
  constexpr double radian = 57.29577951308232, e2 = 6.69437999014e-3, a = 6378137.0, step_deg = 1e-4;
  const double sine = std::sin(epsg_origin.latitude_deg / radian);
  const double N = a / std::sqrt(1.0 - e2 * sine * sine), M = N * (1.0 - e2) / (1.0 - e2 * sine * sine);
  const auto check = [&](auto frame, double altitude) {
    const auto slope = [&](double north, double east) {
      const auto place = [&](double sign) {
        return Geodetic{epsg_origin.latitude_deg + sign * north, epsg_origin.longitude_deg + sign * east, altitude};
      };
      return decltype(frame.to_local(place(1.0)))((frame.to_local(place(1.0)) - frame.to_local(place(-1.0))) /
                                                  (2.0 * step_deg / radian));
    };
    EXPECT_NEAR(slope(step_deg, 0.0)(1), M + altitude, 5e-3);
    EXPECT_NEAR(slope(step_deg, 0.0)(0), 0.0, 5e-3);
    EXPECT_NEAR(slope(0.0, step_deg)(0), (N + altitude) * std::cos(epsg_origin.latitude_deg / radian), 5e-3);
    EXPECT_NEAR(slope(0.0, step_deg)(1), 0.0, 5e-3);
  };
  check(LocalFrame<3>(epsg_origin), epsg_origin.altitude_m);
  check(LocalFrame<2>({epsg_origin.latitude_deg, epsg_origin.longitude_deg, 0.0}), 0.0);
}

TEST(LocalFrame, InverseUndoesForward) {
  for (const double latitude : {-90.0, -89.9999, -33.0, 0.0, 52.0, 90.0}) {
    const LocalFrame<3> frame({latitude, 151.0, 30.0});
    EXPECT_TRUE(frame.to_local(frame.origin()).isZero(1e-8));
    for (const Vector<3>& point :
         {Vector<3>(0, 0, 0), Vector<3>(20000, -10000, 3000), Vector<3>(-3e5, 4e5, 1e4), Vector<3>(1e-3, 2e-3, -3e-3)})
      EXPECT_LT((frame.to_local(frame.to_geodetic(point)) - point).norm(), 1e-8);
    const LocalFrame<2> flat({latitude, 151.0, 0.0});
    for (const Vector<2>& point :
         {Vector<2>(0, 0), Vector<2>(20000, -10000), Vector<2>(-3e5, 4e5), Vector<2>(9e6, 9e6)})
      EXPECT_LT((flat.to_local(flat.to_geodetic(point)) - point).norm(), 1e-6);
  }
}

// The old arithmetic of this project, Cartesian about (50.8, −1.1): what it printed.
TEST(LocalFrame, TwoAxesAreWithinMillimetresTheTangentPlaneNearBy) {
  const Geodetic origin{50.8, -1.1, 0.0};
  for (int k = 0; k < 60; ++k) {
    const Geodetic point{50.8 + 0.001 * k, -1.1 - 0.0015 * k, 0.0};
    const Vector<2> map = LocalFrame<2>(origin).to_local(point);
    const Vector<3> tangent = LocalFrame<3>(origin).to_local(point);
    const double d = map.norm();
    EXPECT_LT((map - tangent.head<2>()).norm(), d * d * d / (6.0 * 6.35e6 * 6.35e6) + 1e-6);
  }
}

TEST(LocalFrame, NoPlaceOfTheEarthComesOutNearAnother) {
  const LocalFrame<2> frame({0.0, 0.0, 0.0});
  EXPECT_GT(frame.to_local({0.0, 120.0, 0.0}).norm(), 1.3e7);  // 60° on the tangent plane
  expect_near(frame.to_geodetic(frame.to_local({0.0, 120.0, 0.0})), {0.0, 120.0, 0.0}, 1e-6);
  EXPECT_GT(LocalFrame<2>({50.0, -1.0, 0.0}).to_local({-36.0, 175.0, 0.0}).norm(), 1.7e7);
}

/// The axes there by a small step in this frame.
template <int Axes>
SquareMatrix<Axes> stepped_axes(const LocalFrame<Axes>& frame, const Vector<Axes>& position) {
  const LocalFrame<Axes> there(frame.to_geodetic(position));
  SquareMatrix<Axes> result;
  for (int axis = 0; axis < Axes; ++axis) {
    const Vector<Axes> step = 10.0 * Vector<Axes>::Unit(axis);
    result.col(axis) =
        (there.to_local(frame.to_geodetic(position + step)) - there.to_local(frame.to_geodetic(position - step))) /
        20.0;
  }
  return result;
}

TEST(LocalFrame, LocalAxesAreWhatAStepIsThere) {
  for (const double latitude : {-80.0, 0.0, 50.0, 89.0})
    for (const double east : {0.0, 1e3, 6e5, -4e6})
      for (const double north : {0.0, -5e4, 2e6}) {
        const LocalFrame<3> frame({latitude, 20.0, 0.0});
        const Vector<3> position(east, north, 2e3);
        EXPECT_LT((frame.local_axes(position) - stepped_axes(frame, position)).norm(), 1e-8);
        const LocalFrame<2> flat({latitude, 20.0, 0.0});
        const Vector<2> place(east, north);
        EXPECT_LT((flat.local_axes(place) - stepped_axes(flat, place)).norm(), 1e-7);
      }
}

TEST(Geodetic, RefusesWhatIsNoPlace) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Geodetic::checked(90.001, 0, 0), std::invalid_argument);
  EXPECT_THROW(Geodetic::checked(nan, 0, 0), std::invalid_argument);
  EXPECT_THROW(Geodetic::checked(0, -361, 0), std::invalid_argument);
  EXPECT_THROW(Geodetic::checked(0, nan, 0), std::invalid_argument);
  EXPECT_THROW(Geodetic::checked(0, 0, nan), std::invalid_argument);
}

}  // namespace
}  // namespace sigmax::apps
