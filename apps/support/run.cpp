#include "support/run.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include <fmt/core.h>

#include "support/error.hpp"
#include "support/output.hpp"
#include "support/text.hpp"

namespace sigmax::apps {
namespace {

constexpr int exit_signal = 128;

const char* program = "";

// Made before a signal can come: a handler may not allocate.
std::array<char, 200> interrupted{};
std::size_t interrupted_size = 0;

extern "C" void end_interrupted(int signal) {
  remove_unfinished_files();
  if (signal != SIGPIPE && ::write(STDERR_FILENO, interrupted.data(), interrupted_size) < 0) {
    // Nobody is left to be told.
  }
  ::_exit(exit_signal + signal);
}

void handle_signals(const char* name) {
  const char* const wipe = ::isatty(STDERR_FILENO) != 0 ? "\r\x1B[K" : "";  // a progress bar
  const std::string text = fmt::format("{}{}: interrupted; unfinished output was removed\n", wipe, name);
  interrupted_size = std::min(text.size(), interrupted.size());
  std::copy_n(text.begin(), interrupted_size, interrupted.begin());

  struct sigaction action = {};
  action.sa_handler = end_interrupted;
  ::sigfillset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    struct sigaction before = {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

/// Throws InputError unless all that was printed has left.
void flush_output() {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  const int error_number = errno;
  if (flushed && std::ferror(stdout) == 0) return;
  throw InputError(message({.where = "standard output",
                            .what = "cannot be written: " + reason(error_number != 0 ? error_number : EIO),
                            .remedy = "make room there, or choose another place"}));
}

}  // namespace

void complain(std::string_view text) {
  const bool terminal = ::isatty(STDERR_FILENO) != 0;
  std::fputs(wrapped(text, terminal ? terminal_width : any_width).c_str(), stderr);  // print would throw without one
}

int exit_code(const std::exception& error) {
  return dynamic_cast<const UsageError*>(&error) != nullptr ? exit_usage : exit_input;
}

void complain(const std::exception& error) { complain(fmt::format("{}: {}", program, error.what())); }

int run_program(const char* name, const std::function<void()>& work) {
  program = name;
  try {
    handle_signals(name);
    work();
    flush_output();
  } catch (const std::exception& error) {
    complain(error);
    return exit_code(error);
  }
  return 0;
}

}  // namespace sigmax::apps
