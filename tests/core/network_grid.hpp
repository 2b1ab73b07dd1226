#pragma once

#include "support/core.hpp"

namespace sigmax::support {

inline std::string name(std::size_t k) { return "x" + std::to_string(k); }

/// A network of these tables, in their order.
template <class... Tables>
RelationNetwork network_of(const Tables&... tables) {
  RelationNetwork network;
  (network.declare(tables), ...);
  return network;
}

/// A square grid of binary random variables, each given the ones to its left and above.
inline RelationNetwork grid(std::size_t side) {
  RelationNetwork network;
  std::vector<NetworkVariable> variables;
  for (std::size_t k = 0; k < side * side; ++k) {
    std::vector<NetworkVariable> parents;
    if (k % side > 0) parents.push_back(variables[k - 1]);
    if (k >= side) parents.push_back(variables[k - side]);
    variables.emplace_back(RandomVariable{name(k), 2});
    std::vector<std::vector<double>> rows;
    for (std::size_t r = 0; r < (std::size_t{1} << parents.size()); ++r) {
      const double p = 0.125 * static_cast<double>(1 + (r + k) % 7);
      rows.push_back({p, 1.0 - p});
    }
    network.declare(variables.back(), parents, rows);
  }
  return network;
}

/// marginals() against query() of each variable: the numbers, the total, and whether they are induced.
inline void expect_single_queries(const RelationNetwork& network, const Evidence& evidence) {
  const auto all = marginals(network, evidence);
  ASSERT_EQ(all.size(), network.size());
  for (std::size_t v = 0; v < all.size(); ++v) {
    SCOPED_TRACE(network[v].variable.name());
    const auto single = query(network, {network[v].variable.name()}, evidence);
    EXPECT_EQ(all[v].variables()[0], network[v].variable);
    EXPECT_EQ(all[v].induced(), single.induced());
    EXPECT_CLOSE(all[v].total().log(), single.total().log(), 1e-12);
    ASSERT_EQ(all[v].values().size(), single.values().size());
    for (std::size_t i = 0; i < single.values().size(); ++i) {
      EXPECT_EQ(all[v].values()[i].is_zero(), single.values()[i].is_zero());
      EXPECT_CLOSE(all[v].values()[i].over(single.total()), single.normalized()[i], 1e-12);
    }
  }
}

}  // namespace sigmax::support
