// What recordings look like that nobody made for this program: units, tabs, clocks, sentinels, several sensors at once.

#include "apps/recordings.hpp"
#include "apps/temporary_directory.hpp"
#include "support/program.hpp"

namespace {

struct Tracked {
  std::string output;
  std::string estimates;
};

Tracked tracked(const std::string& recording, std::vector<std::string> options = {}) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("real.csv", recording);
  const auto ending = program::succeeds(
      SIGMAX_HIMM_DEMO, Arguments{"track", file, "--quiet", "--out", directory.path() / "out"} + options);
  return {ending.on_one_line(), contents(directory.path() / "out" / "estimates.csv")};
}

/// A row for each k by `row(k)`.
template <class Row>
std::string recording(const std::string& header, const Row& row, int count = 30) {
  std::string text = header + "\n";
  for (int k = 0; k < count; ++k) text += row(k) + "\n";
  return text;
}

TEST(HimmDemoRealInput, HeadersMayNameOtherUnits) {
  const auto metres = recording("time_s,range_m,azimuth_deg", [](int k) {
    return exact(k) + "," + exact(1852.0 * (10.0 + 0.01 * k)) + "," + exact(90.0 - (30.0 + 0.1 * k));
  });
  const auto miles = recording("time_s,range_nmi,azimuth_deg_north", [](int k) {
    return exact(k) + "," + exact(10.0 + 0.01 * k) + "," + exact(30.0 + 0.1 * k);
  });
  const auto a = rows(tracked(metres).estimates), b = rows(tracked(miles).estimates);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(number(a[k].at("x_m")), number(b[k].at("x_m")), 1e-6);
  EXPECT_TRUE(
      says(tracked(miles).output, {"range_nmi in nautical miles, azimuth_deg_north in ° clockwise from north"}));
  EXPECT_TRUE(says(tracked(metres).output, {"range_m in m, azimuth_deg in ° counter-clockwise from east"}));
}

/// The numbers of x, y, and a speed along x, in other units than m and m/s.
std::string in_units(const std::string& length, double metres, const std::string& speed, double metres_per_second) {
  return recording("time_s,x_" + length + ",y_" + length + ",speed_" + speed + ",course_deg,true_x_" + length +
                       ",true_y_" + length + ",sigma_x_" + length + ",sigma_y_" + length,
                   [&](int k) {
                     const auto in_length = [&](double value) { return "," + exact(value / metres); };
                     return exact(k) + in_length(500.0 + 20.0 * k + k % 3) + in_length(7.0 * (k % 4)) + "," +
                            exact((20.0 + k % 2) / metres_per_second) + ",90" + in_length(500.0 + 20.0 * k) +
                            in_length(3.0) + in_length(4.0) + in_length(5.0);
                   });
}

TEST(HimmDemoRealInput, AllLengthsAndSpeedsMayBeInAllUnits) {
  const std::vector<std::string> options = {"--set", "sigma_velocity_mps=1"};
  const auto expected = rows(tracked(in_units("m", 1.0, "mps", 1.0), options).estimates);
  const std::vector<std::pair<std::string, double>> lengths = {
      {"km", 1000.0}, {"ft", 0.3048}, {"nmi", 1852.0}, {"mi", 1609.344}, {"m", 1.0}};
  const std::vector<std::pair<std::string, double>> speeds = {
      {"kmh", 1.0 / 3.6}, {"kt", 1852.0 / 3600.0}, {"mph", 0.44704}, {"fps", 0.3048}, {"fpm", 0.00508}};
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    SCOPED_TRACE(lengths[i].first + ", " + speeds[i].first);
    const auto found = rows(
        tracked(in_units(lengths[i].first, lengths[i].second, speeds[i].first, speeds[i].second), options).estimates);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k)
      for (const char* column : {"x_m", "vx_mps", "sigma_y_m", "nis"})
        EXPECT_NEAR(number(found[k].at(column)), number(expected[k].at(column)), 1e-6) << column;
  }
}

