#include <sys/wait.h>

#include "apps/temporary_directory.hpp"
#include "apps/terminal.hpp"
#include "report/result.hpp"
#include "study/study.hpp"

namespace run_test {

struct Ending {
  int code = -1;
  std::string complaint;
};

/// Runs the work in a child of its own, whose standard output is `output` and whose standard error comes back.
Ending run_in_child(const TemporaryDirectory& directory, const std::function<void()>& work,
                    const char* output = "/dev/null") {
  const std::string complaints = directory.path() / "complaints";
  std::fflush(stdout);
  const pid_t child = ::fork();
  if (child == 0) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
    ::dup2(::open(output, O_WRONLY), STDOUT_FILENO);
    ::dup2(::open(complaints.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    ::_exit(run_program("demo", work));
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(complaints)};
}

class RunProgram : public InDirectory {};

TEST_F(RunProgram, TellsTheKindOfAFailureByItsExitCode) {
  EXPECT_EQ(run_in_child(directory, [] {}).code, 0);
  const Ending usage = run_in_child(directory, [] { throw UsageError("what?"); });
  EXPECT_EQ(usage.code, 2);
  EXPECT_EQ(usage.complaint, "demo: what?\n");
  EXPECT_EQ(run_in_child(directory, [] { throw InputError("bad"); }).code, 3);
  const Ending other = run_in_child(directory, [] { throw std::domain_error("lost"); });
  EXPECT_EQ(other.code, 3);
  EXPECT_EQ(other.complaint, "demo: lost\n");
}

/// What a child prints to a terminal that is its standard error; nothing where there is none.
std::string on_a_terminal(const std::function<void()>& work) {
  const Terminal terminal;
  if (!terminal.works()) return "";
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(terminal.device(), STDERR_FILENO);
    ::_exit(run_program("demo", work));
  }
  ::waitpid(child, nullptr, 0);
  return terminal.seen();
}

TEST_F(RunProgram, BreaksLongComplaintsOnATerminalOnly) {
  const std::string word(30, 'x');
  const auto work = [&] { throw InputError(word + " " + word + " " + word); };
  EXPECT_EQ(run_in_child(directory, work).complaint, "demo: " + word + " " + word + " " + word + "\n");
  const std::string text = on_a_terminal(work);
  if (text.empty()) GTEST_SKIP() << "there is no terminal to be had here";
  EXPECT_EQ(text, "demo: " + word + " " + word + "\r\n" + word + "\r\n");
  EXPECT_EQ(on_a_terminal([] { throw InputError("short"); }), "demo: short\r\n");
}

TEST_F(RunProgram, OutputThatIsLostIsAFailure) {
  const Ending ending = run_in_child(
      directory, [] { std::fputs("text", stdout); }, "/dev/full");
  EXPECT_EQ(ending.code, 3);
  EXPECT_EQ(ending.complaint,
            "demo: standard output: cannot be written: No space left on device; make room there, or choose another "
            "place\n");
}

TEST_F(RunProgram, ASignalRemovesUnfinishedFiles) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    const TemporaryDirectory directory;
    const Ending ending = run_in_child(directory, [&] {
      AtomicFile file{directory.path() / "a.csv"};
      file.write(std::string(100'000, 'x'));
      std::raise(signal);
      file.commit();
    });
    EXPECT_EQ(ending.code, 128 + signal);
    EXPECT_EQ(ending.complaint, signal == SIGPIPE ? "" : "demo: interrupted; unfinished output was removed\n");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator{directory.path()}, {}), 1) << "beside the complaints";
  }
}

TEST_F(RunProgram, ASignalLeavesTheJournalOfACampaignAndItsMessageSaysSo) {
  const std::string out = directory.path() / std::string(200, 'o');
  const auto done = [&](std::size_t least) {
    const auto work = [least](std::size_t cell) {
      if (cell < least || (least == 0 && cell == 3)) std::raise(SIGINT);
      return Study::Row{static_cast<double>(cell)};
    };
    const Study study{"cells", 5, work, "a study"};
    return run_in_child(directory,
                        [&] { run(study, {.threads = 1}, {.out = out, .quiet = true}, [](auto, auto&) {}); });
  };
  const Ending ending = done(0);
  EXPECT_EQ(ending.code, 130);
  EXPECT_EQ(ending.complaint, "demo: interrupted; unfinished output was removed; " + out +
                                  "/cells.journal stays, and the same command goes on from there\n");
  EXPECT_EQ(done(3).code, 0) << "the first three cells are not done again";
}

TEST_F(RunProgram, AnIgnoredSignalStaysIgnored) {
  const auto before = std::signal(SIGHUP, SIG_IGN);
  std::fflush(stdout);
  const pid_t child = ::fork();
  if (child == 0) ::_exit(run_program("demo", [] { std::raise(SIGHUP); }));
  int status = 0;
  ::waitpid(child, &status, 0);
  std::signal(SIGHUP, before);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace run_test
