#include <sigmax/core/network/query.hpp>

#include <algorithm>
#include <stdexcept>

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

NetworkAnswer query(const RelationNetwork& network, const std::vector<std::string>& variables,
                    const Evidence& evidence) {
  std::vector<Vertex> asked;
  std::vector<NetworkVariable> answered;
  for (const auto& name : variables) {
    const Vertex v = network.index_of(name);
    if (std::find(asked.begin(), asked.end(), v) != asked.end())
      throw std::invalid_argument("the query has variable '" + name + "' twice");
    asked.push_back(v);
    answered.push_back(network[v].variable);
  }
  const auto findings = elimination::findings_of(network, evidence);
  std::vector<Vertex> targets = asked;
  for (Vertex v = 0; v < network.size(); ++v)
    if (findings.weights[v]) targets.push_back(v);
  auto factors = elimination::factors_of(network, elimination::relevant(network, targets), findings, asked);

  std::vector<std::pair<Vertex, Role>> fixed, kept;
  for (const Vertex v : asked) {
    fixed.emplace_back(v, Role::fixed);
    kept.emplace_back(v, Role::kept);
  }
  const auto problem = elimination::order_problem(network, factors, fixed);
  const auto order = elimination::order_of_elimination(problem);
  const bool induced = !elimination::order_of_elimination(elimination::order_problem(network, factors, kept)).complete;

  Elimination done{{}, order.greatest_table, order.forced, order.greatest_table};
  for (const Vertex v : order.vertices) done.order.push_back(network[v].variable.name());
  if (order.forced) {
    auto of_one_kind = problem;
    of_one_kind.fuzzy.assign(network.size(), false);
    done.greatest_table_if_one_kind = elimination::order_of_elimination(of_one_kind).greatest_table;
  }

  auto joint = elimination::joint(network, std::move(factors), order, asked);
  std::vector<Vertex> innermost_first = asked;
  std::sort(innermost_first.rbegin(), innermost_first.rend());
  std::vector<elimination::Factor> total{joint};
  for (const Vertex v : innermost_first) total = {elimination::eliminate_by_kind(network, total, v, problem.sizes)};
  const ScaledNumber sum = total.front().values.front();
  if (sum.is_zero()) elimination::refuse(findings);
  return {std::move(answered), std::move(joint.values), sum, induced, std::move(done)};
}

}  // namespace sigmax
