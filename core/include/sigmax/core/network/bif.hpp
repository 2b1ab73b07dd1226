#pragma once

#include <iosfwd>
#include <string_view>

#include <sigmax/core/network.hpp>

namespace sigmax {

/// How far from one the printed sum of a row of a BIF file may lie.
inline constexpr double bif_tolerance = 1e-3;

/// Reads a network of random variables in the Bayesian Interchange Format, version 0.15. Variables may be declared in
/// any order; in the network they stand parents first and else in the order of the file.
///
/// Printed probabilities are rounded: a row whose sum is within `bif_tolerance` of one is divided by it. A `table` of a
/// variable with parents lists the outcomes of the variable slowest and those of the last parent fastest, and a row
/// that is not listed is the `default`. Properties are skipped.
///
/// Throws std::invalid_argument that gives file (by `name`), line, what was found and what was expected.
RelationNetwork read_bif(std::istream& in, std::string_view name);

/// Writes a network of random variables in the same format, every number with the digits that it takes to read it
/// again. Throws std::invalid_argument, with nothing written, for a fuzzy variable or a name with a quotation mark.
void write_bif(std::ostream& out, const RelationNetwork& network, std::string_view name);

}  // namespace sigmax
