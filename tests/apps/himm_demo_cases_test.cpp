// What `track` makes of the small inputs of ../shared/cases: himm_demo_cases.json.

#include <nlohmann/json.hpp>

#include "apps/recordings.hpp"

namespace himm_demo_cases_test {

const std::string folder = SIGMAX_DATA "/../cases";

using Case = std::pair<std::string, nlohmann::json>;

std::vector<Case> cases() {
  std::ifstream file(SIGMAX_SOURCE "/tests/apps/himm_demo_cases.json");
  const auto table = nlohmann::ordered_json::parse(file, nullptr, true, true);  // with comments
  std::vector<Case> result;
  for (const auto& [name, fields] : table.items()) result.emplace_back(name, fields);
  return result;
}

class HimmDemoCase : public testing::TestWithParam<Case> {};

TEST_P(HimmDemoCase, EndsAsItsReadmeSays) {
  const auto& fields = GetParam().second;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "there is no " << folder;
  const auto ending =
      program::run("/bin/sh", {"-c", "cd \"$1\"; exec \"$0\" track --quiet " + fields.at("run").get<std::string>(),
                               program::chosen(SIGMAX_HIMM_DEMO), folder});
  EXPECT_EQ(ending.status, fields.value("status", 0)) << ending.output;
  const std::string output = ending.on_one_line();
  using Words = std::vector<std::string>;
  for (const auto& words : fields.value("says", Words{})) EXPECT_TRUE(says(output, {words}));
  for (const auto& words : fields.value("never", Words{})) EXPECT_FALSE(says(output, {words})) << output;
}

INSTANTIATE_TEST_SUITE_P(HimmDemo, HimmDemoCase, testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.first; });

TEST(HimmDemoCases, AzimuthsAreReadClockwiseFromAhead) {
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "there is no " << folder;
  const TemporaryDirectory directory;
  program::succeeds(SIGMAX_HIMM_DEMO, Arguments{"track", folder + "/azimuth_clockwise_from_ahead.csv", "--quiet",
                                                "--azimuth-from", "ahead", "--out", directory.path() / "out"} +
                                          setting({"sigma_range_m=0.2", "sigma_azimuth_deg=0.3"}));
  const auto summary = nlohmann::json::parse(contents(directory.path() / "out" / "summary.json"));
  for (const std::string filter : {"imm", "himm"}) {
    const auto& figures = summary.at("results").at("all").at(filter);
    EXPECT_LT(std::hypot(figures.at("rmse_x_m").get<double>(), figures.at("rmse_y_m").get<double>()), 0.5) << filter;
  }
}

}  // namespace himm_demo_cases_test
