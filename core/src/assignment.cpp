#include <sigmax/core/assignment.hpp>

#include <limits>

#include "alternating_paths.hpp"

namespace sigmax {

Assignment assign(const Choices& costs) {
  check::choices(costs, std::numeric_limits<double>::infinity(), "the cost");
  detail::AlternatingPaths paths;
  if (const std::size_t failed = paths.assign(costs); failed != no_column) check::no_column_left(failed);
  Assignment result{{}, 0.0};
  for (std::size_t row = 0; row < costs.rows(); ++row) {
    result.columns.push_back(paths.choice(row));
    result.cost += paths.cost(row);
  }
  return result;
}

}  // namespace sigmax
