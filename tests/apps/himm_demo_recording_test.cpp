// What `track` reads: radars, several sensors, geodetic tracks on two axes, dates, tracks side by side.

#include <nlohmann/json.hpp>

#include <sigmax/earth/local_frame.hpp>
#include "apps/recordings.hpp"

namespace himm_demo_recording_test {

using support::degree;

using restatement::Index;
using restatement::Position;

/// Where a target is, about 6 km from a radar at the origin: straight, turning, straight, with a gap of a minute.
struct Flown {
  double time;
  std::array<double, 3> x;
};

std::vector<Flown> flight(std::size_t axes) {
  std::vector<Flown> points;
  std::array<double, 3> x = {5000.0, -3000.0, 800.0};
  std::array<double, 3> v = {-60.0, 80.0, 5.0};
  double time = 100.0;
  for (int k = 0; k < 120; ++k) {
    const double dt = k == 90 ? 60.0 : 0.5 + 0.25 * (k % 3);
    time += dt;
    for (std::size_t i = 0; i < 3; ++i) x[i] += dt * v[i];
    if (k >= 40 && k < 70) v = {v[0] - 4.0 * dt, v[1] - 6.0 * dt, v[2]};
    points.push_back({time, {x[0], x[1], axes == 3 ? x[2] : 0.0}});
  }
  return points;
}

struct Sigma {
  double range, azimuth_deg, elevation_deg;
};

/// A radar's measurement: m and degrees counter-clockwise from east.
std::array<double, 3> seen(const std::array<double, 3>& x, const Sigma& sigma, std::mt19937_64& engine) {
  std::normal_distribution<double> noise;
  const double ground = std::hypot(x[0], x[1]);
  const double range = std::hypot(ground, x[2]) + sigma.range * noise(engine);
  const double azimuth = std::atan2(x[1], x[0]) / degree + sigma.azimuth_deg * noise(engine);
  return {range, azimuth, std::atan2(x[2], ground) / degree + sigma.elevation_deg * noise(engine)};
}

Position converted(const std::array<double, 3>& z, const Sigma& sigma, std::size_t axes,
                   const std::array<double, 3>& at = {0, 0, 0}) {
  const Position full = restatement::standard_conversion(z[0], z[1] * degree, z[2] * degree, sigma.range,
                                                         sigma.azimuth_deg * degree, sigma.elevation_deg * degree);
  Position position{restatement::Vector(axes), restatement::Matrix(axes, axes)};
  for (Index i = 0; i < axes; ++i) {
    position.z[i] = full.z[i] + at[i];
    for (Index j = 0; j < axes; ++j) position.R(i, j) = full.R(i, j);
  }
  return position;
}

/// Every estimate of both filters equals that of the plain restatement with the default settings.
void expect_by_default(const std::string& estimates, const std::vector<Detection>& all, std::size_t axes) {
  using restatement::Kind, restatement::Matrix;
  const auto found = rows(estimates);
  const double T12 = all[1].time - all[0].time, T23 = all[2].time - all[1].time;
  for (const auto& [name, kind, transition] : {std::tuple{"imm", Kind::imm, Matrix(2, 2, {0.95, 0.05, 0.05, 0.95})},
                                               std::tuple{"himm", Kind::himm, Matrix(2, 2, {1, 0.5, 0.5, 1})}}) {
    const restatement::Options options{.kind = kind,
                                       .mixed_covariance = restatement::MixedCovariance::own_recentred,
                                       .augmentation = restatement::StateAugmentation::borrowed_variance};
    const restatement::Filter filter({restatement::dwna(axes, 3.0), restatement::dwpa(axes, 3.0)}, transition,
                                     {restatement::two_point_start(*all[1].z, *all[2].z, T23),
                                      restatement::three_point_start(*all[0].z, *all[1].z, *all[2].z, T12, T23)},
                                     {1.0, 1.0}, options);
    expect_restated(of_filter(found, name), filter, all[2].time, {all.begin() + 3, all.end()});
  }
}

Arguments radar_settings(const Sigma& sigma) {
  return {"sigma_range_m=" + exact(sigma.range), "sigma_azimuth_deg=" + exact(sigma.azimuth_deg),
          "sigma_elevation_deg=" + exact(sigma.elevation_deg)};
}

struct RadarCase {
  std::size_t axes;
  bool from_north;
  std::array<double, 3> at;

