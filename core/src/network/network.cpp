#include <sigmax/core/network.hpp>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include <sigmax/core/network/transform.hpp>

namespace sigmax {
namespace {

/// The condition of row `row`, for a message: one outcome of all parents together, "(age, mood)" = "(old, calm)".
Outcomes condition(const std::vector<NetworkVariable>& parents, std::size_t row) {
  std::string names, labels;
  for (std::size_t p = parents.size(); p-- > 0;) {
    const NetworkVariable& parent = parents[p];
    names = parent.name() + (names.empty() ? "" : ", ") + names;
    labels = parent.label(row % parent.size()) + (labels.empty() ? "" : ", ") + labels;
    row /= parent.size();
  }
  if (parents.size() == 1) return {names, {labels}};
  return {"(" + names + ")", {"(" + labels + ")"}};
}

template <Uncertainty Kind>
void prove_row(const Variable<Kind>& variable, const std::vector<NetworkVariable>& parents, std::size_t row,
               const std::vector<double>& values) {
  try {
    prove_normalized<Kind>(variable, {}, values);
  } catch (const std::invalid_argument&) {
    if (parents.empty()) throw;
    const Outcomes given = condition(parents, row);
    prove_normalized<Kind>(variable, {&given, 0}, values);
  }
}

}  // namespace

void RelationNetwork::declare(const NetworkVariable& variable, const std::vector<NetworkVariable>& parents,
                              const std::vector<std::vector<double>>& rows) {
  std::size_t expected = 1;
  for (const auto& parent : parents) expected *= parent.size();
  if (rows.size() != expected)
    throw std::invalid_argument("the table of '" + variable.name() + "' needs " + std::to_string(expected) +
                                " rows, one for the outcomes of its parents together, but " +
                                std::to_string(rows.size()) + " were given");
  Table table(rows.size(), variable.size());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    variable.visit([&](const auto& typed) { prove_row(typed, parents, row, rows[row]); });
    std::copy(rows[row].begin(), rows[row].end(), table.row(row).begin());
  }
  append(variable, parents, std::move(table));
}

std::size_t RelationNetwork::index_of(std::string_view name) const {
  const auto found = index_.find(name);
  if (found == index_.end()) throw std::invalid_argument("the network has no variable '" + std::string(name) + "'");
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

void RelationNetwork::append(const NetworkVariable& variable, const std::vector<NetworkVariable>& parents, Table rows) {
  if (index_.contains(variable.name()))
    throw std::invalid_argument("variable '" + variable.name() + "' is declared twice");
  std::vector<std::size_t> indices;
  for (const auto& parent : parents) {
    if (!index_.contains(parent.name()))
      throw std::invalid_argument("variable '" + variable.name() + "' has the parent '" + parent.name() +
                                  "', which is not declared before it");
    const std::size_t index = index_of(parent);
    if (std::find(indices.begin(), indices.end(), index) != indices.end())
      throw std::invalid_argument("variable '" + variable.name() + "' has the parent '" + parent.name() + "' twice");
    indices.push_back(index);
  }
  vertices_.push_back({variable, std::move(indices), std::move(rows)});
  index_.emplace(variable.name(), vertices_.size() - 1);
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
    std::vector<std::vector<double>> rows;
    for (std::size_t r = 0; r < table.rows(); ++r) rows.emplace_back(table.row(r).begin(), table.row(r).end());
    if (!chosen.contains(v)) {
      result.declare(variable, conditions, rows);
      continue;
    }
    const FuzzyVariable fuzzy = interpreted_as<Fuzzy>(variable.outcomes());
    for (auto& row : rows) {
      const Distribution possibilities = normalized(fuzzy, transform(row));
      row.assign(possibilities.values().begin(), possibilities.values().end());
    }
    result.declare(fuzzy, conditions, rows);
  }
  return result;
}

}  // namespace sigmax
