#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ctime>

namespace sigmax::bench {

/// What a composition repeats; one operation is an ⊗ with the ⊕ that takes its result.
enum class Operation { multiply_add, multiply_max, min_max };

/// Operations a second of one core that has nothing to load or store, by the instruction set that the kernels choose;
/// zero without Highway. It takes about a millisecond.
double peak(Operation operation);

/// Bytes a second that one core reads, again and again from the same memory of this size.
double read_bandwidth(std::size_t bytes);

/// Bytes a second that one core moves by a(k) = b(k) · c(k), again and again through arrays that are of this size
/// together; zero without Highway.
double triad_bandwidth(std::size_t bytes);

/// Processor time of this thread in seconds.
inline double thread_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Reports a benchmark's operations a second, and beside it which fraction that is of the peak before and after it.
///
///     BesidePeak beside{state, Operation::multiply_max};
///     for (auto _ : state) …;
///     beside.report(operations_of_an_iteration);
class BesidePeak {
 public:
  BesidePeak(benchmark::State& state, Operation operation)
      : state_(state), operation_(operation), before_(peak(operation)), start_(thread_time()) {}

  void report(double operations) {
    const double seconds = thread_time() - start_, total = operations * static_cast<double>(state_.iterations());
    state_.SetItemsProcessed(static_cast<std::int64_t>(total));
    const double best = std::max(before_, peak(operation_));
    if (best > 0.0) state_.counters["of_peak"] = total / seconds / best;
  }

 private:
  benchmark::State& state_;
  Operation operation_;
  double before_, start_;
};

/// The same for what only loads and stores: beside its items a second which fraction its bytes, each counted once, are
/// of the bandwidth.
class BesideBandwidth {
 public:
  BesideBandwidth(benchmark::State& state, std::size_t bytes)
      : state_(state), bytes_(bytes), before_(triad_bandwidth(bytes)), start_(thread_time()) {}

  void report(std::int64_t items) {
    const double seconds = thread_time() - start_;
    state_.SetItemsProcessed(state_.iterations() * items);
    const double best = std::max(before_, triad_bandwidth(bytes_));
    const double total = static_cast<double>(bytes_) * static_cast<double>(state_.iterations());
    if (best > 0.0) state_.counters["of_bandwidth"] = total / seconds / best;
  }

 private:
  benchmark::State& state_;
  std::size_t bytes_;
  double before_, start_;
};

}  // namespace sigmax::bench
