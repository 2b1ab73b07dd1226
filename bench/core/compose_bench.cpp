#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <sigmax/core/kernels/dense.hpp>

namespace sigmax {
namespace {

/// A square table of numbers between zero and one, the same for the same seed.
Table numbers(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  Table table(n, n);
  for (double& value : table.values()) value = static_cast<double>(generator() >> 11) * 0x1p-53;
  return table;
}

std::vector<std::vector<double>> rows(const Table& table) {
  std::vector<std::vector<double>> result;
  for (std::size_t i = 0; i < table.rows(); ++i) result.emplace_back(table.row(i).begin(), table.row(i).end());
  return result;
}

/// One operation is an ⊗ and the ⊕ that takes its result.
void count_operations(benchmark::State& state) {
  const std::int64_t n = state.range(0);
  state.SetItemsProcessed(state.iterations() * n * n * n);
}

/// Composition of dense tables as the library does it.
template <Algebra A>
void compose(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const Table left = numbers(n, 1), right = numbers(n, 2);
  Table result(n, n);
  for (auto _ : state) {
    kernels::compose<A>(left, right, result);
    benchmark::DoNotOptimize(result.data());
    benchmark::ClobberMemory();
  }
  count_operations(state);
}

struct Add {
  double operator()(double a, double b) const { return a + b; }
};
struct Greater {
  double operator()(double a, double b) const { return a < b ? b : a; }
};

/// The same by the definition: one result after the other, in a plain triple loop over rows of rows.
template <class Plus>
void triple_loop(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const auto left = rows(numbers(n, 1)), right = rows(numbers(n, 2));
  auto result = left;
  for (auto _ : state) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        double sum = 0.0;
        for (std::size_t j = 0; j < n; ++j) sum = Plus{}(sum, right[i][j] * left[j][k]);
        result[i][k] = sum;
      }
    benchmark::DoNotOptimize(result.data());
    benchmark::ClobberMemory();
  }
  count_operations(state);
}

constexpr std::int64_t smallest = 2, greatest = 2048;
constexpr std::int64_t greatest_of_loops = 512;  // beyond, they take minutes

BENCHMARK(compose<Sigma>)->RangeMultiplier(4)->Range(smallest, greatest);
BENCHMARK(triple_loop<Add>)->RangeMultiplier(4)->Range(smallest, greatest_of_loops);
BENCHMARK(compose<Max>)->RangeMultiplier(4)->Range(smallest, greatest);
BENCHMARK(triple_loop<Greater>)->RangeMultiplier(4)->Range(smallest, greatest_of_loops);

}  // namespace
}  // namespace sigmax
