#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace sigmax::apps {

/// As many threads as the machine has, unless a number was asked for.
inline int threads_or_all(int asked) {
  return asked > 0 ? asked : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// Calls add(run, work(run)) for run = 0 … runs − 1. Any thread does the work, this thread adds in the order of the
/// runs, so that sums do not depend on the number of threads. At most `block` results are held. Rethrows the failure
/// of the earliest run; the runs before its block have been added then.
template <class Work, class Add>
void for_each_run(std::size_t runs, int threads, const Work& work, const Add& add, std::size_t block = 256) {
  using Result = decltype(work(std::size_t{0}));
  for (std::size_t first = 0; first < runs; first += block) {
    const std::size_t count = std::min(block, runs - first);
    std::vector<std::optional<Result>> results(count);
    std::vector<std::exception_ptr> failures(count);
    std::atomic<std::size_t> next = 0;
    const auto take = [&] {
      for (std::size_t i = next++; i < count; i = next++) {
        try {
          results[i].emplace(work(first + i));
        } catch (...) {
          failures[i] = std::current_exception();
        }
      }
    };
    {
      std::vector<std::jthread> workers;
      for (int t = 1; t < std::min(threads, static_cast<int>(count)); ++t) workers.emplace_back(take);
      take();
    }
    for (const auto& failure : failures)
      if (failure) std::rethrow_exception(failure);
    for (std::size_t i = 0; i < count; ++i) add(first + i, *std::move(results[i]));
  }
}

}  // namespace sigmax::apps
