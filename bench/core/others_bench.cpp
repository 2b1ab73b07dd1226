#include <benchmark/benchmark.h>
#include <cblas.h>

#include <cstddef>
#include <vector>

#include "core/numbers.hpp"
#include "core/peak.hpp"

/// OpenBLAS, whose sum of products is the composition by Sigma; on one thread with OPENBLAS_NUM_THREADS=1.
namespace sigmax {
namespace {

void openblas(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const auto size = static_cast<int>(n);
  const std::vector<double> left = bench::numbers(n * n, 1), right = bench::numbers(n * n, 2);
  std::vector<double> result(n * n);
  bench::BesidePeak beside{state, bench::Operation::multiply_add};
  for (auto _ : state) {
    cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, size, size, size, 1.0, right.data(), size, left.data(), size,
                0.0, result.data(), size);
    benchmark::DoNotOptimize(result.data());
  }
  beside.report(static_cast<double>(n) * static_cast<double>(n) * static_cast<double>(n));
}
BENCHMARK(openblas)->RangeMultiplier(4)->Range(16, 1024)->Arg(2048);

}  // namespace
}  // namespace sigmax
