// Targets on the Earth, against an AnyTarget that is told what GeographicLib makes of the places.

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/GeodesicLine.hpp>
#include <GeographicLib/LocalCartesian.hpp>

#include <sigmax/earth/earth_target.hpp>

#include "support/sigmax.hpp"

namespace earth_target_test {

TargetChoice choice(int axes = 3) {
  TargetChoice result{.axes = axes, .motions = {{"cwna"}, {"cwpa"}}, .models = {"cwna", "cwpa"}};
  result.transition = {{0.95, 0.05}, {0.05, 0.95}};
  return result;
}

const Numbers variances = {100.0, 100.0, 400.0};

/// An aircraft that turns and climbs, by 200 m/s, near (52, 4.5).
Geodetic place(int k) {
  const double t = 2.0 * k;
  return {52.0 + 0.02 * std::sin(t / 20.0), 4.5 + 0.0015 * t, 1000.0 + 5.0 * t};
}

AnyDetection whole(int k) {
  const auto [latitude, longitude, altitude] = place(k);
  return AnyDetection::position(2.0 * k, Numbers{latitude, longitude, altitude}, variances);
}

void expect_same(const Numbers& found, const Numbers& expected) {
  ASSERT_EQ(found.size(), expected.size());
  const double scale = std::abs(*std::ranges::max_element(expected, {}, [](double x) { return std::abs(x); }));
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9 * std::max(1.0, scale)) << i;
}

TEST(EarthTarget, IsTheTargetOfPlacesThatGeographicLibMakesLocal) {
  EarthTarget target{choice()};
  AnyTarget local{choice()};
  const GeographicLib::LocalCartesian frame(place(0).latitude_deg, place(0).longitude_deg, place(0).altitude_m);
  std::size_t steps = 0;
  for (int k = 0; k < 40; ++k) {
    AnyDetection in_metres = whole(k);
    in_metres.sensor = AnyDetection::Sensor::components;
    in_metres.places = {0, 1, 2};
    // From its start on: an altitude alone, and places without one.
    AnyDetection detection = in_metres;
    const bool alone = k > 5 && k % 3 == 1, flat = k > 5 && k % 3 == 2;
    if (alone)
      detection = AnyDetection::components(2.0 * k, std::array{2}, Numbers{place(k).altitude_m}, Numbers{400.0});
    if (flat)
      detection = AnyDetection::components(2.0 * k, std::array{0, 1}, Numbers{detection.z[0], detection.z[1]},
                                           Numbers{100.0, 100.0});
    Geodetic there = place(k);
    if (alone || flat) {  // what is not told is where it is expected
      const TargetPoint last = local.output();
      Position at{};
      for (std::size_t i = 0; i < 3; ++i) at[i] = last.mean[i] + (2.0 * k - last.time) * last.mean[3 + i];
      Geodetic expected;
      frame.Reverse(at[0], at[1], at[2], expected.latitude_deg, expected.longitude_deg, expected.altitude_m);
      if (alone) there = {expected.latitude_deg, expected.longitude_deg, there.altitude_m};
      if (flat) there.altitude_m = expected.altitude_m;
    }
    Position at{};
    frame.Forward(there.latitude_deg, there.longitude_deg, there.altitude_m, at[0], at[1], at[2]);
    in_metres = detection;
    for (std::size_t i = 0; i < static_cast<std::size_t>(detection.size); ++i)
      in_metres.z[i] = at[static_cast<std::size_t>(detection.places[i])];
    TargetPoint expected;
    local.follow({&in_metres, 1}, [&](const TargetPoint& point) { expected = point; });
    target.follow({&detection, 1}, [&](const EarthPoint& point) {
      ++steps;
      Geodetic own;
      std::vector<double> turn(9);
      frame.Reverse(expected.mean[0], expected.mean[1], expected.mean[2], own.latitude_deg, own.longitude_deg,
                    own.altitude_m, turn);
      expect_same({point.place.latitude_deg, point.place.longitude_deg, point.place.altitude_m},
                  {own.latitude_deg, own.longitude_deg, own.altitude_m});
      const Eigen::Map<const Eigen::Matrix3d> to_there(turn.data());  // the transpose of what is row by row
      Eigen::Map<Eigen::Matrix<double, 9, 1>> mean(expected.mean.data());
      Eigen::Map<SquareMatrix<9>> covariance(expected.covariance.data());
      SquareMatrix<9> all = SquareMatrix<9>::Identity();
      for (int i = 0; i < 9; i += 3) all.block<3, 3>(i, i) = to_there;
      mean.tail<6>() = (all.bottomRightCorner<6, 6>() * mean.tail<6>()).eval();
      covariance = (all * covariance * all.transpose()).eval();
      expect_same(point.mean, expected.mean);
      expect_same(point.covariance, expected.covariance);
      EXPECT_EQ(point.nis, expected.nis);
    });
  }
  EXPECT_EQ(steps, 38U);
}

