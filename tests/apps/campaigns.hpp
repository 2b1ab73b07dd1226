#pragma once

#include <fcntl.h>
#include <signal.h>

#include "apps/temporary_directory.hpp"
#include "support/program.hpp"

namespace sigmax::apps {

/// Runs himm_demo with these arguments and results in `out`; it must succeed.
inline std::string campaign(const std::filesystem::path& out, const Arguments& arguments) {
  const auto ending = program::succeeds(SIGMAX_HIMM_DEMO, arguments + Arguments{"--quiet", "--out", out});
  return ending.output;
}

/// The bytes of all files of a directory, but for the command that the summary repeats.
inline std::map<std::string, std::string> results(const std::filesystem::path& out) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    std::string text = contents(entry.path());
    if (const auto at = text.find("\"command\":"); at != std::string::npos) text.erase(at, text.find('\n', at) - at);
    files[entry.path().filename()] = text;
  }
  return files;
}

inline long lines_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return std::count(std::istreambuf_iterator<char>(stream), {}, '\n');
}

/// A program that runs beside the test.
class Running {
 public:
  explicit Running(Arguments words) {
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ != 0) return;
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (const int stream : {0, 1, 2}) ::dup2(nowhere, stream);
    ::execvp(argv.front(), argv.data());
    ::_exit(127);
  }

  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running() {
    if (pid_ > 0) end(SIGKILL);
  }

  pid_t pid() const { return pid_; }

  /// Waits until the file has so many lines; false if the program ends before.
  bool has_written(const std::filesystem::path& file, long lines) const {
    using namespace std::chrono_literals;
    for (int i = 0; i < 60'000; ++i) {
      if (lines_of(file) >= lines) return true;
      siginfo_t ended = {};
      if (::waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == pid_)
        return false;
      std::this_thread::sleep_for(1ms);
    }
    return false;
  }

  /// Waits for the end, after a signal if there is one; 128 and the signal's number if that ended it.
  int end(int signal = 0) {
    if (signal != 0) ::kill(pid_, signal);
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  pid_t pid_;
};

/// Kills the command as soon as it has finished some cells, again and again, and lets it end at last.
inline void campaign_with_kills(const std::filesystem::path& out, const Arguments& arguments) {
  std::filesystem::create_directories(out);
  const auto journal = out / "cells.journal";
  for (const long lines : {3L, 6L}) {
    Running running(Arguments{program::chosen(SIGMAX_HIMM_DEMO)} + arguments + Arguments{"--quiet", "--out", out});
    ASSERT_TRUE(running.has_written(journal, lines)) << "the work ended before it could be interrupted";
    ASSERT_EQ(running.end(SIGKILL), 128 + SIGKILL);
    std::ofstream(journal, std::ios::app) << "7,0.25,0.1";  // as if killed in the middle of a line
  }
  campaign(out, arguments);
}

inline bool has_mpirun() { return std::system("mpirun --version >/dev/null 2>&1") == 0; }

inline Arguments mpirun(const Arguments& arguments) {
  return Arguments{"mpirun", "--oversubscribe", "--allow-run-as-root", "-n", "3"} +
         Arguments{program::chosen(SIGMAX_HIMM_DEMO)} + arguments;
}

/// Runs three ranks to their end; 124 if they do not come to one.
inline program::Ending run_in_ranks(const Arguments& arguments) {
  return program::run("timeout", Arguments{"--kill-after=5", "200"} + mpirun(arguments));
}

/// The processes that a process has started.
inline std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  std::ifstream list("/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children");
  for (pid_t child = 0; list >> child;) children.push_back(child);
  return children;
}

}  // namespace sigmax::apps
