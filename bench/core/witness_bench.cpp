#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>

#include <sigmax/core/witness.hpp>

#include "numbers.hpp"

namespace sigmax {
namespace {

/// One operation is an ⊗ and the ⊕ that takes its result.
void count_operations(benchmark::State& state) {
  const std::int64_t n = state.range(0);
  state.SetItemsProcessed(state.iterations() * n * n * n);
}

/// Composition of dense relations that says which intermediate value won.
template <Uncertainty Kind>
void witness(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const auto left = bench::transition<Kind>(n, 1), right = bench::transition<Kind>(n, 2);
  for (auto _ : state) benchmark::DoNotOptimize(compose_with_witness(left, right));
  count_operations(state);
}

/// The same without a witness.
template <Uncertainty Kind>
void composition(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const auto left = bench::transition<Kind>(n, 1), right = bench::transition<Kind>(n, 2);
  for (auto _ : state) benchmark::DoNotOptimize(compose(left, right));
  count_operations(state);
}

BENCHMARK(witness<Fuzzy>)->RangeMultiplier(4)->Range(2, 2048);
BENCHMARK(witness<Ordinal>)->RangeMultiplier(4)->Range(2, 2048);
BENCHMARK(composition<Fuzzy>)->RangeMultiplier(4)->Range(2, 2048);
BENCHMARK(composition<Ordinal>)->RangeMultiplier(4)->Range(2, 2048);

}  // namespace
}  // namespace sigmax