TEST(HimmDemoRealInput, SaysWhichColumnsItDoesNotUse) {
  const auto extra = recording("time_s,x_m,y_m,x_km,vx_mps,vy_mps,range_rate_mps,altitude,colour",
                               [](int k) { return exact(k) + "," + exact(10 * k) + ",7,0,10,0,1,200,red"; });
  const std::string plain = tracked(extra).output;
  EXPECT_TRUE(
      says(plain, {"Not used: x_km (x_m says it), altitude (name its unit: _m, _km, _ft, _nmi or _mi), vx_mps, vy_mps "
                   "(give --set sigma_velocity_mps=…), range_rate_mps (does not go with the others), colour"}));
  EXPECT_FALSE(says(tracked(extra, {"--set", "sigma_velocity_mps=1"}).output, {"vx_mps, vy_mps (give"}));
  const auto radar = recording("time_s,range_m,azimuth_deg,range_rate_mps,vx_mps,vy_mps",
                               [](int k) { return exact(k) + "," + exact(9000 + k) + ",5,1,2,3"; });
  EXPECT_TRUE(says(tracked(radar).output, {"range_rate_mps (give --set sigma_range_rate_mps=…)"}));
  const auto moving = tracked(radar, {"--set", "sigma_velocity_mps=1", "--set", "sigma_range_rate_mps=1"});
  EXPECT_FALSE(says(moving.output, {"Not used"}));
  EXPECT_TRUE(says(moving.output, {"Velocities do not count in rows of a radar or with a bearing: 30 rows"}));
  const auto two = recording("time_s,sensor,x_m,y_m,vx_mps,vy_mps",
                             [](int k) { return exact(k) + (k % 3 == 0 ? ",a," : ",b,") + exact(10 * k) + ",7,10,0"; });
  EXPECT_TRUE(says(tracked(two, {"--set", "sensor.a.sigma_velocity_mps=1"}).output,
                   {"velocity does not count, for want of sensor.NAME.sigma_velocity_mps: b 20"}));
  EXPECT_FALSE(says(tracked(two, {"--set", "sigma_velocity_mps=1"}).output, {"for want of"}));
  const auto truth = recording("time_s,x_m,y_m,z_m,vx_mps,vy_mps,sigma_x_m",
                               [](int k) { return exact(k) + "," + exact(5000 + k) + ",7,9,1,0,1"; });
  EXPECT_TRUE(says(tracked(truth, {"--radar", "50,0.1,0.1", "--set", "sigma_velocity_mps=1"}).output,
                   {"Not used: vx_mps, vy_mps (--radar measures no velocity), sigma_x_m (--radar has its own)"}));
  const auto place = recording("time_s,latitude_deg,longitude_deg,azimuth_deg",
                               [](int k) { return exact(k) + ",50," + exact(1e-4 * k) + ",5"; });
  EXPECT_TRUE(says(tracked(place).output, {"Not used: azimuth_deg (does not go with the others)"}));
  const auto none = recording("time_s,x_m,y_m", [](int k) { return exact(k) + "," + exact(k) + ",7"; });
  EXPECT_FALSE(says(tracked(none).output, {"Not used"}));
}

TEST(HimmDemoRealInput, NoColumnGoesUnsaid) {
  const auto with = [](const std::string& more, const std::string& cells) {
    return tracked(
               recording("time_s,x_m,y_m," + more, [&](int k) { return exact(k) + "," + exact(k) + ",7," + cells; }),
               {"--set", "sigma_velocity_mps=1"})
        .output;
  };
  EXPECT_TRUE(says(with("flight_level,accuracy_m,sensor_x_m,sigma_m,heading_deg,cov_vxvx", "1,2,3,4,5,6"),
                   {"Not used: accuracy_m, sigma_m (one standard deviation along each axis is sigma_position_m), "
                    "flight_level, sensor_x_m, heading_deg, cov_vxvx  all"}));
  // A pair that lacks its other half says which.
  EXPECT_TRUE(says(with("sog_kt", "1"), {"Not used: sog_kt (needs track_deg or course_deg or cog_deg)"}));
  EXPECT_TRUE(says(with("latitude_deg,true_y_m", "1,1"),
                   {"Not used: latitude_deg (needs longitude_deg), true_y_m (needs true_x_m)"}));
  EXPECT_TRUE(says(with("elevation_deg", "1"), {"Not used: elevation_deg (needs range_m)"}));
  EXPECT_TRUE(says(with("altitude_ft,altitude", "1,1"), {"Not used: altitude_ft (needs latitude_deg), altitude"}));
  EXPECT_TRUE(says(with("", "1"), {"Not used: column 4"}));
}

/// A ship at 10 m/s east by the names of AIS, every fifth row with these cells.
std::string ship(const std::string& speed, const std::string& course, const std::string& place_and_velocity) {
  return recording("time_s,latitude_deg,longitude_deg," + speed + "," + course, [&](int k) {
    const std::string ordinary = "50," + exact(0.0014 * k) + "," + exact(10.0 * 3600.0 / 1852.0) + ",90";
    return exact(10 * k) + "," + (k % 5 == 4 ? place_and_velocity : ordinary);
  });
}

