#pragma once

#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sigmax::apps {

/// As many threads as the machine has, unless a number was asked for.
int threads_or_all(int asked);

/// Calls work(i) for i = 0 … count − 1, which begin in this order, by any thread. Rethrows the failure of the least i;
/// of what comes after it not all was done then.
void in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

/// Calls add(run, work(run)) for run = 0 … runs − 1. Any thread does the work, this thread adds in the order of the
/// runs, so that sums do not depend on the number of threads. At most `block` results are held. Rethrows the failure
/// of the earliest run; the runs before its block have been added then.
template <class Work, class Add>
void for_each_run(std::size_t runs, int threads, const Work& work, const Add& add, std::size_t block = 256) {
  for (std::size_t first = 0; first < runs; first += block) {
    std::vector<std::optional<decltype(work(first))>> results(std::min(block, runs - first));
    in_parallel(results.size(), threads, [&](std::size_t i) { results[i].emplace(work(first + i)); });
    for (std::size_t i = 0; i < results.size(); ++i) add(first + i, *std::move(results[i]));
  }
}

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

  /// Wipes the line; nothing is drawn afterwards.
  void finish();

  std::uint64_t done() const { return done_; }

  /// One line of at most `width` columns: "runs [#####.....]  50 %, 7 s left".
  static std::string line(std::string_view label, std::uint64_t done, std::uint64_t total,
                          std::chrono::duration<double> elapsed, std::size_t width);

 private:
  using Clock = std::chrono::steady_clock;

  const std::string label_;
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
