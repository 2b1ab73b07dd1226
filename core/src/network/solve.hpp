#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/core/network.hpp>
#include <sigmax/core/network/evidence.hpp>

#include "factor.hpp"
#include "order.hpp"

namespace sigmax::elimination {

/// Evidence by index of the vertex: a weight for every outcome where there is any.
struct Findings {
  std::vector<std::optional<std::vector<ScaledNumber>>> weights;
  std::string description;
};

/// Throws std::invalid_argument if the evidence is about what the network has not, std::domain_error if it excludes
/// every outcome of one variable.
Findings findings_of(const RelationNetwork& network, const Evidence& evidence);

/// Throws std::domain_error that names the evidence.
[[noreturn]] void refuse(const Findings& findings);

std::vector<std::size_t> sizes_of(const RelationNetwork& network);

/// The vertices whose tables bear on `targets`: these and their ancestors, in order. Any other table's variable is
/// eliminated to one before all that it depends on. The way up ends at `barrier`, which is not included.
std::vector<Vertex> relevant(const RelationNetwork& network, const std::vector<Vertex>& targets,
                             std::optional<Vertex> barrier = {});

/// Tables and evidence as factors, where variables of which only one outcome is left are put in place: each is
/// substituted by whichever ⊕, which therefore may be done first.
struct Factors {
  std::vector<Factor> all;
  std::vector<std::optional<std::size_t>> known;  ///< that outcome, by index of the vertex
};
Factors factors_of(const RelationNetwork& network, const std::vector<Vertex>& tables, const Findings& findings,
                   const std::vector<Vertex>& asked);

/// The ordering problem of the factors: variables are eliminated unless they are known, or `roles` says otherwise.
OrderProblem order_problem(const RelationNetwork& network, const Factors& factors,
                           const std::vector<std::pair<Vertex, Role>>& roles);

/// Eliminates in this order; `eliminate(factors, vertex)` gives the factor that takes the place of all that have it.
template <class Eliminate>
std::vector<Factor> eliminated(std::vector<Factor> factors, const std::vector<Vertex>& order,
                               const Eliminate& eliminate) {
  for (const Vertex v : order) {
    const auto has_not = [v](const Factor& f) { return std::find(f.scope.begin(), f.scope.end(), v) == f.scope.end(); };
    const auto first = std::partition(factors.begin(), factors.end(), has_not);
    std::vector<Factor> bucket(std::make_move_iterator(first), std::make_move_iterator(factors.end()));
    factors.erase(first, factors.end());
    factors.push_back(eliminate(std::move(bucket), v));
  }
  return factors;
}

/// ⊕ over one variable by its own kind: the only place where a network's kind chooses the algebra.
Factor eliminate_by_kind(const RelationNetwork& network, const std::vector<Factor>& factors, Vertex vertex,
                         const std::vector<std::size_t>& sizes);

/// The joint of `asked`, all others eliminated by their kinds in the order given.
Factor joint(const RelationNetwork& network, Factors factors, const Order& order, const std::vector<Vertex>& asked);

}  // namespace sigmax::elimination
