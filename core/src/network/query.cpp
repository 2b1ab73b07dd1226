#include <sigmax/core/network/query.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "solve.hpp"

namespace sigmax {

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
  double numbers = 1.0;  // of the answer
  bool induced = false;
};

Plan plan_of(const RelationNetwork& network, const std::vector<std::string>& variables, const Evidence& evidence) {
  Plan plan{elimination::vertices_of(network, variables), elimination::findings_of(network, evidence), {}, {}, {}};
  plan.parts = elimination::parts_of(network, elimination::relevant(network, plan.asked, plan.findings), plan.findings,
                                     plan.asked);
  std::vector<std::pair<Vertex, Role>> fixed, kept;
  for (const Vertex v : plan.asked) {
    fixed.emplace_back(v, Role::fixed);
    kept.emplace_back(v, Role::kept);
    plan.numbers *= static_cast<double>(network[v].variable.size());
  }
  const auto problem = elimination::order_problem(network, plan.parts, fixed);
  plan.order = elimination::order_of_elimination(problem);
  // What the evidence leaves one outcome of can be eliminated first or last.
  const auto as_declared =
      elimination::order_problem(network, elimination::parts_of(network, plan.parts.tables, plan.findings, {}), kept);
  plan.induced = elimination::of_two_kinds(as_declared) && !elimination::order_of_elimination(as_declared).complete;

  Elimination& cost = plan.cost;
  cost.forced = plan.order.forced;
  cost.greatest_table = cost.greatest_table_if_one_kind = std::max(plan.order.greatest_table, plan.numbers);
  for (const Vertex v : plan.order.vertices) cost.order.push_back(network[v].variable.name());
  if (cost.forced) {
    auto of_one_kind = problem;
    of_one_kind.kinds.assign(network.size(), 0);
    cost.greatest_table_if_one_kind =
        std::max(elimination::order_of_elimination(of_one_kind).greatest_table, plan.numbers);
  }
  return plan;
}

}  // namespace

NetworkAnswer query(const RelationNetwork& network, const std::vector<std::string>& variables, const Evidence& evidence,
                    std::size_t table_limit) {
  Plan plan = plan_of(network, variables, evidence);
  elimination::refuse_above(table_limit, plan.order.greatest_table, plan.order.greatest_scope, network);
  elimination::refuse_above(table_limit, plan.numbers, plan.asked, network);
  auto joint =
      elimination::joint(network, elimination::factors_of(network, plan.parts, plan.findings), plan.order, plan.asked);
  const auto sizes = elimination::sizes_of(network);
  std::vector<Vertex> innermost_first = plan.asked;
  std::sort(innermost_first.rbegin(), innermost_first.rend());
  std::vector<elimination::Factor> total{joint};
  for (const Vertex v : innermost_first) total = {elimination::eliminate_by_kind(network, total, v, sizes)};
  const ScaledNumber sum = total.front().values.front();
  if (sum.is_zero()) elimination::refuse(plan.findings);
  std::vector<NetworkVariable> answered;
  for (const Vertex v : plan.asked) answered.push_back(network[v].variable);
  return {std::move(answered), std::move(joint.values), sum, plan.induced, std::move(plan.cost)};
}

Elimination cost(const RelationNetwork& network, const std::vector<std::string>& variables, const Evidence& evidence) {
  return plan_of(network, variables, evidence).cost;
}

}  // namespace sigmax
