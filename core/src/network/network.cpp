#include <sigmax/core/network.hpp>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>
#include <variant>

#include <sigmax/core/network/transform.hpp>

#include "row_label.hpp"

namespace sigmax {
namespace {

/// The condition of row `row`, for a message: one outcome of all parents together, "(age, mood)" = "(old, calm)".
Outcomes condition(const std::vector<NetworkVariable>& parents, std::size_t row) {
  std::string names;
  std::vector<Outcomes> outcomes;
  for (const auto& parent : parents) {
    names += (names.empty() ? "" : ", ") + parent.name();
    outcomes.push_back(parent.outcomes());
  }
  const std::string labels = labels_of_row(outcomes, row);
  if (parents.size() == 1) return {names, {labels}};
  return {"(" + names + ")", {"(" + labels + ")"}};
}

/// Runs `prove(row)`; only where that throws is the row's condition put into words.
template <class Prove>
void prove_row(const std::vector<NetworkVariable>& parents, std::size_t row, const Prove& prove) {
  try {
    prove(check::Row{});
  } catch (const std::invalid_argument&) {
    if (parents.empty()) throw;
    const Outcomes given = condition(parents, row);
    prove(check::Row{&given, 0});
  }
}

void prove_number_of_rows(const NetworkVariable& variable, const std::vector<NetworkVariable>& parents,
                          std::size_t rows) {
  std::size_t expected = 1;
  for (const auto& parent : parents) expected *= parent.size();
  if (rows != expected)
    throw std::invalid_argument("the table of '" + variable.name() + "' needs " + std::to_string(expected) +
                                " rows, one for the outcomes of its parents together, but " + std::to_string(rows) +
                                " were given");
}

}  // namespace

void RelationNetwork::declare(const NetworkVariable& variable, const std::vector<NetworkVariable>& parents,
                              const std::vector<std::vector<double>>& rows) {
  prove_number_of_rows(variable, parents, rows.size());
  Table table(rows.size(), variable.size());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    variable.visit([&]<class Kind>(const Variable<Kind>& typed) {
      prove_row(parents, row, [&](check::Row at) { prove_normalized<Kind>(typed, at, rows[row]); });
    });
    std::copy(rows[row].begin(), rows[row].end(), table.row(row).begin());
  }
  append(variable, parents, std::move(table));
}

void RelationNetwork::declare(const NetworkVariable& variable, const std::vector<NetworkVariable>& parents,
                              SparseRows rows) {
  prove_number_of_rows(variable, parents, rows.rows());
  for (std::size_t row = 0; row < rows.rows(); ++row)
    variable.visit([&]<class Kind>(const Variable<Kind>& typed) {
      prove_row(parents, row, [&](check::Row at) {
        detail::prove_entries(typed, at, rows.entries(row), detail::algebra_of<Kind>(), Kind::total);
      });
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
  const auto place = place_of(name);
  if (place == by_name_.end() || vertices_[*place].variable.name() != name)
    throw std::invalid_argument("the network has no variable '" + std::string(name) + "'");
  return *place;
}

std::vector<std::size_t>::const_iterator RelationNetwork::place_of(std::string_view name) const {
  return std::lower_bound(by_name_.begin(), by_name_.end(), name, [this](std::size_t v, std::string_view other) {
    return vertices_[v].variable.name() < other;
  });
}

bool RelationNetwork::has(std::string_view name) const {
  const auto place = place_of(name);
  return place != by_name_.end() && vertices_[*place].variable.name() == name;
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
  if (has(variable.name())) throw std::invalid_argument("variable '" + variable.name() + "' is declared twice");
  std::vector<std::size_t> indices;
  for (const auto& parent : parents) {
    if (!has(parent.name()))
      throw std::invalid_argument("variable '" + variable.name() + "' has the parent '" + parent.name() +
                                  "', which is not declared before it");
    const std::size_t index = index_of(parent);
    if (std::find(indices.begin(), indices.end(), index) != indices.end())
      throw std::invalid_argument("variable '" + variable.name() + "' has the parent '" + parent.name() + "' twice");
    indices.push_back(index);
  }
  const auto place = place_of(variable.name()) - by_name_.begin();
  vertices_.push_back({variable, std::move(indices), std::move(rows)});
  by_name_.insert(by_name_.begin() + place, vertices_.size() - 1);
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
