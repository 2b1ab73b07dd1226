#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/core/rows.hpp>

namespace sigmax::kernels {

/// Rows as columns, in time proportional to what is stored.
template <class Rows>
SparseRows transposed(const Rows& rows) {
  std::vector<std::size_t> ends(rows.columns() + 1, 0);  // at first of the column before
  for (std::size_t r = 0; r < rows.rows(); ++r) {
    const auto entries = rows.entries(r);
    for (std::size_t k = 0; k < entries.size(); ++k) ++ends[entries.index(k) + 1];
  }
  for (std::size_t column = 0; column < rows.columns(); ++column) ends[column + 1] += ends[column];
  SparseRows::Columns indices(ends.back());
  SparseRows::Values values(ends.back());
  for (std::size_t r = 0; r < rows.rows(); ++r) {
    const auto entries = rows.entries(r);
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const std::size_t at = ends[entries.index(k)]++;
      indices[at] = static_cast<std::uint32_t>(r);
      values[at] = entries.value(k);
    }
  }
  ends.pop_back();
  return {rows.rows(), ends, std::move(indices), std::move(values)};
}

/// The columns of a table, each as the entries of a row: of a dense one where they are, without a copy.
struct ColumnsOfTable {
  struct Column {
    const double* first;
    std::size_t step, rows;
    std::size_t size() const { return rows; }
    std::size_t index(std::size_t k) const { return k; }
    double value(std::size_t k) const { return first[k * step]; }
  };
  const Table& table;
  Column entries(std::size_t column) const { return {table.data() + column, table.columns(), table.rows()}; }
};
inline ColumnsOfTable columns_of(const Table& table) { return {table}; }
template <class Rows>
SparseRows columns_of(const Rows& rows) {
  return transposed(rows);
}

inline void transpose(const Table& table, Table& columns) {
  columns.reshape(table.columns(), table.rows());
  for (std::size_t r = 0; r < table.rows(); ++r)
    for (std::size_t c = 0; c < table.columns(); ++c) columns(c, r) = table(r, c);
}

/// Rows as columns, written into `result`: dense if they are, and then nothing is allocated that has room.
inline void transpose(const AnyRows& rows, AnyRows& result) {
  if (const Table* const table = std::get_if<Table>(&rows)) {
    transpose(*table, as_table(result));
  } else if (const auto* const sparse = std::get_if<SparseRows>(&rows)) {
    result = transposed(*sparse);
  } else {
    result = transposed(std::get<BandedRows>(rows));
  }
}

}  // namespace sigmax::kernels