  friend void PrintTo(const RadarCase& test, std::ostream* text) {
    *text << test.axes << " axes, azimuth from " << (test.from_north ? "north" : "east") << ", a radar at "
          << testing::PrintToString(test.at);
  }
};

class RadarInput : public testing::TestWithParam<RadarCase> {};

TEST_P(RadarInput, IsConvertedAsTheStandardConversionHasIt) {
  const auto [axes, from_north, at] = GetParam();
  const Sigma sigma{20.0, 0.3, 0.2};
  std::mt19937_64 engine(5);
  std::string text = axes == 3 ? "time_s,range_m,azimuth_deg,elevation_deg\n" : "time_s,range_m,azimuth_deg\n";
  std::vector<Detection> expected;
  std::size_t k = 0;
  for (const auto& [time, x] : flight(axes)) {
    if (++k % 11 == 0) {  // missed
      text += exact(time) + (axes == 3 ? ",,,\n" : ",,\n");
      expected.push_back({time, {}});
      continue;
    }
    const auto z = seen(x, sigma, engine);
    text += exact(time) + "," + exact(z[0]) + "," + exact(from_north ? 90.0 - z[1] : z[1]);
    text += axes == 3 ? "," + exact(z[2]) + "\n" : "\n";
    expected.push_back({time, converted({z[0], z[1], axes == 3 ? z[2] : 0.0}, sigma, axes, at)});
  }
  Arguments options = {"--radar-at=" + exact(at[0]) + "," + exact(at[1]) + "," + exact(at[2])};
  if (from_north) options.insert(options.end(), {"--azimuth-from", "north"});
  expect_by_default(tracked(text, radar_settings(sigma), options).estimates, expected, axes);
}

INSTANTIATE_TEST_SUITE_P(HimmDemo, RadarInput,
                         testing::Values(RadarCase{3, false, {0, 0, 0}}, RadarCase{3, true, {100, -50, 7}},
                                         RadarCase{2, false, {-30, 40, 0}}, RadarCase{2, true, {0, 0, 0}}),
                         [](const auto& test) {
                           return (test.param.axes == 3 ? "Three" : "Two") +
                                  std::string(test.param.from_north ? "AxesFromNorth" : "AxesFromEast");
                         });

TEST(HimmDemoRecording, ARoundPathAboutARadarEqualsItsConvertedMeasurements) {
  // With σ_r = r σ_α the converted covariance is σ_r² I, which Cartesian input can have too.
  const double range = 4000.0, sigma_azimuth_deg = 0.5;
  const double sigma_range = range * sigma_azimuth_deg * degree;
  std::string polar = "time_s,range_m,azimuth_deg\n", cartesian = "time_s,x_m,y_m\n";
  std::mt19937_64 engine(3);
  std::normal_distribution<double> noise(0.0, sigma_azimuth_deg);
  for (int k = 0; k < 200; ++k) {
    const double azimuth = 2.0 * k + noise(engine) - 200.0;
    polar += std::to_string(k) + "," + exact(range) + "," + exact(azimuth) + "\n";
    cartesian += std::to_string(k) + "," + exact(range * std::cos(azimuth * degree)) + "," +
                 exact(range * std::sin(azimuth * degree)) + "\n";
  }
  const auto by_radar = estimates(polar, radar_settings({sigma_range, sigma_azimuth_deg, 1.0}));
  const auto by_position = estimates(cartesian, {"sigma_position_m=" + exact(sigma_range)});
  ASSERT_EQ(by_radar.size(), 2U * 197U);
  ASSERT_EQ(by_radar.size(), by_position.size());
  for (std::size_t k = 0; k < by_radar.size(); ++k)
    for (const auto& [name, cell] : by_position[k]) {
      const std::string& other = by_radar[k].at(name);
      if (name == "filter" || name == "most_likely" || cell.empty()) {
        ASSERT_EQ(other, cell) << name;
      } else {
        ASSERT_CLOSE(std::stod(other), std::stod(cell), 1e-9) << name << " of row " << k;
      }
    }
}

TEST(HimmDemoRecording, EachSensorOfAFileHasItsAccuracy) {
  for (const std::size_t axes : {2U, 3U}) {
    SCOPED_TRACE(axes);
    const Sigma coarse{40.0, 0.6, 0.5}, fine{15.0, 0.1, 0.5};  // the elevation's is the same for both
    std::mt19937_64 engine(9);
    std::normal_distribution<double> noise(0.0, 5.0);
    std::string text = axes == 3 ? "time_s,sensor,x_m,y_m,z_m,range_m,azimuth_deg,elevation_deg\n"
                                 : "time_s,sensor,x_m,y_m,range_m,azimuth_deg\n";
    std::vector<Detection> expected;
    std::size_t k = 0;
    for (const auto& [time, x] : flight(axes)) {
      if (k % 3 == 0) {
        Position z{restatement::Vector(axes), restatement::Matrix(axes, axes)};
        text += exact(time) + ",lidar";
        for (Index i = 0; i < axes; ++i) {
          z.z[i] = x[i] + noise(engine);
          z.R(i, i) = 25.0;
          text += "," + exact(z.z[i]);
        }
        text += axes == 3 ? ",,,\n" : ",,\n";
        expected.push_back({time, z});
      } else {
        const Sigma& sigma = k % 3 == 1 ? coarse : fine;
        const auto z = seen(x, sigma, engine);
        text += exact(time) + (k % 3 == 1 ? ",old radar" : ",new") + (axes == 3 ? ",,,," : ",,,") + exact(z[0]) + "," +
                exact(z[1]) + (axes == 3 ? "," + exact(z[2]) : "") + "\n";
        expected.push_back({time, converted({z[0], z[1], axes == 3 ? z[2] : 0.0}, sigma, axes)});
      }
      ++k;
    }
    const TemporaryDirectory directory;
    const auto settings =
        directory.write("settings.toml",
                        "sigma_range_m = 40\nsigma_elevation_deg = 0.5\n[sensor.lidar]\nsigma_position_m = 5\n"
                        "[sensor.\"old radar\"]\nsigma_azimuth_deg = 0.6\n"
                        "[sensor.new]\nsigma_azimuth_deg = 0.1\n[filter.imm.sensor.new]\nsigma_range_m = 15\n"
                        "[filter.himm.sensor.new]\nsigma_range_m = 15\n");
    const auto found = tracked(text, {}, {"--config", settings});
    expect_by_default(found.estimates, expected, axes);
    EXPECT_TRUE(says(found.output, {"Rows by sensor: lidar 40, new 40, old radar 40"}));

    const auto printed = program::run(SIGMAX_HIMM_DEMO, {"track", "any", "--print-config", "--config", settings});
    const auto again = directory.write("again.toml", printed.output);
    EXPECT_EQ(program::run(SIGMAX_HIMM_DEMO, {"track", "any", "--print-config", "--config", again}).output,
              printed.output);
  }
}

TEST(HimmDemoRecording, EachRowMayTellItsWholeCovariance) {
  for (const std::size_t axes : {2U, 3U}) {
    SCOPED_TRACE(axes);
    std::mt19937_64 engine(4);
    std::normal_distribution<double> noise;
    std::string text = axes == 3 ? "time_s,x_m,y_m,z_m,cov_xx,cov_xy,cov_yy_m2,cov_xz,cov_yz,cov_zz_m2\n"
                                 : "time_s,x_m,y_m,cov_xx,cov_xy,cov_yy_m2\n";
    std::vector<Detection> expected;
    for (const auto& [time, x] : flight(axes)) {
      Position z{restatement::Vector(axes), restatement::Matrix(axes, axes)};
      text += exact(time);
      std::vector<double> errors(
          axes);  // the covariance is that of three errors along directions of the row, and some along all
      for (const double sigma : {3.0, 8.0, 5.0}) {
        for (double& error : errors) error = sigma * noise(engine);
        for (Index i = 0; i < axes; ++i)
          for (Index j = 0; j < axes; ++j) z.R(i, j) += errors[i] * errors[j] + (i == j ? 1.0 : 0.0);
      }
      for (Index i = 0; i < axes; ++i) text += "," + exact(z.z[i] = x[i] + errors[i]);
      for (Index i = 0; i < axes; ++i)
        for (Index j = 0; j <= i; ++j) text += "," + exact(z.R(i, j));
      text += "\n";
      expected.push_back({time, z});
    }
    expect_by_default(tracked(text).estimates, expected, axes);
  }
}

TEST(HimmDemoRecording, ErrorsAreThoseAgainstTheTruthWhereItIsGiven) {
  std::mt19937_64 engine(2);
  std::normal_distribution<double> noise(0.0, 10.0);
  std::string text = "time_s,x_m,y_m,true_x_m,true_y_m\n";
  const auto points = flight(2);
  for (const auto& [time, x] : points)
    text += exact(time) + "," + exact(x[0] + noise(engine)) + "," + exact(x[1] + noise(engine)) + "," + exact(x[0]) +
            "," + exact(x[1]) + "\n";
  const auto track = tracked(text);
  const auto results = nlohmann::json::parse(track.summary).at("results").at("all");
  const auto found = rows(track.estimates);
  const auto measured = rows(text);
  for (const std::string filter : {"measurement", "imm", "himm"})
    for (const auto& [axis, index] : {std::pair{"x", 0U}, {"y", 1U}}) {
      double sum = 0.0, variance = 0.0;
      std::size_t count = 0;
      if (filter == "measurement") {
        for (; count < points.size(); ++count)
          sum += std::pow(std::stod(measured[count].at(axis + std::string("_m"))) - points[count].x[index], 2);
      } else {
        for (const auto& row : found)
          if (row.at("filter") == filter) {
            sum += std::pow(std::stod(row.at(axis + std::string("_m"))) - points[3 + count].x[index], 2);
            variance += std::pow(std::stod(row.at("sigma_" + std::string(axis) + "_m")), 2);
            ++count;
          }
        EXPECT_CLOSE(results.at(filter).at(std::string("sigma_") + axis + "_m").get<double>(),
                     std::sqrt(variance / static_cast<double>(count)), 1e-9);
      }
      EXPECT_CLOSE(results.at(filter).at(std::string("rmse_") + axis + "_m").get<double>(),
                   std::sqrt(sum / static_cast<double>(count)), 1e-9);
    }
}

/// Three tracks of one file, whose rows lie between each other's in time; `axes` columns of positions.
struct Interleaved {
  std::string all;
  std::map<std::string, std::string> alone;
};

Interleaved interleaved(std::size_t axes) {
  const std::string header = axes == 3 ? "time_s,ship,x_m,y_m,z_m\n" : "time_s,ship,x_m,y_m\n";
  Interleaved result{header, {{"A", header}, {"B", header}, {"C", header}}};
  std::mt19937_64 engine(1);
  std::normal_distribution<double> noise(0.0, 10.0);
  for (int k = 0; k < 300; ++k) {
    const std::string ship = k % 5 == 0 ? "A" : k % 2 == 0 ? "B" : "C";
    std::string row = std::to_string(0.5 * k) + "," + ship;
    for (std::size_t i = 0; i < axes; ++i) row += "," + exact(3000.0 + 5.0 * k + noise(engine));
    result.all += row + "\n";
    result.alone[ship] += row + "\n";
  }
  return result;
}

/// The lines of one track, without the column that names it.
std::string lines_of(const std::string& text, const std::string& track) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    const auto first = line.find(',');
    const auto second = line.find(',', first + 1);
    const std::string name = line.substr(first + 1, second - first - 1);
    if (name == track || name == "track") result += line.substr(0, first) + line.substr(second) + "\n";
  }
  return result;
}

