#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <sigmax/core/table.hpp>

namespace sigmax {

/// What a row has that takes no column.
inline constexpr std::size_t no_column = std::numeric_limits<std::size_t>::max();

/// What rows may choose: each row some columns, with a number each, or no column, with a number, too. In a
/// matching the numbers are logarithms of weights. Rows are sparse: a column that is not listed is excluded.
///
///     Choices log_weights;
///     log_weights.add_row(0.0, {{0, 1.5}, {2, 4.0}});   // row 0: column 0 at 1.5, column 2 at 4, none at 0
class Choices {
 public:
  struct Entry {
    std::size_t column;
    double value;
  };

  /// Appends a row with the number of no column; its columns ascend. Throws std::invalid_argument if they do not.
  void add_row(double none, const std::vector<Entry>& entries = {});

  /// Appends a column to the last row; it is beyond the row's others, or std::invalid_argument is thrown.
  void add(std::size_t column, double value);

  /// Removes all rows and keeps the memory.
  void clear();

  std::size_t rows() const { return none_.size(); }

  /// One more than the greatest column that was added.
  std::size_t columns() const { return width_; }

  /// How many entries all rows have, and the number among them of a row's first one.
  std::size_t size() const { return values_.size(); }
  std::size_t offset(std::size_t row) const { return first_[row]; }

  ListOfEntries entries(std::size_t row) const {
    const std::size_t first = first_[row], size = (row + 1 < rows() ? first_[row + 1] : values_.size()) - first;
    return {{columns_.data() + first, size}, {values_.data() + first, size}};
  }
  double none(std::size_t row) const { return none_[row]; }

  /// The same numbers, to be changed.
  std::span<double> values(std::size_t row) { return {values_.data() + first_[row], entries(row).size()}; }
  double& none(std::size_t row) { return none_[row]; }

 private:
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> columns_;
  std::vector<double> values_, none_;
  std::size_t width_ = 0;
};

}  // namespace sigmax
