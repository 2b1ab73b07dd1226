#include "solve.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <variant>

#include "kernels/unbounded_row.hpp"

namespace sigmax::elimination {
namespace {

std::vector<Vertex> scope_of(const RelationNetwork& network, Vertex v, const Parts& parts) {
  std::vector<Vertex> scope;
  for (const Vertex parent : network[v].parents)
    if (!parts.known[parent]) scope.push_back(parent);
  if (!parts.known[v]) scope.push_back(v);
  return scope;
}

/// The table of `v` where what is known has its outcome.
Factor table_factor(const RelationNetwork& network, Vertex v, const Parts& parts,
                    const std::vector<std::size_t>& sizes) {
  Factor factor{scope_of(network, v, parts), {}};
  factor.values.resize(elimination::outcomes_of(factor.scope, sizes));
  const std::vector<std::size_t>& parents = network[v].parents;
  ScaledNumber* out = factor.values.data();
  const auto read = [&](const auto& rows) {
    for (std::size_t r = 0; r < rows.rows(); ++r) {
      bool fits = true;
      for (std::size_t p = parents.size(), rest = r; fits && p-- > 0; rest /= sizes[parents[p]])
        fits = parts.known[parents[p]].value_or(rest % sizes[parents[p]]) == rest % sizes[parents[p]];
      if (!fits) continue;
      const auto entries = rows.entries(r);
      for (std::size_t k = 0; k < entries.size(); ++k) {
        if (!parts.known[v])
          out[entries.index(k)] = ScaledNumber{entries.value(k)};
        else if (entries.index(k) == *parts.known[v])
          *out = ScaledNumber{entries.value(k)};
      }
      out += parts.known[v] ? 1 : sizes[v];
    }
  };
  std::visit(read, network[v].rows);
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

std::vector<Vertex> relevant(const RelationNetwork& network, std::vector<Vertex> targets, const Findings& findings) {
  for (Vertex v = 0; v < network.size(); ++v)
    if (findings.weights[v]) targets.push_back(v);
  return relevant(network, targets);
}

std::vector<Vertex> vertices_of(const RelationNetwork& network, const std::vector<std::string>& names) {
  std::vector<Vertex> vertices;
  std::vector<bool> seen(network.size(), false);
  for (const auto& name : names) {
    vertices.push_back(network.index_of(name));
    if (seen[vertices.back()]) throw std::invalid_argument("the query has variable '" + name + "' twice");
    seen[vertices.back()] = true;
  }
  return vertices;
}

Parts parts_of(const RelationNetwork& network, std::vector<Vertex> tables, const Findings& findings,
               const std::vector<Vertex>& asked) {
  Parts parts{std::move(tables), std::vector<std::optional<std::size_t>>(network.size())};
  for (const Vertex v : parts.tables) {
    const auto& weights = findings.weights[v];
    const std::size_t size = network[v].variable.size();
    if ((!weights && size > 1) || std::find(asked.begin(), asked.end(), v) != asked.end()) continue;
    std::size_t first = 0, count = 0;
    for (std::size_t i = size; i-- > 0;)
      if (!weights || !(*weights)[i].is_zero()) first = i, ++count;
    if (count == 1) parts.known[v] = first;
  }
  return parts;
}

OrderProblem order_problem(const RelationNetwork& network, const Parts& parts, const std::vector<Vertex>& others,
                           Role role) {
  OrderProblem problem{sizes_of(network), {}, std::vector<Role>(network.size(), Role::absent), {}};
  for (const auto& vertex : network.vertices()) problem.kinds.push_back(vertex.variable.kind());
  for (const Vertex v : parts.tables) {
    problem.scopes.push_back(scope_of(network, v, parts));
    for (const Vertex u : problem.scopes.back()) problem.roles[u] = Role::eliminated;
  }
  for (const Vertex v : others)
    if (!parts.known[v]) problem.roles[v] = role;
  return problem;
}

void refuse_above(std::size_t limit, const Order& order, const RelationNetwork& network) {
  const double numbers = order.greatest_table, bytes = numbers * static_cast<double>(sizeof(ScaledNumber));
  if (bytes <= static_cast<double>(limit)) return;
  constexpr std::size_t shown = 12;
  const std::vector<Vertex>& scope = order.greatest_scope;
  std::ostringstream message;
  message.precision(3);
  message << "the query needs a table of " << numbers << " numbers (" << bytes / 0x1p30 << " GiB), above the limit of "
          << static_cast<double>(limit) / 0x1p30 << " GiB: over ";
  for (std::size_t k = 0; k < scope.size() && k < shown; ++k)
    message << (k > 0 ? ", '" : "'") << network[scope[k]].variable.name() << "'";
  if (scope.size() > shown) message << ", … (" << scope.size() << " variables)";
  throw std::length_error(message.str());
}

std::vector<Factor> factors_of(const RelationNetwork& network, const Parts& parts, const Findings& findings) {
  const std::vector<std::size_t> sizes = sizes_of(network);
  std::vector<Factor> factors;
  for (const Vertex v : parts.tables) {
    if (!findings.weights[v]) continue;
    if (parts.known[v])
      factors.push_back({{}, {(*findings.weights[v])[*parts.known[v]]}});
    else
      factors.push_back({{v}, *findings.weights[v]});
  }
  for (const Vertex v : parts.tables) factors.push_back(table_factor(network, v, parts, sizes));
  return factors;
}

std::vector<Factor> eliminated(const RelationNetwork& network, std::vector<Factor> factors,
                               const std::vector<Vertex>& order) {
  const std::vector<std::size_t> sizes = sizes_of(network);
  return eliminated(std::move(factors), order, sizes, [&](const std::vector<Factor>& bucket, Vertex v) {
    return with_algebra_of(network[v].variable, [&]<class A>(A) { return eliminate<A>(bucket, v, sizes); });
  });
}

double outcomes_of(const RelationNetwork& network, const std::vector<Vertex>& vertices) {
  double outcomes = 1.0;
  for (const Vertex v : vertices) outcomes *= static_cast<double>(network[v].variable.size());
  return outcomes;
}

Factor joint(const RelationNetwork& network, const Parts& parts, const Findings& findings, const Order& order,
             const std::vector<Vertex>& asked, std::size_t limit) {
  refuse_above(limit, order, network);
  refuse_above(limit, {{}, outcomes_of(network, asked), asked}, network);
  return product(eliminated(network, factors_of(network, parts, findings), order.vertices), asked, sizes_of(network));
}

}  // namespace sigmax::elimination

namespace sigmax {

Evidence::Evidence(std::initializer_list<std::pair<std::string, std::string>> outcomes) {
  for (const auto& [variable, label] : outcomes) observe(variable, label);
}

Evidence& Evidence::observe(std::string variable, std::string label) {
  outcomes_.push_back({std::move(variable), std::move(label)});
  return *this;
}

Evidence& Evidence::observe(const NetworkVariable& variable, const kernels::Evidence& likelihood) {
  Weights weights{variable, {}};
  for (std::size_t i = 0; i < variable.size(); ++i) weights.numbers.push_back(number_of(likelihood, i));
  likelihoods_.push_back(std::move(weights));
  return *this;
}

}  // namespace sigmax
