#pragma once

#include <cstddef>
#include <vector>

#include <sigmax/core/choices.hpp>

namespace sigmax {

/// Which column each row takes.
struct Assignment {
  std::vector<std::size_t> columns;  ///< of each row, `no_column` if it takes none
  double cost;                       ///< the sum of the costs of what rows take
};

/// The assignment of least total cost: each row takes one column or none, no column is taken twice.
///
///     const Assignment best = assign(costs);   // costs.add_row(cost of none, {{column, cost}, …})
///
/// Costs may be negative; +∞ excludes a choice, so none = +∞ asks for a column. Where totals tie within
/// `tie_tolerance`, the first row takes the first column that it can, then the second row, and so on; no column comes
/// after all columns.
///
/// Successive shortest paths by Dijkstra's algorithm with potentials (Jonker and Volgenant, Computing 38, 1987) on
/// sparse rows. Throws std::invalid_argument for NaN and −∞, std::domain_error, naming a row, if there is no
/// assignment.
Assignment assign(const Choices& costs);

}  // namespace sigmax
