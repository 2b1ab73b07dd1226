#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <sigmax/core/chain.hpp>
#include <sigmax/core/forward_backward.hpp>
#include <sigmax/core/route.hpp>

#include "numbers.hpp"

namespace sigmax {
namespace {

using bench::numbers;
using bench::transition;

constexpr int links = 1000;  // an iteration

std::size_t size(const benchmark::State& state) { return static_cast<std::size_t>(state.range(0)); }

/// One item is one relation of the chain, with its evidence where there is any.
void count_links(benchmark::State& state) { state.SetItemsProcessed(state.iterations() * links); }

/// Relations of one kind with evidence at every step; the argument `subnormal` is how many of a hundred numbers are.
template <Uncertainty Kind>
void chain_with_evidence(benchmark::State& state) {
  const double chance = static_cast<double>(state.range(1)) / 100.0;
  const auto next = transition<Kind>(size(state), 1, chance);
  const Likelihood<Kind> report{next.to(), numbers(size(state), 2, chance)};
  for (auto _ : state) {
    Chain chain{uninformative(next.to())};
    for (int link = 0; link < links; ++link) chain = update(compose(next, std::move(chain)), report);
    benchmark::DoNotOptimize(chain.log_total());
  }
  count_links(state);
}

/// The same without evidence.
template <Uncertainty Kind>
void chain_without_evidence(benchmark::State& state) {
  const auto next = transition<Kind>(size(state), 1, static_cast<double>(state.range(1)) / 100.0);
  for (auto _ : state) {
    Chain chain{uninformative(next.to())};
    for (int link = 0; link < links; ++link) chain = compose(next, std::move(chain));
    benchmark::DoNotOptimize(chain.log_total());
  }
  count_links(state);
}

/// Relations whose kinds alternate, induced throughout.
void chain_of_alternating_kinds(benchmark::State& state) {
  const RandomVariable x{"x", size(state)};
  const FuzzyVariable y{"y", size(state)};
  const double chance = static_cast<double>(state.range(1)) / 100.0;
  const Relation<Fuzzy, Random> y_given_x{y, x, transition<Fuzzy>(size(state), 1, chance).rows(), detail::ByLaw{}};
  const Relation<Random, Fuzzy> x_given_y{x, y, transition<Random>(size(state), 2, chance).rows(), detail::ByLaw{}};
  for (auto _ : state) {
    Chain chain{uninformative(x)};
    for (int link = 0; link < links; link += 2) chain = compose(x_given_y, compose(y_given_x, std::move(chain)));
    benchmark::DoNotOptimize(chain.log_total());
  }
  count_links(state);
}

/// A chain that remembers its winners, and the route at its end.
template <Uncertainty Kind>
void routes(benchmark::State& state) {
  const auto next = transition<Kind>(size(state), 1);
  const Likelihood<Kind> report{next.to(), numbers(size(state), 2)};
  for (auto _ : state) {
    Routes all{uninformative(next.to())};
    for (int link = 0; link < links; ++link) all = update(compose(next, std::move(all)), report);
    benchmark::DoNotOptimize(best_route(all));
  }
  count_links(state);
}

/// The posteriors of all times.
template <Uncertainty Kind>
void chain_posteriors(benchmark::State& state) {
  const auto next = transition<Kind>(size(state), 1);
  const std::vector<Likelihood<Kind>> reports(links, Likelihood<Kind>{next.to(), numbers(size(state), 2)});
  const auto start = uninformative(next.to());
  for (auto _ : state) benchmark::DoNotOptimize(forward_backward(start, next, reports));
  count_links(state);
}

/// A table over neighbouring times, the later one fastest, as a library of factors keeps it: every operation makes a
/// new one.
struct PairTable {
  std::size_t n;
  std::vector<double> numbers;

  template <class A>
  std::vector<double> over_earlier() const {
    std::vector<double> result(n, A::zero());
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) result[j] = A::plus(result[j], numbers[i * n + j]);
    return normalized<A>(std::move(result));
  }
  template <class A>
  std::vector<double> over_later() const {
    std::vector<double> result(n, A::zero());
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) result[i] = A::plus(result[i], numbers[i * n + j]);
    return normalized<A>(std::move(result));
  }
  PairTable times_earlier(const std::vector<double>& factor) const {
    PairTable result = *this;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) result.numbers[i * n + j] *= factor[i];
    return result;
  }
  PairTable times_later(const std::vector<double>& factor) const {
    PairTable result = *this;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) result.numbers[i * n + j] *= factor[j];
    return result;
  }
  template <class A>
  static std::vector<double> normalized(std::vector<double> numbers) {
    condition<A>(std::span(numbers));
    return numbers;
  }
};

/// The same posteriors by propagation of tables: collected and distributed through the tables of neighbouring times.
template <Uncertainty Kind>
void table_propagation(benchmark::State& state) {
  using A = AlgebraOf<Kind>;
  const std::size_t n = size(state);
  const auto next = transition<Kind>(n, 1);
  const std::vector<double> report = numbers(n, 2);
  const PairTable relation{n, std::vector<double>(next.table().data(), next.table().data() + n * n)};
  for (auto _ : state) {
    std::vector<PairTable> tables;
    std::vector<std::vector<double>> messages, posteriors;
    std::vector<double> message = PairTable::normalized<A>(std::vector<double>(n, 1.0));
    for (int link = 0; link < links; ++link) {
      tables.push_back(relation.times_later(report).times_earlier(message));
      messages.push_back(message = tables.back().template over_earlier<A>());
    }
    posteriors.push_back(messages.back());
    for (std::size_t t = tables.size() - 1; t > 0; --t) {
      std::vector<double> told = tables[t].template over_later<A>();
      posteriors.push_back(told);
      for (std::size_t i = 0; i < n; ++i) told[i] = messages[t - 1][i] == 0.0 ? 0.0 : told[i] / messages[t - 1][i];
      tables[t - 1] = tables[t - 1].times_later(told);
    }
    posteriors.push_back(tables[0].template over_later<A>());
    benchmark::DoNotOptimize(posteriors.data());
  }
  count_links(state);
}

void sizes_and_subnormals(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"n", "subnormal"});
  for (const int n : {3, 10, 100})
    for (const int percent : {0, 50, 100}) benchmark->Args({n, percent});
}

BENCHMARK(chain_with_evidence<Random>)->Apply(sizes_and_subnormals);
BENCHMARK(chain_with_evidence<Fuzzy>)->Apply(sizes_and_subnormals);
BENCHMARK(chain_without_evidence<Random>)->Apply(sizes_and_subnormals);
BENCHMARK(chain_without_evidence<Fuzzy>)->Apply(sizes_and_subnormals);
BENCHMARK(chain_of_alternating_kinds)->Apply(sizes_and_subnormals);
BENCHMARK(chain_posteriors<Random>)->ArgName("n")->Arg(3)->Arg(16);
BENCHMARK(table_propagation<Random>)->ArgName("n")->Arg(3)->Arg(16);
BENCHMARK(chain_posteriors<Fuzzy>)->ArgName("n")->Arg(3)->Arg(16);
BENCHMARK(table_propagation<Fuzzy>)->ArgName("n")->Arg(3)->Arg(16);
BENCHMARK(routes<Fuzzy>)->Arg(3)->Arg(10)->Arg(100);
BENCHMARK(routes<Ordinal>)->Arg(3)->Arg(10)->Arg(100);

}  // namespace
}  // namespace sigmax
