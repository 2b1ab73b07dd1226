#include <sigmax/core/network/query.hpp>

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "solve.hpp"

namespace sigmax {

using elimination::Factor;
using elimination::Role;
using elimination::Vertex;

std::vector<double> NetworkAnswer::normalized() const {
  std::vector<double> result;
  for (const ScaledNumber value : values_) result.push_back(value.over(total_));
  return result;
}

std::size_t NetworkAnswer::index_of(std::initializer_list<std::string_view> labels) const {
  if (labels.size() != variables_.size())
    throw std::invalid_argument("the query has " + std::to_string(variables_.size()) + " variables, but " +
                                std::to_string(labels.size()) + " outcomes are given");
  std::size_t index = 0, place = 0;
  for (const auto label : labels) {
    const NetworkVariable& variable = variables_[place++];
    index = index * variable.size() + variable.index_of(label);
  }
  return index;
}

const NetworkVariable& NetworkAnswer::only() const& {
  if (variables_.size() != 1)
    throw std::invalid_argument("the query is of " + std::to_string(variables_.size()) + " variables, not of one");
  return variables_.front();
}

namespace {

/// A query up to its arithmetic.
struct Plan {
  std::vector<Vertex> asked;
  elimination::Findings findings;
  elimination::Parts parts;
  elimination::Order order;
  Elimination cost;
  bool induced = false;
};

Plan plan_of(const RelationNetwork& network, const std::vector<std::string>& variables, const Evidence& evidence) {
  Plan plan{elimination::vertices_of(network, variables), elimination::findings_of(network, evidence), {}, {}, {}};
  plan.parts = elimination::parts_of(network, elimination::relevant(network, plan.asked, plan.findings), plan.findings,
                                     plan.asked);
  auto problem = elimination::order_problem(network, plan.parts, plan.asked);
  plan.order = elimination::order_of_elimination(problem);
  // What the evidence leaves one outcome of can be eliminated first or last.
  const auto as_declared = elimination::order_problem(
      network, elimination::parts_of(network, plan.parts.tables, plan.findings, {}), plan.asked, Role::kept);
  plan.induced = elimination::of_two_kinds(as_declared) && !elimination::order_of_elimination(as_declared).complete;

  Elimination& cost = plan.cost;
  cost.forced = plan.order.forced;
  const double numbers = elimination::outcomes_of(network, plan.asked);
  cost.greatest_table = cost.greatest_table_if_one_kind = std::max(plan.order.greatest_table, numbers);
  for (const Vertex v : plan.order.vertices) cost.order.push_back(network[v].variable.name());
  if (cost.forced) {
    problem.kinds.assign(network.size(), 0);
    cost.greatest_table_if_one_kind = std::max(elimination::order_of_elimination(problem).greatest_table, numbers);
  }
  return plan;
}

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
  const auto can = elimination::can_be_last(elimination::order_problem(network, {std::move(tables), parts.known}));
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
  auto problem = elimination::order_problem(network, parts, group, Role::kept);
  elimination::Order within;
  if (std::find(problem.roles.begin(), problem.roles.end(), Role::eliminated) != problem.roles.end())
    within = elimination::order_of_elimination(problem);
  if (!within.complete || !fits(within, table_limit)) return;
  const auto factors =
      elimination::eliminated(network, elimination::factors_of(network, parts, findings), within.vertices);

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

NetworkAnswer query(const RelationNetwork& network, const std::vector<std::string>& variables, const Evidence& evidence,
                    std::size_t table_limit) {
  Plan plan = plan_of(network, variables, evidence);
  auto joint = elimination::joint(network, plan.parts, plan.findings, plan.order, plan.asked, table_limit);
  std::vector<Vertex> innermost_first = plan.asked;
  std::sort(innermost_first.rbegin(), innermost_first.rend());
  const auto total = elimination::eliminated(network, {joint}, innermost_first);
  const ScaledNumber sum = total.front().values.front();
  if (sum.is_zero()) elimination::refuse(plan.findings);
  std::vector<NetworkVariable> answered;
  for (const Vertex v : plan.asked) answered.push_back(network[v].variable);
  return {std::move(answered), std::move(joint.values), sum, plan.induced, std::move(plan.cost)};
}

Elimination cost(const RelationNetwork& network, const std::vector<std::string>& variables, const Evidence& evidence) {
  return plan_of(network, variables, evidence).cost;
}

std::vector<NetworkAnswer> marginals(const RelationNetwork& network, const Evidence& evidence,
                                     std::size_t table_limit) {
  const auto findings = elimination::findings_of(network, evidence);
  std::vector<Vertex> all(network.size());
  std::iota(all.begin(), all.end(), Vertex{0});
  const auto parts = elimination::parts_of(network, all, findings, {});
  const auto problem = elimination::order_problem(network, parts);
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
