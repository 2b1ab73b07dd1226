#include <benchmark/benchmark.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <sigmax/core/kernels/compose.hpp>

#include "core/peak.hpp"
#include "kernels/plain.hpp"

namespace sigmax {
namespace {

using bench::BesidePeak;
using bench::Operation;

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

/// The operations of a composition of n × n.
double operations(const benchmark::State& state) {
  const auto n = static_cast<double>(state.range(0));
  return n * n * n;
}
template <Algebra A>
constexpr Operation operation_of = std::same_as<A, Sigma> ? Operation::multiply_add : Operation::multiply_max;

/// Composition of dense tables as the library does it.
template <Algebra A>
void compose(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const Table left = numbers(n, 1), right = numbers(n, 2);
  Table result(n, n);
  BesidePeak beside{state, operation_of<A>};
  for (auto _ : state) {
    kernels::compose<A>(left, right, result);
    benchmark::DoNotOptimize(result.data());
    benchmark::ClobberMemory();
  }
  beside.report(operations(state));
}

/// The plain loops over tables that the kernels replace.
void plain_loops(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const Table left = numbers(n, 1), right = numbers(n, 2);
  Table result(n, n);
  BesidePeak beside{state, Operation::multiply_max};
  for (auto _ : state) {
    kernels::compose_plainly(Max{}, left, right, result);
    benchmark::DoNotOptimize(result.data());
    benchmark::ClobberMemory();
  }
  beside.report(operations(state));
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
  state.SetItemsProcessed(state.iterations() * state.range(0) * state.range(0) * state.range(0));
}

constexpr std::int64_t smallest = 2;
constexpr std::int64_t greatest_of_loops = 512;  // beyond, they take minutes

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const std::int64_t n : {2, 4, 8, 16, 33, 64, 65, 128, 256, 257, 512, 1024, 2048}) benchmark->Arg(n);
}

BENCHMARK(compose<Sigma>)->Apply(sizes);
BENCHMARK(compose<Max>)->Apply(sizes);
BENCHMARK(plain_loops)->RangeMultiplier(4)->Range(smallest, greatest_of_loops);
BENCHMARK(triple_loop<Add>)->RangeMultiplier(4)->Range(smallest, greatest_of_loops);
BENCHMARK(triple_loop<Greater>)->RangeMultiplier(4)->Range(smallest, greatest_of_loops);

}  // namespace
}  // namespace sigmax
