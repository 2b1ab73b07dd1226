#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/core/relation.hpp>

namespace sigmax {

/// Variables of the kinds that can meet in one network; all that a network knows of them. They are mixable: their ⊗ is
/// the product.
using NetworkKinds = std::variant<RandomVariable, FuzzyVariable>;

template <class Kind>
concept NetworkKind = std::constructible_from<NetworkKinds, Variable<Kind>>;

/// A variable whose kind is known only when the program runs.
class NetworkVariable {
 public:
  template <NetworkKind Kind>
  NetworkVariable(Variable<Kind> variable) : variable_(std::move(variable)) {}

  /// Calls `action` with the Variable<Kind> that it is.
  template <class Action>
  decltype(auto) visit(const Action& action) const {
    return std::visit(action, variable_);
  }

  /// The number of its kind among the kinds of networks.
  std::size_t kind() const { return variable_.index(); }

  template <NetworkKind Kind>
  bool is() const {
    return std::holds_alternative<Variable<Kind>>(variable_);
  }

  /// Throws std::invalid_argument if the variable is of another kind.
  template <NetworkKind Kind>
  const Variable<Kind>& as() const& {
    if (const auto* const variable = std::get_if<Variable<Kind>>(&variable_)) return *variable;
    check::other_kind(name(), kind_name(), Kind::name);
  }

  template <NetworkKind Kind>
  Variable<Kind> as() const&& {
    const NetworkVariable& named = *this;
    return named.as<Kind>();
  }

  /// "random" or "fuzzy".
  std::string_view kind_name() const {
    return visit([]<class Kind>(const Variable<Kind>&) { return Kind::name; });
  }
  const Outcomes& outcomes() const& {
    return visit([](const Outcomes& outcomes) -> const Outcomes& { return outcomes; });
  }
  Outcomes outcomes() const&& {
    return visit([](const Outcomes& outcomes) { return outcomes; });
  }
  const std::string& name() const& { return outcomes().name(); }
  std::string name() const&& { return outcomes().name(); }
  std::size_t size() const { return outcomes().size(); }
  std::string label(std::size_t index) const { return outcomes().label(index); }
  std::size_t index_of(std::string_view label) const { return outcomes().index_of(label); }

  friend bool operator==(const NetworkVariable& a, const NetworkVariable& b) {
    return a.kind() == b.kind() && a.outcomes() == b.outcomes();
  }

 private:
  NetworkKinds variable_;
};

/// Variables of either kind, each with a table of itself given any number of variables declared before it.
///
///     RelationNetwork network;
///     network.declare(uninformative(age));
///     network.declare(mood_given_age);                               // one parent: a Relation
///     network.declare(speed, {age, mood}, {{0.9, 0.1}, …});          // a row per age and mood, the last fastest
///
/// What it means: the product of all tables, from which the variables are eliminated innermost first, each by the ⊕ of
/// its own kind, in the reverse order of declaration. Every table is normalised, so that without evidence the total is
/// one. Among variables of different kinds that order is part of the meaning, as in (10) and (11).
class RelationNetwork {
 public:
  struct Vertex {
    NetworkVariable variable;
    std::vector<std::size_t> parents;  ///< indices of vertices, all lower than its own
    AnyRows rows;                      ///< a row per outcome of the parents; the last parent varies fastest

    /// All rows as one dense table.
    Table table() const { return dense_table(rows); }
  };

  /// A variable without parents. Throws std::invalid_argument if one of its name was declared.
  template <NetworkKind Kind>
  void declare(const Distribution<Kind>& distribution) {
    append(distribution.variable(), {}, distribution.table());
  }

  /// A variable with one parent, `relation.from()`. Throws std::invalid_argument if that was not declared.
  template <NetworkKind To, NetworkKind From>
  void declare(const Relation<To, From>& relation) {
    append(relation.to(), {relation.from()}, relation.rows());
  }

  /// A variable with any number of parents. Throws std::invalid_argument, naming variable, row and value, if a parent
  /// was not declared before it (so no cycle can be made), if the sizes do not fit, or if a row is no distribution.
  void declare(const NetworkVariable& variable, const std::vector<NetworkVariable>& parents,
               const std::vector<std::vector<double>>& rows);

  /// The same of rows that store only some of their numbers: none is ever made dense but by a query that needs it.
  void declare(const NetworkVariable& variable, const std::vector<NetworkVariable>& parents, SparseRows rows);

  std::size_t size() const { return vertices_.size(); }

  /// Views that live as long as the network and nothing more is declared; of a temporary, copies.
  std::span<const Vertex> vertices() const& { return {vertices_.data(), vertices_.size()}; }
  std::vector<Vertex> vertices() const&& { return vertices_; }
  const Vertex& operator[](std::size_t index) const& { return vertices_[index]; }
  Vertex operator[](std::size_t index) const&& { return vertices_[index]; }

  /// The variable of this name. Throws std::invalid_argument if there is none, or it is of another kind.
  ///
  ///     network.variable<Fuzzy>("age")
  template <NetworkKind Kind>
  Variable<Kind> variable(std::string_view name) const {
    return (*this)[index_of(name)].variable.template as<Kind>();
  }

  /// The distribution of random variable `v` given outcomes of all variables before it. Throws std::invalid_argument if
  /// it is not random.
  Distribution<Random> given(std::size_t v, std::span<const std::size_t> outcomes) const;

  /// Throws std::invalid_argument if no such variable was declared.
  std::size_t index_of(std::string_view name) const;
  std::size_t index_of(const NetworkVariable& variable) const;

 private:
  friend RelationNetwork as_fuzzy(const RelationNetwork&,
                                  const std::function<std::vector<double>(std::span<const double>)>&,
                                  const std::vector<std::string>&);
  void append(const NetworkVariable& variable, const std::vector<NetworkVariable>& parents, AnyRows rows);

  std::vector<Vertex> vertices_;
  std::map<std::string, std::size_t, std::less<>> by_name_;  // the indices of all vertices
};

}  // namespace sigmax