TEST(HimmDemoRecording, TracksOfOneFileEqualEachAlone) {
  const auto [all, alone] = interleaved(2);
  const auto together = tracked(all, {}, {"--track-id", "ship"});
  EXPECT_TRUE(says(together.output, {"3 tracks by ship  all"}));
  for (const auto& [ship, text] : alone) {
    const std::string own = lines_of(together.estimates, ship);
    EXPECT_EQ(own, tracked(text).estimates) << ship;
    EXPECT_EQ(own, tracked(all, {}, {"--select", "ship=" + ship}).estimates) << ship;
  }
}

TEST(HimmDemoRecording, TheSimulatedRadarSeesATrackAlikeWhicheverOthersThereAre) {
  const auto [all, alone] = interleaved(3);
  const Arguments radar = {"--track-id", "ship", "--radar", "10,0.1,0.1"};
  const std::string together = tracked(all, {}, radar).estimates;
  for (const auto& [ship, text] : alone)
    EXPECT_EQ(lines_of(together, ship), lines_of(tracked(text, {}, radar).estimates, ship));
}

TEST(HimmDemoRecording, TheStandardInputEqualsTheFile) {
  const std::string text = interleaved(2).all;
  const TemporaryDirectory directory;
  const std::string input = directory.write("input.csv", text);
  const std::string out = directory.path() / "out";
  const auto ending = program::succeeds("/bin/sh", {"-c", "exec \"$1\" track - --track-id ship --out \"$2\" < \"$3\"",
                                                    "sh", program::chosen(SIGMAX_HIMM_DEMO), out, input});
  EXPECT_TRUE(says(ending.output, {"\nstandard input: 300 rows"}));
  EXPECT_EQ(contents(directory.path() / "out" / "estimates.csv"), tracked(text, {}, {"--track-id", "ship"}).estimates);
}