TEST(HimmDemoRealInput, WhatAisHasWhereThereIsNoNumberIsMissing) {
  const std::vector<std::string> velocity = {"--set", "sigma_velocity_mps=1"};
  const auto in = [&](const std::string& cells) { return tracked(ship("sog_kt", "cog_deg", cells), velocity); };
  const auto sentinels = in("91,181,102.3,360");
  EXPECT_EQ(sentinels.estimates, in(",,,").estimates);
  EXPECT_TRUE(says(sentinels.output, {"sog_kt in kt, cog_deg in ° clockwise from north"}));
  EXPECT_TRUE(says(sentinels.output, {"Cells that say that there is no number: latitude_deg 6, longitude_deg 6, sog_kt "
                                      "6, cog_deg 6  all"}));
  EXPECT_EQ(in("50,0.1,102.3,90").estimates, in("50,0.1,,").estimates);
  EXPECT_EQ(in("50,0.1,10,360.0").estimates, in("50,0.1,,").estimates);
  EXPECT_EQ(in("50,181,1,0").estimates, in("50,-179,1,0").estimates);  // alone it is a place
  // Names that are not those of AIS keep their numbers.
  const auto course = [&](const std::string& cells) {
    return tracked(ship("speed_kt", "course_deg", cells), velocity).estimates;
  };
  EXPECT_NE(course("50,0.1,102.3,90"), course("50,0.1,,"));
  EXPECT_NE(course("50,0.1,10,360"), course("50,0.1,,"));
}

TEST(HimmDemoRealInput, CellsThatStandForNoNumberMayBeNamed) {
  const auto with = [](const std::string& cells) {
    return recording("time_s,x_m,y_m,roll_deg",
                     [&](int k) { return exact(k) + "," + (k % 6 == 5 ? cells : exact(10 * k) + ",7,1"); });
  };
  const auto named = tracked(with("-999, n/a ,-999.0"), {"--missing=-999,n/a"});
  EXPECT_EQ(named.estimates, tracked(with(",,")).estimates);
  EXPECT_TRUE(says(named.output, {"Cells that say that there is no number: x_m 5, y_m 5, roll_deg 5"}));
}

TEST(HimmDemoRealInput, ANisFarTooLowIsWarnedOf) {
  const auto as_metres =
      recording("time_s,range_m,azimuth_deg", [](int k) { return exact(k) + "," + exact(10.0 + 0.001 * k) + ",45"; });
  EXPECT_TRUE(says(tracked(as_metres).output, {"in another unit than was taken"}));
}

TEST(HimmDemoRealInput, SeveralTargetsInOneFileNameTheOptionThatTellsThemApart) {
  const auto mixed = recording("time_s,x_m,y_m", [](int k) { return exact(k) + "," + exact(5e4 * (k % 2)) + ",0"; });
  EXPECT_TRUE(says(tracked(mixed).output, {"tell them apart with --track-id COLUMN"}));
}

TEST(HimmDemoRealInput, TabsAndTimesOfDayAreRead) {
  const auto seconds =
      recording("time_s,x_m,y_m", [](int k) { return exact(36900.0 + k) + "," + exact(k * k) + ",7"; });
  const auto clock = recording("time_s\tx_m\ty_m", [](int k) {
    return "10:15:" + std::string(k < 10 ? "0" : "") + exact(k) + "\t" + exact(k * k) + "\t7";
  });
  EXPECT_EQ(tracked(seconds).estimates, tracked(clock).estimates);
}

TEST(HimmDemoRealInput, TimesComeOutAsDatesOnRequest) {
  const auto dated = recording("time_s,x_m,y_m", [](int k) {
    return "2016-02-29T23:59:" + std::string(k < 10 ? "0" : "") + exact(k) + ".25Z," + exact(10 * k) + ",7";
  });
  const auto found = rows(tracked(dated, {"--iso-times"}).estimates);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().at("time_utc"), "2016-02-29T23:59:03.25Z");
}

TEST(HimmDemoRealInput, ASentinelIsAMissedMeasurement) {
  const auto with = [](const char* cells) {
    return recording("time_s,x_m,y_m",
                     [&](int k) { return exact(k) + "," + (k == 9 ? std::string(cells) : exact(10 * k) + ",7"); });
  };
  const auto sentinel = tracked(with("1.797e308,7"));
  EXPECT_EQ(sentinel.estimates, tracked(with(",")).estimates);
  EXPECT_TRUE(says(sentinel.output, {"real.csv:11: no measurement can be that great; 1 such row counts as missed"}));
}

TEST(HimmDemoRealInput, TwoSensorsMayMeasureAtOneTime) {
  std::string both = "time_s,sensor,x_m,y_m\n", once = "time_s,x_m,y_m\n";
  for (int k = 0; k < 30; ++k) {
    for (const char* sensor : {",a,", ",b,"}) both += exact(k) + sensor + exact(10 * k) + ",7\n";
    once += exact(k) + "," + exact(10 * k) + ",7\n";
  }
  const auto found = rows(tracked(both).estimates);
  const auto alone = rows(tracked(once).estimates);
  EXPECT_EQ(number(found.back().at("time_s")), 29.0);
  EXPECT_NEAR(number(found.back().at("x_m")), 290.0, 1e-6);
  EXPECT_LT(number(found.back().at("sigma_x_m")), number(alone.back().at("sigma_x_m")));
}

