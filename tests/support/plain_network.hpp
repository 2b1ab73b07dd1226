#pragma once

#include "support/plain.hpp"

/// A network restated with plain loops: no code shared with the library.
namespace sigmax::plain {

/// Variables in the order of declaration, each with its table: a row per outcome of the parents, the last fastest.
struct Network {
  struct Node {
    By by;
    std::size_t size;
    std::vector<std::size_t> parents;
    Rows rows;
  };
  std::vector<Node> nodes;
};

/// A weight for every outcome of every variable: one where nothing is known.
using Weights = std::vector<Numbers>;

inline Weights no_evidence(const Network& network) {
  Weights weights;
  for (const auto& node : network.nodes) weights.push_back(Numbers(node.size, 1.0));
  return weights;
}

/// The product of all tables and weights where every variable has an outcome.
inline long double joint(const Network& network, const Weights& weights, const std::vector<std::size_t>& outcomes) {
  long double product = 1;
  for (std::size_t v = 0; v < network.nodes.size(); ++v) {
    std::size_t row = 0;
    for (const std::size_t parent : network.nodes[v].parents) row = row * network.nodes[parent].size + outcomes[parent];
    product *= static_cast<long double>(network.nodes[v].rows[row][outcomes[v]]) * weights[v][outcomes[v]];
  }
  return product;
}

/// By full enumeration: the variables from `v` on eliminated innermost first, except those that `fixed` marks.
inline long double enumerate(const Network& network, const Weights& weights, const std::vector<bool>& fixed,
                             std::vector<std::size_t>& outcomes, std::size_t v = 0) {
  if (v == network.nodes.size()) return joint(network, weights, outcomes);
  if (fixed[v]) return enumerate(network, weights, fixed, outcomes, v + 1);
  std::vector<long double> terms;
  for (outcomes[v] = 0; outcomes[v] < network.nodes[v].size; ++outcomes[v])
    terms.push_back(enumerate(network, weights, fixed, outcomes, v + 1));
  return eliminate(network.nodes[v].by, terms);
}

/// Calls action(outcomes) for all outcomes of the variables `asked`, the last fastest; those of the others are zero.
template <class Action>
void for_each_outcome(const Network& network, const std::vector<std::size_t>& asked, const Action& action) {
  std::vector<std::size_t> outcomes(network.nodes.size(), 0);
  while (true) {
    action(outcomes);
    std::size_t left = asked.size();
    while (left > 0 && ++outcomes[asked[left - 1]] == network.nodes[asked[left - 1]].size) outcomes[asked[--left]] = 0;
    if (left == 0) return;
  }
}

/// By full enumeration: the numbers of the variables asked for.
inline std::vector<long double> enumerate(const Network& network, const Weights& weights,
                                          const std::vector<std::size_t>& asked) {
  std::vector<bool> fixed(network.nodes.size(), false);
  for (const std::size_t v : asked) fixed[v] = true;
  std::vector<long double> result;
  for_each_outcome(network, asked, [&](std::vector<std::size_t> outcomes) {
    result.push_back(enumerate(network, weights, fixed, outcomes));
  });
  return result;
}

/// A function of some variables, the last fastest.
struct Function {
  std::vector<std::size_t> scope;
  std::vector<long double> values;
};

inline std::vector<long double> product(const Network& network, const std::vector<Function>& functions,
                                        const std::vector<std::size_t>& scope) {
  std::vector<long double> result;
  for_each_outcome(network, scope, [&](const std::vector<std::size_t>& outcomes) {
    long double value = 1;
    for (const Function& function : functions) {
      std::size_t index = 0;
      for (const std::size_t v : function.scope) index = index * network.nodes[v].size + outcomes[v];
      value *= function.values[index];
      if (value == 0) break;
    }
    result.push_back(value);
  });
  return result;
}

/// The numbers of the variables asked for, where enumeration would take too long: the others are eliminated strictly in
/// the reverse order of declaration, each from the product of the functions that have it. `asked` is in any order.
inline std::vector<long double> eliminate_in_reverse(const Network& network, const Weights& weights,
                                                     const std::vector<std::size_t>& asked) {
  std::vector<Function> functions;
  for (std::size_t v = 0; v < network.nodes.size(); ++v) {
    const auto& node = network.nodes[v];
    Function function{node.parents, {}};
    function.scope.push_back(v);
    for (const auto& row : node.rows)
      for (std::size_t i = 0; i < node.size; ++i)
        function.values.push_back(static_cast<long double>(row[i]) * weights[v][i]);
    functions.push_back(function);
  }
  for (std::size_t v = network.nodes.size(); v-- > 0;) {
    if (std::find(asked.begin(), asked.end(), v) != asked.end()) continue;
    std::vector<Function> with, without;
    Function result;
    for (const Function& function : functions) {
      const bool has = std::find(function.scope.begin(), function.scope.end(), v) != function.scope.end();
      (has ? with : without).push_back(function);
      for (const std::size_t u : function.scope)
        if (has && u != v && std::find(result.scope.begin(), result.scope.end(), u) == result.scope.end())
          result.scope.push_back(u);
    }
    auto scope = result.scope;
    scope.push_back(v);
    const auto values = product(network, with, scope);
    const std::size_t size = network.nodes[v].size;
    for (std::size_t i = 0; i < values.size(); i += size) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(i);
      result.values.push_back(eliminate(network.nodes[v].by, {first, first + static_cast<std::ptrdiff_t>(size)}));
    }
    without.push_back(result);
    functions = without;
  }
  return product(network, functions, asked);
}

}  // namespace sigmax::plain
