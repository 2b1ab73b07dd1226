#include <nlohmann/json.hpp>

#include "apps/recordings.hpp"

namespace himm_demo_associate_test {

using nlohmann::json;

const Arguments associations = {"jpda", "jpda_star", "gnn", "fuzzy_random"};

/// What is known of files without a false detection; the area that two targets cover tells too little.
const Arguments clean = {"--clutter-density", "1e-6"};

class HimmDemoAssociate : public InDirectory {
 protected:
  std::filesystem::path out(const std::string& name = "out") const { return directory.path() / name; }
  program::Ending associate(const Arguments& arguments, const std::string& name = "out") const {
    return program::succeeds(SIGMAX_HIMM_DEMO, Arguments{"associate", "--quiet", "--out", out(name)} + arguments);
  }
  json summary(const std::string& name = "out") const { return json::parse(contents(out(name) / "summary.json")); }
};

/// Two targets that keep 400 m apart, seen at one time each second, with errors that repeat.
std::string two_targets(const std::string& header = "time_s,x_m,y_m,of", bool labelled = true) {
  return recording(header, [&](int k) {
    const std::string time = std::to_string(k), x = exact(50.0 * k + (k % 3 - 1) * 4.0);
    return fmt::format("{0},{1},{2}{4}\n{0},{1},{3}{5}", time, x, exact((k % 2) * 5.0), exact(400.0 - (k % 2) * 5.0),
                       labelled ? ",a" : "", labelled ? ",b" : "");
  });
}

TEST_F(HimmDemoAssociate, FindsTheAircraftAmongFalseDetections) {
  const std::string cases = SIGMAX_DATA "/../cases";
  if (!std::filesystem::exists(cases)) GTEST_SKIP() << "there is no " << cases;
  for (const std::size_t aircraft : {1U, 3U})
    for (const std::string& association : associations) {
      SCOPED_TRACE(fmt::format("{} aircraft, {}", aircraft, association));
      const std::string file = fmt::format("{}/plots_{}_aircraft_clutter.csv", cases, aircraft);
      const auto ending = associate({file, "--association", association});
      EXPECT_TRUE(says(ending.on_one_line(), {"A scan is one turn of the radar, 4 s on average"}));
      EXPECT_EQ(summary().at("tracks").at("at_the_end"), aircraft);
      std::map<std::string, std::size_t> scans;  // of each track
      for (const TextRow& row : rows_of(out() / "tracks.csv")) ++scans[row.at("track")];
      EXPECT_EQ(scans.size(), summary().at("tracks").at("confirmed"));
      const auto is_short = [](const auto& track) { return track.second <= 10; };
      const auto false_tracks = static_cast<std::size_t>(std::ranges::count_if(scans, is_short));
      if (association.starts_with("jpda")) EXPECT_EQ(scans.size() - false_tracks, aircraft);
    }
}

TEST_F(HimmDemoAssociate, SaysWhoseEachDetectionIs) {
  const std::string file = directory.write("two.csv", two_targets());
  const auto ending = associate(Arguments{file, "--labels", "of"} + clean);
  EXPECT_TRUE(says(ending.on_one_line(),
                   {"Verdict: 2 confirmed tracks, 2 of them at the end; 58 of 60 detections are explained",
                    "A scan is the rows of one time"}));
  const auto detections = rows_of(out() / "detections.csv");
  ASSERT_EQ(detections.size(), 60U);
  for (std::size_t i = 4; i < detections.size(); ++i) {  // the second ones begin tracks, too
    EXPECT_EQ(detections[i].at("line"), std::to_string(i + 2));
    EXPECT_EQ(detections[i].at("track"), i % 2 == 0 ? "1" : "2") << i;
  }
  const auto tracks = rows_of(out() / "tracks.csv");
  const auto last = row_with(tracks, {{"track", "2"}, {"time_s", "29"}});
  EXPECT_NEAR(number(last.at("y_m")), 397.5, 10.0);
  EXPECT_NEAR(number(last.at("vx_mps")), 50.0, 10.0);
  EXPECT_GT(number(last.at("existence")), 0.99);
  EXPECT_EQ(last.at("most_likely"), "dwna");
  const json score = summary().at("score").at("jpda_star");
  EXPECT_EQ(score.at("switches"), 0.0);
  EXPECT_EQ(score.at("false_tracks"), 0.0);
  EXPECT_EQ(score.at("untracked"), 0.0);
  EXPECT_EQ(score.at("targets"), 2.0);
  const auto square = [&](const char* part) { return std::pow(score.at(part).get<double>(), 2); };
  EXPECT_CLOSE(square("gospa_m"), square("localisation_m") + square("missed_m") + square("false_m"), 1e-9);
}

TEST_F(HimmDemoAssociate, TheLabelsChangeNoEstimate) {
  const std::string labelled = directory.write("labelled.csv", two_targets());
  const std::string unlabelled = directory.write("unlabelled.csv", two_targets("time_s,x_m,y_m", false));
  associate({labelled, "--labels", "of"}, "with");
  associate({unlabelled}, "without");
  for (const char* file : {"tracks.csv", "detections.csv"})
    EXPECT_EQ(contents(out("with") / file), contents(out("without") / file)) << file;
}

TEST_F(HimmDemoAssociate, AScanIsAWindowOfTime) {
  const std::string file = directory.write("apart.csv", recording("time_s,x_m,y_m", [](int k) {
                                             return fmt::format("{},{},0\n{},{},400", exact(k), exact(50.0 * k),
                                                                exact(k + 0.25), exact(50.0 * k + 12.5));
                                           }));
  const auto ending = associate(Arguments{file, "--scan", "1"} + clean);
  EXPECT_TRUE(says(ending.on_one_line(), {"A scan is 1 s, as --scan says", "30 scans", "2 confirmed tracks"}));
}

TEST_F(HimmDemoAssociate, SensorsAreScansOfTheirOwn) {
  const std::string file =
      directory.write("sensors.csv", recording("time_s,sensor,x_m,y_m", [](int k) {
                        const std::string x = exact(50.0 * k);
                        return fmt::format("{0},a,{1},0\n{0},b,{1},401\n{0},b,{1},1\n{0},a,{1},400", k, x);
                      }));
  const auto ending = associate(Arguments{file} + clean);
  EXPECT_TRUE(says(ending.on_one_line(), {"60 scans", "2 confirmed tracks", "120 of 120 detections are explained"}));
}

TEST_F(HimmDemoAssociate, PlacesOnTheEarthAreInOneFrame) {
  const std::string file = directory.write("earth.csv", recording("time_s,latitude_deg,longitude_deg", [](int k) {
                                             return fmt::format("{0},50,{1}\n{0},50.01,{1}", k, exact(1.0 + 1e-4 * k));
                                           }));
  associate(Arguments{file} + clean);
  const auto last = row_with(rows_of(out() / "tracks.csv"), {{"track", "2"}, {"time_s", "29"}});
  EXPECT_NEAR(number(last.at("latitude_deg")), 50.01, 1e-4);
  EXPECT_NEAR(number(last.at("longitude_deg")), 1.0029, 1e-4);
  EXPECT_NEAR(number(last.at("vx_mps")), 7.17, 2.0);
}

TEST_F(HimmDemoAssociate, ASimulatedRadarSeesARecording) {
  const std::string file = directory.write("two.csv", two_targets());
  const Arguments radar = {"--labels", "of", "--radar",   "10,0.1,0.1", "--radar-at=0,-5000,0",
                           "--scan",   "1",  "--clutter", "4"};
  const auto ending = associate(Arguments{file} + radar);
  EXPECT_TRUE(says(ending.on_one_line(),
                   {"30 scans", "measured by a simulated radar: 10 m, 0.1°", "P_D 0.9, 4 false detections a scan"}));
  EXPECT_EQ(summary().at("score").at("jpda_star").at("untracked"), 0.0);
  const std::string tracks = contents(out() / "tracks.csv");
  associate(Arguments{file} + radar);
  EXPECT_EQ(contents(out() / "tracks.csv"), tracks);
  associate(Arguments{file, "--seed", "2"} + radar);
  EXPECT_NE(contents(out() / "tracks.csv"), tracks);
}

TEST_F(HimmDemoAssociate, FollowsWhatItSimulates) {
  for (const std::string radars : {"0", "2"}) {
    const auto simulated = associate({"--simulate", "crossing", "--radars", radars}, "scene");
    EXPECT_TRUE(says(simulated.on_one_line(), {"Situation crossing, seed 1: 60 scans", "crossing.csv --labels label"}));
    associate({out("scene") / "crossing.csv", "--labels", "label"});
    const json score = summary().at("score").at("jpda_star");
    EXPECT_EQ(score.at("targets"), 2.0);
    EXPECT_EQ(score.at("untracked"), 0.0);
    EXPECT_EQ(score.at("false_tracks"), 0.0);
    EXPECT_LT(score.at("gospa_m"), 200.0);
  }
}

TEST_F(HimmDemoAssociate, TheNumberOfThreadsChangesNoByte) {
  for (const std::string threads : {"1", "2"})
    associate({"--simulate", "crossing", "--runs", "3", "--threads", threads}, threads);
  EXPECT_EQ(contents(out("1") / "associations.csv"), contents(out("2") / "associations.csv"));
  const auto rows = rows_of(out("1") / "associations.csv");
  ASSERT_EQ(rows.size(), 8U);
  EXPECT_EQ(rows[0].at("of"), "jpda imm");
  EXPECT_EQ(rows[7].at("of"), "fuzzy_random himm");
  for (const TextRow& row : rows) EXPECT_LT(number(row.at("gospa_m")), 200.0) << row.at("of");
}

TEST_F(HimmDemoAssociate, DrawsThePlanAndTheExistence) {
  const std::string file = directory.write("two.csv", two_targets() + "40,1e5,1e5,\n");
  associate(Arguments{file, "--labels", "of"} + clean);
  const json page = json::parse(contents(out() / "report.json"));
  const std::string text = page.dump();
  for (const char* words : {"\"Existence\"", "\"track 1\"", "\"track 2\"", "unexplained detections"})
    EXPECT_NE(text.find(words), std::string::npos) << words;
}

}  // namespace himm_demo_associate_test
