#pragma once

#include "apps/rows.hpp"
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

/// Waits until the file has so many lines; false if the program ends before.
inline bool has_written(const program::Running& running, const std::filesystem::path& file, long lines) {
  while (lines_of(file) < lines) {
    if (running.has_ended()) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

/// Kills the command as soon as it has finished some cells, again and again, and lets it end at last.
inline void campaign_with_kills(const std::filesystem::path& out, const Arguments& arguments) {
  std::filesystem::create_directories(out);
  const auto journal = out / "cells.journal";
  for (const long lines : {3L, 6L}) {
    program::Running running(SIGMAX_HIMM_DEMO, arguments + Arguments{"--quiet", "--out", out});
    ASSERT_TRUE(has_written(running, journal, lines)) << "the work ended before it could be interrupted";
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
