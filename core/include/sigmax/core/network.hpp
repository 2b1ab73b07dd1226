#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <sigmax/core/network/variable.hpp>
#include <sigmax/core/relation.hpp>

namespace sigmax {

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
    AnyRows rows;                      ///< a row per outcome of the parents, of which the last varies fastest

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

  /// Where the index of a variable of this name is, or would be, in `by_name_`.
  std::vector<std::size_t>::const_iterator place_of(std::string_view name) const;
  bool has(std::string_view name) const;

  std::vector<Vertex> vertices_;
  std::vector<std::size_t> by_name_;  // the indices of all vertices, in the order of the names
};

}  // namespace sigmax