// Along a geodesic over an eighth of the Earth, and smoothed: the frame moves, and the way there stays even.
TEST(EarthTarget, GoesAboutTheEarthWithItsFrame) {
  for (const int axes : {2, 3}) {
    TargetChoice recorded = choice(axes);
    recorded.rules.record = true;
    EarthTarget target{recorded};
    const auto line = GeographicLib::Geodesic::WGS84().Line(50.0, 8.0, 60.0);
    const auto there = [&](std::size_t k) {
      Geodetic place{.altitude_m = axes == 3 ? 9000.0 : 0.0};
      line.Position(5000.0 * static_cast<double>(k), place.latitude_deg, place.longitude_deg);
      return place;
    };
    const auto expect_there = [&](const EarthPoint& point) {
      const Geodetic expected = there(point.tag);
      double off = 0.0;
      GeographicLib::Geodesic::WGS84().Inverse(point.place.latitude_deg, point.place.longitude_deg,
                                               expected.latitude_deg, expected.longitude_deg, off);
      EXPECT_LT(off, 3.0);
      EXPECT_NEAR(point.place.altitude_m, expected.altitude_m, 15.0);
      const auto n = static_cast<std::size_t>(axes);
      EXPECT_NEAR(std::hypot(point.mean[n], point.mean[n + 1]), 250.0, 1.0) << point.tag;
    };
    for (std::size_t k = 0; k < 1000; ++k) {
      const Geodetic place = there(k);
      Numbers z = {place.latitude_deg, place.longitude_deg, place.altitude_m}, R = variances;
      z.resize(static_cast<std::size_t>(axes));
      R.resize(z.size());
      AnyDetection detection = AnyDetection::position(20.0 * static_cast<double>(k), z, R);
      detection.tag = k;
      target.follow({&detection, 1}, [&](const EarthPoint& point) {
        if (k > 20) expect_there(point);
      });
    }
    std::size_t smoothed = 0;
    target.smoothed([&](const TargetPoint& point) {
      ++smoothed;
      if (point.tag > 20 && point.tag < 980) expect_there(target.on_earth(point));
    });
    EXPECT_EQ(smoothed, 998U);
    target.predict(20.0 * 1030, 1030, [&](const TargetPoint& point) {
      const EarthPoint predicted = target.on_earth(point, true);
      const Geodetic expected = there(1030);
      EXPECT_NEAR(predicted.place.latitude_deg, expected.latitude_deg, 0.05);
      EXPECT_NEAR(predicted.place.altitude_m, expected.altitude_m, 200.0);
    });
  }
}

