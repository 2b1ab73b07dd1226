#include <sigmax/core/kernels/compose.hpp>

#include <cstddef>
#include <type_traits>
#include <variant>

#include "algebras.hpp"
#include "kernels/narrow.hpp"
#include "kernels/plain.hpp"
#include "kernels/sparse.hpp"
#include "kernels/tiled.hpp"

namespace sigmax::kernels {
namespace {

using sigmax::detail::with;

/// The same of parts stored in any way, by plain loops: apart, so that small tables, which take nanoseconds, need not
/// save registers for it.
template <class Left, class Right>
[[gnu::noinline]] void compose_in_loops(const AnyAlgebra& algebra, const Left& left, const Right& right,
                                        Table& result) {
  result.reshape(right.rows(), left.columns());
  with(algebra, [&](auto a) { compose_plainly(a, left, right, result); });
}

/// Whether a composition is worth storing sparsely: it is not if `left` is dense, nor if the rows of `left` could fill
/// half of a row of the result.
template <class Left, class Right>
bool is_sparse(const Left& left, const Right&) {
  return !std::is_same_v<Right, Table> || left.stored() < left.columns() / 2;
}

/// Whether the bands of a banded composition hold little beside what the parts lead to.
bool is_banded(const BandedRows& left, const BandedRows& right) {
  std::size_t stored = 0, terms = 0;
  for (std::size_t i = 0; i < right.rows(); ++i) {
    const RunOfEntries weights = right.entries(i);
    stored += reach(left, weights).size();
    for (std::size_t j = 0; j < weights.size(); ++j) terms += left.entries(weights.index(j)).size();
  }
  return stored <= 2 * terms;
}

SparseRows& as_sparse_rows(AnyRows& rows) {
  if (SparseRows* const sparse = std::get_if<SparseRows>(&rows)) return *sparse;
  return rows.emplace<SparseRows>();
}

}  // namespace

void compose_shaped(const AnyAlgebra& algebra, const Table& left, const Table& right, Table& result) {
  const DenseParts parts{right.data(), left.data(), result.data(), right.rows(), left.rows(), left.columns()};
  if (worth_tiling(parts) ? compose_tiled(algebra, parts) : compose_narrow(algebra, parts)) return;
  compose_in_loops(algebra, left, right, result);
}

void compose(const AnyAlgebra& algebra, const AnyRows& left, const Table& right, Table& result) {
  if (const Table* const table = std::get_if<Table>(&left)) return compose(algebra, *table, right, result);
  std::visit([&](const auto& l) { compose_in_loops(algebra, l, right, result); }, left);
}

void compose(const AnyAlgebra& algebra, const AnyRows& left, const AnyRows& right, AnyRows& result) {
  std::visit(
      [&]<class Left, class Right>(const Left& l, const Right& r) {
        if constexpr (std::is_same_v<Left, BandedRows> && std::is_same_v<Right, BandedRows>)
          if (is_banded(l, r)) {
            result = with(algebra, [&](auto a) { return banded_composition(a, l, r); });
            return;
          }
        if constexpr (!std::is_same_v<Left, Table>)
          if (is_sparse(l, r)) {
            SparseRows& rows = as_sparse_rows(result);
            with(algebra, [&](auto a) { sparse_composition(a, l, r, rows); });
            if (rows.stored() >= rows.rows() * rows.columns() / 2) result = dense_table(result);
            return;
          }
        if constexpr (std::is_same_v<Left, Table> && std::is_same_v<Right, Table>)
          compose(algebra, l, r, as_table(result));
        else
          compose_in_loops(algebra, l, r, as_table(result));
      },
      left, right);
}

}  // namespace sigmax::kernels
