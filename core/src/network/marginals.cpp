#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <sigmax/core/network/query.hpp>

#include "clique_tree.hpp"
#include "solve.hpp"

namespace sigmax {

using elimination::Factor;
using elimination::Role;
using elimination::Vertex;

namespace {

/// The answers by index of the vertex, as far as they are known; and the evidence.
struct Answers {
  std::vector<std::optional<NetworkAnswer>> of;
  std::optional<ScaledNumber> total;
};

/// The variables of this kind that can be kept to the last together, in the network without what bears on none of them
/// nor on the evidence. Those that depend on one of another kind which the evidence does not ask for cannot.
std::vector<Vertex> lasting(const RelationNetwork& network, const elimination::Findings& findings,
                            const elimination::Parts& parts, std::size_t kind) {
  std::vector<bool> taken(network.size(), false);
  for (const Vertex v : elimination::relevant(network, {}, findings)) taken[v] = true;
  std::vector<Vertex> tables;
  for (Vertex v = 0; v < network.size(); ++v) {
    const auto& parents = network[v].parents;
    taken[v] = taken[v] || (network[v].variable.kind() == kind &&
                            std::all_of(parents.begin(), parents.end(), [&](Vertex p) { return taken[p]; }));
    if (taken[v]) tables.push_back(v);
  }
  const auto can = elimination::can_be_last(elimination::order_problem(network, {std::move(tables), parts.known}, {}));
  std::vector<Vertex> result;
  for (Vertex v = 0; v < network.size(); ++v)
    if (can[v] && network[v].variable.kind() == kind) result.push_back(v);
  return result;
}

bool fits(const elimination::Order& order, std::size_t table_limit) {
  return order.greatest_table * static_cast<double>(sizeof(ScaledNumber)) <= static_cast<double>(table_limit);
}

/// Answers for `group`, variables of one kind that can be kept to the last: all others are eliminated once, and what is
/// left makes a tree of cliques. Nothing is answered if that takes a table above the limit.
void answer_together(const RelationNetwork& network, const elimination::Findings& findings,
                     const std::vector<Vertex>& group, std::size_t table_limit, Answers& answers) {
  if (group.empty()) return;
  const auto parts = elimination::parts_of(network, elimination::relevant(network, group, findings), findings, {});
  std::vector<std::pair<Vertex, Role>> kept;
  for (const Vertex v : group) kept.emplace_back(v, Role::kept);
  auto problem = elimination::order_problem(network, parts, kept);
  elimination::Order within;
  if (std::find(problem.roles.begin(), problem.roles.end(), Role::eliminated) != problem.roles.end())
    within = elimination::order_of_elimination(problem);
  if (!within.complete || !fits(within, table_limit)) return;
  const auto sizes = elimination::sizes_of(network);
  const auto factors = elimination::eliminated(
      elimination::factors_of(network, parts, findings), within.vertices, sizes,
      [&](const auto& bucket, Vertex v) { return elimination::eliminate_by_kind(network, bucket, v, sizes); });

  for (const Vertex v : group) problem.roles[v] = Role::eliminated;
  for (const Vertex v : within.vertices) problem.roles[v] = Role::absent;
  problem.scopes.clear();
  for (const Factor& factor : factors) problem.scopes.push_back(factor.scope);
  const auto order = elimination::order_of_elimination(problem);
  if (!fits(order, table_limit)) return;
  auto found = elimination::calibrated(network, factors, order.vertices);
  if (found.total.is_zero()) elimination::refuse(findings);
  answers.total = found.total;
  const double greatest = std::max(within.greatest_table, order.greatest_table);
  const Elimination cost{{}, greatest, within.forced, greatest};
  for (const Vertex v : group)
    answers.of[v].emplace(std::vector{network[v].variable}, std::move(found.marginals[v]), found.total, false, cost);
}

}  // namespace

std::vector<NetworkAnswer> marginals(const RelationNetwork& network, const Evidence& evidence,
                                     std::size_t table_limit) {
  const auto findings = elimination::findings_of(network, evidence);
  std::vector<Vertex> all(network.size());
  std::iota(all.begin(), all.end(), Vertex{0});
  const auto parts = elimination::parts_of(network, all, findings, {});
  const auto problem = elimination::order_problem(network, parts, {});
  Answers answers{std::vector<std::optional<NetworkAnswer>>(network.size()), {}};
  if (elimination::of_two_kinds(problem)) {
    for (const std::size_t kind : std::set(problem.kinds.begin(), problem.kinds.end()))
      answer_together(network, findings, lasting(network, findings, parts, kind), table_limit, answers);
  } else {
    std::erase_if(all, [&](Vertex v) { return problem.roles[v] == Role::absent; });
    answer_together(network, findings, all, table_limit, answers);
  }
  // The others one by one: the last declared first, which most others bear on, so that a limit is met early.
  for (Vertex v = network.size(); v-- > 0;)
    if (!answers.of[v] && !parts.known[v])
      answers.of[v] = query(network, {network[v].variable.name()}, evidence, table_limit);
  std::vector<NetworkAnswer> result;
  for (Vertex v = 0; v < network.size(); ++v) {
    if (!answers.of[v]) {
      if (!answers.total) answers.total = query(network, {}, evidence, table_limit).total();
      std::vector<ScaledNumber> values(network[v].variable.size());
      values[*parts.known[v]] = *answers.total;
      answers.of[v].emplace(std::vector{network[v].variable}, std::move(values), *answers.total, false, Elimination{});
    }
    result.push_back(*std::move(answers.of[v]));
  }
  return result;
}

}  // namespace sigmax
