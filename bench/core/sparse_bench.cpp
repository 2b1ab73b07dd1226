#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <sigmax/core/compose.hpp>
#include <sigmax/core/update.hpp>

#include "numbers.hpp"

namespace sigmax {
namespace {

constexpr std::size_t entries = bench::entries_of_a_row;

/// Ten equal numbers a row around the diagonal.
template <Uncertainty Kind>
Relation<Kind, Kind> banded(std::size_t n) {
  const Variable<Kind> x{"x", n};
  BandedRows rows(n);
  for (std::size_t i = 0; i < n; ++i)
    rows.append(std::min(i < entries / 2 ? 0 : i - entries / 2, n - entries), entries,
                equal_share<AlgebraOf<Kind>>(entries));
  return {x, x, std::move(rows)};
}

std::size_t size(const benchmark::State& state) { return static_cast<std::size_t>(state.range(0)); }

/// One operation is an ⊗ and the ⊕ that takes its result.
void count_operations(benchmark::State& state, std::size_t factor) {
  state.SetItemsProcessed(state.iterations() * state.range(0) * static_cast<std::int64_t>(entries * factor));
}

template <Uncertainty Kind>
void compose_sparse(benchmark::State& state) {
  const auto left = bench::sparse_transition<Kind>(size(state), 1),
             right = bench::sparse_transition<Kind>(size(state), 2);
  for (auto _ : state) benchmark::DoNotOptimize(compose(left, right));
  count_operations(state, entries);
}

/// The same into the memory of a former result.
template <Uncertainty Kind>
void compose_sparse_again(benchmark::State& state) {
  const auto left = bench::sparse_transition<Kind>(size(state), 1),
             right = bench::sparse_transition<Kind>(size(state), 2);
  auto result = compose(left, right);
  for (auto _ : state) {
    compose(left, right, result);
    benchmark::ClobberMemory();
  }
  count_operations(state, entries);
}

template <Uncertainty Kind>
void compose_banded(benchmark::State& state) {
  const auto left = banded<Kind>(size(state)), right = banded<Kind>(size(state));
  for (auto _ : state) benchmark::DoNotOptimize(compose(left, right));
  count_operations(state, entries);
}

template <Uncertainty Kind>
void compose_with_distribution(benchmark::State& state) {
  const auto relation = bench::sparse_transition<Kind>(size(state), 1);
  const auto prior = uninformative(relation.from());
  for (auto _ : state) benchmark::DoNotOptimize(compose(relation, prior));
  count_operations(state, 1);
}

template <Uncertainty Kind>
void invert_sparse(benchmark::State& state) {
  const auto relation = bench::sparse_transition<Kind>(size(state), 1);
  const auto prior = uninformative(relation.from());
  for (auto _ : state) benchmark::DoNotOptimize(invert(relation, prior));
  count_operations(state, 1);
}

BENCHMARK(compose_sparse<Random>)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK(compose_sparse<Fuzzy>)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK(compose_sparse_again<Random>)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK(compose_sparse_again<Fuzzy>)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK(compose_banded<Random>)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK(compose_banded<Fuzzy>)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK(compose_with_distribution<Random>)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(compose_with_distribution<Fuzzy>)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(invert_sparse<Random>)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(invert_sparse<Fuzzy>)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sigmax
