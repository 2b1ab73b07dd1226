#include <sigmax/core/network/compose.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "solve.hpp"

namespace sigmax {

using elimination::Role;
using elimination::Vertex;

namespace {

/// The joint of `asked` that these tables give without evidence.
elimination::Factor joint(const RelationNetwork& network, const std::vector<Vertex>& tables,
                          const std::vector<Vertex>& asked, std::size_t table_limit) {
  const auto findings = elimination::findings_of(network, {});
  const auto parts = elimination::parts_of(network, tables, findings, asked);
  const auto order = elimination::order_of_elimination(elimination::order_problem(network, parts, asked));
  return elimination::joint(network, parts, findings, order, asked, table_limit);
}

}  // namespace

ComposedRelation compose(const RelationNetwork& network, std::string_view from_name, std::string_view to_name,
                         std::size_t table_limit) {
  const Vertex from = network.index_of(from_name), to = network.index_of(to_name);
  if (from == to) throw std::invalid_argument("compose: '" + std::string(from_name) + "' is given twice");
  const NetworkVariable& from_variable = network[from].variable;
  const NetworkVariable& to_variable = network[to].variable;

  auto tables = elimination::relevant(network, {to}, from);
  const auto ancestors = elimination::relevant(network, network[from].parents);
  const bool only_away_from =
      std::find_first_of(tables.begin(), tables.end(), ancestors.begin(), ancestors.end()) == tables.end();
  std::optional<elimination::Factor> marginal;
  if (!only_away_from) {
    tables = elimination::relevant(network, {from, to});
    marginal = joint(network, elimination::relevant(network, {from}), {from}, table_limit);
  }
  const auto numbers = joint(network, tables, {from, to}, table_limit);

  const auto parts = elimination::parts_of(network, tables, elimination::findings_of(network, {}), {from, to});
  auto problem = elimination::order_problem(network, parts, {from});
  problem.roles[to] = Role::kept;
  const bool induced = !elimination::order_of_elimination(problem).complete;

  Table rows(from_variable.size(), to_variable.size());
  std::vector<std::size_t> unreachable;
  for (std::size_t r = 0; r < rows.rows(); ++r) {
    const ScaledNumber divisor = marginal ? marginal->values[r] : ScaledNumber{1.0};
    if (divisor.is_zero()) {
      unreachable.push_back(r);
      to_variable.visit([&](const auto& variable) {
        const Distribution nothing_known = uninformative(variable);
        std::copy_n(nothing_known.values().begin(), rows.columns(), rows.row(r).begin());
      });
      continue;
    }
    for (std::size_t c = 0; c < rows.columns(); ++c) rows(r, c) = numbers.values[r * rows.columns() + c].over(divisor);
  }
  return {to_variable, from_variable, std::move(rows), induced, std::move(unreachable)};
}

}  // namespace sigmax
