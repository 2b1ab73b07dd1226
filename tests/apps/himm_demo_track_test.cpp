#include "apps/manoeuvring_targets.hpp"
#include "apps/temporary_directory.hpp"
#include "support/program.hpp"

namespace {

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
  const std::map<std::string, Lift> lifts = {
      {"zero", Lift::zero}, {"borrowed_variance", Lift::borrowed_variance}, {"unbiased", Lift::unbiased}};
  const std::map<std::string, Weights> weights = {{"correct", Weights::correct}, {"released", Weights::released}};
  const std::map<std::string, MixedCovariance> readings = {{"selected", MixedCovariance::selected},
                                                           {"own", MixedCovariance::own},
                                                           {"own_recentred", MixedCovariance::own_recentred},
                                                           {"released", MixedCovariance::released}};
  for (const auto& [lift, lift_value] : lifts) {
    for (const auto& [name, value] : weights) {
      Options options;
      options.mixing_weights = value;
      options.lift = lift_value;
      result.push_back(
          {"imm_" + name + "_" + lift, {"filters=[\"imm\"]", "imm_mixing=" + name, "lift=" + lift}, options});
    }
    for (const auto& [name, value] : readings) {
      Options options;
      options.kind = Kind::himm;
      options.mixed_covariance = value;
      options.lift = lift_value;
      result.push_back(
          {"himm_" + name + "_" + lift, {"filters=[\"himm\"]", "mixed_covariance=" + name, "lift=" + lift}, options});
    }
  }
  Options ties;
  ties.kind = Kind::himm;
  ties.lift = Lift::zero;
  ties.mixed_covariance = MixedCovariance::own_recentred;
  ties.mixing_tie = Tie::last;
  ties.output_tie = Tie::first;
  result.push_back(
      {"himm_ties_as_released", {"filters=[\"himm\"]", "mixing_tie=last", "output_tie=first", "lift=zero"}, ties});
  for (const std::string start : {"points", "released"}) {
    for (const std::size_t axes : {2U, 3U}) {
      Options imm;
      imm.lift = Lift::borrowed_variance;
      Options himm = imm;
      himm.kind = Kind::himm;
      himm.mixed_covariance = MixedCovariance::own_recentred;  // the default
      const std::string suffix = "_" + start + "_" + std::to_string(axes);
      result.push_back({"imm" + suffix, {"filters=[\"imm\"]"}, imm, start, axes});
      result.push_back({"himm" + suffix, {"filters=[\"himm\"]"}, himm, start, axes});
    }
  }
  return result;
}

class Track : public testing::TestWithParam<Case> {};

TEST_P(Track, EqualsThePlainRestatementAtEveryStep) {
  const Case& c = GetParam();
  const auto points = accelerating_target(c.axes);
  const TemporaryDirectory directory;
  const auto input = directory.write("recording.csv", csv(points));
  const auto out = directory.path() / "out";
  std::vector<std::string> arguments = {"track", input, "--quiet", "--out", out};
  std::vector<std::string> sets = {
      "start=" + c.start,
      "start_mean=[1200,800,300,-95,-85,1,0.5,-0.25,0]",
      "start_covariance_diagonal=[400,500,600,100,110,120,25,16,9]",
      "start_time_s=2.5",
      "sigma_w=[3,4]",
      "sigma_position_m=10",
      "transition_probability=[[0.95,0.05],[0.1,0.9]]",
      "transition_possibility=[[1,0.5],[0.25,1]]",
  };
  program::succeeds(SIGMAX_HIMM_DEMO, arguments + setting(sets) + setting(c.sets));
  const auto found = rows(contents(out / "estimates.csv"));

  using restatement::Index;
  restatement::Matrix R(c.axes, c.axes);
  for (Index i = 0; i < c.axes; ++i) R(i, i) = 100.0;
  std::vector<restatement::State> states;
  std::size_t first = 0;
  double time = start_time;
  if (c.start == "given") {
    states = {restated_start(2 * c.axes), restated_start(3 * c.axes)};
  } else {
    const auto at = [&](std::size_t i) { return restatement::Position{points[i].z, R}; };
    const double T12 = points[1].time - points[0].time;
    const double T23 = points[2].time - points[1].time;
    if (c.start == "points") {
      states = {restatement::two_point_start(at(1), at(2), T23),
                restatement::three_point_start(at(0), at(1), at(2), T12, T23)};
    } else {
      const auto start = restatement::released_start(at(0), at(1), at(2), T23);
      states = {restatement::leading(start, 2 * c.axes), start};
    }
    first = 3;
    time = points[2].time;
  }
  const bool himm = c.options.kind == restatement::Kind::himm;
  restatement::Filter filter(
      {restatement::dwna(c.axes, 3.0), restatement::dwpa(c.axes, 4.0)},
      himm ? restatement::Matrix(2, 2, {1, 0.5, 0.25, 1}) : restatement::Matrix(2, 2, {0.95, 0.05, 0.1, 0.9}), states,
      {1.0, 1.0}, c.options);

  ASSERT_EQ(found.size(), points.size() - first);
  for (std::size_t k = first; k < points.size(); ++k) {
    filter.step(points[k].time - time, points[k].z, R);
    time = points[k].time;
    const auto& row = found[k - first];
    const auto estimate = filter.estimate();
    SCOPED_TRACE("step " + std::to_string(k));
    ASSERT_EQ(std::stod(row.at("time_s")), points[k].time);
    expect_row(row, estimate, c.axes);
    ASSERT_CLOSE(std::stod(row.at("nis")), *filter.nis(), 1e-9);
    ASSERT_CLOSE(std::stod(row.at("weight_dwna")), std::exp(filter.log_weights()[0]), 1e-9);
    ASSERT_CLOSE(std::stod(row.at("weight_dwpa")), std::exp(filter.log_weights()[1]), 1e-9);
    ASSERT_EQ(row.at("most_likely"), filter.winner() == 0 ? "dwna" : "dwpa");
  }
}