TEST(HimmDemoRecording, AMillionRowsTakeLessThanAGigabyte) {
  const TemporaryDirectory directory;
  const auto file_of = [&](const std::string& name, int count) {
    std::ofstream file(directory.path() / name);
    file << "time_s,x_m,y_m\n";
    for (int k = 0; k < count; ++k) file << k << ',' << 10 * k << ',' << k % 100 << ".123456\n";
    return (directory.path() / name).string();
  };
  const auto peak = [&](const std::string& file) {
    return program::peak_memory(SIGMAX_HIMM_DEMO, Arguments{"track", file} + setting({"filters=imm", "models=dwna"}));
  };
  const long small = peak(file_of("small.csv", 10'000));
  const std::string large = file_of("large.csv", 200'000);
  EXPECT_LT(peak(large) - small, 190'000);  // KiB, of as many rows
}

TEST(HimmDemoRecording, RecordedShipsAreTrackedOneByOneAndAllAtOnce) {
  const std::string file = recorded("ais_solent.csv");
  if (file.empty()) GTEST_SKIP() << "no recorded data in " << SIGMAX_DATA;
  const TemporaryDirectory directory;
  const auto run = [&](const std::string& out, std::vector<std::string> more) {
    return program::run(SIGMAX_HIMM_DEMO,
                        Arguments{"track", file, "--columns",
                                  "time_s=Time,latitude_deg=Latitude_degrees,longitude_deg=Longitude_degrees",
                                  "--origin", "50.8,-1.1,0", "--set", "sigma_w=0.05", "--out", directory.path() / out} +
                            more);
  };
  const auto all = program::succeeded(run("all", {"--track-id", "MMSI", "--on-bad-time", "skip"}));
  const std::string said = all.on_one_line();
  EXPECT_TRUE(says(
      said, {"18620 rows, 18620 measurements, 2 axes", "91 tracks by MMSI, 3 of them too short", "Skipped 3 rows"}));
  const auto one = program::succeeded(run("one", {"--select", "MMSI=235013375"}));
  const std::string alone = contents(directory.path() / "one" / "estimates.csv");
  EXPECT_EQ(rows(alone).size(), 2U * 1135U);
  EXPECT_EQ(lines_of(contents(directory.path() / "all" / "estimates.csv"), "235013375"), alone);
  EXPECT_EQ(run("none", {"--track-id", "MMSI"}).status, 3) << "three reports come twice";
}

TEST(HimmDemoRecording, ARecordedLidarAndRadarAreFusedAgainstTheTruth) {
  const std::string file = recorded("lidar_radar.csv");
  if (file.empty()) GTEST_SKIP() << "no recorded data in " << SIGMAX_DATA;
  const TemporaryDirectory directory;
  const auto ending =
      program::succeeds(SIGMAX_HIMM_DEMO, {"track", file, "--set", "sensor.lidar.sigma_position_m=0.15", "--set",
                                           "sensor.radar.sigma_range_m=0.3", "--set",
                                           "sensor.radar.sigma_azimuth_deg=1.72", "--out", directory.path()});
  EXPECT_TRUE(says(ending.on_one_line(), {"Rows by sensor: lidar 250, radar 250"}));
  const auto results = nlohmann::json::parse(contents(directory.path() / "summary.json")).at("results").at("all");
  const auto truth = rows(contents(file));
  const auto found = rows(contents(directory.path() / "estimates.csv"));
  ASSERT_EQ(found.size(), 2U * 497U);
  for (std::size_t f = 0; f < 2; ++f)
    for (const std::string axis : {"x", "y"}) {
      double sum = 0.0;
      for (std::size_t k = 3; k < 500; ++k)
        sum += std::pow(
            std::stod(found[2 * (k - 3) + f].at(axis + "_m")) - std::stod(truth[k].at("true_" + axis + "_m")), 2);
      const double rmse = results.at(f == 0 ? "imm" : "himm").at(std::string("rmse_") + axis + "_m").get<double>();
      EXPECT_CLOSE(rmse, std::sqrt(sum / 497.0), 1e-9);
      EXPECT_LT(rmse, results.at("measurement").at(std::string("rmse_") + axis + "_m").get<double>());
    }
}

}  // namespace himm_demo_recording_test
