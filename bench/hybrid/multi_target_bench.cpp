/// Scans of many targets with two models in a plane, by the four associations and both kinds of mode: 1,000 targets
/// and 600 false detections a scan. docs/benchmarks.md says what they cost.

#include <array>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include <sigmax/hybrid/multi_target_tracker.hpp>

namespace {

using namespace sigmax;

constexpr std::size_t targets = 1000, false_detections = 600, scans = 30, first = 10;
constexpr double side = 100e3, sigma = 20.0;

std::vector<std::vector<AnyDetection>> drawn_scans() {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal;
  std::vector<std::array<double, 4>> states(targets);
  for (auto& [x, y, vx, vy] : states) {
    x = side * uniform(generator), y = side * uniform(generator);
    vx = 100.0 * normal(generator), vy = 100.0 * normal(generator);
  }
  std::vector<std::vector<AnyDetection>> result(scans);
  for (std::size_t k = 0; k < scans; ++k) {
    const auto see = [&](double x, double y) {
      result[k].push_back(
          AnyDetection::position(static_cast<double>(k), std::array{x, y}, std::array{sigma * sigma, sigma * sigma}));
    };
    for (auto& [x, y, vx, vy] : states) {
      if (uniform(generator) < 0.9) see(x + sigma * normal(generator), y + sigma * normal(generator));
      x += vx, y += vy;
    }
    for (std::size_t c = 0; c < false_detections; ++c) see(side * uniform(generator), side * uniform(generator));
  }
  return result;
}

/// One item is a scan, from the tenth on, when tracks are confirmed.
void MultiTargetScan(benchmark::State& state) {
  const bool fuzzy = state.range(2) != 0;
  const double other = fuzzy ? 0.5 : 0.05, own = fuzzy ? 1.0 : 0.95;
  TargetChoice choice;
  choice.axes = 2;
  choice.fuzzy = fuzzy;
  choice.motions = {{"dwna"}, {"dwpa"}};
  choice.models = {"dwna", "dwpa"};
  choice.transition = {{own, other}, {other, own}};
  const auto all = drawn_scans();
  MultiTargetTracker start{choice, {state.range(0) != 0, state.range(1) != 0}};
  for (std::size_t k = 0; k < first; ++k) start.scan(all[k]);
  for (auto _ : state) {
    MultiTargetTracker tracker = start;
    for (std::size_t k = first; k < scans; ++k) tracker.scan(all[k]);
    benchmark::DoNotOptimize(tracker.time());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scans - first));
}
BENCHMARK(MultiTargetScan)->ArgsProduct({{0, 1}, {0, 1}, {0, 1}})->ArgNames({"pattern", "permutation", "mode"});

}  // namespace
