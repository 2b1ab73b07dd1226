// Sensors where they stand: radars and stations of bearings, in metres and on the Earth, against rows that are
// converted by hand; on the Earth against where the target is.

#include <sigmax/earth/local_frame.hpp>

#include "apps/recordings.hpp"

namespace himm_demo_sensors_test {

using support::degree;

constexpr double sigma_azimuth = 0.2 * degree, sigma_range = 12.0;

struct Seen {
  double time;
  bool east;
  double range, azimuth;
};

const Eigen::Vector2d west_at(-400.0, 300.0), east_at(5000.0, -200.0);
const Eigen::Vector2d& place_of(const Seen& seen) { return seen.east ? east_at : west_at; }

/// By turns, and every fifth time both at once.
std::vector<Seen> seen_by_turns() {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  std::vector<Seen> rows;
  for (int k = 0; k < 80; ++k) {
    const double t = 0.5 * k - (k % 5 == 1 ? 0.5 : 0.0);
    Seen seen{t, k % 2 == 1, 0.0, 0.0};
    const Eigen::Vector2d d = Eigen::Vector2d(-1000.0 + 60.0 * t, 6000.0 + 400.0 * std::sin(t / 9.0)) - place_of(seen);
    seen.range = d.norm() + sigma_range * normal(engine);
    seen.azimuth = std::atan2(d.y(), d.x()) + sigma_azimuth * normal(engine);
    rows.push_back(seen);
  }
  return rows;
}

std::string csv(const std::vector<Seen>& rows) {
  std::string text = "time_s,sensor,range_m,azimuth_deg\n";
  for (const Seen& row : rows)
    text += exact(row.time) + (row.east ? ",east," : ",west,") + exact(row.range) + "," + exact(row.azimuth / degree) +
            "\n";
  return text;
}

const Arguments one_model = {"filters=imm", "models=[dwna]", "sigma_w=3", "sigma_azimuth_deg=0.2", "sigma_range_m=12"};
const Arguments places = {"sensor.west.at=[-400,300]", "sensor.east.at=[5000,-200,77]"};

TEST(HimmDemoSensors, TwoRadarsAreTheirRowsConvertedByHand) {
  const auto rows = seen_by_turns();
  std::string by_hand = "time_s,sensor,x_m,y_m,cov_xx_m2,cov_xy_m2,cov_yy_m2\n";
  for (const Seen& row : rows) {
    const double c = std::cos(row.azimuth), s = std::sin(row.azimuth);
    const double along = sigma_range * sigma_range, across = std::pow(row.range * sigma_azimuth, 2);
    by_hand += exact(row.time) + (row.east ? ",east" : ",west");
    for (const double number :
         {place_of(row).x() + row.range * c, place_of(row).y() + row.range * s, c * c * along + s * s * across,
          c * s * (along - across), s * s * along + c * c * across})
      by_hand += "," + exact(number);
    by_hand += "\n";
  }
  const auto expected = estimates(by_hand, one_model), found = estimates(csv(rows), one_model + places);
  ASSERT_GE(found.size(), rows.size() - 5);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    for (const char* name : {"time_s", "x_m", "y_m", "vx_mps", "vy_mps", "sigma_x_m", "sigma_vy_mps", "nis"})
      ASSERT_CLOSE(number(found[k].at(name)), number(expected[k].at(name)), 1e-9) << name << " of row " << k;
}

/// Of a place in a column, in the settings, and of all sensors; in a radar's own space, with range rates and without.
TEST(HimmDemoSensors, ARadarThatStandsElsewhereSeesTheSameFromThere) {
  const auto rows = [](const std::string& columns, const std::string& more) {
    return recording("time_s,range_m,azimuth_deg,elevation_deg,range_rate_mps" + columns, [&](int k) {
      return exact(k) + "," + exact(3000.0 + 20.0 * k + k % 3) + "," + exact(40.0 + 0.3 * k) + "," +
             exact(5.0 + 0.01 * k) + "," + exact(20.0 + k % 2) + more;
    });
  };
  for (const char* form : {"radar_measurement=polar", "radar_measurement=debiased", "sigma_range_rate_mps=1"}) {
    const auto about = estimates(rows("", ""), {form});
    for (const auto& moved : {estimates(rows(",sensor_x_m,sensor_y_km,sensor_z_m", ",700,-0.2,30"), {form}),
                              estimates(rows("", ""), {form, "at=[700,-200,30]"}),
                              estimates(rows("", ""), {form}, {"--radar-at=700,-200,30"})}) {
      ASSERT_EQ(moved.size(), about.size());
      for (std::size_t k = 0; k < about.size(); ++k) {
        ASSERT_CLOSE(number(moved[k].at("x_m")), number(about[k].at("x_m")) + 700.0, 1e-9);
        ASSERT_CLOSE(number(moved[k].at("y_m")), number(about[k].at("y_m")) - 200.0, 1e-9);
        ASSERT_CLOSE(number(moved[k].at("z_m")), number(about[k].at("z_m")) + 30.0, 1e-9);
        ASSERT_CLOSE(number(moved[k].at("vx_mps")), number(about[k].at("vx_mps")), 1e-7);
      }
    }
  }
}

std::array<double, 3> target_on_the_earth(int k) { return {60.2 + 0.001 * k, 10.5 + 0.001 * k, 9000.0 + 10.0 * k}; }

/// Two radars 90 km apart, or two stations of bearings in a `flat` recording, measure without an error, each from its
/// own north and horizon; where they stand is said by `columns` or by settings. Every third row is a place if `mixed`.
std::string seen_on_the_earth(bool flat, bool columns, bool mixed) {
  const std::array<std::array<double, 3>, 2> stand{{{60.0, 10.0, 250.0}, {60.5, 11.3, 20.0}}};
  std::string text = "time_s,sensor,azimuth_deg_north";
  if (!flat) text += ",range_m,elevation_deg";
  if (columns)
    text += flat ? ",sensor_latitude_deg,sensor_longitude_deg"
                 : ",sensor_latitude_deg,sensor_longitude_deg,sensor_altitude_m";
  if (mixed) text += flat ? ",latitude_deg,longitude_deg" : ",latitude_deg,longitude_deg,altitude_m";
  text += "\n";
  for (int k = 0; k < 60; ++k) {
    const auto [latitude, longitude, altitude] = target_on_the_earth(k);
    const auto cells = [&](double b, double l, double h) {
      return "," + exact(b) + "," + exact(l) + (flat ? "" : "," + exact(h));
    };
    const std::string none = flat ? ",," : ",,,";
    const bool located = mixed && k % 3 == 2;
    const std::size_t by = k / 2 % 2 == 0 ? 0 : 1;
    const auto [b, l, h] = stand[by];
    const LocalFrame here({b, l, flat ? 0.0 : h}, 3);
    const Eigen::Vector3d d(here.to_local({latitude, longitude, flat ? 0.0 : altitude}).data());
    text += exact(2.0 * k) + (located ? ",C," : by ? ",B," : ",A,");
    if (!located) text += exact(std::atan2(d.x(), d.y()) / degree);
    if (!flat) text += located ? ",," : "," + exact(d.norm()) + "," + exact(std::asin(d.z() / d.norm()) / degree);
    if (columns) text += located ? none : cells(b, l, h);
    if (mixed) text += located ? cells(latitude, longitude, altitude) : none;
    text += "\n";
  }
  return text;
}

TEST(HimmDemoSensors, OnTheEarthEachMeasuresFromItsOwnNorthAndHorizon) {
  for (int k = 0; k < 8; ++k) {
    const bool flat = k % 2 == 1, columns = k / 2 % 2 == 1, mixed = k / 4 == 1;
    SCOPED_TRACE(k);
    Arguments sets = {"sigma_azimuth_deg=0.001", "sigma_elevation_deg=0.001", "sigma_range_m=1", "sigma_position_m=5"};
    if (!columns)
      sets = sets + Arguments{"sensor.A.latitude_deg=60",   "sensor.A.longitude_deg=10",   "sensor.A.altitude_m=250",
                              "sensor.B.latitude_deg=60.5", "sensor.B.longitude_deg=11.3", "sensor.B.altitude_m=20"};
    const auto all = tracked(seen_on_the_earth(flat, columns, mixed), sets);
    EXPECT_TRUE(says(all.output, {"Positions are counted from the first place, latitude 60°, longitude 10°"}));
    const auto found = rows(all.estimates);
    EXPECT_GT(found.size(), 100U);
    for (const auto& each : found) {
      SCOPED_TRACE(each.at("time_s"));
      const double time = number(each.at("time_s"));
      const auto [latitude, longitude, altitude] = target_on_the_earth(static_cast<int>(std::lround(time / 2.0)));
      EXPECT_NEAR(number(each.at("latitude_deg")), latitude, flat ? 1e-4 : 1e-5);
      EXPECT_NEAR(number(each.at("longitude_deg")), longitude, flat ? 2e-4 : 2e-5);
      if (!flat) {
        EXPECT_NEAR(number(each.at("altitude_m")), altitude, 1.0);
      }
    }
  }
}

/// A ship with a direction finder that turns its bow tells where a beacon is, alone.
TEST(HimmDemoSensors, AStationThatMovesCrossesItsOwnBearings) {
  const auto row = [](int k) {
    const double x = k < 20 ? 10.0 * k : 200.0, y = k < 20 ? 0.0 : 10.0 * (k - 20);
    return exact(10.0 * k) + "," + exact(std::atan2(1500.0 - 10.0 * y, 2000.0 - 10.0 * x) / degree) + "," +
           exact(10.0 * x) + "," + exact(10.0 * y);
  };
  const auto found = estimates(recording("time_s,azimuth_deg,sensor_x_m,sensor_y_m", row, 40),
                               {"sigma_azimuth_deg=0.01", "sigma_w=0.001", "models=[dwna]"});
  ASSERT_GT(found.size(), 10U);
  EXPECT_GE(number(found.front().at("time_s")), 200.0) << "before it turned nothing tells the range";
  EXPECT_NEAR(number(found.back().at("x_m")), 2000.0, 5.0);
  EXPECT_NEAR(number(found.back().at("y_m")), 1500.0, 5.0);
}

}  // namespace himm_demo_sensors_test
