// What track makes of the small inputs of ../shared/cases, each of which went wrong once: their README says what is
// right.

#include "apps/recordings.hpp"

namespace himm_demo_cases_test {

/// How track ends with a file and options, which a shell parts into words, and what it says.
struct Case {
  std::string file, options;
  int status;
  std::vector<std::string> says;

  friend void PrintTo(const Case& test, std::ostream* text) { *text << test.file << " " << test.options; }
};

class Cases : public testing::TestWithParam<Case> {};

TEST_P(Cases, EndsAsItsReadmeSays) {
  const Case& test = GetParam();
  const std::string folder = SIGMAX_DATA "/../cases";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "there is no " << folder;
  const auto ending =
      program::run("/bin/sh", {"-c", "cd \"$1\"; exec \"$0\" track " + test.file + ".csv --quiet " + test.options,
                               program::chosen(SIGMAX_HIMM_DEMO), folder});
  EXPECT_EQ(ending.status, test.status) << ending.output;
  for (const std::string& words : test.says) EXPECT_TRUE(says(ending.on_one_line(), {words}));
}

INSTANTIATE_TEST_SUITE_P(
    HimmDemo, Cases,
    testing::Values(Case{"outlier_blames_row_after",
                         "",
                         0,
                         {"Verdict: outlier_blames_row_after.csv:471: 13 outliers in 486 measurements",
                          "reject them with --set gate_probability=0.9999"}},
                    Case{"transition_transposed",
                         "--set 'transition_probability=[[0.97,0.05],[0.03,0.95]]'",
                         3,
                         {"its columns sum to 1: transpose it"}}),
    [](const auto& test) { return test.param.file; });

}  // namespace himm_demo_cases_test
