#pragma once

#include <iosfwd>

#include <sigmax/core/network.hpp>

namespace sigmax {

/// Writes the network in the DOT language of Graphviz: an arrow from every parent to its child, random variables as
/// ellipses, fuzzy ones as boxes.
void write_graphviz(std::ostream& out, const RelationNetwork& network);

}  // namespace sigmax
