#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/test.hpp"

namespace sigmax::support {

using Arguments = std::vector<std::string>;

inline Arguments operator+(Arguments all, const Arguments& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// Those that stand between the blanks of a text.
inline Arguments words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// `--set` before each.
inline Arguments setting(const Arguments& settings) {
  Arguments all;
  for (const auto& each : settings) all.insert(all.end(), {"--set", each});
  return all;
}

}  // namespace sigmax::support

namespace program {

using sigmax::support::Arguments;

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

/// A program that runs beside the test, and has no input and output.
class Running {
 public:
  Running(const std::string& path, Arguments arguments) {
    arguments.insert(arguments.begin(), chosen(path));
    std::vector<char*> argv;
    for (auto& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ != 0) return;
    ::alarm(600);  // what waits for ever ends as well
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
    ::setenv("ASAN_OPTIONS", "quarantine_size_mb=1", 1);  // else a sanitizer keeps what is freed
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
  bool has_ended() const {
    siginfo_t ended = {};
    return ::waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == pid_;
  }

  /// Waits for the end, after a signal if there is one; 128 and the signal's number if that ended it.
  int end(int signal = 0) {
    if (signal != 0) ::kill(pid_, signal);
    int status = 0;
    rusage usage{};
    ::wait4(pid_, &status, 0, &usage);
    pid_ = -1;
    peak_ = usage.ru_maxrss;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  /// The most memory that it had, in KiB.
  long peak() const { return peak_; }

 private:
  pid_t pid_;
  long peak_ = 0;
};

/// The most memory that a run has, in KiB; it must end well.
inline long peak_memory(const std::string& path, const Arguments& arguments) {
  Running running(path, arguments);
  EXPECT_EQ(running.end(), 0);
  return running.peak();
}

}  // namespace program
