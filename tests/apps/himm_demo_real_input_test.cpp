// What recordings look like that nobody made for this program: units, tabs, clocks, sentinels, several sensors at once.

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/recordings.hpp"
#include "apps/temporary_directory.hpp"
#include "support/program.hpp"

namespace sigmax::apps {
namespace {

struct Tracked {
  std::string output;
  std::string estimates;
};

Tracked tracked(const std::string& recording, std::vector<std::string> options = {}) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("real.csv", recording);
  options.insert(options.begin(), {"track", file, "--quiet", "--out", directory.path() / "out"});
  const auto ending = program::run(SIGMAX_HIMM_DEMO, options);
  EXPECT_EQ(ending.status, 0) << ending.output;
  return {ending.output, contents(directory.path() / "out" / "estimates.csv")};
}

/// A row for each k by `row(k)`.
template <class Row>
std::string recording(const std::string& header, const Row& row, int count = 30) {
  std::string text = header + "\n";
  for (int k = 0; k < count; ++k) text += row(k) + "\n";
  return text;
}

bool says(const std::string& output, const std::string& words) {
  std::string plain = output;  // lines may be broken anywhere
  for (char& letter : plain)
    if (letter == '\n') letter = ' ';
  return plain.find(words) != std::string::npos;
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
  EXPECT_TRUE(says(tracked(miles).output, "range_nmi in nautical miles, azimuth_deg_north in ° clockwise from north"));
  EXPECT_TRUE(says(tracked(metres).output, "range_m in m, azimuth_deg in ° counter-clockwise from east"));
}

TEST(HimmDemoRealInput, ANisFarTooLowIsWarnedOf) {
  const auto as_metres =
      recording("time_s,range_m,azimuth_deg", [](int k) { return exact(k) + "," + exact(10.0 + 0.001 * k) + ",45"; });
  EXPECT_TRUE(says(tracked(as_metres).output, "in another unit than was taken"));
}

TEST(HimmDemoRealInput, SeveralTargetsInOneFileNameTheOptionThatTellsThemApart) {
  const auto mixed = recording("time_s,x_m,y_m", [](int k) { return exact(k) + "," + exact(5e4 * (k % 2)) + ",0"; });
  EXPECT_TRUE(says(tracked(mixed).output, "tell them apart with --track-id COLUMN"));
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
  EXPECT_TRUE(says(sentinel.output, "real.csv:11: no measurement can be that great; 1 such row counts as missed"));
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
  // Only the envelope of the whole state is another one where there are more components.
  for (const char* set : {"smooth=true", "filters=[imm_released,imm_most_likely,gpb1,gpb2,static_random]",
                          "filters=[himm,himm_selected,himm_own,himm_released,himm_global,viterbi,static_fuzzy]",
                          "filters=[imm_histories,himm_histories]"}) {
    const std::vector<std::string> options = {"--set", set};
    const auto found = tracked(one, options);
    EXPECT_TRUE(says(found.output, "30 rows, 30 measurements, 1 axis")) << found.output;
    EXPECT_TRUE(says(tracked(blind, options).output, "30 measurements (27 along some axes only), 2 axes"));
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
  EXPECT_TRUE(says(found.output, "after rejections in a row: imm 1, himm 1")) << found.output;
  EXPECT_TRUE(says(found.output, "measurement    30  7071.07 imm")) << found.output;  // every other row is 10 km off
  const std::string page = contents(directory.path() / "page.html");
  EXPECT_NE(page.find("Error in x"), std::string::npos);
  EXPECT_EQ(page.find("Error in y"), std::string::npos);
  const auto turning = program::run(SIGMAX_HIMM_DEMO,
                                    {"track", directory.write("one.csv", one), "--set", "models=[dwna,ct]", "--quiet"});
  EXPECT_EQ(turning.status, 2);
  EXPECT_TRUE(says(turning.output, "the recording has one axis, and ct turns in a plane")) << turning.output;
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
  EXPECT_TRUE(says(ending.output, "starts from whole positions; drop a column that is always empty")) << ending.output;
}

TEST(HimmDemoRealInput, ARowMaySayItsOwnAccuracy) {
  const auto own = recording("time_s,x_m,y_m,sigma_x_m,sigma_y_m",
                             [](int k) { return exact(k) + "," + exact(k * k) + "," + exact(k % 5) + ",3,3"; });
  const auto set =
      recording("time_s,x_m,y_m", [](int k) { return exact(k) + "," + exact(k * k) + "," + exact(k % 5); });
  EXPECT_EQ(tracked(own).estimates, tracked(set, {"--set", "sigma_position_m=3"}).estimates);
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
  EXPECT_TRUE(says(late.output, "nothing was predicted: every track ends at the time")) << late.output;
  EXPECT_EQ(late.estimates, tracked(straight).estimates);
}

TEST(HimmDemoRealInput, TheInputIsNotWrittenOver) {
  const TemporaryDirectory directory;
  const std::string text = recording("time_s,x_m,y_m", [](int k) { return exact(k) + "," + exact(k) + ",7"; });
  const std::string file = directory.write("estimates.csv", text);
  const auto ending = program::run(SIGMAX_HIMM_DEMO, {"track", file, "--out", directory.path()});
  EXPECT_EQ(ending.status, 2) << ending.output;
  EXPECT_TRUE(says(ending.output, "would write over the input")) << ending.output;
  EXPECT_EQ(contents(file), text);
}

TEST(HimmDemoRealInput, WhatEveryGateTurnsAwayIsNamed) {
  const auto outlier = recording(
      "time_s,x_m,y_m", [](int k) { return exact(k) + "," + (k == 20 ? std::string("90000") : exact(10 * k)) + ",7"; });
  EXPECT_TRUE(says(tracked(outlier, {"--set", "gate_probability=0.999"}).output,
                   "Turned away by every filter: 1, the first on line 22"));
}

}  // namespace
}  // namespace sigmax::apps
