#include "shell/parallel.hpp"

#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <thread>

namespace sigmax::apps {

int threads_or_all(int asked) {
  return asked > 0 ? asked : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

void in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex failing;
  std::map<std::size_t, std::exception_ptr> failures;
  const auto take = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        next = count;
        const std::lock_guard lock(failing);
        failures.emplace(i, std::current_exception());
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int t = 1; t < std::min(threads, static_cast<int>(std::min<std::size_t>(count, 4096))); ++t)
      workers.emplace_back(take);
    take();
  }
  if (!failures.empty()) std::rethrow_exception(failures.begin()->second);
}

}  // namespace sigmax::apps
