#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <sigmax/core/compose.hpp>
#include <sigmax/core/update.hpp>

namespace sigmax {
namespace {

constexpr std::size_t entries = 10;  // a row

/// Ten equal numbers a row in columns drawn at random, the same for the same seed.
template <Uncertainty Kind>
Relation<Kind, Kind> sparse(std::size_t n, std::uint64_t seed) {
  const Variable<Kind> x{"x", n};
  std::mt19937_64 generator(seed);
  SparseRows rows(n);
  std::vector<std::size_t> columns(entries);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t& column : columns) column = generator() % n;
    std::sort(columns.begin(), columns.end());
    const auto end = std::unique(columns.begin(), columns.end());
    const auto share = equal_share<AlgebraOf<Kind>>(static_cast<std::size_t>(end - columns.begin()));
    for (auto column = columns.begin(); column != end; ++column) rows.append_entry(*column, share);
    rows.end_row();
  }
  return {x, x, std::move(rows)};
}

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
  const auto left = sparse<Kind>(size(state), 1), right = sparse<Kind>(size(state), 2);
  for (auto _ : state) benchmark::DoNotOptimize(compose(left, right));
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
  const auto relation = sparse<Kind>(size(state), 1);
  const auto prior = uninformative(relation.from());
  for (auto _ : state) benchmark::DoNotOptimize(compose(relation, prior));
  count_operations(state, 1);
}

template <Uncertainty Kind>
void invert_sparse(benchmark::State& state) {
  const auto relation = sparse<Kind>(size(state), 1);
  const auto prior = uninformative(relation.from());
  for (auto _ : state) benchmark::DoNotOptimize(invert(relation, prior));
  count_operations(state, 1);
}

BENCHMARK(compose_sparse<Random>)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK(compose_sparse<Fuzzy>)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK(compose_banded<Random>)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK(compose_banded<Fuzzy>)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK(compose_with_distribution<Random>)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(compose_with_distribution<Fuzzy>)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(invert_sparse<Random>)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(invert_sparse<Fuzzy>)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sigmax
