#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/core/network.hpp>
#include <sigmax/core/network/query.hpp>

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

/// The vertices of these names. Throws std::invalid_argument if one is not the network's, or is there twice.
std::vector<Vertex> vertices_of(const RelationNetwork& network, const std::vector<std::string>& names);

/// The vertices whose tables bear on `targets`: these and their ancestors, in order. Any other table's variable is
/// eliminated to one before all that it depends on. The way up ends at `barrier`, which is not included.
std::vector<Vertex> relevant(const RelationNetwork& network, const std::vector<Vertex>& targets,
                             std::optional<Vertex> barrier = {});

/// The same, with everything that there is evidence about.
std::vector<Vertex> relevant(const RelationNetwork& network, std::vector<Vertex> targets, const Findings& findings);

/// The tables that take part. Variables of which the evidence leaves one outcome are put in place: each is substituted
/// by whichever ⊕, which therefore may be done first.
struct Parts {
  std::vector<Vertex> tables;
  std::vector<std::optional<std::size_t>> known;  ///< the outcome put in place, by index of the vertex
};

/// Variables in `asked` stay as they are, even if known.
Parts parts_of(const RelationNetwork& network, std::vector<Vertex> tables, const Findings& findings,
               const std::vector<Vertex>& asked);

/// The ordering problem of the parts: variables are eliminated unless they are known, or are `others`, with this role.
OrderProblem order_problem(const RelationNetwork& network, const Parts& parts, const std::vector<Vertex>& others = {},
                           Role role = Role::fixed);

/// Throws std::length_error, naming the variables, if the greatest table of an order takes more than `limit` bytes.
void refuse_above(std::size_t limit, const Order& order, const RelationNetwork& network);

/// Tables and evidence as factors. The order must have passed `refuse_above`, for they are made dense.
std::vector<Factor> factors_of(const RelationNetwork& network, const Parts& parts, const Findings& findings);

/// Eliminates in this order, each variable from the factors that have it; `eliminate(factors, vertex)` gives the factor
/// that takes their place. Returns those that are left.
template <class Eliminate>
std::vector<Factor> eliminated(std::vector<Factor> factors, const std::vector<Vertex>& order,
                               const std::vector<std::size_t>& sizes, const Eliminate& eliminate) {
  std::vector<std::size_t> place(sizes.size(), order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = k;
  std::vector<std::vector<Factor>> buckets(order.size() + 1);  // by the first of its variables to go; the last stays
  const auto put = [&](Factor factor) {
    std::size_t first = order.size();
    for (const Vertex v : factor.scope) first = std::min(first, place[v]);
    buckets[first].push_back(std::move(factor));
  };
  for (Factor& factor : factors) put(std::move(factor));
  for (std::size_t k = 0; k < order.size(); ++k) put(eliminate(std::move(buckets[k]), order[k]));
  return std::move(buckets.back());
}

/// action(algebra) with the algebra of a variable's kind: the only place where a network's kind chooses it.
template <class Action>
decltype(auto) with_algebra_of(const NetworkVariable& variable, const Action& action) {
  return variable.visit([&]<class Kind>(const Variable<Kind>&) -> decltype(auto) { return action(AlgebraOf<Kind>{}); });
}

/// Eliminates in this order, each variable by its own kind.
std::vector<Factor> eliminated(const RelationNetwork& network, std::vector<Factor> factors,
                               const std::vector<Vertex>& order);

/// How many outcomes the variables have together.
double outcomes_of(const RelationNetwork& network, const std::vector<Vertex>& vertices);

/// The joint of `asked`, all others of the parts eliminated by their kinds in the order given. Throws
/// std::length_error, naming the variables, if that or its greatest table takes more than `limit` bytes.
Factor joint(const RelationNetwork& network, const Parts& parts, const Findings& findings, const Order& order,
             const std::vector<Vertex>& asked, std::size_t limit);

/// What a calibrated tree of cliques tells.
struct Calibrated {
  std::vector<std::vector<ScaledNumber>> marginals;  ///< by index of the vertex; empty if it is not in the order
  ScaledNumber total;                                ///< ⊕ over everything; if it is zero there are no marginals
};

/// All marginals of the product of the factors. The variables of `order` are of one kind and all that the factors have.
///
/// The cliques are those that eliminating in this order makes, each within another left out. Every clique first hands
/// on to the next what it and those behind it say of the variables that both have, the outermost ones being last; on
/// the way back it is told what all say of them, which is divided by what it said itself (0/0 = 0: there it has only
/// zeros). Marginals then are those of single cliques. It takes time and memory in proportion to the cliques' tables.
///
/// The numbers are doubles with one exponent a table. Should a product come near the limit of their range, everything
/// is done again with an exponent for each number, so nothing underflows. All marginals have the same ⊕, the total.
Calibrated calibrated(const RelationNetwork& network, const std::vector<Factor>& factors,
                      const std::vector<Vertex>& order);

}  // namespace sigmax::elimination

namespace sigmax {

/// The outcomes of the parents in one row of a table, the last parent fastest: "young, calm"; or what `show` makes of
/// their labels.
template <class Show = std::identity>
std::string labels_of_row(const std::vector<NetworkVariable>& parents, std::size_t row, const Show& show = {}) {
  std::string labels;
  for (std::size_t p = parents.size(); p-- > 0;) {
    labels = show(parents[p].label(row % parents[p].size())) + (labels.empty() ? "" : ", ") + labels;
    row /= parents[p].size();
  }
  return labels;
}

}  // namespace sigmax