INSTANTIATE_TEST_SUITE_P(HimmDemo, Track, testing::ValuesIn(cases()), [](const auto& test) { return test.param.name; });

/// Runs `track` on a file of that text.
program::Ending track(const TemporaryDirectory& directory, std::string_view text, std::vector<std::string> more = {}) {
  return program::run(SIGMAX_HIMM_DEMO, Arguments{"track", directory.write("input.csv", text)} + more);
}

class HimmDemoTrack : public InDirectory {};

TEST_F(HimmDemoTrack, AGeodeticRecordingIsTrackedAboutItsOrigin) {
  // Due north along a meridian at constant height: the estimate's latitude follows the input's.
  std::string text = "t,lat,lon,altitude_ft,junk\n";
  for (int k = 0; k < 60; ++k) text += std::to_string(k) + "," + std::to_string(52.0 + 0.001 * k) + ",4.5,1000,x\n";
  const auto out = directory.path() / "out";
  program::succeeded(track(directory, text,
                           {"--columns", "time_s=t,latitude_deg=lat,longitude_deg=lon", "--origin", "52,4.5,0", "--out",
                            out, "--set", "sigma_position_m=1"}));
  const auto found = rows(contents(out / "estimates.csv"));
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
  const auto run = [&](const std::string& out, const std::string& seed) {
    const auto ending = program::succeeded(
        track(directory, text,
              {"--radar", "10,0.1,0.1", "--radar-at=-5000,-4000,0", "--seed", seed, "--out", directory.path() / out}));
    EXPECT_TRUE(says(ending.output, {"RMSE"}));
    return contents(directory.path() / out / "estimates.csv");
  };
  const auto first = run("a", "3");
  EXPECT_EQ(first, run("b", "3"));
  EXPECT_NE(first, run("c", "4"));
}

TEST_F(HimmDemoTrack, AnEmptyPositionIsAMissedMeasurement) {
  const auto out = directory.path() / "out";
  program::succeeded(track(directory, "time_s,x_m,y_m\n0,0,0\n1,1,2\n2,2,4\n3,,\n4,4,8\n", {"--out", out}));
  const auto found = rows(contents(out / "estimates.csv"));
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].at("nis"), "");
  EXPECT_NEAR(std::stod(found[0].at("x_m")), 3.0, 1e-9);  // the points lie on a line
  EXPECT_NE(found[2].at("nis"), "");
}

TEST_F(HimmDemoTrack, WhatPrintConfigPrintsReadsBackAsTheSame) {
  const std::string good = "time_s,x_m,y_m\n0,1,2\n";
  const auto first = program::succeeded(
      track(directory, good, {"--print-config", "--set", "filter.himm.sigma_w=5", "--set", "lift=unbiased"}));
  const auto file = directory.write("settings.toml", first.output);
  const auto second = track(directory, good, {"--print-config", "--config", file});
  EXPECT_EQ(second.output, first.output);
  EXPECT_TRUE(says(first.output, {"sigma_w = [5.0, 5.0]"}));
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

}  // namespace
