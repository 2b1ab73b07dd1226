// `mpirun himm_demo track --track-id`: each rank follows its share of the tracks.

#include "apps/campaigns.hpp"
#include "apps/recordings.hpp"

namespace himm_demo_ranks_test {

/// Rows of seven tracks in turn, all seen to 10 m, some missed; "early" ends before it can start, "late" begins in the
/// middle, and "lost" has a gap and an outlier.
std::string seven_tracks() {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> noise(0.0, 10.0);
  std::string text = "time_s,id,x_m,y_m,z_m\n";
  const std::vector<std::string> names = {"early", "e", "lost", "a", "late", "c", "b"};
  for (int k = 0; k < 200; ++k)
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string& name = names[i];
      if ((name == "early" && k > 1) || (name == "late" && k < 100) || (name == "lost" && k > 80 && k < 120)) continue;
      text += exact(k + 0.01 * static_cast<double>(i)) + "," + name;
      const double turn = k < 60 ? 0.0 : 0.3 * (k - 60) * (k - 60);
      const std::vector<double> position = {5000.0 + 1000.0 * static_cast<double>(i) + 20.0 * k, 3000.0 + turn, 900.0};
      for (const double x : position)
        text += k % 17 == 4 ? "," : "," + exact(x + noise(engine) + (name == "lost" && k == 150 ? 5000.0 : 0.0));
      text += "\n";
    }
  return text;
}

/// What mpirun prints and how it ends; nothing, with `skipped` filled, where it cannot be.
program::Ending in_ranks(const Arguments& arguments, std::string& skipped) {
  if (!has_mpirun()) return skipped = "there is no mpirun", program::Ending{};
  auto ending = run_in_ranks(arguments);
  if (ending.output.find("this build has no MPI") != std::string::npos) {
    EXPECT_TRUE(says(ending.output, {"; run it without mpirun, or configure with"}));
    EXPECT_EQ(ending.status, 2);
    skipped = "this build has no MPI, and says so";
  }
  return ending;
}

class TrackInRanks : public testing::TestWithParam<const char*> {};

TEST_P(TrackInRanks, PrintsAndWritesTheBytesOfOneProcess) {
  const TemporaryDirectory directory;
  const auto out = directory.path() / "out";
  const Arguments arguments =
      Arguments{"track", directory.write("seven.csv", seven_tracks()), "--track-id", "id", "--quiet", "--out", out} +
      words(GetParam()) + setting({"gate_probability=0.999"});
  const auto alone = program::succeeds(SIGMAX_HIMM_DEMO, arguments);
  EXPECT_TRUE(says(alone.output, {"7 tracks by id, 1 of them too short"}));
  const auto files = results(out);
  EXPECT_GT(files.at("estimates.csv").size(), 500'000U) << "so that it takes several messages";
  std::filesystem::remove_all(out);
  std::string skipped;
  const auto ranks = in_ranks(arguments, skipped);
  if (!skipped.empty()) GTEST_SKIP() << skipped;
  EXPECT_EQ(ranks.status, 0);
  EXPECT_EQ(ranks.output, alone.output);
  EXPECT_TRUE(results(out) == files) << "of the files in " << out;
}

INSTANTIATE_TEST_SUITE_P(
    HimmDemo, TrackInRanks,
    testing::Values("--set restart_after_s=20", "--set restart_after_s=20 --set smooth=true",
                    "--set filters=[imm,imm_smoothed] --set filter.imm_smoothed.smooth=true --predict-to 300",
                    "--set scheme=histories --set explain=true", "--radar 20,0.1,0.1"),
    [](const auto& test) {
      return (std::vector<std::string>{"Filtered", "Smoothed", "TwoFilters", "Histories", "Radar"})[test.index];
    });

/// Tracks at rest from a to f; a radar's row that no model can take follows for the second, on line 183, unless it is
/// among positions.
std::string with_a_failure() {
  std::ostringstream text;
  text << "time_s,id,sensor,x_m,y_m,range_m,azimuth_deg\n";
  for (int k = 0; k < 40; ++k)
    for (const char id : {'a', 'b', 'c', 'd', 'e', 'f'})
      if (id == 'b' && k == 30)
        text << k << ",b,radar,,,0.001,10\n";
      else
        text << k << ',' << id << ",gps,0,0,,\n";
  return text.str();
}

class HimmDemoRanks : public InDirectory {};

TEST_F(HimmDemoRanks, WhatFailsInOneEndsAllWithTheMessageOfOneProcess) {
  const auto out = directory.path() / "out";
  std::string first_bad = with_a_failure(), later_bad = first_bad;
  first_bad.insert(first_bad.find("\n20,a,") + 1, "20,c,gps,here,0,,\n");
  later_bad.insert(later_bad.find("\n35,a,") + 1, "35,c,gps,here,0,,\n");
  const std::vector<std::pair<std::string, std::string>> cases = {{with_a_failure(), ":183: filter 'imm' at time 30 s"},
                                                                  {later_bad, ":183: filter 'imm' at time 30 s"},
                                                                  {first_bad, ":122: column 'x_m': found 'here'"}};
  for (const auto& [text, complaint] : cases) {
    const Arguments arguments = {"track",      directory.write("failing.csv", text),
                                 "--track-id", "id",
                                 "--set",      "radar_measurement=polar",
                                 "--out",      out,
                                 "--quiet"};
    const auto alone = program::run(SIGMAX_HIMM_DEMO, arguments);
    EXPECT_EQ(alone.status, 3);
    EXPECT_TRUE(says(alone.output, {complaint}));
    std::string skipped;
    const auto ranks = in_ranks(arguments, skipped);
    if (!skipped.empty()) GTEST_SKIP() << skipped;
    EXPECT_EQ(ranks.status, 3);
    const auto at = ranks.output.find(alone.output);
    ASSERT_NE(at, std::string::npos) << ranks.output << "\nas one process has it: " << alone.output;
    EXPECT_EQ(ranks.output.find("himm_demo:", at + 1), std::string::npos) << "said once: " << ranks.output;
    EXPECT_TRUE(std::filesystem::is_empty(out));
  }
}

TEST_F(HimmDemoRanks, WhatTheyCannotShareIsSaid) {
  const std::string file = directory.write("seven.csv", seven_tracks());
  std::string skipped;
  const auto one = in_ranks({"track", file, "--select", "id=a"}, skipped);
  if (!skipped.empty()) GTEST_SKIP() << skipped;
  EXPECT_EQ(one.status, 2);
  EXPECT_TRUE(says(one.output, {"name the column that tells tracks apart by --track-id"}));
  const auto piped = in_ranks({"track", "-", "--track-id", "id"}, skipped);
  EXPECT_EQ(piped.status, 2);
  EXPECT_TRUE(says(piped.output, {"give the name of a file"}));
}

}  // namespace himm_demo_ranks_test
