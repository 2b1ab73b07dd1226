#include <benchmark/benchmark.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <sigmax/core/network/bif.hpp>
#include <sigmax/core/network/explanation.hpp>
#include <sigmax/core/network/query.hpp>
#include <sigmax/core/network/transform.hpp>

/// Queries a second on published networks, found in the folder of recorded data that the environment variable
/// SIGMAX_DATA names; and on a generated one.
namespace sigmax {
namespace {

std::string path_of(const std::string& name) {
  const char* const folder = std::getenv("SIGMAX_DATA");
  return std::string(folder == nullptr ? "." : folder) + "/relations/" + name + ".bif.gz";
}

RelationNetwork published(const std::string& name) {
  std::string text;
  if (std::FILE* const pipe = popen(("gzip -dc '" + path_of(name) + "'").c_str(), "r")) {
    std::array<char, 1 << 16> buffer{};
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
      text.append(buffer.data(), count);
    pclose(pipe);
  }
  std::istringstream in(text);
  return read_bif(in, name);
}

/// 40 variables of 3 outcomes, each with up to 2 parents among the 6 before it; the same every time.
RelationNetwork generated() {
  std::mt19937_64 generator(1);
  RelationNetwork network;
  for (std::size_t v = 0; v < 40; ++v) {
    std::vector<NetworkVariable> parents;
    std::size_t rows = 1;
    for (std::size_t step = 1 + generator() % 3; step <= 6 && step <= v && parents.size() < 2;
         step += 1 + generator() % 3) {
      parents.push_back(network[v - step].variable);
      rows *= 3;
    }
    std::vector<std::vector<double>> table;
    for (std::size_t r = 0; r < rows; ++r) {
      const double p = static_cast<double>(generator() >> 11) * 0x1p-54, q = 0.5 - p;
      table.push_back({p, q, 0.5});
    }
    network.declare(RandomVariable{"v" + std::to_string(v), 3}, parents, table);
  }
  return network;
}

/// A square grid of binary variables, each given the ones to its left and above.
RelationNetwork grid(std::size_t side) {
  std::mt19937_64 generator(2);
  RelationNetwork network;
  for (std::size_t k = 0; k < side * side; ++k) {
    std::vector<NetworkVariable> parents;
    if (k % side > 0) parents.push_back(network[k - 1].variable);
    if (k >= side) parents.push_back(network[k - side].variable);
    std::vector<std::vector<double>> table;
    for (std::size_t r = 0; r < (std::size_t{1} << parents.size()); ++r) {
      const double p = 0.05 + 0.9 * static_cast<double>(generator() >> 11) * 0x1p-53;
      table.push_back({p, 1.0 - p});
    }
    network.declare(RandomVariable{"x" + std::to_string(k), 2}, parents, table);
  }
  return network;
}

/// Variables of three outcomes, each given the one before it.
RelationNetwork chain(std::size_t length) {
  RelationNetwork network;
  network.declare(uninformative(RandomVariable{"x0", 3}));
  for (std::size_t k = 1; k < length; ++k)
    network.declare(RandomVariable{"x" + std::to_string(k), 3}, {network[k - 1].variable},
                    {{0.8, 0.15, 0.05}, {0.1, 0.8, 0.1}, {0.05, 0.15, 0.8}});
  return network;
}

/// The most likely outcomes of the last quarter of the variables, so that the evidence is possible.
Evidence evidence_of(const RelationNetwork& network) {
  const Explanation likely = most_likely_explanation(network);
  Evidence evidence;
  for (std::size_t v = network.size() - network.size() / 4; v < network.size(); ++v) {
    const NetworkVariable& variable = network[v].variable;
    evidence.observe(variable.name(), likely[variable.name()]);
  }
  return evidence;
}

/// Posteriors of one variable after the other.
void single_posteriors(benchmark::State& state, const RelationNetwork& network) {
  const Evidence evidence = evidence_of(network);
  std::size_t v = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(query(network, {network[v].variable.name()}, evidence));
    v = (v + 1) % network.size();
  }
  state.SetItemsProcessed(state.iterations());
}

/// Posteriors of all variables at once.
void all_posteriors(benchmark::State& state, const RelationNetwork& network, const Evidence& evidence) {
  for (auto _ : state) benchmark::DoNotOptimize(marginals(network, evidence));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(network.size()));
}

void explanations(benchmark::State& state, const RelationNetwork& network) {
  const Evidence evidence = evidence_of(network);
  for (auto _ : state) benchmark::DoNotOptimize(most_likely_explanation(network, evidence));
  state.SetItemsProcessed(state.iterations());
}

void add(const std::string& name, const RelationNetwork& network) {
  const RelationNetwork fuzzy = as_fuzzy(network, RatioScale{});
  std::vector<std::string> every_third;
  for (std::size_t v = 0; v < network.size(); v += 3) every_third.push_back(network[v].variable.name());
  const RelationNetwork mixed = as_fuzzy(network, RatioScale{}, every_third);
  const auto in_microseconds = [](benchmark::internal::Benchmark* bench) { bench->Unit(benchmark::kMicrosecond); };
  const auto query_of = [&](const std::string& kinds, const RelationNetwork& of) {
    in_microseconds(benchmark::RegisterBenchmark(("posterior/" + name + "/" + kinds).c_str(),
                                                 [of](benchmark::State& state) { single_posteriors(state, of); }));
    in_microseconds(
        benchmark::RegisterBenchmark(("posteriors/" + name + "/" + kinds).c_str(),
                                     [of](benchmark::State& state) { all_posteriors(state, of, evidence_of(of)); }));
  };
  query_of("random", network);
  query_of("fuzzy", fuzzy);
  query_of("mixed", mixed);
  in_microseconds(benchmark::RegisterBenchmark(("explanation/" + name).c_str(),
                                               [network](benchmark::State& state) { explanations(state, network); }));
}

/// All variables at once, without evidence.
void add_without_evidence(const std::string& name, const RelationNetwork& network) {
  benchmark::RegisterBenchmark(("posteriors/" + name + "/nothing known").c_str(), [network](benchmark::State& state) {
    all_posteriors(state, network, {});
  })->Unit(benchmark::kMicrosecond);
}

const bool registered = [] {
  add("generated", generated());
  for (const std::string name : {"alarm", "pathfinder"})
    if (std::filesystem::exists(path_of(name))) {
      const RelationNetwork network = published(name);
      add(name, network);
      add_without_evidence(name, network);
    }
  add_without_evidence("grid of 12 x 12", grid(12));
  add_without_evidence("chain of 3000", chain(3000));
  return true;
}();

}  // namespace
}  // namespace sigmax
