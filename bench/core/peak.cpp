// What the machine can do at best, by every instruction set that the kernels are compiled for.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/peak.cpp"
#include "kernels/targets.hpp"

#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "core/peak.hpp"

HWY_BEFORE_NAMESPACE();
namespace sigmax::bench::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
constexpr hn::ScalableTag<double> all;
using Vector = hn::Vec<hn::ScalableTag<double>>;

// As many at a time as hide how long one takes, and fit into the registers.
constexpr std::size_t chains = HWY_TARGET == HWY_AVX3 ? 16 : 12;
constexpr std::size_t rounds = 5000;

/// Operations a second, each on the result of the one before it in its chain.
template <class Operate>
double operations(const Operate& operate) {
  Vector results[chains];
  for (std::size_t c = 0; c < chains; ++c) results[c] = hn::Set(all, 1.0 + static_cast<double>(c));
  const double start = thread_time();
  for (std::size_t r = 0; r < rounds; ++r)
#pragma GCC unroll 16
    for (std::size_t c = 0; c < chains; ++c) results[c] = operate(results[c]);
  const double seconds = thread_time() - start;
  for (std::size_t c = 1; c < chains; ++c) results[0] = hn::Add(results[0], results[c]);
  double sum = hn::GetLane(hn::SumOfLanes(all, results[0]));
  benchmark::DoNotOptimize(sum);
  return static_cast<double>(rounds * chains * hn::Lanes(all)) / seconds;
}

double peak_of(Operation operation) {
  double nearly_one = 0.999;
  benchmark::DoNotOptimize(nearly_one);
  const Vector a = hn::Set(all, nearly_one), b = hn::Set(all, 1.0 - nearly_one);
  switch (operation) {
    case Operation::multiply_add:
      return operations([=](Vector x) HWY_ATTR { return hn::MulAdd(x, a, b); });
    case Operation::multiply_max:
      return operations([=](Vector x) HWY_ATTR { return hn::Max(hn::Mul(x, a), b); });
    case Operation::min_max:
      return operations([=](Vector x) HWY_ATTR { return hn::Max(hn::Min(x, a), b); });
  }
  return 0.0;
}

double bytes_read(const double* numbers, std::size_t size, std::size_t times) {
  Vector sums[8];
  for (Vector& sum : sums) sum = hn::Zero(all);
  const std::size_t step = 8 * hn::Lanes(all);
  const double start = thread_time();
  for (std::size_t t = 0; t < times; ++t)
    for (std::size_t i = 0; i + step <= size; i += step)
      for (std::size_t s = 0; s < 8; ++s) sums[s] = hn::Max(sums[s], hn::LoadU(all, numbers + i + s * hn::Lanes(all)));
  const double seconds = thread_time() - start;
  for (std::size_t s = 1; s < 8; ++s) sums[0] = hn::Add(sums[0], sums[s]);
  double sum = hn::GetLane(hn::SumOfLanes(all, sums[0]));
  benchmark::DoNotOptimize(sum);
  return static_cast<double>(times * (size / step * step) * sizeof(double)) / seconds;
}

double bytes_moved(double* a, const double* b, const double* c, std::size_t size, std::size_t times) {
  const std::size_t step = hn::Lanes(all);
  const double start = thread_time();
  for (std::size_t t = 0; t < times; ++t) {
    for (std::size_t i = 0; i + step <= size; i += step)
      hn::StoreU(hn::Mul(hn::LoadU(all, b + i), hn::LoadU(all, c + i)), all, a + i);
    benchmark::ClobberMemory();
  }
  return static_cast<double>(times * (size / step * step) * 3 * sizeof(double)) / (thread_time() - start);
}

}  // namespace
}  // namespace sigmax::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sigmax::bench {
namespace {

HWY_EXPORT(peak_of);
HWY_EXPORT(bytes_read);
HWY_EXPORT(bytes_moved);

void peaks(benchmark::State& state, std::int64_t set, Operation operation) {
  hwy::SetSupportedTargetsForTest(set);
  double best = 0.0;
  for (auto _ : state) best = std::max(best, peak(operation));
  hwy::SetSupportedTargetsForTest(0);
  state.counters["operations"] = benchmark::Counter(best, benchmark::Counter::kDefaults);
}

void reading(benchmark::State& state) {
  double best = 0.0;
  for (auto _ : state) best = std::max(best, read_bandwidth(static_cast<std::size_t>(state.range(0))));
  state.counters["bytes"] = benchmark::Counter(best, benchmark::Counter::kDefaults, benchmark::Counter::kIs1024);
}
void moving(benchmark::State& state) {
  double best = 0.0;
  for (auto _ : state) best = std::max(best, triad_bandwidth(static_cast<std::size_t>(state.range(0))));
  state.counters["bytes"] = benchmark::Counter(best, benchmark::Counter::kDefaults, benchmark::Counter::kIs1024);
}
BENCHMARK(moving)->Name("peak/triad")->Arg(1 << 14)->Arg(1 << 18)->Arg(1 << 22)->Arg(1 << 27);
BENCHMARK(reading)->Name("peak/read")->Arg(1 << 14)->Arg(1 << 18)->Arg(1 << 22)->Arg(1 << 27);

const bool registered = [] {
  const std::pair<const char*, Operation> operations[] = {{"multiply_add", Operation::multiply_add},
                                                          {"multiply_max", Operation::multiply_max},
                                                          {"min_max", Operation::min_max}};
  for (const std::int64_t set : hwy::SupportedAndGeneratedTargets())
    for (const auto& [name, operation] : operations)
      benchmark::RegisterBenchmark((std::string("peak/") + hwy::TargetName(set) + "/" + name).c_str(), peaks, set,
                                   operation);
  return true;
}();

}  // namespace

double peak(Operation operation) {  // the best of a few, for a machine does other things as well
  double best = 0.0;
  for (int i = 0; i < 5; ++i) best = std::max(best, HWY_DYNAMIC_DISPATCH(peak_of)(operation));
  return best;
}

double read_bandwidth(std::size_t bytes) {
  const std::vector<double> numbers(bytes / sizeof(double), 1.0);
  const std::size_t times = std::max<std::size_t>(1, (std::size_t{1} << 24) / bytes);
  HWY_DYNAMIC_DISPATCH(bytes_read)(numbers.data(), numbers.size(), 1);
  return HWY_DYNAMIC_DISPATCH(bytes_read)(numbers.data(), numbers.size(), times);
}

double triad_bandwidth(std::size_t bytes) {
  const std::size_t size = bytes / (3 * sizeof(double));
  const std::vector<double> b(size, 1.0), c(size, 0.5);
  std::vector<double> a(size);
  const std::size_t times = std::max<std::size_t>(1, (std::size_t{1} << 24) / std::max<std::size_t>(1, bytes));
  double best = 0.0;
  for (int i = 0; i < 5; ++i)
    best = std::max(best, HWY_DYNAMIC_DISPATCH(bytes_moved)(a.data(), b.data(), c.data(), size, times));
  return best;
}

}  // namespace sigmax::bench
#endif
