// What himm_demo says to input that is wrong, and what it leaves behind: nothing.

#include <sys/stat.h>

#include "apps/refusals.hpp"
#include "report/report.hpp"

namespace himm_demo_bad_input_test {

const std::string good = "time_s,x_m,y_m\n0,0,0\n1,1,2\n2,2,4\n3,3,6\n4,4,8\n";

/// Everything under the directory that a program may have written.
std::vector<std::string> files_in(const std::filesystem::path& out) {
  std::vector<std::string> files;
  std::error_code absent;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out, absent))
    files.push_back(entry.path().filename());
  return files;
}

class BadInput : public testing::TestWithParam<Refusal> {};

TEST_P(BadInput, IsExplainedAndNothingIsWritten) {
  if (GetParam().name.starts_with("Report") && !has_reports())
    GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  expect_refused(GetParam(), SIGMAX_HIMM_DEMO, GetParam().name.starts_with("FullDisk"));
}

const Refusal usual{"", "himm_demo track input.csv --out out", {{"input.csv", good}}, 3, {}};
INSTANTIATE_TEST_SUITE_P(HimmDemo, BadInput, testing::ValuesIn(refusals("himm_demo_refusals.json", usual)),
                         [](const auto& test) { return test.param.name; });

/// Starts the program with an open pipe as its standard input, signals it when it has begun to write, and waits.
class Interrupted : public testing::TestWithParam<std::tuple<const char*, int>> {};

TEST_P(Interrupted, LeavesNoHalfWrittenFile) {
  const auto [subcommand, signal] = GetParam();
  const TemporaryDirectory directory;
  const std::string out = directory.path() / "out", pipe = directory.path() / "pipe";
  const std::string complaints = directory.path() / "complaints";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  program::Running running("/bin/sh", {"-c", "exec \"$0\" \"$4\" - --out \"$1\" <\"$2\" 2>\"$3\"",
                                       program::chosen(SIGMAX_HIMM_DEMO), out, pipe, complaints, subcommand});
  std::ofstream input(pipe);
  input << good << std::flush;
  // The reader waits for more input, so what is written stays unfinished until the signal.
  while (files_in(out).empty() && !running.has_ended()) std::this_thread::yield();
  ASSERT_FALSE(running.has_ended()) << "it ended before it was interrupted: " << contents(complaints);
  EXPECT_EQ(running.end(signal), 128 + signal);
  EXPECT_EQ(contents(complaints), "himm_demo: interrupted; unfinished output was removed\n");
  EXPECT_EQ(files_in(out), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(HimmDemo, Interrupted,
                         testing::Values(std::tuple{"track", SIGINT}, std::tuple{"track", SIGTERM},
                                         std::tuple{"track", SIGHUP}, std::tuple{"associate", SIGINT}),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param)) + "BySIG" +
                                  ::sigabbrev_np(std::get<1>(test.param));
                         });

}  // namespace himm_demo_bad_input_test
