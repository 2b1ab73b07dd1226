#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>

#include <sigmax/core/update.hpp>

#include "core/numbers.hpp"
#include "core/peak.hpp"

namespace sigmax {
namespace {

std::size_t size(const benchmark::State& state) { return static_cast<std::size_t>(state.range(0)); }

/// One item is one outcome.
template <Uncertainty Kind>
void update_distribution(benchmark::State& state) {
  const Variable<Kind> x{"x", size(state)};
  const auto prior = normalized(x, std::span<const double>(bench::numbers(x.size(), 1)));
  const Likelihood<Kind> likelihood{x, bench::numbers(x.size(), 2)};
  using Number = decltype(likelihood.number(0));
  bench::BesideBandwidth beside{state, x.size() * (2 * sizeof(double) + sizeof(Number))};  // prior, result; likelihood
  for (auto _ : state) benchmark::DoNotOptimize(update(prior, likelihood));
  beside.report(state.range(0));
}

template <Uncertainty Kind>
void update_belief(benchmark::State& state) {
  const Variable<Kind> x{"x", size(state)};
  const Belief<Kind> prior{normalized(x, std::span<const double>(bench::numbers(x.size(), 1)))};
  const Likelihood<Kind> likelihood{x, bench::numbers(x.size(), 2)};
  Belief<Kind> posterior = prior;
  bench::BesideBandwidth beside{state, x.size() * 3 * sizeof(double)};
  for (auto _ : state) benchmark::DoNotOptimize(update(prior, likelihood, posterior));
  beside.report(state.range(0));
}

BENCHMARK(update_distribution<Random>)->RangeMultiplier(8)->Range(2, 1 << 16);
BENCHMARK(update_distribution<Fuzzy>)->RangeMultiplier(8)->Range(2, 1 << 16);
BENCHMARK(update_distribution<Ordinal>)->RangeMultiplier(8)->Range(2, 1 << 16);
BENCHMARK(update_belief<Random>)->RangeMultiplier(8)->Range(2, 1 << 16);
BENCHMARK(update_belief<Fuzzy>)->RangeMultiplier(8)->Range(2, 1 << 16);

}  // namespace
}  // namespace sigmax
