#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
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

}  // namespace sigmax::apps
