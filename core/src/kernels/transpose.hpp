#pragma once

#include <cstddef>

#include <sigmax/core/rows.hpp>

namespace sigmax::kernels {

/// Rows as columns, written into the second: dense if the rows are, and then nothing is allocated that has room; else
/// sparse, in time proportional to what is stored.
inline void transpose(const Table& table, Table& columns) {
  columns.reshape(table.columns(), table.rows());
  for (std::size_t r = 0; r < table.rows(); ++r)
    for (std::size_t c = 0; c < table.columns(); ++c) columns(c, r) = table(r, c);
}
void transpose(const AnyRows& rows, AnyRows& columns);

}  // namespace sigmax::kernels
