#pragma once

#include <sys/wait.h>

#include "support/test.hpp"

namespace sigmax::support {

using Arguments = std::vector<std::string>;

inline Arguments operator+(Arguments all, const Arguments& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// `--set` before each.
inline Arguments setting(const Arguments& settings) {
  Arguments all;
  for (const auto& each : settings) all.insert(all.end(), {"--set", each});
  return all;
}

}  // namespace sigmax::support

namespace program {

/// What a program printed, on both streams, and how it ended.
struct Ending {
  std::string output;
  int status = -1;

  /// What it printed with a blank for each end of a line: where lines end is a matter of the names of files.
  std::string on_one_line() const {
    std::string result = output;
    std::replace(result.begin(), result.end(), '\n', ' ');
    return result;
  }
};

/// One word as a shell reads it back.
inline std::string quoted(const std::string& word) {
  std::string result = "'";
  for (const char letter : word) result += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return result + "'";
}

/// The same program of another build, if the environment names the folder of one: SIGMAX_PROGRAMS.
inline std::string chosen(const std::string& path) {
  const char* folder = std::getenv("SIGMAX_PROGRAMS");
  const auto other = std::filesystem::path(folder ? folder : "") / std::filesystem::path(path).filename();
  return folder && std::filesystem::exists(other) ? other.string() : path;
}

/// Runs a program and waits for it.
inline Ending run(const std::string& path, const std::vector<std::string>& arguments) {
  std::string command = quoted(chosen(path));
  for (const auto& argument : arguments) command += " " + quoted(argument);
  std::FILE* const pipe = popen((command + " 2>&1 </dev/null").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  Ending ending;
  std::array<char, 4096> buffer;
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    ending.output.append(buffer.data(), n);
  const int status = pclose(pipe);
  ending.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return ending;
}

/// The ending, which must be a good one.
inline Ending succeeded(Ending ending) {
  EXPECT_EQ(ending.status, 0) << ending.output;
  return ending;
}
inline Ending succeeds(const std::string& path, const std::vector<std::string>& arguments) {
  return succeeded(run(path, arguments));
}

}  // namespace program
