#pragma once

#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace sigmax::apps {

/// The columns of the terminal that a descriptor is; `terminal_width` if it is none.
std::size_t columns_of(int terminal);

/// A bar on a terminal that shows how much of the work is done, drawn at most ten times a second; its line is wiped at
/// the end. Silent when asked, and where the output is no terminal.
class Progress {
 public:
  Progress(std::string_view label, std::uint64_t total, bool quiet, int terminal = STDERR_FILENO);

  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { finish(); }

  /// Adds to the work done; any thread may call it.
  void advance(std::uint64_t work = 1);

  /// Says what is being done from now on, in place of the label; any thread may call it.
  void tell(std::string_view label);

  /// Wipes the line; nothing is drawn afterwards.
  void finish();

  std::uint64_t done() const { return done_; }

  /// One line of at most `width` columns: "runs [#####.....]  50 %, 7 s left".
  static std::string line(std::string_view label, std::uint64_t done, std::uint64_t total,
                          std::chrono::duration<double> elapsed, std::size_t width);

 private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  const std::uint64_t total_;
  const int terminal_;
  const bool silent_;
  const Clock::time_point start_ = Clock::now();
  std::mutex advancing_;
  std::uint64_t done_ = 0;
  Clock::time_point next_;  // time to draw
  std::size_t shown_ = 0;
  bool finished_ = false;
};

}  // namespace sigmax::apps
