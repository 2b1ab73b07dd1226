#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <sigmax/core/entries.hpp>

namespace sigmax {

/// One number of a sparse row.
struct Entry {
  std::size_t column;
  double value;
};

/// A table of which each row stores only some of its columns.
///
///     SparseRows{{{0, 0.3}, {7, 1.0}}, {{7, 1.0}}}   // a row per outcome of the condition: column, value
class SparseRows {
 public:
  explicit SparseRows(std::size_t columns = 0) : columns_(columns) {}
  SparseRows(std::initializer_list<std::initializer_list<Entry>> rows) {
    for (const auto& row : rows) append(row);
  }

  /// The arrays of compressed sparse rows as they are: row r has entries `ends[r − 1]` up to `ends[r]`.
  /// Throws std::invalid_argument if the arrays do not fit together.
  SparseRows(std::size_t columns, std::span<const std::size_t> ends, std::vector<std::size_t> indices,
             std::vector<double> values)
      : columns_(columns), indices_(std::move(indices)), values_(std::move(values)) {
    for (const std::size_t end : ends) {
      if (end < end_) throw std::invalid_argument("the ends of sparse rows do not ascend");
      extents_.push_back({end_, end - end_});
      end_ = end;
    }
    if (indices_.size() != values_.size() || end_ != values_.size())
      throw std::invalid_argument("sparse rows need as many columns as values, and their last end to be that number");
    for (const std::size_t index : indices_) columns_ = std::max(columns_, index + 1);
  }

  /// Appends a row; its columns ascend.
  void append(std::span<const Entry> row) {
    for (const Entry& entry : row) append_entry(entry.column, entry.value);
    end_row();
  }
  void append(std::initializer_list<Entry> row) { append(std::span(row.begin(), row.size())); }

  /// Appends a row entry by entry: the entries, then `end_row`.
  void append_entry(std::size_t column, double value) {
    columns_ = std::max(columns_, column + 1);
    indices_.push_back(column);
    values_.push_back(value);
  }
  void end_row() {
    extents_.push_back({end_, values_.size() - end_});
    end_ = values_.size();
  }

  /// Makes rows share one further row of equal numbers in every column: what is stored grows by one row only.
  void fill_rows(std::span<const std::size_t> rows, double value) {
    if (rows.empty()) return;
    for (std::size_t column = 0; column < columns_; ++column) append_entry(column, value);
    for (const std::size_t row : rows) extents_[row] = {end_, columns_};
    end_ = values_.size();
  }

  std::size_t rows() const { return extents_.size(); }
  std::size_t columns() const { return columns_; }
  std::size_t stored() const { return values_.size(); }
  void widen(std::size_t columns) { columns_ = std::max(columns_, columns); }

  /// Where row r begins among the stored numbers.
  std::size_t offset(std::size_t r) const { return extents_[r].first; }
  ListOfEntries entries(std::size_t r) const&& = delete;
  ListOfEntries entries(std::size_t r) const& {
    const auto [first, size] = extents_[r];
    return {std::span(indices_).subspan(first, size), std::span(values_).subspan(first, size)};
  }
  double at(std::size_t r, std::size_t column) const {
    const ListOfEntries row = entries(r);
    const auto found = std::lower_bound(row.columns.begin(), row.columns.end(), column);
    if (found == row.columns.end() || *found != column) return 0.0;
    return row.value(static_cast<std::size_t>(found - row.columns.begin()));
  }
  std::span<double> values(std::size_t r) & {
    return std::span(values_).subspan(extents_[r].first, extents_[r].second);
  }

 private:
  std::size_t columns_ = 0, end_ = 0;
  std::vector<std::pair<std::size_t, std::size_t>> extents_;  // of each row: first, size
  std::vector<std::size_t> indices_;
  std::vector<double> values_;
};

}  // namespace sigmax
