// The filters over histories in himm_demo.

#include <nlohmann/json.hpp>

#include "apps/manoeuvring_targets.hpp"
#include "support/history_restatement.hpp"

namespace himm_demo_histories_test {

/// Random numbers of the kind that nobody would choose twice, so that no two histories tie.
const Arguments no_ties = {"sigma_w=[3,0.4]",
                           "transition_probability=[[0.983,0.017],[0.071,0.929]]",
                           "transition_possibility=[[1,0.017],[0.071,1]]",
                           "entry_scales=[7,23]",
                           "entry_vertical=1",
                           "histories=11"};

TEST(HimmDemoHistories, EachNamedOneEqualsThePlainRestatement) {
  const auto points = accelerating_target();
  const auto found = estimates(csv(points), given + no_ties + Arguments{"filters=[himm_histories,imm_histories]"});
  for (const std::string name : {"himm_histories", "imm_histories"}) {
    const bool fuzzy = name == "himm_histories";
    const restatement::HistoryOptions options{.kind = fuzzy ? restatement::Kind::himm : restatement::Kind::imm,
                                              .histories = 11,
                                              .least = -12.0,
                                              .cut = fuzzy ? 0.05 : 0.0,
                                              .scales = {7.0, 23.0}};
    const restatement::Matrix transition(
        2, 2, fuzzy ? std::vector{1.0, 0.017, 0.071, 1.0} : std::vector{0.983, 0.017, 0.071, 0.929});
    const restatement::HistoryFilter filter({restatement::dwna(3, 3.0), restatement::dwpa(3, 0.4)}, transition,
                                            {restated_start(6), restated_start(9)}, options);
    expect_restated(of_filter(found, name), filter, start_time, detections(points), 1e-8);
  }
}

/// The best history by all that came has one manoeuvre, where it was.
TEST(HimmDemoHistories, TrackTellsWhenTheTargetTurned) {
  const auto points = accelerating_target();
  const auto found = tracked(csv(points), {"filters=himm_histories", "explain=true"});
  EXPECT_TRUE(says(found.output, {"Best history by himm_histories: dwna from "}));
  const auto summary = nlohmann::json::parse(found.summary);
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
  program::succeeds(SIGMAX_HIMM_DEMO, Arguments{"simulate", "--quiet", "--runs", "10", "--out", directory.path()} +
                                          setting({"filters=[himm,himm_histories,himm_histories_fast,imm_histories]"}));
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

}  // namespace himm_demo_histories_test
