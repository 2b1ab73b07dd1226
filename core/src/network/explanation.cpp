#include <sigmax/core/network/explanation.hpp>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "solve.hpp"

namespace sigmax {

using elimination::Factor;
using elimination::Vertex;

std::string Explanation::operator[](std::string_view variable) const {
  for (std::size_t v = 0; v < variables.size(); ++v)
    if (variables[v].name() == variable) return variables[v].label(outcomes[v]);
  throw std::invalid_argument("the network has no variable '" + std::string(variable) + "'");
}

Explanation most_likely_explanation(const RelationNetwork& network, const Evidence& evidence) {
  const auto findings = elimination::findings_of(network, evidence);
  const auto sizes = elimination::sizes_of(network);
  std::vector<Vertex> all(network.size());
  std::iota(all.begin(), all.end(), Vertex{0});
  auto factors = elimination::factors_of(network, all, findings, {});
  auto problem = elimination::order_problem(network, factors, {});
  problem.fuzzy.assign(network.size(), true);  // all by the maximum
  const auto order = elimination::order_of_elimination(problem);

  // Max is selective: what each elimination selected is read off its factors afterwards, outermost variable first.
  std::vector<std::vector<Factor>> buckets;
  const auto left =
      elimination::eliminated(std::move(factors.all), order.vertices, [&](std::vector<Factor> bucket, Vertex v) {
        Factor result = elimination::eliminate<Max>(bucket, v, sizes);
        buckets.push_back(std::move(bucket));
        return result;
      });
  const ScaledNumber best = elimination::product(left, {}, sizes).values.front();
  if (best.is_zero()) elimination::refuse(findings);

  Explanation explanation{{}, std::vector<std::size_t>(network.size(), 0), best.log()};
  for (Vertex v = 0; v < network.size(); ++v) {
    explanation.variables.push_back(network[v].variable);
    explanation.outcomes[v] = factors.known[v].value_or(0);
  }
  for (std::size_t step = order.vertices.size(); step-- > 0;) {
    const Vertex v = order.vertices[step];
    auto factors_of_v = std::move(buckets[step]);
    for (Factor& factor : factors_of_v) {
      const std::vector<Vertex> scope = factor.scope;
      for (const Vertex other : scope)
        if (other != v) factor = elimination::restricted(factor, other, explanation.outcomes[other], sizes);
    }
    const auto values = elimination::product(factors_of_v, {v}, sizes).values;
    explanation.outcomes[v] = static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
  }
  return explanation;
}

}  // namespace sigmax
