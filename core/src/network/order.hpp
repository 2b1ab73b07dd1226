#pragma once

#include <cstddef>
#include <vector>

#include "factor.hpp"

namespace sigmax::elimination {

/// What becomes of a variable in a query.
enum class Role {
  absent,      ///< it is in no factor: not relevant, or its outcome is known
  fixed,       ///< held fixed while all others are eliminated, as if declared first
  kept,        ///< held fixed where it was declared: eliminations do not pass it unless they provably may
  eliminated,  ///< eliminated
};

/// The problem of ordering: by index of the vertex, which is its rank in the order of declaration.
struct OrderProblem {
  std::vector<std::size_t> sizes;
  std::vector<std::size_t> kinds;  ///< equal numbers for equal kinds
  std::vector<Role> roles;
  std::vector<std::vector<Vertex>> scopes;  ///< of the factors
};

struct Order {
  std::vector<Vertex> vertices;
  double greatest_table = 1.0;         ///< the most outcomes that one elimination ranges over
  std::vector<Vertex> greatest_scope;  ///< the variables of that elimination
  bool forced = false;                 ///< whether the kinds ever forbade a vertex of less fill than the one chosen
  bool complete = true;                ///< whether all that should be eliminated could be; false only if some are kept
};

/// Whether variables of different kinds are eliminated or kept.
bool of_two_kinds(const OrderProblem& problem);

/// Whether each variable can be eliminated last: it is eliminated, and every variable outside it that is joined to it,
/// also by way of those within it, has its kind and can be last too. All that can and are of one kind can be kept to
/// the last together, docs/networks.md.
std::vector<bool> can_be_last(const OrderProblem& problem);

/// An order of elimination that provably gives the value of the reverse order of declaration; by the least fill.
///
/// Eliminations of the same kind that follow each other may be exchanged. So may those of different kinds if no chain
/// of factors joins them through variables that are eliminated within both: the product then falls into two, and each ⊕
/// passes by the half that does not have its variable. A variable is free to be eliminated next if such exchanges bring
/// it innermost. Freedom is never lost, so the greedy choice cannot get stuck.
Order order_of_elimination(const OrderProblem& problem);

}  // namespace sigmax::elimination
