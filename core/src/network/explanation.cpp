#include <sigmax/core/network/explanation.hpp>

#include <algorithm>
#include <ostream>
#include <stdexcept>
#include <utility>

#include "solve.hpp"

namespace sigmax {

using elimination::Factor;
using elimination::Role;
using elimination::Vertex;

std::string Explanation::operator[](std::string_view variable) const {
  for (std::size_t v = 0; v < variables.size(); ++v)
    if (variables[v].name() == variable) return variables[v].label(outcomes[v]);
  throw std::invalid_argument("the network has no variable '" + std::string(variable) + "'");
}

std::ostream& operator<<(std::ostream& out, const Explanation& explanation) {
  for (std::size_t v = 0; v < explanation.variables.size(); ++v)
    out << (v == 0 ? "" : ", ") << explanation.variables[v].name() << ' '
        << explanation.variables[v].label(explanation.outcomes[v]);
  return out << ": " << ScaledNumber::exp(explanation.log_value);
}

Explanation most_likely_explanation(const RelationNetwork& network, const Evidence& evidence, std::size_t table_limit) {
  std::vector<std::string> all;
  for (const auto& vertex : network.vertices()) all.push_back(vertex.variable.name());
  return most_likely_outcomes(network, all, evidence, table_limit);
}

Explanation most_likely_outcomes(const RelationNetwork& network, const std::vector<std::string>& variables,
                                 const Evidence& evidence, std::size_t table_limit) {
  const auto asked = elimination::vertices_of(network, variables);
  const auto findings = elimination::findings_of(network, evidence);
  const auto sizes = elimination::sizes_of(network);
  const auto parts = elimination::parts_of(network, elimination::relevant(network, asked, findings), findings, {});

  // The others by their kinds, then those asked for by the maximum, on what is left of the factors.
  auto problem = elimination::order_problem(network, parts, asked);
  const auto within = elimination::order_of_elimination(problem);
  elimination::refuse_above(table_limit, within, network);
  auto factors = elimination::eliminated(network, elimination::factors_of(network, parts, findings), within.vertices);

  problem.kinds.assign(network.size(), 0);  // as if of one kind
  problem.roles.assign(network.size(), Role::absent);
  problem.scopes.clear();
  for (const Factor& factor : factors) {
    problem.scopes.push_back(factor.scope);
    for (const Vertex v : factor.scope) problem.roles[v] = Role::eliminated;
  }
  const auto order = elimination::order_of_elimination(problem);
  elimination::refuse_above(table_limit, order, network);

  // Max is selective: what each elimination selected is read off its factors afterwards, outermost variable first.
  std::vector<std::vector<Factor>> buckets;
  const auto left =
      elimination::eliminated(std::move(factors), order.vertices, sizes, [&](std::vector<Factor> bucket, Vertex v) {
        Factor result = elimination::eliminate<Max>(bucket, v, sizes);
        buckets.push_back(std::move(bucket));
        return result;
      });
  const ScaledNumber best = elimination::product(left, {}, sizes).values.front();
  if (best.is_zero()) elimination::refuse(findings);

  std::vector<std::size_t> outcomes(network.size(), 0);
  for (Vertex v = 0; v < network.size(); ++v) outcomes[v] = parts.known[v].value_or(0);
  for (std::size_t step = order.vertices.size(); step-- > 0;) {
    const Vertex v = order.vertices[step];
    std::vector<ScaledNumber> values(sizes[v], ScaledNumber{1.0});
    for (outcomes[v] = 0; outcomes[v] < sizes[v]; ++outcomes[v])
      for (const Factor& factor : buckets[step])
        values[outcomes[v]] = values[outcomes[v]] * elimination::number_at(factor, outcomes, sizes);
    outcomes[v] = static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
  }
  Explanation explanation{{}, {}, best.log()};
  for (const Vertex v : asked) {
    explanation.variables.push_back(network[v].variable);
    explanation.outcomes.push_back(outcomes[v]);
  }
  return explanation;
}

}  // namespace sigmax
