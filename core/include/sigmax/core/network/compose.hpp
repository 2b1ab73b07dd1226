#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/core/induced.hpp>
#include <sigmax/core/network.hpp>
#include <sigmax/core/network/query.hpp>

namespace sigmax {

/// What a network says of one variable given another, their kinds known only when the program runs.
class ComposedRelation {
 public:
  ComposedRelation(NetworkVariable to, NetworkVariable from, Table table, bool induced,
                   std::vector<std::size_t> unreachable)
      : to_(std::move(to)),
        from_(std::move(from)),
        table_(std::move(table)),
        induced_(induced),
        unreachable_(std::move(unreachable)) {}

  const NetworkVariable& to() const& { return to_; }
  NetworkVariable to() const&& { return to_; }
  const NetworkVariable& from() const& { return from_; }
  NetworkVariable from() const&& { return from_; }
  const Table& table() const& { return table_; }  ///< a row per outcome of `from`
  Table table() && { return std::move(table_); }

  /// Whether the rows are only induced, (17), (18): not normalised, each with its own β.
  bool induced() const { return induced_; }

  /// Outcomes of `from` that nothing reaches; their rows are uninformative, as in `invert`.
  const std::vector<std::size_t>& unreachable() const& { return unreachable_; }
  std::vector<std::size_t> unreachable() const&& { return unreachable_; }

  /// The same with the kinds that the caller knows: a Relation, or what is only induced of one.
  template <NetworkKind To, NetworkKind From>
  std::variant<Relation<To, From>, Induced<Relation<To, From>>> relation() const {
    if (induced_) return Induced<Relation<To, From>>{to_.as<To>(), from_.as<From>(), table_, detail::ByLaw{}};
    return Relation<To, From>{to_.as<To>(), from_.as<From>(), table_, detail::ByLaw{}};
  }

 private:
  NetworkVariable to_;
  NetworkVariable from_;
  Table table_;
  bool induced_;
  std::vector<std::size_t> unreachable_;
};

/// The variable `to` given the variable `from`: every variable between them, and every one that bears on `to` besides,
/// is eliminated innermost first.
///
/// Where `from` bears on `to` only along paths away from `from`, it is the composition of the tables on these paths,
/// (6), (7), (17), (18), whatever the table of `from` itself. Else (a common ancestor, or a path backwards) it is the
/// joint of both over the marginal of `from`; of random variables it always is p(to|from). Throws std::invalid_argument
/// if one is not the network's, or both are the same, and std::length_error as `query` does.
ComposedRelation compose(const RelationNetwork& network, std::string_view from, std::string_view to,
                         std::size_t table_limit = default_table_limit);

}  // namespace sigmax
