#include "apps/manoeuvring_targets.hpp"

namespace himm_demo_track_test {

using support::degree;

struct Case {
  std::string name;
  std::vector<std::string> sets;  // beside those that all cases share
  restatement::Options options;
  std::string start = "given";
  std::size_t axes = 3;

  friend void PrintTo(const Case& test, std::ostream* text) { *text << test.name; }
};

std::vector<Case> cases() {
  using namespace restatement;
  std::vector<Case> result;
  const std::map<std::string, StateAugmentation> augmentations = {
      {"zero", StateAugmentation::zero},
      {"borrowed_variance", StateAugmentation::borrowed_variance},
      {"unbiased", StateAugmentation::unbiased}};
  const std::map<std::string, Weights> weights = {{"correct", Weights::correct}, {"released", Weights::released}};
  const std::map<std::string, MixedCovariance> readings = {{"selected", MixedCovariance::selected},
                                                           {"own", MixedCovariance::own},
                                                           {"own_recentred", MixedCovariance::own_recentred},
                                                           {"released", MixedCovariance::released}};
  for (const auto& [augmentation, augmentation_value] : augmentations) {
    for (const auto& [name, value] : weights) {
      const Options options{.mixing_weights = value, .augmentation = augmentation_value};
      result.push_back({"imm_" + name + "_" + augmentation,
                        {"filters=imm", "imm_mixing=" + name, "augmentation=" + augmentation},
                        options});
    }
    for (const auto& [name, value] : readings) {
      const Options options{.kind = Kind::himm, .mixed_covariance = value, .augmentation = augmentation_value};
      result.push_back({"himm_" + name + "_" + augmentation,
                        {"filters=himm", "mixed_covariance=" + name, "augmentation=" + augmentation},
                        options});
    }
  }
  const Options ties{.kind = Kind::himm,
                     .mixed_covariance = MixedCovariance::own_recentred,
                     .mixing_tie = Tie::last,
                     .output_tie = Tie::first};
  result.push_back(
      {"himm_ties_as_released", {"filters=himm", "mixing_tie=last", "output_tie=first", "augmentation=zero"}, ties});
  for (const std::string start : {"points", "released"})
    for (const std::size_t axes : {2U, 3U})
      for (const auto& [filter, kind] : {std::pair{"imm", Kind::imm}, {"himm", Kind::himm}})
        result.push_back({filter + ("_" + start) + "_" + std::to_string(axes),
                          {std::string("filters=") + filter},
                          usual(kind),
                          start,
                          axes});
  return result;
}

class Track : public testing::TestWithParam<Case> {};

TEST_P(Track, EqualsThePlainRestatementAtEveryStep) {
  const Case& c = GetParam();
  const auto points = accelerating_target(c.axes);
  const auto found = estimates(csv(points), given + Arguments{"start=" + c.start, "sigma_position_m=10"} + c.sets);
  const auto all = detections(points);
  const double T12 = all[1].time - all[0].time, T23 = all[2].time - all[1].time;
  std::vector<restatement::State> starts = {restated_start(2 * c.axes), restated_start(3 * c.axes)};
  if (c.start == "points")
    starts = {restatement::two_point_start(*all[1].z, *all[2].z, T23),
              restatement::three_point_start(*all[0].z, *all[1].z, *all[2].z, T12, T23)};
  if (c.start == "released") {
    const auto start = restatement::released_start(*all[0].z, *all[1].z, *all[2].z, T23);
    starts = {restatement::leading(start, 2 * c.axes), start};
  }
  const bool begins = c.start == "given";
  expect_restated(found, restated(c.options, starts, c.axes), begins ? start_time : all[2].time,
                  detections(points, begins ? 0 : 3));
}

INSTANTIATE_TEST_SUITE_P(HimmDemo, Track, testing::ValuesIn(cases()), [](const auto& test) { return test.param.name; });

class HimmDemoTrack : public InDirectory {};

TEST_F(HimmDemoTrack, AGeodeticRecordingIsTrackedAboutItsOrigin) {
  // Due north along a meridian at constant height: the estimate's latitude follows the input's.
  std::string text = "t,lat,lon,altitude_ft,junk\n";
  for (int k = 0; k < 60; ++k) text += std::to_string(k) + "," + std::to_string(52.0 + 0.001 * k) + ",4.5,1000,x\n";
  const auto found = estimates(text, {"sigma_position_m=1"},
                               {"--columns", "time_s=t,latitude_deg=lat,longitude_deg=lon", "--origin", "52,4.5,0"});
  ASSERT_EQ(found.size(), 2U * 57U);
  for (const auto& row : found) {
    // A metre is 9e-6 of a degree; the input has six decimals.
    EXPECT_NEAR(std::stod(row.at("latitude_deg")), 52.0 + 0.001 * std::stod(row.at("time_s")), 9e-6);
    EXPECT_NEAR(std::stod(row.at("longitude_deg")), 4.5, 1e-5);
    EXPECT_NEAR(std::stod(row.at("altitude_m")), 304.8, 1.0);
    EXPECT_NEAR(std::stod(row.at("vy_mps")), 111.26, 0.5);  // a thousandth of a degree of latitude at 52° a second
  }
}

TEST_F(HimmDemoTrack, ASimulatedRadarMakesErrorsKnownAndTheSameSeedTheSameBytes) {
  const auto text = csv(accelerating_target());
  const auto by = [&](const char* seed) {
    return tracked(text, {}, {"--radar", "10,0.1,0.1", "--radar-at=-5000,-4000,0", "--seed", seed});
  };
  const auto first = by("3");
  EXPECT_TRUE(says(first.output, {"RMSE"}));
  EXPECT_EQ(first.estimates, by("3").estimates);
  EXPECT_NE(first.estimates, by("4").estimates);
}

TEST_F(HimmDemoTrack, AnEmptyPositionIsAMissedMeasurement) {
  const auto found = estimates("time_s,x_m,y_m\n0,0,0\n1,1,2\n2,2,4\n3,,\n4,4,8\n");
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].at("nis"), "");
  EXPECT_NEAR(std::stod(found[0].at("x_m")), 3.0, 1e-9);  // the points lie on a line
  EXPECT_NE(found[2].at("nis"), "");
}

