#include <nlohmann/json.hpp>

#include "apps/campaigns.hpp"

namespace himm_demo_sweep_test {

/// Nine conditions, two filters, of which the noises are searched.
const Arguments small = words(
    "sweep --scenario 2 --filters imm,himm_own --probability 0.05 --possibility 0.5 --sigma-w 3,9 --augmentation zero "
    "--tuning-runs 4 --runs 40 --mismatch 1,2");

/// The row of tuned.csv about a filter where nothing is mismatched.
TextRow tuned(const std::filesystem::path& out, const std::string& filter) {
  return row_with(rows_of(out / "tuned.csv"),
                  {{"noise", "1"}, {"period", "1"}, {"strength", "1"}, {"length", "1"}, {"filter", filter}});
}

/// Its condition alone.
const std::string alone = " --mismatch 1 --period 1 --strength 1 --length 1 ";

nlohmann::json simulated(const std::filesystem::path& out, const Arguments& sets) {
  program::succeeds(SIGMAX_HIMM_DEMO,
                    Arguments{"simulate", "--scenario", "2", "--quiet", "--runs", "10", "--out", out} + setting(sets));
  return nlohmann::json::parse(contents(out / "summary.json")).at("results");
}

double score_of(const nlohmann::json& results, const std::string& filter) {
  double sum = 0.0;
  for (const std::string phase : {"before", "during", "after"})
    for (const std::string axis : {"x", "y", "z"}) {
      const std::string key = "rmse_" + phase + "_" + axis + "_m";
      sum += results.at(filter).at(key).get<double>() / results.at("measurement").at(key).get<double>();
    }
  return sum / 9.0;
}

class HimmDemoSweep : public InDirectory {
 protected:
  void SetUp() override {
    const auto least =
        words("sweep --quiet --scenario 2 --filters imm --runs 2 --tuning-runs 1 --sigma-w 3 --augmentation zero");
    if (program::run(SIGMAX_HIMM_DEMO, least + words(alone)).output.find("without an optimiser") != std::string::npos)
      GTEST_SKIP() << "built without NLopt";
  }
};

TEST_F(HimmDemoSweep, TheScoreIsThatOfSimulateAndNoCornerHasABetterOne) {
  campaign(directory.path() / "sweep",
           words("sweep --scenario 2 --filters imm,himm_own --tuning-runs 10 --runs 4 --probability 0.05 "
                 "--possibility 0.2,0.5 --sigma-w 1,9 --augmentation zero,unbiased" +
                 alone));
  const auto row = tuned(directory.path() / "sweep", "himm_own");
  const auto score = [&](const std::string& leaving, const std::string& returning, const std::string& dwna,
                         const std::string& dwpa, const std::string& augmentation) {
    const auto results =
        simulated(directory.path() / "simulate",
                  {"filters=himm_own", "transition_possibility=[[1," + leaving + "],[" + returning + ",1]]",
                   "sigma_w=[" + dwna + "," + dwpa + "]", "augmentation=" + augmentation});
    return score_of(results, "himm_own");
  };
  const double best = std::stod(row.at("tuning_score"));
  EXPECT_NEAR(score(row.at("leaving"), row.at("returning"), row.at("sigma_w_dwna"), row.at("sigma_w_dwpa"),
                    row.at("augmentation")),
              best, 1e-9);
  for (const std::string leaving : {"0.2", "0.5"})
    for (const std::string returning : {"0.2", "0.5"})
      for (const std::string dwna : {"1", "9"})
        for (const std::string dwpa : {"1", "9"})
          for (const std::string augmentation : {"zero", "unbiased"})
            EXPECT_GE(score(leaving, returning, dwna, dwpa, augmentation), best - 1e-4)
                << leaving << returning << dwna << dwpa;
}

TEST_F(HimmDemoSweep, ItStopsAtTheEndOfARangeAndSaysSo) {
  const auto said = campaign(
      directory.path(), words("sweep --scenario 1 --tuning-runs 4 --runs 2 --sigma-w 3 --augmentation zero --filters "
                              "imm,himm_own_recentred --probability 0.16,0.32 --possibility 0.4,0.8" +
                              alone));
  EXPECT_TRUE(says(said, {"2 of 2 tuned filters have a number at an end of its range"}));
  const auto row = tuned(directory.path(), "imm");
  EXPECT_NEAR(std::stod(row.at("leaving")), 0.16, 1e-3);
  EXPECT_EQ(row.at("at_the_limit"), "1");
}

TEST_F(HimmDemoSweep, TheyAreJudgedOnOtherRuns) {
  const auto one =
      words("sweep --scenario 2 --filters imm --probability 0.05 --sigma-w 3 --augmentation zero --runs 6" + alone);
  const auto early = directory.path() / "early", all = directory.path() / "all";
  campaign(early, one + words("--tuning-runs 4"));
  campaign(all, one + words("--tuning-runs 10"));
  const auto score = [](const auto& run, const char* key) { return std::stod(tuned(run, "imm").at(key)); };
  // Runs 5 to 10 are judged first, and are among the ten that tune then: mean squares add up.
  EXPECT_NE(score(early, "score"), score(all, "tuning_score"));
  EXPECT_NE(score(early, "score"), score(all, "score"));
  EXPECT_NEAR(score(all, "tuning_score"), score_of(simulated(directory.path() / "s", {"filters=imm"}), "imm"), 1e-9);
}

TEST_F(HimmDemoSweep, TheNumberOfThreadsChangesNoByte) {
  for (const std::string threads : {"1", "3"})
    campaign(directory.path() / threads, small + Arguments{"--threads", threads});
  EXPECT_EQ(results(directory.path() / "1"), results(directory.path() / "3"));
}

TEST_F(HimmDemoSweep, KilledAndStartedAgainItEndsWithTheSameBytes) {
  campaign(directory.path() / "whole", small);
  campaign_with_kills(directory.path() / "killed", small);
  EXPECT_EQ(results(directory.path() / "killed"), results(directory.path() / "whole"));
}

TEST_F(HimmDemoSweep, ShardsMergeIntoTheSameBytes) {
  campaign(directory.path() / "whole", small);
  Arguments merge = small + Arguments{"--out", directory.path() / "merged", "--merge"};
  for (const std::string shard : {"1", "2", "3"}) {
    campaign(directory.path() / shard, small + Arguments{"--shard", shard + "/3"});
    merge.push_back(directory.path() / shard);
  }
  program::succeeds(SIGMAX_HIMM_DEMO, merge);
  EXPECT_EQ(results(directory.path() / "merged"), results(directory.path() / "whole"));
}

TEST_F(HimmDemoSweep, ADigitOfAShardThatChangedIsNeverMerged) {
  const auto shard = directory.path() / "1", merged = directory.path() / "merged";
  for (const std::string number : {"1", "2"})
    campaign(directory.path() / number, small + Arguments{"--shard", number + "/2"});
  const std::string whole = contents(shard / "cells.journal");
  std::mt19937_64 random(28);
  for (int change = 0; change < 200; ++change) {
    std::string changed = whole;
    const std::size_t at = random() % whole.size();
    while (changed[at] == whole[at]) changed[at] = "0123456789,.-e\n"[random() % 15];
    std::ofstream(shard / "cells.journal") << changed;
    const auto line = 1 + std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    const auto where = (shard / "cells.journal").string() + ":" + std::to_string(line) + ": the line";
    const auto merge =
        program::run(SIGMAX_HIMM_DEMO, small + Arguments{"--merge", shard, directory.path() / "2", "--out", merged});
    EXPECT_EQ(merge.status, 3);
    EXPECT_TRUE(says(merge.on_one_line(), {at + 1 < whole.size() ? where : "are missing"}));
    const auto resumed = program::run(SIGMAX_HIMM_DEMO, small + Arguments{"--quiet", "--shard", "1/2", "--out", shard});
    EXPECT_TRUE(says(resumed.on_one_line(), {at + 1 < whole.size() ? where : "Finished"}));
    if (line > 1) ASSERT_EQ(contents(shard / "cells.journal"), whole);
  }
}

TEST_F(HimmDemoSweep, ARankIsKilledAndTheRestGoesOnFromThere) {
  if (!has_mpirun()) GTEST_SKIP() << "there is no mpirun";
  const auto out = directory.path() / "ranks";
  const auto command = mpirun(small + Arguments{"--quiet", "--out", out});
  const Arguments ranked(command.begin() + 1, command.end());
  campaign(directory.path() / "whole", small);
  program::Running running(command.front(), ranked);
  if (!has_written(running, out / "cells.journal", 3)) {
    const auto ending = program::run(command.front(), ranked);
    ASSERT_NE(ending.output.find("this build has no MPI"), std::string::npos) << ending.output;
    GTEST_SKIP() << "this build has no MPI, and says so";
  }
  const auto ranks = children_of(running.pid());
  ASSERT_EQ(ranks.size(), 3U);
  ::kill(ranks.back(), SIGKILL);
  EXPECT_NE(running.end(), 0);
  EXPECT_LT(lines_of(out / "cells.journal"), lines_of(directory.path() / "whole" / "cells.journal"));
  program::succeeds(command.front(), ranked);
  EXPECT_EQ(results(out), results(directory.path() / "whole"));
}

TEST_F(HimmDemoSweep, WhatCannotBeIsSaid) {
  const auto run = [&](const Arguments& arguments) {
    return program::run(SIGMAX_HIMM_DEMO, arguments + Arguments{"--quiet"});
  };
  const auto out = directory.path() / "out";
  campaign(out, small);
  const auto other = run(small + Arguments{"--seed", "2", "--out", out});
  EXPECT_EQ(other.status, 3);
  EXPECT_TRUE(says(other.output, {"the directory holds another campaign: found '--seed 1', expected '--seed 2'"}));

  EXPECT_EQ(run(small + Arguments{"--shard", "1/2"}).status, 2) << "there is no --out";
  EXPECT_EQ(run(small + Arguments{"--cross", "--out", out}).status, 3) << "another campaign";
  EXPECT_EQ(run({"sweep", "--filters", "nobody"}).status, 3);
  EXPECT_EQ(run(small + Arguments{"--merge", directory.path(), "--out", out}).status, 3);
}

}  // namespace himm_demo_sweep_test