TEST(HimmDemoRealInput, AHeightMayBeMissing) {
  const auto with = [](const char* height) {
    return recording("time_s,x_m,y_m,z_m", [&](int k) {
      return exact(k) + "," + exact(10 * k) + ",7," + (k % 3 == 2 && k > 5 ? std::string(height) : exact(100 + 2 * k));
    });
  };
  const auto missing = rows(tracked(with("")).estimates);
  // As a height that is measured, but to nothing: what is known across is the same.
  for (const auto& row : missing) {
    EXPECT_NEAR(number(row.at("x_m")), 10.0 * number(row.at("time_s")), 1e-6);
    EXPECT_NEAR(number(row.at("z_m")), 100.0 + 2.0 * number(row.at("time_s")), 1e-6);
  }
  const auto whole = rows(tracked(recording("time_s,x_m,y_m,z_m", [](int k) {
                            return exact(k) + "," + exact(10 * k) + ",7," + exact(100 + 2 * k);
                          })).estimates);
  EXPECT_GT(number(missing.back().at("sigma_z_m")), 1.05 * number(whole.back().at("sigma_z_m")));
  EXPECT_LT(number(missing.back().at("sigma_x_m")), 1.05 * number(whole.back().at("sigma_x_m")));
}

double bend(int k) { return k < 15 ? 20.0 * k : 20.0 * k + 2.0 * (k - 15) * (k - 15) + (k % 4) - 1.5; }

