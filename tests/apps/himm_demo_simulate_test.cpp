#include <nlohmann/json.hpp>

#include "apps/campaigns.hpp"

namespace himm_demo_simulate_test {

program::Ending simulate(const std::filesystem::path& out, std::vector<std::string> more) {
  return program::run(SIGMAX_HIMM_DEMO, Arguments{"simulate", "--quiet", "--out", out} + more);
}

class HimmDemoSimulate : public InDirectory {};

TEST_F(HimmDemoSimulate, TheNumberOfThreadsChangesNoByte) {
  for (const char* what : {"--runs 70", "--runs 5 --set filters=all"}) {
    for (const std::string threads : {"1", "3"})
      ASSERT_EQ(simulate(directory.path() / threads, words(what) + Arguments{"--threads", threads}).status, 0);
    for (const char* file : {"filters.csv", "rmse.csv", "weights.csv"})
      EXPECT_EQ(contents(directory.path() / "1" / file), contents(directory.path() / "3" / file)) << file;
  }
}

TEST_F(HimmDemoSimulate, RanksShareTheRunsAndChangeNoByte) {
  if (!has_mpirun()) GTEST_SKIP() << "there is no mpirun";
  const Arguments arguments = {"simulate", "--quiet", "--runs", "20", "--out", directory.path() / "out"};
  const auto alone = program::succeeds(SIGMAX_HIMM_DEMO, arguments);
  const auto files = results(directory.path() / "out");
  const auto ranks = run_in_ranks(arguments);
  if (ranks.output.find("this build has no MPI") != std::string::npos) GTEST_SKIP() << "this build has no MPI";
  EXPECT_EQ(ranks.output, alone.output);
  EXPECT_TRUE(results(directory.path() / "out") == files);
}

TEST_F(HimmDemoSimulate, TheSeedChoosesTheRuns) {
  for (const std::string seed : {"1", "2"})
    ASSERT_EQ(simulate(directory.path() / seed, {"--runs", "5", "--seed", seed}).status, 0);
  EXPECT_NE(contents(directory.path() / "1" / "rmse.csv"), contents(directory.path() / "2" / "rmse.csv"));
}

TEST_F(HimmDemoSimulate, WritesARowForEverySampleFilterAndAxis) {
  ASSERT_EQ(simulate(directory.path(), {"--runs", "3", "--scenario", "2"}).status, 0);
  const std::string rmse = contents(directory.path() / "rmse.csv");
  EXPECT_EQ(std::count(rmse.begin(), rmse.end(), '\n'), 1 + 80 * 3 * 3);
  EXPECT_TRUE(rmse.starts_with("sample,filter,axis,rmse_m\n1,measurement,x,"));
  EXPECT_TRUE(says(rmse, {"\n2,imm,x,\n"}));
  EXPECT_EQ(rmse.find("\n3,imm,x,\n"), std::string::npos);
  const std::string weights = contents(directory.path() / "weights.csv");
  EXPECT_TRUE(weights.starts_with("sample,filter,weight_dwna,weight_dwpa\n1,imm,,\n2,imm,,\n3,imm,0.5,0.5\n"))
      << weights.substr(0, 99);
  EXPECT_TRUE(says(weights, {"\n3,himm,1,1\n"}));
}

TEST_F(HimmDemoSimulate, EveryPresetGroupAndScenarioRuns) {
  for (const std::string preset : {"paper_text", "released"})
    for (const std::string scenario : {"1", "2"})
      for (const std::string group : {"1", "2", "3", "4"}) {
        const auto ending = program::succeeded(
            simulate(directory.path(), {"--runs", "2", "--preset", preset, "--scenario", scenario, "--group", group}));
        EXPECT_EQ(ending.output.find("nan"), std::string::npos) << ending.output;
        EXPECT_EQ(ending.output.find("inf"), std::string::npos) << ending.output;
      }
}

TEST_F(HimmDemoSimulate, AFilterTableOverridesAKeyForOneFilter) {
  const auto rmse = [&](std::vector<std::string> sets) {
    EXPECT_EQ(simulate(directory.path(), Arguments{"--runs", "5"} + setting(sets)).status, 0);
    return nlohmann::json::parse(contents(directory.path() / "summary.json")).at("results");
  };
  const auto plain = rmse({});
  const auto wider = rmse({"filter.himm.sigma_w=5"});
  EXPECT_EQ(plain.at("imm"), wider.at("imm"));
  EXPECT_NE(plain.at("himm"), wider.at("himm"));
  EXPECT_EQ(rmse({"sigma_w=5"}).at("himm"), wider.at("himm"));
}

const auto all_filters = words(
    "imm imm_correct imm_released imm_most_likely imm_as_printed gpb1 gpb2 himm himm_selected himm_own "
    "himm_own_recentred "
    "himm_released himm_envelope himm_global himm_possibility viterbi static_random static_fuzzy");

TEST_F(HimmDemoSimulate, AllPrintsEveryFilterAsARowOfEachTable) {
  const auto ending = program::succeeded(simulate(directory.path(), {"--runs", "3", "--set", "filters=all"}));
  for (const auto& filter : all_filters) {
    EXPECT_TRUE(says(ending.output, {"\n" + filter + " "})) << filter;
  }
  EXPECT_EQ(ending.output.find("nan"), std::string::npos) << ending.output;
  const auto table = contents(directory.path() / "filters.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 2 + static_cast<long>(all_filters.size()));
}

TEST_F(HimmDemoSimulate, EachRowOfAllIsThatOfTheFilterAlone) {
  for (const std::string preset : {"paper_text", "released"}) {
    const auto all = directory.path() / preset;
    ASSERT_EQ(simulate(all, {"--runs", "3", "--preset", preset, "--set", "filters=all"}).status, 0);
    for (const auto& filter : all_filters) {
      const auto alone = directory.path() / (preset + filter);
      ASSERT_EQ(simulate(alone, {"--runs", "3", "--preset", preset, "--set", "filters=" + filter}).status, 0);
      for (const char* file : {"filters.csv", "rmse.csv", "weights.csv"}) {
        const auto rows = of_filter(rows_of(alone / file), filter);
        EXPECT_FALSE(rows.empty()) << file;
        EXPECT_EQ(of_filter(rows_of(all / file), filter), rows) << file << ", " << filter;
      }
    }
  }
}

TEST_F(HimmDemoSimulate, TheFigureOfAPhaseIsTheDistanceOfItsAxes) {
  ASSERT_EQ(simulate(directory.path(), {"--runs", "4"}).status, 0);
  const auto results = nlohmann::json::parse(contents(directory.path() / "summary.json")).at("results");
  for (const char* filter : {"measurement", "imm", "himm"})
    for (const char* phase : {"before", "during", "after"}) {
      const auto rmse = [&](const char* axis) -> double {
        return results.at(filter).at(std::string("rmse_") + phase + axis + "_m");
      };
      EXPECT_NEAR(rmse(""), std::hypot(rmse("_x"), rmse("_y"), rmse("_z")), 1e-9);
    }
}

TEST_F(HimmDemoSimulate, OtherModelsThanThePapersRun) {
  program::succeeded(
      simulate(directory.path(), {"--runs", "2", "--set", "models=[cwna,singer]", "--set", "sigma_w=[3,30]"}));
  EXPECT_TRUE(contents(directory.path() / "weights.csv").starts_with("sample,filter,weight_cwna,weight_singer\n"));
  // Without a velocity there is nothing to say of its NEES.
  const auto still = program::succeeded(
      simulate(directory.path(), {"--runs", "2", "--set", "models=ou_position", "--set", "sigma_w=1e5"}));
  EXPECT_EQ(still.output.find("nan"), std::string::npos) << still.output;
}

}  // namespace himm_demo_simulate_test
