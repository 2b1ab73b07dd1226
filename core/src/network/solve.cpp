#include "solve.hpp"

#include <algorithm>
#include <stdexcept>

namespace sigmax::elimination {
namespace {

Factor table_factor(const RelationNetwork& network, Vertex v) {
  const auto& vertex = network[v];
  Factor factor{vertex.parents, {}};
  factor.scope.push_back(v);
  factor.values.reserve(vertex.rows.size());
  for (const double value : vertex.rows.values()) factor.values.emplace_back(value);
  return factor;
}

}  // namespace

void refuse(const Findings& findings) {
  throw std::domain_error("the evidence excludes every outcome: " + findings.description);
}

Findings findings_of(const RelationNetwork& network, const Evidence& evidence) {
  Findings findings{std::vector<std::optional<std::vector<ScaledNumber>>>(network.size()), ""};
  const auto include = [&](Vertex v, const auto& weight, const std::string& description) {
    auto& all = findings.weights[v];
    if (!all) all.emplace(network[v].variable.size(), ScaledNumber{1.0});
    for (std::size_t i = 0; i < all->size(); ++i) (*all)[i] = (*all)[i] * weight(i);
    findings.description += (findings.description.empty() ? "" : ", ") + description;
  };
  for (const auto& [name, label] : evidence.outcomes()) {
    const Vertex v = network.index_of(name);
    const std::size_t seen = network[v].variable.index_of(label);
    const auto weight = [seen](std::size_t i) { return ScaledNumber{i == seen ? 1.0 : 0.0}; };
    include(v, weight, name + " = '" + label + "'");
  }
  for (const auto& weights : evidence.likelihoods()) {
    const auto weight = [&weights](std::size_t i) { return weights.numbers[i]; };
    include(network.index_of(weights.variable), weight, "likelihood of " + weights.variable.name());
  }
  for (const auto& weights : findings.weights)
    if (weights && std::all_of(weights->begin(), weights->end(), [](ScaledNumber w) { return w.is_zero(); }))
      refuse(findings);
  return findings;
}

std::vector<std::size_t> sizes_of(const RelationNetwork& network) {
  std::vector<std::size_t> sizes;
  for (const auto& vertex : network.vertices()) sizes.push_back(vertex.variable.size());
  return sizes;
}

std::vector<Vertex> relevant(const RelationNetwork& network, const std::vector<Vertex>& targets,
                             std::optional<Vertex> barrier) {
  std::vector<bool> bears(network.size(), false);
  for (const Vertex v : targets) bears[v] = true;
  std::vector<Vertex> result;
  for (Vertex v = network.size(); v-- > 0;) {
    if (!bears[v] || v == barrier) continue;
    result.push_back(v);
    for (const Vertex parent : network[v].parents) bears[parent] = true;
  }
  std::reverse(result.begin(), result.end());
  return result;
}

Factors factors_of(const RelationNetwork& network, const std::vector<Vertex>& tables, const Findings& findings,
                   const std::vector<Vertex>& asked) {
  const std::vector<std::size_t> sizes = sizes_of(network);
  Factors factors{{}, std::vector<std::optional<std::size_t>>(network.size())};
  for (const Vertex v : tables) {
    const auto& weights = findings.weights[v];
    if (weights) factors.all.push_back({{v}, *weights});
    if (std::find(asked.begin(), asked.end(), v) != asked.end()) continue;
    const auto possible = [&](std::size_t i) { return !weights || !(*weights)[i].is_zero(); };
    std::size_t first = 0, count = 0;
    for (std::size_t i = sizes[v]; i-- > 0;)
      if (possible(i)) first = i, ++count;
    if (count == 1) factors.known[v] = first;
  }
  for (const Vertex v : tables) factors.all.push_back(table_factor(network, v));
  for (Factor& factor : factors.all) {
    const std::vector<Vertex> scope = factor.scope;
    for (const Vertex v : scope)
      if (factors.known[v]) factor = restricted(factor, v, *factors.known[v], sizes);
  }
  return factors;
}

OrderProblem order_problem(const RelationNetwork& network, const Factors& factors,
                           const std::vector<std::pair<Vertex, Role>>& roles) {
  OrderProblem problem{sizes_of(network), {}, std::vector<Role>(network.size(), Role::absent), {}};
  for (const auto& vertex : network.vertices()) problem.fuzzy.push_back(vertex.variable.is<Fuzzy>());
  for (const Factor& factor : factors.all) {
    for (const Vertex v : factor.scope) problem.roles[v] = Role::eliminated;
    problem.scopes.push_back(factor.scope);
  }
  for (const auto& [v, role] : roles) problem.roles[v] = role;
  return problem;
}

Factor eliminate_by_kind(const RelationNetwork& network, const std::vector<Factor>& factors, Vertex vertex,
                         const std::vector<std::size_t>& sizes) {
  return network[vertex].variable.visit(
      [&]<class Kind>(const Variable<Kind>&) { return eliminate<AlgebraOf<Kind>>(factors, vertex, sizes); });
}

Factor joint(const RelationNetwork& network, Factors factors, const Order& order, const std::vector<Vertex>& asked) {
  const std::vector<std::size_t> sizes = sizes_of(network);
  const auto left = eliminated(
      std::move(factors.all), order.vertices,
      [&](const std::vector<Factor>& bucket, Vertex v) { return eliminate_by_kind(network, bucket, v, sizes); });
  return product(left, asked, sizes);
}

}  // namespace sigmax::elimination
