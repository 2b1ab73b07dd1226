#include "kernels/transpose.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

namespace sigmax::kernels {
namespace {

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

}  // namespace

void transpose(const AnyRows& rows, AnyRows& columns) {
  if (const auto* const table = std::get_if<Table>(&rows))
    transpose(*table, as_table(columns));
  else if (const auto* const sparse = std::get_if<SparseRows>(&rows))
    columns = transposed(*sparse);
  else
    columns = transposed(std::get<BandedRows>(rows));
}

}  // namespace sigmax::kernels
