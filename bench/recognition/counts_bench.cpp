#include <benchmark/benchmark.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <sigmax/recognition/counts.hpp>

namespace sigmax {
namespace {

constexpr std::size_t features = 10, values = 16, patterns = 20;

/// Learning p(f|c) of ten features from a million rows, one in ten values missing. Nothing of the rows is kept, so each
/// is drawn as it is wanted; `Draw` is that alone.
template <bool Learn>
void MillionRows(benchmark::State& state) {
  std::vector<RandomVariable> variables;
  for (std::size_t i = 0; i < features; ++i) variables.emplace_back("feature " + std::to_string(i), values);
  for (auto _ : state) {
    Counts counts{RandomVariable{"pattern", patterns}, variables};
    std::mt19937_64 generator(1);
    std::array<std::size_t, features> row{};
    for (std::size_t k = 0; k < 1000000; ++k) {
      for (std::size_t& value : row) {
        const std::uint64_t draw = generator();
        value = draw % 10 == 0 ? missing : (draw >> 32) % values;
      }
      benchmark::DoNotOptimize(row);
      if constexpr (Learn) counts.observe(k % patterns, row);
    }
    if constexpr (Learn) benchmark::DoNotOptimize(learned_relations(counts, 1.0));
  }
}

void Learn(benchmark::State& state) { MillionRows<true>(state); }
void Draw(benchmark::State& state) { MillionRows<false>(state); }

BENCHMARK(Learn)->Unit(benchmark::kMillisecond);
BENCHMARK(Draw)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sigmax
