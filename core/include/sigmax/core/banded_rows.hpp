#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <vector>

#include <sigmax/core/entries.hpp>

namespace sigmax {

/// One row of a banded table: numbers from column `first` on.
struct BandOfRow {
  std::size_t first;
  std::vector<double> values;
};

/// A table of which each row stores a run of columns.
///
///     BandedRows{{0, {0.9, 0.1}}, {1, {0.4, 0.6}}}
class BandedRows {
 public:
  explicit BandedRows(std::size_t columns = 0) : columns_(columns) {}
  BandedRows(std::initializer_list<BandOfRow> rows);

  /// Appends a row.
  void append(std::size_t first, std::span<const double> values);

  /// Appends a row of `size` equal numbers.
  void append(std::size_t first, std::size_t size, double value) { append(first, std::vector<double>(size, value)); }

  std::size_t rows() const { return rows_.size(); }
  std::size_t columns() const { return columns_; }
  std::size_t stored() const { return values_.size(); }
  void widen(std::size_t columns) { columns_ = columns > columns_ ? columns : columns_; }

  std::size_t offset(std::size_t r) const { return rows_[r].offset; }
  RunOfEntries entries(std::size_t r) const&& = delete;
  RunOfEntries entries(std::size_t r) const& {
    return {rows_[r].first, {values_.data() + rows_[r].offset, rows_[r].size}};
  }
  double at(std::size_t r, std::size_t column) const { return detail::AnyEntries(entries(r)).at(column); }
  std::span<double> values(std::size_t r) & { return {values_.data() + rows_[r].offset, rows_[r].size}; }

 private:
  struct Row {
    std::size_t first, offset, size;
  };
  std::size_t columns_ = 0;
  std::vector<Row> rows_;
  std::vector<double> values_;
};

}  // namespace sigmax
