#pragma once

#include <cstddef>
#include <vector>

#include "factor.hpp"
#include "solve.hpp"

namespace sigmax::elimination {

/// What a calibrated tree of cliques tells.
struct Calibrated {
  std::vector<std::vector<ScaledNumber>> marginals;  ///< by index of the vertex; empty if it is not in the order
  ScaledNumber total;                                ///< ⊕ over everything; if it is zero there are no marginals
};

/// All marginals of the product of the factors. The variables of `order` are of one kind and all that the factors have.
///
/// The cliques are those that eliminating in this order makes, each within another left out. Every clique first hands
/// on to the next what it and those behind it say of the variables that both have, the outermost ones being last; on
/// the way back it is told what all say of them, which is divided by what it said itself (0/0 = 0: there it has only
/// zeros). Marginals then are those of single cliques. It takes time and memory in proportion to the cliques' tables.
///
/// The numbers are doubles with one exponent a table. Should a product come near the limit of their range, everything
/// is done again with an exponent for each number, so nothing underflows. All marginals have the same ⊕, the total.
Calibrated calibrated(const RelationNetwork& network, const std::vector<Factor>& factors,
                      const std::vector<Vertex>& order);

}  // namespace sigmax::elimination