TEST_F(HimmDemoTrack, WhatPrintConfigPrintsReadsBackAsTheSame) {
  const auto print = [&](const Arguments& more) {
    const auto file = directory.write("rows.csv", "time_s,x_m,y_m\n0,1,2\n");
    return program::succeeds(SIGMAX_HIMM_DEMO, Arguments{"track", file, "--print-config"} + more).output;
  };
  const auto first = print(setting({"filter.himm.sigma_w=5", "augmentation=unbiased"}));
  EXPECT_EQ(print({"--config", directory.write("settings.toml", first)}), first);
  EXPECT_TRUE(says(first, {"sigma_w = [5.0, 5.0]"}));
}

TEST_F(HimmDemoTrack, ARecordedJetIsTrackedBetterThanItIsMeasured) {
  const std::string file = recorded("c550_phlab_20170320_08.csv");
  if (file.empty()) GTEST_SKIP() << "no recorded data in " << SIGMAX_DATA;
  const auto ending = program::succeeds(
      SIGMAX_HIMM_DEMO,
      {"track", file, "--radar", "50,0.1,0.1", "--radar-at=-20000,-10000,0", "--quiet", "--out", directory.path()});
  EXPECT_TRUE(says(ending.on_one_line(), {"|roll| > 15°"}));
  const auto found = rows(contents(directory.path() / "estimates.csv"));
  ASSERT_EQ(found.size(), 2U * (5470U - 3U));
  for (const auto& row : found) {
    const double weight = std::stod(row.at("weight_dwna"));
    const double other = std::stod(row.at("weight_dwpa"));
    ASSERT_NEAR(row.at("filter") == "imm" ? weight + other : std::max(weight, other), 1.0, 1e-12);
  }
}

TEST_F(HimmDemoTrack, ARecordedMultirotorIsTrackedThroughMappedColumns) {
  const std::string file = recorded("uav_rot.csv");
  if (file.empty()) GTEST_SKIP() << "no recorded data in " << SIGMAX_DATA;
  const auto ending = program::succeeds(
      SIGMAX_HIMM_DEMO, {"track", file, "--columns",
                         "time_s=timestamp,latitude_deg=latitude,longitude_deg=longitude,altitude_m=altitude (m)"});
  EXPECT_TRUE(says(ending.on_one_line(), {"965 measurements"}));
}

}  // namespace himm_demo_track_test
