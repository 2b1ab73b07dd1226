#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <sigmax/core/outcomes.hpp>

namespace sigmax {

/// The outcomes of the parents in one row of a table, the last parent fastest: "young, calm".
inline std::string labels_of_row(const std::vector<Outcomes>& parents, std::size_t row) {
  std::string labels;
  for (std::size_t p = parents.size(); p-- > 0;) {
    labels = parents[p].label(row % parents[p].size()) + (labels.empty() ? "" : ", ") + labels;
    row /= parents[p].size();
  }
  return labels;
}

}  // namespace sigmax
