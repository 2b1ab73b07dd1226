#include <sigmax/earth/local_frame.hpp>

#include "support/sigmax.hpp"

namespace local_frame_test {

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

Position operator-(const Position& a, const Position& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double norm(const Position& p) { return std::hypot(p[0], p[1], p[2]); }

TEST(LocalFrame, AgreesWithTheWorkedExampleOfEpsg) {
  const auto [x, y, z] = LocalFrame(epsg_origin, 3).to_local(epsg_point);
  EXPECT_NEAR(x, -189013.869, 6e-4);
  EXPECT_NEAR(y, -128642.040, 6e-4);
  EXPECT_NEAR(z, -4220.171, 6e-4);
}

// The radii of curvature of WGS 84: across the meridian N, along it M.
TEST(LocalFrame, AxesAreTheDirectionsInWhichTheCoordinatesGrow) {
  constexpr double radian = 57.29577951308232, e2 = 6.69437999014e-3, a = 6378137.0, step_deg = 1e-4;
  const double sine = std::sin(epsg_origin.latitude_deg / radian);
  const double N = a / std::sqrt(1.0 - e2 * sine * sine), M = N * (1.0 - e2) / (1.0 - e2 * sine * sine);
  for (const int axes : {2, 3}) {
    const double altitude = axes == 3 ? epsg_origin.altitude_m : 0.0;
    const LocalFrame frame({epsg_origin.latitude_deg, epsg_origin.longitude_deg, altitude}, axes);
    const auto slope = [&](double north, double east) {
      const auto at = [&](double sign) {
        return frame.to_local(
            {epsg_origin.latitude_deg + sign * north, epsg_origin.longitude_deg + sign * east, altitude});
      };
      const Position step = at(1.0) - at(-1.0);
      return Position{step[0] / (2.0 * step_deg / radian), step[1] / (2.0 * step_deg / radian), 0.0};
    };
    EXPECT_NEAR(slope(step_deg, 0.0)[1], M + altitude, 5e-3);
    EXPECT_NEAR(slope(step_deg, 0.0)[0], 0.0, 5e-3);
    EXPECT_NEAR(slope(0.0, step_deg)[0], (N + altitude) * std::cos(epsg_origin.latitude_deg / radian), 5e-3);
    EXPECT_NEAR(slope(0.0, step_deg)[1], 0.0, 5e-3);
  }
}

TEST(LocalFrame, AxesTurnByLittleHoweverNearTheOrigin) {
  const LocalFrame frame({52.0, 4.0, 0.0}, 2);
  for (double x = 1e-14; x < 1000.0; x *= 10.0) {
    const auto axes = frame.local_axes({x, -3.0 * x, 0.0});
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(axes[i][j], i == j ? 1.0 : 0.0, 1e-6 + 1e-6 * x) << x;
  }
}

TEST(LocalFrame, InverseUndoesForward) {
  for (const double latitude : {-90.0, -89.9999, -33.0, 0.0, 52.0, 90.0}) {
    const LocalFrame frame({latitude, 151.0, 30.0}, 3);
    EXPECT_LT(norm(frame.to_local(frame.origin())), 1e-8);
    for (const Position& point :
         {Position{}, Position{20000, -10000, 3000}, Position{-3e5, 4e5, 1e4}, Position{1e-3, 2e-3, -3e-3}})
      EXPECT_LT(norm(frame.to_local(frame.to_geodetic(point)) - point), 1e-8);
    const LocalFrame flat({latitude, 151.0, 0.0}, 2);
    for (const Position& point :
         {Position{}, Position{20000, -10000, 0}, Position{-3e5, 4e5, 0}, Position{9e6, 9e6, 0}})
      EXPECT_LT(norm(flat.to_local(flat.to_geodetic(point)) - point), 1e-6);
  }
}

// The old arithmetic of this project, Cartesian about (50.8, −1.1): what it printed.
TEST(LocalFrame, TwoAxesAreWithinMillimetresTheTangentPlaneNearBy) {
  const Geodetic origin{50.8, -1.1, 0.0};
  for (int k = 0; k < 60; ++k) {
    const Geodetic point{50.8 + 0.001 * k, -1.1 - 0.0015 * k, 0.0};
    const Position map = LocalFrame(origin, 2).to_local(point);
    Position tangent = LocalFrame(origin, 3).to_local(point);
    tangent[2] = 0.0;
    const double d = norm(map);
    EXPECT_LT(norm(map - tangent), d * d * d / (6.0 * 6.35e6 * 6.35e6) + 1e-6);
  }
}

TEST(LocalFrame, NoPlaceOfTheEarthComesOutNearAnother) {
  const LocalFrame frame({0.0, 0.0, 0.0}, 2);
  EXPECT_GT(norm(frame.to_local({0.0, 120.0, 0.0})), 1.3e7);  // 60° on the tangent plane
  expect_near(frame.to_geodetic(frame.to_local({0.0, 120.0, 0.0})), {0.0, 120.0, 0.0}, 1e-6);
  EXPECT_GT(norm(LocalFrame({50.0, -1.0, 0.0}, 2).to_local({-36.0, 175.0, 0.0})), 1.7e7);
}

TEST(LocalFrame, LocalAxesAreWhatAStepIsThere) {
  for (const int axes : {2, 3})
    for (const double latitude : {-80.0, 0.0, 50.0, 89.0})
      for (const double east : {0.0, 1e3, 6e5, -4e6})
        for (const double north : {0.0, -5e4, 2e6}) {
          const LocalFrame frame({latitude, 20.0, 0.0}, axes);
          const Position position{east, north, axes == 3 ? 2e3 : 0.0};
          const LocalFrame there(frame.to_geodetic(position), axes);
          const auto found = frame.local_axes(position);
          for (std::size_t axis = 0; axis < static_cast<std::size_t>(axes); ++axis) {
            Position ahead = position, behind = position;
            ahead[axis] += 10.0;
            behind[axis] -= 10.0;
            const Position step = there.to_local(frame.to_geodetic(ahead)) - there.to_local(frame.to_geodetic(behind));
            for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i][axis], step[i] / 20.0, 1e-7);
          }
        }
}

TEST(Geodetic, KnowsWhatIsNoPlace) {
  EXPECT_TRUE((Geodetic{-90.0, 360.0, -1e4}.is_valid()));
  for (const Geodetic& place : {Geodetic{90.001, 0, 0}, Geodetic{not_a_number, 0, 0}, Geodetic{0, -361, 0},
                                Geodetic{0, not_a_number, 0}, Geodetic{0, 0, not_a_number}})
    EXPECT_FALSE(place.is_valid());
}

}  // namespace local_frame_test
