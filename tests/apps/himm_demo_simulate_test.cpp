#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/temporary_directory.hpp"
#include "support/program.hpp"

namespace sigmax::apps {
namespace {

program::Ending simulate(const std::filesystem::path& out, std::vector<std::string> more) {
  std::vector<std::string> arguments = {"simulate", "--quiet", "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return program::run(SIGMAX_HIMM_DEMO, arguments);
}

TEST(HimmDemoSimulate, TheNumberOfThreadsChangesNoByte) {
  const TemporaryDirectory directory;
  for (const std::string threads : {"1", "3"})
    ASSERT_EQ(simulate(directory.path() / threads, {"--runs", "70", "--threads", threads}).status, 0);
  for (const char* file : {"rmse.csv", "weights.csv"})
    EXPECT_EQ(contents(directory.path() / "1" / file), contents(directory.path() / "3" / file)) << file;
}

TEST(HimmDemoSimulate, TheSeedChoosesTheRuns) {
  const TemporaryDirectory directory;
  for (const std::string seed : {"1", "2"})
    ASSERT_EQ(simulate(directory.path() / seed, {"--runs", "5", "--seed", seed}).status, 0);
  EXPECT_NE(contents(directory.path() / "1" / "rmse.csv"), contents(directory.path() / "2" / "rmse.csv"));
}

TEST(HimmDemoSimulate, WritesARowForEverySampleFilterAndAxis) {
  const TemporaryDirectory directory;
  ASSERT_EQ(simulate(directory.path(), {"--runs", "3", "--scenario", "2"}).status, 0);
  const std::string rmse = contents(directory.path() / "rmse.csv");
  EXPECT_EQ(std::count(rmse.begin(), rmse.end(), '\n'), 1 + 80 * 3 * 3);
  EXPECT_TRUE(rmse.starts_with("sample,filter,axis,rmse_m\n1,measurement,x,"));
  EXPECT_NE(rmse.find("\n2,imm,x,\n"), std::string::npos) << "no estimate before the third sample";
  EXPECT_EQ(rmse.find("\n3,imm,x,\n"), std::string::npos);
  const std::string weights = contents(directory.path() / "weights.csv");
  EXPECT_TRUE(weights.starts_with("sample,filter,weight_dwna,weight_dwpa\n1,imm,,\n2,imm,,\n3,imm,0.5,0.5\n"))
      << weights.substr(0, 99);
  EXPECT_NE(weights.find("\n3,himm,1,1\n"), std::string::npos);
}

TEST(HimmDemoSimulate, EveryPresetGroupAndScenarioRuns) {
  const TemporaryDirectory directory;
  for (const std::string preset : {"paper_text", "released"})
    for (const std::string scenario : {"1", "2"})
      for (const std::string group : {"1", "2", "3", "4"}) {
        const auto ending =
            simulate(directory.path(), {"--runs", "2", "--preset", preset, "--scenario", scenario, "--group", group});
        ASSERT_EQ(ending.status, 0) << ending.output;
        EXPECT_EQ(ending.output.find("nan"), std::string::npos) << ending.output;
        EXPECT_EQ(ending.output.find("inf"), std::string::npos) << ending.output;
      }
}

TEST(HimmDemoSimulate, AFilterTableOverridesAKeyForOneFilter) {
  const TemporaryDirectory directory;
  const auto rmse = [&](std::vector<std::string> sets) {
    std::vector<std::string> arguments = {"--runs", "5"};
    for (auto& set : sets) arguments.insert(arguments.end(), {"--set", set});
    EXPECT_EQ(simulate(directory.path(), arguments).status, 0);
    return nlohmann::json::parse(contents(directory.path() / "summary.json")).at("results");
  };
  const auto plain = rmse({});
  const auto wider = rmse({"filter.himm.sigma_w=5"});
  EXPECT_EQ(plain.at("imm"), wider.at("imm"));
  EXPECT_NE(plain.at("himm"), wider.at("himm"));
  EXPECT_EQ(rmse({"sigma_w=5"}).at("himm"), wider.at("himm"));
}

TEST(HimmDemoSimulate, AnUnwritableDirectoryIsKnownBeforeTheWork) {
  const TemporaryDirectory directory;
  const auto file = directory.write("file", "");
  const auto ending = simulate(file, {"--runs", "100000000"});
  EXPECT_EQ(ending.status, 3) << ending.output;
}

}  // namespace
}  // namespace sigmax::apps
