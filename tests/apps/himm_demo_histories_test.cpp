// The filters over histories in himm_demo.

#include <nlohmann/json.hpp>

#include "apps/manoeuvring_targets.hpp"
#include "apps/temporary_directory.hpp"
#include "support/history_restatement.hpp"
#include "support/program.hpp"

namespace {

program::Ending himm_demo(const Arguments& arguments, const Arguments& sets) {
  return program::run(SIGMAX_HIMM_DEMO, arguments + setting(sets));
}

/// A random number of the kind that nobody would choose twice, so that no two histories tie.
const std::vector<std::string> given = {"start=given",
                                        "start_mean=[1200,800,300,-95,-85,1,0.5,-0.25,0]",
                                        "start_covariance_diagonal=[400,500,600,100,110,120,25,16,9]",
                                        "start_time_s=2.5",
                                        "sigma_w=[3,0.4]",
                                        "transition_probability=[[0.983,0.017],[0.071,0.929]]",
                                        "transition_possibility=[[1,0.017],[0.071,1]]",
                                        "entry_scales=[7,23]",
                                        "entry_vertical=1",
                                        "histories=11"};

class HimmDemoHistories : public InDirectory {};

TEST_F(HimmDemoHistories, EachNamedOneEqualsThePlainRestatement) {
  const auto points = accelerating_target();
  const auto out = directory.path() / "out";
  std::vector<std::string> sets = given;
  sets.push_back("filters=[\"himm_histories\",\"imm_histories\"]");
  program::succeeded(
      himm_demo({"track", directory.write("recording.csv", csv(points)), "--quiet", "--out", out}, sets));
  const auto found = rows(contents(out / "estimates.csv"));
  for (const std::string name : {"himm_histories", "imm_histories"}) {
    const bool fuzzy = name == "himm_histories";
    restatement::HistoryOptions options;
    options.kind = fuzzy ? restatement::Kind::himm : restatement::Kind::imm;
    options.histories = 11;
    options.least = -12.0;
    options.cut = fuzzy ? 0.05 : 0.0;
    options.scales = {7.0, 23.0};
    const restatement::Matrix transition(
        2, 2, fuzzy ? std::vector{1.0, 0.017, 0.071, 1.0} : std::vector{0.983, 0.017, 0.071, 0.929});
    restatement::HistoryFilter filter({restatement::dwna(3, 3.0), restatement::dwpa(3, 0.4)}, transition,
                                      {restated_start(6), restated_start(9)}, options);
    restatement::Matrix R(3, 3);
    for (restatement::Index i = 0; i < 3; ++i) R(i, i) = 100.0;
    const auto of_it = of_filter(found, name);
    ASSERT_EQ(of_it.size(), points.size());
    double time = start_time;
    for (std::size_t k = 0; k < points.size(); ++k) {
      filter.step(points[k].time - time, points[k].z, R);
      time = points[k].time;
      const auto estimate = filter.estimate();
      SCOPED_TRACE(name + ", step " + std::to_string(k));
      expect_row(of_it[k], estimate, 3, 1e-8);
      ASSERT_CLOSE(std::stod(of_it[k].at("nis")), filter.nis(), 1e-8);
    }
  }
}

/// The best history by all that came has one manoeuvre, where it was.
TEST_F(HimmDemoHistories, TrackTellsWhenTheTargetTurned) {
  const auto points = accelerating_target();
  const auto out = directory.path() / "out";
  const auto ending =
      program::succeeded(himm_demo({"track", directory.write("recording.csv", csv(points)), "--quiet", "--out", out},
                                   {"filters=himm_histories", "explain=true"}));
  EXPECT_TRUE(says(ending.output, {"Best history by himm_histories: dwna from "}));
  const auto summary = nlohmann::json::parse(contents(out / "summary.json"));
  const auto& stays = summary.at("histories").at("himm_histories").at("");
  ASSERT_EQ(stays.size(), 3U) << stays.dump();
  EXPECT_EQ(stays[0].at("mode"), "dwna");
  EXPECT_EQ(stays[1].at("mode"), "dwpa");
  EXPECT_EQ(stays[2].at("mode"), "dwna");
  EXPECT_NEAR(stays[1].at("since_s"), points[80].time, 1.0);
  EXPECT_NEAR(stays[2].at("since_s"), points[130].time, 1.0);
}

TEST_F(HimmDemoHistories, ThePresetsRunOnTheScenariosAndAreBelowTheHimmWhileTheTargetManoeuvres) {
  program::succeeded(himm_demo({"simulate", "--quiet", "--runs", "10", "--out", directory.path()},
                               {"filters=[\"himm\",\"himm_histories\",\"himm_histories_fast\",\"imm_histories\"]"}));
  const auto summary = nlohmann::json::parse(contents(directory.path() / "summary.json"));
  const auto found = rows(contents(directory.path() / "rmse.csv"));
  const auto sum_of_squares = [&](const std::string& filter) {
    double sum = 0.0;
    for (const auto& row : of_filter(found, filter))
      if (const double sample = number(row.at("sample")); sample >= 81.0 && sample <= 130.0)
        sum += std::pow(number(row.at("rmse_m")), 2);
    return sum;
  };
  for (const char* name : {"himm_histories", "himm_histories_fast", "imm_histories"})
    EXPECT_LT(sum_of_squares(name), sum_of_squares("himm")) << name;
}

}  // namespace
