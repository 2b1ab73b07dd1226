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

/// action(algebra, whether winners are wanted), both known to the compiler.
template <class Action>
decltype(auto) with(const AnyAlgebra& algebra, const FirstWinners* winners, const Action& action) {
  return sigmax::detail::with(
      algebra, [&](auto a) { return winners ? action(a, std::true_type{}) : action(a, std::false_type{}); });
}

/// The same of parts stored in any way, by plain loops.
template <class Left, class Right>
void compose_in_loops(const AnyAlgebra& algebra, const Left& left, const Right& right, Table& result,
                      FirstWinners* winners) {
  result.reshape(right.rows(), left.columns());
  with(algebra, winners, [&](auto a, auto wanted) { compose_plainly<wanted>(a, left, right, result, winners); });
}

/// Tables for which there is no kernel, or with winners: apart, so that small ones, which take nanoseconds, need not
/// save registers for it.
[[gnu::noinline]] void compose_otherwise(const AnyAlgebra& algebra, const Table& left, const Table& right,
                                         Table& result, FirstWinners* winners) {
  const DenseParts parts{right.data(), left.data(), result.data(), right.rows(), left.rows(), left.columns()};
  if (winners && worth_tiling(parts)) {
    winners->resize(result.size());
    if (compose_tiled(algebra, parts, winners->data())) return;
  }
  compose_in_loops(algebra, left, right, result, winners);
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

void compose_shaped(const AnyAlgebra& algebra, const Table& left, const Table& right, Table& result,
                    FirstWinners* winners) {
  const DenseParts parts{right.data(), left.data(), result.data(), right.rows(), left.rows(), left.columns()};
  if (!winners && (worth_tiling(parts) ? compose_tiled(algebra, parts, nullptr) : compose_narrow(algebra, parts)))
    return;
  compose_otherwise(algebra, left, right, result, winners);
}

void compose(const AnyAlgebra& algebra, const AnyRows& left, const Table& right, Table& result, FirstWinners* winners) {
  if (const Table* const table = std::get_if<Table>(&left)) return compose(algebra, *table, right, result, winners);
  std::visit([&](const auto& l) { compose_in_loops(algebra, l, right, result, winners); }, left);
}

void compose(const AnyAlgebra& algebra, const AnyRows& left, const AnyRows& right, AnyRows& result,
             FirstWinners* winners) {
  std::visit(
      [&]<class Left, class Right>(const Left& l, const Right& r) {
        if constexpr (std::is_same_v<Left, BandedRows> && std::is_same_v<Right, BandedRows>)
          if (is_banded(l, r)) {
            result = with(algebra, winners,
                          [&](auto a, auto wanted) { return banded_composition<wanted>(a, l, r, winners); });
            return;
          }
        if constexpr (!std::is_same_v<Left, Table>)
          if (is_sparse(l, r)) {
            SparseRows& rows = as_sparse_rows(result);
            with(algebra, winners, [&](auto a, auto wanted) { sparse_composition<wanted>(a, l, r, rows, winners); });
            if (!winners && rows.stored() >= rows.rows() * rows.columns() / 2) result = dense_table(result);
            return;
          }
        if constexpr (std::is_same_v<Left, Table> && std::is_same_v<Right, Table>)
          compose(algebra, l, r, as_table(result), winners);
        else
          compose_in_loops(algebra, l, r, as_table(result), winners);
      },
      left, right);
}

}  // namespace sigmax::kernels
