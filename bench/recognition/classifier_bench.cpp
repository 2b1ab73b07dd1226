#include <benchmark/benchmark.h>

#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/recognition/classifier.hpp>

namespace sigmax {
namespace {

constexpr std::size_t patterns = 1000, features = 50, values = 16;

/// 1,000 patterns × 50 features × 16 values, all of them possible.
template <Uncertainty Kind>
Classifier<Kind, Kind> large_classifier() {
  const Variable<Kind> pattern{"pattern", patterns};
  std::mt19937_64 generator(1);
  std::vector<Relation<Kind, Kind>> relations;
  for (std::size_t i = 0; i < features; ++i) {
    Table rows(patterns, values);
    for (std::size_t c = 0; c < patterns; ++c) {
      for (double& value : rows.row(c)) value = static_cast<double>(1 + generator() % 1000);
      condition<AlgebraOf<Kind>>(rows.row(c));
    }
    relations.push_back(
        {Variable<Kind>{"feature " + std::to_string(i), values}, pattern, std::move(rows), detail::ByLaw{}});
  }
  return {uninformative(pattern), relations};
}

/// Crisp reports, many enough that no cache learns them.
std::vector<std::vector<std::size_t>> reports() {
  std::mt19937_64 generator(2);
  std::vector<std::vector<std::size_t>> result(4096, std::vector<std::size_t>(features));
  for (auto& report : result)
    for (std::size_t& reading : report) reading = generator() % values;
  return result;
}

/// One crisp report on all features, each about another object: from the prior to the belief.
template <Uncertainty Kind>
void ClassifyCrisp(benchmark::State& state) {
  const auto classifier = large_classifier<Kind>();
  const auto all = reports();
  std::size_t k = 0;
  for (auto _ : state) {
    const auto belief = classifier.posterior(InOrder{all[k++ % all.size()]});
    benchmark::DoNotOptimize(belief.logs().data());
  }
  state.SetItemsProcessed(state.iterations());
}

/// One crisp report after the other about one object.
template <Uncertainty Kind>
void ObserveCrisp(benchmark::State& state) {
  const auto classifier = large_classifier<Kind>();
  Belief belief{classifier.prior()};
  const auto all = reports();
  std::size_t k = 0;
  for (auto _ : state) {
    classifier.observe(belief, InOrder{all[k++ % all.size()]});
    benchmark::DoNotOptimize(belief.logs().data());
  }
  state.SetItemsProcessed(state.iterations());
}

BENCHMARK(ClassifyCrisp<Random>)->Unit(benchmark::kMicrosecond);
BENCHMARK(ClassifyCrisp<Fuzzy>)->Unit(benchmark::kMicrosecond);
BENCHMARK(ObserveCrisp<Random>)->Unit(benchmark::kMicrosecond);
BENCHMARK(ObserveCrisp<Fuzzy>)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace sigmax
