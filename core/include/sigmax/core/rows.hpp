#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include <sigmax/core/banded_rows.hpp>
#include <sigmax/core/sparse_rows.hpp>
#include <sigmax/core/table.hpp>

namespace sigmax {

/// How a relation stores its rows; chosen when it is constructed, and by a verb to fit its result.
using AnyRows = std::variant<Table, SparseRows, BandedRows>;

/// The dense table that a result is written to; allocates nothing if it is one already.
inline Table& as_table(AnyRows& rows) {
  if (Table* const table = std::get_if<Table>(&rows)) return *table;
  return rows.emplace<Table>(std::size_t{0}, std::size_t{0});
}

/// The sparse rows that a result is written to; keeps their memory if it is some already.
inline SparseRows& as_sparse_rows(AnyRows& rows) {
  if (SparseRows* const sparse = std::get_if<SparseRows>(&rows)) return *sparse;
  return rows.emplace<SparseRows>();
}

namespace detail {

/// action(r) once for every row that is stored: rows without a number of their own share one.
template <class Rows, class Action>
void for_each_stored_row(const Rows& rows, const Action& action) {
  std::vector<bool> done(rows.stored() + 1, false);  // by where a row begins
  for (std::size_t r = 0; r < rows.rows(); ++r) {
    if (done[rows.offset(r)]) continue;
    done[rows.offset(r)] = true;
    action(r);
  }
}

}  // namespace detail

/// The same numbers as a dense table.
template <class Rows>
Table dense_table(const Rows& rows) {
  Table result(rows.rows(), rows.columns());
  for (std::size_t r = 0; r < rows.rows(); ++r) {
    const auto entries = rows.entries(r);
    for (std::size_t k = 0; k < entries.size(); ++k) result(r, entries.index(k)) = entries.value(k);
  }
  return result;
}

}  // namespace sigmax
