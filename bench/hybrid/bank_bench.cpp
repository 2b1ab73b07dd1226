/// Many tracks of the paper's two models in a FilterBank, by the track-step; few, which stay in the cache, and a
/// million, beside what the memory gives: every number of a track is read and written once a call, every number of a
/// scan read.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <type_traits>
#include <vector>

#include <benchmark/benchmark.h>

#include <sigmax/hybrid/filter_bank.hpp>

#include "hybrid/paper_step.hpp"

namespace {

using namespace sigmax;
using namespace sigmax::bench;

constexpr std::size_t many = 100'000;
constexpr double numbers_of_track = (6 + 21) + (9 + 45) + 3, numbers_of_scan = 13;

/// Bytes a second that one core reads, changes and writes again where they were; far more than a cache holds.
double bandwidth() {
  static std::vector<double> numbers(std::size_t{1} << 26, 1.0);
  const auto before = std::chrono::steady_clock::now();
  for (double& number : numbers) number *= 0.999;
  benchmark::DoNotOptimize(numbers.data());
  benchmark::ClobberMemory();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - before;
  return 2.0 * static_cast<double>(numbers.size() * sizeof(double)) / seconds.count();
}

/// N tracks, so many steps of them in each call. What a sensor delivers is there before. Few tracks begin again where
/// the measurements do; many are measured at one place.
template <Uncertainty Kind, class Number>
void BankStep(benchmark::State& state) {
  const auto tracks = static_cast<std::size_t>(state.range(0)), steps = static_cast<std::size_t>(state.range(1));
  const std::tuple models{dwna<3>(sigma_w), dwpa<3>(sigma_w)};
  FilterBank<std::remove_const_t<decltype(models)>, Kind, Number> bank{models, transition<Kind>()};
  const auto begin = [&] {
    for (std::size_t t = 0; t < bank.capacity(); ++t)
      if (bank.lives(t)) bank.remove(t);
    for (std::size_t t = 0; t < tracks; ++t) bank.add(start());
  };
  begin();
  const auto measured = measurements();
  std::vector<typename decltype(bank)::Scan> scans;
  for (std::size_t k = 0; k < (tracks < many ? 64 : steps); ++k) {
    scans.push_back(bank.scan());
    for (std::size_t t = 0; t < tracks; ++t) scans.back().set(t, measured[tracks < many ? k : 0]);
  }
  double fastest = tracks < many ? 0.0 : std::max(bandwidth(), bandwidth());
  const auto before = std::chrono::steady_clock::now();
  std::size_t k = 0;
  for (auto _ : state) {
    bank.run(T, std::span(scans).subspan(k, steps));
    k += steps;
    if (k < scans.size()) continue;
    k = 0;
    if (tracks >= many) continue;
    state.PauseTiming();
    begin();
    state.ResumeTiming();
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - before;
  const double calls = static_cast<double>(state.iterations()), n = static_cast<double>(tracks);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(tracks * steps));
  if (tracks < many) return;
  fastest = std::max(fastest, bandwidth());
  const double bytes = sizeof(Number) * n * (2.0 * numbers_of_track + static_cast<double>(steps) * numbers_of_scan);
  state.counters["of_bandwidth"] = calls * bytes / seconds.count() / fastest;
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"tracks", "steps"})
      ->Args({1024, 1})
      ->Args({1024, 8})
      ->Args({1'000'000, 1})
      ->Args({1'000'000, 8});
}
BENCHMARK(BankStep<Random, double>)->Name("ImmBankStep")->Apply(sizes);
BENCHMARK(BankStep<Fuzzy, double>)->Name("HimmBankStep")->Apply(sizes);
BENCHMARK(BankStep<Random, float>)->Name("ImmBankStepOfFloats")->Apply(sizes);
BENCHMARK(BankStep<Fuzzy, float>)->Name("HimmBankStepOfFloats")->Apply(sizes);

}  // namespace
