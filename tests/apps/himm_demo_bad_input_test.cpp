// What himm_demo says to input that is wrong, and what it leaves behind: nothing.

#include <fcntl.h>

#include "apps/refusals.hpp"

namespace {

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
  expect_refused(GetParam(), SIGMAX_HIMM_DEMO, GetParam().name.starts_with("FullDisk"));
}

const Refusal usual{"", "himm_demo track input.csv --out out", {{"input.csv", good}}, 3, {}};
INSTANTIATE_TEST_SUITE_P(HimmDemo, BadInput, testing::ValuesIn(refusals("himm_demo_refusals.json", usual)),
                         [](const auto& test) { return test.param.name; });

/// Starts the program with an open pipe as its standard input, signals it when it has begun to write, and waits.
class Interrupted : public testing::TestWithParam<int> {};

TEST_P(Interrupted, LeavesNoHalfWrittenFile) {
  const TemporaryDirectory directory;
  const std::string out = directory.path() / "out";
  const std::string complaints = directory.path() / "complaints", himm_demo = program::chosen(SIGMAX_HIMM_DEMO);
  std::array<int, 2> input{};
  ASSERT_EQ(::pipe(input.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(100);  // a program that waits for ever ends as well
    std::signal(GetParam(), SIG_DFL);
    ::dup2(input[0], STDIN_FILENO);
    ::close(input[1]);
    ::dup2(::open(complaints.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    ::execl(himm_demo.c_str(), "himm_demo", "track", "-", "--out", out.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ::close(input[0]);
  ASSERT_EQ(::write(input[1], good.data(), good.size()), static_cast<ssize_t>(good.size()));
  int status = 0;
  pid_t ended = 0;
  // The reader waits for more input, so what is written stays unfinished until the signal.
  while (files_in(out).empty() && (ended = ::waitpid(child, &status, WNOHANG)) == 0) std::this_thread::yield();
  ASSERT_EQ(ended, 0) << "it ended before it was interrupted: " << contents(complaints);
  ::kill(child, GetParam());
  ::waitpid(child, &status, 0);
  ::close(input[1]);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 128 + GetParam());
  EXPECT_EQ(contents(complaints), "himm_demo: interrupted; unfinished output was removed\n");
  EXPECT_EQ(files_in(out), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(HimmDemo, Interrupted, testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const auto& test) { return std::string("BySIG") + ::sigabbrev_np(test.param); });

}  // namespace