// A radar and a station on the Earth see what the Cartesian coordinates of the whole Earth say.
TEST(EarthTarget, IsSeenFromPlacesOnTheEarth) {
  const Geodetic station{51.9, 4.2, 30.0};
  const auto& earth = GeographicLib::Geocentric::WGS84();
  const auto sighting = [&](const Geodetic& target) {
    Eigen::Vector3d here, there;
    std::vector<double> axes(9);  // from east, north and up there
    earth.Forward(station.latitude_deg, station.longitude_deg, station.altitude_m, here[0], here[1], here[2], axes);
    earth.Forward(target.latitude_deg, target.longitude_deg, target.altitude_m, there[0], there[1], there[2]);
    return Eigen::Vector3d(Eigen::Map<const Eigen::Matrix3d>(axes.data()) * (there - here));
  };
  const LocalFrame frame(place(0), 3);
  for (int k = 0; k < 40; ++k) {
    const Polar seen = to_polar(sighting(place(k)));
    const Numbers z = {seen.range, seen.azimuth.radians(), seen.elevation.radians()};
    const AnyDetection detection = seen_from(station, AnyDetection::polar(2.0 * k, z, variances), frame, 3);
    const Position expected = frame.to_local(place(k));
    const Vector<3> found = to_cartesian({detection.z[0], radians(detection.z[1]), radians(detection.z[2])}) +
                            Vector<3>(detection.origin.data());
    for (Eigen::Index i = 0; i < 3; ++i)
      EXPECT_NEAR(found[i], expected[static_cast<std::size_t>(i)], 1e-9 * seen.range) << k;
  }
  // Followed by such a radar alone, then by its ranges and azimuths beside an altimeter.
  EarthTarget target{choice()};
  const std::array at = {station.latitude_deg, station.longitude_deg, station.altitude_m};
  EarthPoint last;
  for (int k = 0; k < 60; ++k) {
    const Polar seen = to_polar(sighting(place(k)));
    const Numbers z = {seen.range, seen.azimuth.radians(), seen.elevation.radians()}, R = {25.0, 1e-7, 1e-7};
    AnyDetection detection =
        AnyDetection::polar(2.0 * k, std::span(z).first(k < 10 ? 3 : 2), std::span(R).first(k < 10 ? 3 : 2), at);
    if (k >= 10 && k % 2 == 0)
      detection = AnyDetection::components(2.0 * k, std::array{2}, Numbers{place(k).altitude_m}, Numbers{25.0});
    target.follow({&detection, 1}, [&](const EarthPoint& point) { last = point; });
  }
  EXPECT_NEAR(last.place.latitude_deg, place(59).latitude_deg, 3e-4);
  EXPECT_NEAR(last.place.longitude_deg, place(59).longitude_deg, 3e-4);
  EXPECT_NEAR(last.place.altitude_m, place(59).altitude_m, 10.0);
}

TEST(EarthTarget, TakesVelocitiesAlongEastNorthAndUpOfTheirPlace) {
  const LocalFrame frame({60.0, 10.0, 0.0}, 3);
  const Geodetic there{61.0, 14.0, 9000.0};
  const GeographicLib::LocalCartesian local(60.0, 10.0, 0.0);
  Position at{};
  std::vector<double> turn(9);
  local.Forward(there.latitude_deg, there.longitude_deg, there.altitude_m, at[0], at[1], at[2], turn);
  const AnyDetection detection = AnyDetection::components(
      0.0, std::array{0, 1, 2, 3, 4, 5}, Numbers{61.0, 14.0, 9000.0, 100.0, -30.0, 5.0}, Numbers(6, 1.0));
  const AnyDetection found = in_frame(detection, frame, at, 3);
  const Eigen::Vector3d v = Eigen::Map<const Eigen::Matrix3d>(turn.data()).transpose() * Eigen::Vector3d(100, -30, 5);
  expect_same(Numbers(found.z.begin(), found.z.end()), {at[0], at[1], at[2], v[0], v[1], v[2]});
}

TEST(EarthTarget, RefusesWhatIsNoPlaceAndOneAxis) {
  EarthTarget target{choice()}, on_a_line{choice(1)};
  const AnyDetection detection = AnyDetection::position(0.0, Numbers{91.0, 0.0, 0.0}, variances);
  EXPECT_THROW(target.follow({&detection, 1}, {}), std::invalid_argument);
  EXPECT_THROW(on_a_line.begin({}, {}), std::invalid_argument);
  const AnyDetection height = AnyDetection::components(0.0, std::array{2}, Numbers{100.0}, Numbers{25.0});
  EarthTarget nowhere{choice()};
  nowhere.follow({&height, 1}, [](const EarthPoint&) { FAIL(); });  // a height tells no place
  EXPECT_FALSE(nowhere.anchor());
}

}  // namespace earth_target_test