void expect_same(const std::vector<TextRow>& rows, const std::vector<TextRow>& others,
                 const std::vector<std::string>& columns) {
  ASSERT_EQ(rows.size(), others.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (const auto& column : columns) {
      const double value = number(others[k].at(column));
      EXPECT_NEAR(number(rows[k].at(column)), value, 1e-9 * (1.0 + std::abs(value))) << column << " of row " << k;
    }
}

TEST(HimmDemoRealInput, OneAxisIsATrackWhoseOtherAxisIsNeverSeen) {
  const auto one = recording("time_s,x_m", [](int k) { return exact(k) + "," + exact(bend(k)); });
  const auto blind = recording("time_s,x_m,y_m", [](int k) {  // but for the three points of the start
    return exact(k) + "," + exact(bend(k)) + (k < 3 ? ",5" : ",");
  });
  // Only the envelope (A-1) of the whole state is another one where there are more components.
  for (const char* set : {"smooth=true", "filters=[imm_released,imm_most_likely,gpb1,gpb2,static_random]",
                          "filters=[himm,himm_selected,himm_own,himm_released,himm_global,viterbi,static_fuzzy]",
                          "filters=[imm_histories,himm_histories]"}) {
    const std::vector<std::string> options = {"--set", set};
    const auto found = tracked(one, options);
    EXPECT_TRUE(says(found.output, {"30 rows, 30 measurements, 1 axis"}));
    EXPECT_TRUE(says(tracked(blind, options).output, {"30 measurements (27 along some axes only), 2 axes"}));
    const auto line = rows(found.estimates);
    expect_same(line, rows(tracked(blind, options).estimates),
                {"x_m", "vx_mps", "sigma_x_m", "sigma_vx_mps", "nis", "weight_dwna", "weight_dwpa"});
    EXPECT_EQ(line.back().at("y_m") + line.back().at("vy_mps") + line.back().at("sigma_y_m"), "");
  }
}

TEST(HimmDemoRealInput, OneAxisRestartsMeetsATruthAndMakesAPage) {
  const TemporaryDirectory directory;
  const auto one = recording("time_s,x_m,true_x_m",
                             [](int k) { return exact(k) + "," + exact(k < 15 ? k : 1e4 + k) + "," + exact(k); });
  const auto found = tracked(one, {"--set", "gate_probability=0.999", "--report", directory.path() / "page.html"});
  EXPECT_TRUE(says(found.output, {"after rejections in a row: imm 1, himm 1"}));
  EXPECT_TRUE(says(found.output, {"measurement    30  7071.07 imm"}));  // every other row is 10 km off
  const std::string page = contents(directory.path() / "page.html");
  EXPECT_TRUE(says(page, {"Error in x"}));
  EXPECT_EQ(page.find("Error in y"), std::string::npos);
  const auto turning = program::run(SIGMAX_HIMM_DEMO,
                                    {"track", directory.write("one.csv", one), "--set", "models=[dwna,ct]", "--quiet"});
  EXPECT_EQ(turning.status, 2);
  EXPECT_TRUE(says(turning.on_one_line(), {"the recording has one axis, and ct turns in a plane"}));
}

TEST(HimmDemoRealInput, EachAxisOfAPositionMayBeMissing) {
  const auto by_turns = recording("time_s,x_m,y_m", [](int k) {
    if (k < 3) return exact(k) + "," + exact(bend(k)) + ",7";
    return exact(k) + (k % 2 == 0 ? "," + exact(bend(k)) + "," : ",," + exact(3.0 * k));
  });
  const auto x_alone =
      recording("time_s,x_m", [](int k) { return exact(k) + (k < 3 || k % 2 == 0 ? "," + exact(bend(k)) : ","); });
  // With one model the axes know nothing of each other.
  const std::vector<std::string> one_model = {"--set",         "filters=[imm]", "--set",
                                              "models=[dwpa]", "--set",         "transition_probability=[[1]]"};
  expect_same(rows(tracked(by_turns, one_model).estimates), rows(tracked(x_alone, one_model).estimates),
              {"x_m", "vx_mps", "ax_mps2", "sigma_x_m", "sigma_vx_mps"});
  const TemporaryDirectory directory;
  const auto never = recording("time_s,x_m,y_m", [](int k) { return exact(k) + "," + exact(k) + ","; });
  const auto ending = program::run(SIGMAX_HIMM_DEMO, {"track", directory.write("never.csv", never), "--quiet"});
  EXPECT_EQ(ending.status, 3);
  EXPECT_TRUE(says(ending.on_one_line(), {"starts from whole positions; drop a column that is always empty"}));
}

TEST(HimmDemoRealInput, ARowMaySayItsOwnAccuracy) {
  const auto own = recording("time_s,x_m,y_m,sigma_x_m,sigma_y_m",
                             [](int k) { return exact(k) + "," + exact(k * k) + "," + exact(k % 5) + ",3,3"; });
  const auto set =
      recording("time_s,x_m,y_m", [](int k) { return exact(k) + "," + exact(k * k) + "," + exact(k % 5); });
  EXPECT_EQ(tracked(own).estimates, tracked(set, {"--set", "sigma_position_m=3"}).estimates);
  for (const char* names : {"std_x_m,std_y_m", "sigma_position_m,sigma_x_m"})  // the axis' own goes before that of all
    EXPECT_EQ(tracked(recording(std::string("time_s,x_m,y_m,") + names,
                                [](int k) { return exact(k) + "," + exact(k * k) + "," + exact(k % 5) + ",3,3"; }))
                  .estimates,
              tracked(own).estimates)
        << names;
  const auto variances = recording("time_s,x_m,y_m,var_x_m2,cov_yy,sigma_x_m,cov_zz", [](int k) {
    return exact(k) + "," + exact(k * k) + "," + exact(k % 5) + ",9,9,7,7";
  });
  EXPECT_EQ(tracked(variances).estimates, tracked(own).estimates);
  EXPECT_TRUE(says(tracked(variances).output, {"var_x_m2 in m² for the row's accuracy, cov_yy in m² for",
                                               "Not used: sigma_x_m, cov_zz (does not go with the others)"}));
  const auto polar = recording("time_s,range_m,azimuth_deg,sigma_range_m,sigma_azimuth_deg", [](int k) {
    return exact(k) + "," + exact(9000 + k * k) + "," + exact(k % 5) + ",3,0.2";
  });
  const auto polar_set = recording("time_s,range_m,azimuth_deg",
                                   [](int k) { return exact(k) + "," + exact(9000 + k * k) + "," + exact(k % 5); });
  EXPECT_EQ(tracked(polar).estimates,
            tracked(polar_set, {"--set", "sigma_range_m=3", "--set", "sigma_azimuth_deg=0.2"}).estimates);
}

TEST(HimmDemoRealInput, ATargetIsPredictedToATime) {
  const auto straight = recording("time_s,x_m,y_m", [](int k) { return exact(k) + "," + exact(10 * k) + ",7"; });
  const auto found = rows(tracked(straight, {"--predict-to", "100"}).estimates);
  EXPECT_EQ(found.back().at("time_s"), "100");
  EXPECT_NEAR(number(found.back().at("x_m")), 1000.0, 1e-6);
  EXPECT_EQ(found.back().at("nis"), "");
  const auto late = tracked(straight, {"--predict-to", "5"});
  EXPECT_TRUE(says(late.output, {"nothing was predicted: every track ends at the time"}));
  EXPECT_EQ(late.estimates, tracked(straight).estimates);
}

TEST(HimmDemoRealInput, TheInputIsNotWrittenOver) {
  const TemporaryDirectory directory;
  const std::string text = recording("time_s,x_m,y_m", [](int k) { return exact(k) + "," + exact(k) + ",7"; });
  const std::string file = directory.write("estimates.csv", text);
  const auto ending = program::run(SIGMAX_HIMM_DEMO, {"track", file, "--out", directory.path()});
  EXPECT_EQ(ending.status, 2) << ending.output;
  EXPECT_TRUE(says(ending.on_one_line(), {"would write over the input"}));
  EXPECT_EQ(contents(file), text);
}

TEST(HimmDemoRealInput, WhatEveryGateTurnsAwayIsNamed) {
  const auto outlier = recording(
      "time_s,x_m,y_m", [](int k) { return exact(k) + "," + (k == 20 ? std::string("90000") : exact(10 * k)) + ",7"; });
  EXPECT_TRUE(says(tracked(outlier, {"--set", "gate_probability=0.999"}).output,
                   {"Turned away by every filter: 1, the first on line 22"}));
}

TEST(HimmDemoRealInput, AGateThatTurnsAwayMuchIsWarnedOf) {
  const auto jumping = [](int every) {
    return recording("time_s,ship,x_m,y_m", [=](int k) {
      return exact(k) + ",quiet," + exact(10 * k) + ",7\n" + exact(k) + ",loud," +
             exact(10 * k + (k % every == every - 1 ? 3000 : 0)) + ",7";
    });
  };
  const std::vector<std::string> options = {"--track-id", "ship",          "--set", "gate_probability=0.99",
                                            "--set",      "filters=[imm]", "--set", "restart_after_rejections=0"};
  const auto much = tracked(jumping(4), options).output;  // 7 of 30
  EXPECT_TRUE(says(much, {"the gate of filter 'imm' turned 7 of 30 measurements of track 'loud' away, where 0.3 are "
                          "expected"}));
  EXPECT_FALSE(says(much, {"the mean NIS is"}));
  EXPECT_TRUE(says(much, {"raise sigma_w, the sensor's sigmas or gate_probability"}));
  const auto little = tracked(jumping(5), options).output;  // 6 of 30 are no more than a fifth
  EXPECT_TRUE(says(little, {"Measurements that the gate turned away: imm 6"}));
  EXPECT_FALSE(says(little, {"the gate of filter"}));
}

/// Rows of positions that hardly move, by a sensor that is better than it says, or a filter that expects jumps.
TEST(HimmDemoRealInput, AnNisFarBelowWhatIsExpectedHasACause) {
  const auto still = recording("time_s,x_m,y_m", [](int k) {
    return exact(k) + "," + exact(k % 2 == 0 ? 1.0 : -1.0) + "," + exact(k % 3 - 1.0);
  });
  const auto with = [&](const char* sigma, const char* sigma_w) {
    return tracked(still, {"--set", sigma, "--set", sigma_w}).output;
  };
  EXPECT_TRUE(says(with("sigma_position_m=5", "sigma_w=300"),
                   {"where 2 is expected, and 100 % of the variance of an innovation is the prediction's: sigma_w is "
                    "too great"}));
  EXPECT_TRUE(says(with("sigma_position_m=500", "sigma_w=0.1"), {"where 2 is expected: the measurements are far better "
                                                                 "than the sensor's sigmas say"}));
  EXPECT_FALSE(says(with("sigma_position_m=1", "sigma_w=1"), {"the mean NIS is"}));
}

/// A filter's own name that is like that of a known one, and has keys.
TEST(HimmDemoRealInput, AFilterWithATableHasTheNameThatItWants) {
  EXPECT_TRUE(says(tracked("time_s,x_m,y_m\n0,0,0\n1,1,0\n2,2,0\n3,3,0\n",
                           {"--set", "filters=imm_histores", "--set", "filter.imm_histores.sigma_w=2"})
                       .output,
                   {"imm_histores"}));
}

std::string clock(int seconds) {
  const auto two = [](int value) { return std::string(value < 10 ? "0" : "") + std::to_string(value); };
  seconds %= 86400;
  return two(seconds / 3600) + ":" + two(seconds / 60 % 60) + ":" + two(seconds % 60);
}

TEST(HimmDemoRealInput, TimesOfDayGoOnAfterMidnight) {
  // Every two hours past two midnights; a track that begins after the first, and one before the second that comes last.
  const auto with = [](const auto& time) {
    std::string text = "time_s,ship,x_m,y_m\n";
    for (int k = 0; k < 17; ++k) {
      text += time(72000 + 7200 * k) + ",a," + exact(10 * k) + ",7\n";
      if (k >= 2) text += time(72001 + 7200 * k) + ",b," + exact(5 * k) + ",9\n";
    }
    for (int k = 0; k < 6; ++k) text += time(171000 + 600 * k) + ",c," + exact(k) + ",1\n";
    return text;
  };
  const std::vector<std::string> options = {"--track-id", "ship"};
  const auto seconds = tracked(with([](int time) { return std::to_string(time); }), options);
  const auto clocks = tracked(with(clock), options);
  EXPECT_EQ(clocks.estimates, seconds.estimates);
  EXPECT_TRUE(says(clocks.output, {"Times of day pass midnight 4 times, first on line 4;"}));
  EXPECT_FALSE(says(seconds.output, {"midnight"}));
}

TEST(HimmDemoRealInput, TimesOfDayThatFallALittleAreWrongAndHaveNoDates) {
  const TemporaryDirectory directory;
  const auto run = [&](const std::string& last, const std::vector<std::string>& more) {
    std::string text = "time_s,x_m,y_m\n";
    for (int k = 0; k < 5; ++k) text += clock(43200 + k) + "," + exact(k) + ",7\n";
    return program::run(SIGMAX_HIMM_DEMO,
                        Arguments{"track", directory.write("real.csv", text + last), "--quiet"} + more);
  };
  EXPECT_EQ(run("", {}).status, 0);
  const auto fallen = run("00:00:05,5,7\n", {});
  EXPECT_EQ(fallen.status, 3);
  EXPECT_TRUE(says(fallen.on_one_line(), {"real.csv:7: column 'time_s': found '00:00:05', expected a time after"}));
  const auto dates = run("", {"--iso-times"});
  EXPECT_EQ(dates.status, 3);
  EXPECT_TRUE(says(dates.on_one_line(), {"real.csv:2: --iso-times writes dates, and a time of day has none"}));
}

TEST(HimmDemoRealInput, ALateRowAfterMidnightGoesBack) {
  const auto times = [](const std::string& late) {
    std::string text = "time_s,x_m,y_m\n";
    for (int k = 0; k < 5; ++k) text += clock(86395 + k) + "," + exact(10 * k) + ",7\n";
    text += "00:00:01,60,7\n" + late;
    for (int k = 7; k < 12; ++k) text += clock(k - 5) + "," + exact(10 * k) + ",7\n";
    return text;
  };
  const TemporaryDirectory directory;
  const auto refused = program::run(SIGMAX_HIMM_DEMO, {"track", directory.write("a.csv", times("23:59:59,41,7\n"))});
  EXPECT_EQ(refused.status, 3);
  EXPECT_TRUE(says(refused.on_one_line(), {"a.csv:8: column 'time_s': found '23:59:59', expected a time after"}));
  const std::vector<std::string> skip = {"--on-bad-time", "skip"};
  EXPECT_EQ(tracked(times("23:59:59,41,7\n"), skip).estimates, tracked(times(""), skip).estimates);
  EXPECT_EQ(rows(tracked(times("23:59:59,41,7\n"), skip).estimates).back().at("time_s"), "86406");
}

TEST(HimmDemoRealInput, ATimeOfDayToPredictToIsOfTheLastDay) {
  const auto straight = [](int first) {
    return recording("time_s,x_m,y_m", [&](int k) { return clock(first + k) + "," + exact(10 * k) + ",7"; });
  };
  const auto after = rows(tracked(straight(86390), {"--predict-to", "00:01:00"}).estimates);
  EXPECT_EQ(after.back().at("time_s"), "86460");
  EXPECT_NEAR(number(after.back().at("x_m")), 700.0, 1e-6);
  EXPECT_EQ(rows(tracked(straight(86350), {"--predict-to", "00:01:00"}).estimates).back().at("time_s"), "86460");
  const auto earlier = tracked(straight(86350), {"--predict-to", "23:59:00"});
  EXPECT_TRUE(says(earlier.output, {"nothing was predicted"}));
}

TEST(HimmDemoRealInput, AHeadingIsNoBearingOfASimulatedRadar) {
  const auto flight = [](bool heading) {
    return recording(std::string("time_s,x_m,y_m,z_m") + (heading ? ",azimuth_deg" : ""), [&](int k) {
      const std::string place = k > 3 && k % 4 == 0 ? ",,," : "," + exact(10000 + 50 * k) + ",5000,1000";
      return exact(k) + place + (heading ? ",90" : "");
    });
  };
  const std::vector<std::string> radar = {"--radar", "50,0.1,0.1"};
  const auto with = tracked(flight(true), radar);
  EXPECT_EQ(with.estimates, tracked(flight(false), radar).estimates);
  EXPECT_TRUE(says(with.output, {"Not used: azimuth_deg (--radar measures positions)"}));
  EXPECT_TRUE(says(tracked(flight(true)).output, {"Azimuths do not count in rows with a position: 23 rows"}));
}

TEST(HimmDemoRealInput, MetresGoBeforeFeetAndWhatIsMappedBeforeBoth) {
  const auto high = recording("time_s,latitude_deg,longitude_deg,altitude_m,altitude_gnss_ft,altitude_ft",
                              [](int k) { return exact(k) + ",50,10,100,2000,3000"; });
  EXPECT_TRUE(says(tracked(high).output, {"altitude_m in m above the ellipsoid"}));
  const auto feet = recording("time_s,latitude_deg,longitude_deg,altitude_ft,altitude_gnss_ft",
                              [](int k) { return exact(k) + ",50,10,3000,2000"; });
  EXPECT_TRUE(says(tracked(feet).output, {"altitude_gnss_ft in ft above the ellipsoid"}));
  const auto two = recording("time_s,x_m,y_m,east", [](int k) { return exact(k) + ",9,7," + exact(0.01 * k); });
  const auto mapped = tracked(two, {"--columns", "x_km=east"});
  EXPECT_NEAR(number(rows(mapped.estimates).back().at("x_m")), 290.0, 1e-6);
  EXPECT_TRUE(says(mapped.output, {"Not used: x_m (east says it)"}));
  const TemporaryDirectory directory;
  const auto none = program::run(SIGMAX_HIMM_DEMO, {"track", directory.write("a.csv", two), "--columns", "vx_mps=no"});
  EXPECT_EQ(none.status, 3);
  EXPECT_TRUE(says(none.on_one_line(), {"no column 'no'"}));
}

TEST(HimmDemoRealInput, IdentifiersAreNoQuantities) {
  const auto two =
      recording("time_s,x_m,y_m,track_id,speed_type", [](int k) { return exact(k) + "," + exact(10 * k) + ",7,A,B"; });
  EXPECT_TRUE(says(tracked(two).output, {"Not used: track_id, speed_type  all"}));
  const auto chosen = recording("time_s,x_m,y_m,track", [](int k) { return exact(k) + "," + exact(10 * k) + ",7,1"; });
  EXPECT_TRUE(says(tracked(chosen).output, {"Not used: track (name its unit: _deg)"}));
  EXPECT_FALSE(says(tracked(chosen, {"--select", "track=1"}).output, {"Not used"}));
}

TEST(HimmDemoRealInput, ACellThatDoesNotCountRefusesNothing) {
  const auto two = recording("time_s,x_m,y_m,range_m,azimuth_deg,sensor,course_deg,speed_kt", [](int k) {
    return exact(k) +
           (k % 5 == 4 ? ",,," + exact(5000 + 10 * k) + ",0,r,511,1" : "," + exact(5000 + 10 * k) + ",0,,,a,90,19.4");
  });
  EXPECT_TRUE(says(tracked(two, {"--set", "sigma_velocity_mps=1"}).output,
                   {"Velocities do not count in rows of a radar or with a bearing: 6 rows"}));
}

TEST(HimmDemoRealInput, NoNameCommandsTheTerminal) {
  const TemporaryDirectory directory;
  const std::string clear = "\x1B[2J\xC2\x9B\x31m";
  const auto hostile = recording("time_s,sensor,ship,x" + clear + ",y_m", [&](int k) {
    return exact(k) + ",radar" + clear + ",ship" + clear + "," + exact(k == 20 ? 1e5 : k) + ",7";
  });
  const std::string file = directory.write("real" + clear + ".csv", hostile);
  const std::vector<std::string> columns = {"--columns", "x_m=x" + clear};
  const std::string key = R"(sensor."radar\u001B[2J\u009B1m".sigma_position_m)";
  const auto run = [&](std::vector<std::string> more) {
    const auto ending = program::run(SIGMAX_HIMM_DEMO, Arguments{"track", file, "--columns", "x_m=x" + clear} + more);
    EXPECT_EQ(ending.output.find('\x1B'), std::string::npos) << ending.output;
    EXPECT_EQ(ending.output.find("\xC2\x9B"), std::string::npos) << ending.output;
    return ending;
  };
  const auto whole =
      program::succeeded(run({"--track-id", "ship", "--out", directory.path() / ("out" + clear), "--set", key + "=3",
                              "--set", "filters=[himm_histories]", "--set", "explain=true"}));
  for (const char* words : {R"(radar\x1B[2J\x9B1m 30)", R"(x\x1B[2J\x9B1m in m)", R"(of ship\x1B[2J\x9B1m)", R"(to )",
                            R"(out\x1B[2J\x9B1m)", R"(real\x1B[2J\x9B1m.csv:23: no filter)"})
    EXPECT_TRUE(says(whole.on_one_line(), {words}));
  // Files keep the bytes.
  EXPECT_TRUE(says(contents(directory.path() / ("out" + clear) / "estimates.csv"), {",ship" + clear + ","}));
  EXPECT_EQ(run({"--set", "a" + clear + "=3"}).status, 3);
  EXPECT_EQ(run({"--track-id", "none" + clear}).status, 3);
  EXPECT_EQ(run({"--set", key + "=-3"}).status, 3);
  const auto settings =
      program::succeeded(run({"--set", key + "=3", "--set", R"(filters=["imm a","himm\u0007"])", "--print-config"}));
  EXPECT_EQ(run({"--config", directory.write("same.toml", settings.output), "--print-config"}).output, settings.output);
}

}  // namespace
