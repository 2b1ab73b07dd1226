#include <sigmax/core/network.hpp>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>
#include <variant>

#include <sigmax/core/network/transform.hpp>

#include "solve.hpp"

namespace sigmax {
namespace {

/// The condition of row `row`, for a message: one outcome of all parents together, "(age, mood)" = "(old, calm)".
Outcomes condition(const std::vector<NetworkVariable>& parents, std::size_t row) {
  std::string names;
  for (const auto& parent : parents) names += (names.empty() ? "" : ", ") + parent.name();
  const std::string labels = labels_of_row(parents, row);
  if (parents.size() == 1) return {names, {labels}};
  return {"(" + names + ")", {"(" + labels + ")"}};
}

/// Runs prove(variable of its kind, row's condition, row) for every row; only where that throws is the condition put
/// into words.
template <class Prove>
void prove_rows(const NetworkVariable& variable, const std::vector<NetworkVariable>& parents, std::size_t rows,
                const Prove& prove) {
  std::size_t expected = 1;
  for (const auto& parent : parents) expected *= parent.size();
  if (rows != expected)
    throw std::invalid_argument("the table of '" + variable.name() + "' needs " + std::to_string(expected) +
                                " rows, one for the outcomes of its parents together, but " + std::to_string(rows) +
                                " were given");
  variable.visit([&](const auto& typed) {
    for (std::size_t row = 0; row < rows; ++row) {
      try {
        prove(typed, check::Row{}, row);
      } catch (const std::invalid_argument&) {
        if (parents.empty()) throw;
        const Outcomes given = condition(parents, row);
        prove(typed, check::Row{&given, 0}, row);
      }
    }
  });
}

}  // namespace

void RelationNetwork::declare(const NetworkVariable& variable, const std::vector<NetworkVariable>& parents,
                              const std::vector<std::vector<double>>& rows) {
  Table table(rows.size(), variable.size());
  prove_rows(variable, parents, rows.size(),
             [&]<class Kind>(const Variable<Kind>& typed, check::Row condition, std::size_t row) {
               prove_normalized<Kind>(typed, condition, rows[row]);
               std::copy(rows[row].begin(), rows[row].end(), table.row(row).begin());
             });
  append(variable, parents, std::move(table));
}

void RelationNetwork::declare(const NetworkVariable& variable, const std::vector<NetworkVariable>& parents,
                              SparseRows rows) {
  prove_rows(variable, parents, rows.rows(),
             [&]<class Kind>(const Variable<Kind>& typed, check::Row condition, std::size_t row) {
               detail::prove_entries(typed, condition, rows.entries(row), detail::algebra_of<Kind>(), Kind::total);
             });
  rows.widen(variable.size());
  append(variable, parents, std::move(rows));
}

Distribution<Random> RelationNetwork::given(std::size_t v, std::span<const std::size_t> outcomes) const {
  const RandomVariable& variable = vertices_[v].variable.as<Random>();
  std::size_t row = 0;
  for (const std::size_t parent : vertices_[v].parents)
    row = row * vertices_[parent].variable.size() + outcomes[parent];
  return {variable, detail::dense_row(vertices_[v].rows, row), detail::ByLaw{}};
}

std::size_t RelationNetwork::index_of(std::string_view name) const {
  const auto found = by_name_.find(name);
  if (found == by_name_.end()) throw std::invalid_argument("the network has no variable '" + std::string(name) + "'");
  return found->second;
}

std::size_t RelationNetwork::index_of(const NetworkVariable& variable) const {
  const std::size_t index = index_of(variable.name());
  const NetworkVariable& own = vertices_[index].variable;
  if (own.kind_name() != variable.kind_name())
    throw std::invalid_argument("variable '" + own.name() + "' of the network is " + std::string(own.kind_name()) +
                                ", not " + std::string(variable.kind_name()));
  check::same(own.outcomes(), variable.outcomes(), "RelationNetwork");
  return index;
}

void RelationNetwork::append(const NetworkVariable& variable, const std::vector<NetworkVariable>& parents,
                             AnyRows rows) {
  if (by_name_.contains(variable.name()))
    throw std::invalid_argument("variable '" + variable.name() + "' is declared twice");
  std::vector<std::size_t> indices;
  for (const auto& parent : parents) {
    if (!by_name_.contains(parent.name()))
      throw std::invalid_argument("variable '" + variable.name() + "' has the parent '" + parent.name() +
                                  "', which is not declared before it");
    const std::size_t index = index_of(parent);
    if (std::find(indices.begin(), indices.end(), index) != indices.end())
      throw std::invalid_argument("variable '" + variable.name() + "' has the parent '" + parent.name() + "' twice");
    indices.push_back(index);
  }
  vertices_.push_back({variable, std::move(indices), std::move(rows)});
  by_name_.emplace(variable.name(), vertices_.size() - 1);
}

RelationNetwork as_fuzzy(const RelationNetwork& network, const RowTransform& transform) {
  std::vector<std::string> names;
  for (const auto& vertex : network.vertices())
    if (vertex.variable.is<Random>()) names.push_back(vertex.variable.name());
  return as_fuzzy(network, transform, names);
}

RelationNetwork as_fuzzy(const RelationNetwork& network, const RowTransform& transform,
                         const std::vector<std::string>& names) {
  std::set<std::size_t> chosen;
  for (const auto& name : names) {
    chosen.insert(network.index_of(name));
    network[network.index_of(name)].variable.as<Random>();  // throws if it is not
  }
  RelationNetwork result;
  for (std::size_t v = 0; v < network.size(); ++v) {
    const auto& [variable, parents, table] = network[v];
    std::vector<NetworkVariable> conditions;
    for (const std::size_t parent : parents) conditions.push_back(result[parent].variable);
    if (!chosen.contains(v)) {
      result.append(variable, conditions, table);
      continue;
    }
    const FuzzyVariable fuzzy = interpreted_as<Fuzzy>(variable.outcomes());
    result.append(fuzzy, conditions, detail::transformed<Fuzzy>(table, fuzzy, nullptr, transform));
  }
  return result;
}

}  // namespace sigmax
