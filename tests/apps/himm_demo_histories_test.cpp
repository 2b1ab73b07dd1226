// The filters over histories in himm_demo.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/manoeuvring_targets.hpp"
#include "apps/recordings.hpp"
#include "apps/temporary_directory.hpp"
#include "support/history_restatement.hpp"
#include "support/near.hpp"
#include "support/program.hpp"

namespace sigmax::apps {
namespace {

using support::near;

program::Ending himm_demo(std::vector<std::string> arguments, const std::vector<std::string>& sets) {
  for (const auto& set : sets) arguments.insert(arguments.end(), {"--set", set});
  return program::run(SIGMAX_HIMM_DEMO, arguments);
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

TEST(HimmDemoHistories, EachNamedOneEqualsThePlainRestatement) {
  const auto points = accelerating_target();
  const TemporaryDirectory directory;
  const auto out = directory.path() / "out";
  std::vector<std::string> sets = given;
  sets.push_back("filters=[\"himm_histories\",\"imm_histories\"]");
  const auto ending =
      himm_demo({"track", directory.write("recording.csv", csv(points)), "--quiet", "--out", out}, sets);
  ASSERT_EQ(ending.status, 0) << ending.output;
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
      const std::vector<const char*> means = {"x_m", "y_m", "z_m", "vx_mps", "vy_mps", "vz_mps"};
      for (std::size_t i = 0; i < means.size(); ++i)
        ASSERT_PRED_FORMAT3(near, std::stod(of_it[k].at(means[i])), estimate.mean[i], 1e-8);
      ASSERT_PRED_FORMAT3(near, std::stod(of_it[k].at("sigma_x_m")), std::sqrt(estimate.covariance(0, 0)), 1e-8);
      ASSERT_PRED_FORMAT3(near, std::stod(of_it[k].at("nis")), filter.nis(), 1e-8);
    }
  }
}

/// The best history by all that came has one manoeuvre, where it was.
TEST(HimmDemoHistories, TrackTellsWhenTheTargetTurned) {
  const auto points = accelerating_target();
  const TemporaryDirectory directory;
  const auto out = directory.path() / "out";
  const auto ending = himm_demo({"track", directory.write("recording.csv", csv(points)), "--quiet", "--out", out},
                                {"filters=himm_histories", "explain=true"});
  ASSERT_EQ(ending.status, 0) << ending.output;
  EXPECT_NE(ending.output.find("Best history by himm_histories: dwna from "), std::string::npos) << ending.output;
  const auto summary = nlohmann::json::parse(contents(out / "summary.json"));
  const auto& stays = summary.at("histories").at("himm_histories").at("");
  ASSERT_EQ(stays.size(), 3U) << stays.dump();
  EXPECT_EQ(stays[0].at("mode"), "dwna");
  EXPECT_EQ(stays[1].at("mode"), "dwpa");
  EXPECT_EQ(stays[2].at("mode"), "dwna");
  EXPECT_NEAR(stays[1].at("since_s"), points[80].time, 1.0);
  EXPECT_NEAR(stays[2].at("since_s"), points[130].time, 1.0);
}

TEST(HimmDemoHistories, ThePresetsRunOnTheScenariosAndAreBelowTheHimmWhileTheTargetManoeuvres) {
  const TemporaryDirectory directory;
  const auto ending = himm_demo({"simulate", "--quiet", "--runs", "10", "--out", directory.path()},
                                {"filters=[\"himm\",\"himm_histories\",\"himm_histories_fast\",\"imm_histories\"]"});
  ASSERT_EQ(ending.status, 0) << ending.output;
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

TEST(HimmDemoHistories, RefusesWhatCannotBe) {
  const auto refused = [](const std::string& set, std::initializer_list<const char*> words) {
    const auto ending = himm_demo({"simulate", "--runs", "2"}, {"filters=himm_histories", set});
    EXPECT_EQ(ending.status, 3) << set << "\n" << ending.output;
    for (const char* word : words) EXPECT_NE(ending.output.find(word), std::string::npos) << ending.output;
  };
  refused("histories=1", {"histories", "2 or more", "one for each model"});
  refused("histories=2.5", {"histories", "whole number"});
  refused("entry_scales=[]", {"entry_scales", "one or more"});
  refused("entry_scales=[0]", {"entry_scales", "positive"});
  refused("cut=2", {"cut", "from 0 to 1"});
  refused("tempering=0", {"tempering", "above 0"});
}

}  // namespace
}  // namespace sigmax::apps
