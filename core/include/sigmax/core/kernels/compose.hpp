#pragma once

#include <cstddef>
#include <type_traits>
#include <variant>

#include <sigmax/core/kernels/dense.hpp>
#include <sigmax/core/kernels/sparse.hpp>
#include <sigmax/core/rows.hpp>

namespace sigmax::kernels {

/// Whether a composition is worth storing sparsely: it is not if `left` is dense, nor if the rows of `left` could fill
/// half of a row of the result.
template <class Left, class Right>
bool is_sparse(const Left& left, const Right&) {
  if constexpr (std::is_same_v<Left, Table>) return false;
  if constexpr (std::is_same_v<Right, Table>) return left.stored() < left.columns() / 2;
  return true;
}

/// Whether the bands of a banded composition hold little beside what the parts lead to.
inline bool is_banded(const BandedRows& left, const BandedRows& right) {
  std::size_t stored = 0, terms = 0;
  for (std::size_t i = 0; i < right.rows(); ++i) {
    const RunOfEntries weights = right.entries(i);
    stored += reach(left, weights).size();
    for (std::size_t j = 0; j < weights.size(); ++j) terms += left.entries(weights.index(j)).size();
  }
  return stored <= 2 * terms;
}

/// result(i, k) = ⊕_j right(i, j) ⊗ left(j, k), stored as fits: dense if a part of it must be, banded if both parts
/// are, else sparse. `winners` is FirstWinners or NoWinners.
template <Algebra A, class Winners>
void compose(const AnyRows& left, const AnyRows& right, AnyRows& result, Winners& winners) {
  std::visit(
      [&](const auto& l, const auto& r) {
        using Left = std::decay_t<decltype(l)>;
        using Right = std::decay_t<decltype(r)>;
        if constexpr (std::is_same_v<Left, BandedRows> && std::is_same_v<Right, BandedRows>)
          if (is_banded(l, r)) {
            result = banded_composition<A>(l, r, winners);
            return;
          }
        if constexpr (!std::is_same_v<Left, Table>)
          if (is_sparse(l, r)) {
            SparseRows& rows = as_sparse_rows(result);
            sparse_composition<A>(l, r, rows, winners);
            if (!Winners::wanted && rows.stored() >= rows.rows() * rows.columns() / 2) result = dense_table(rows);
            return;
          }
        compose<A>(l, r, as_table(result), winners);
      },
      left, right);
}
template <Algebra A>
void compose(const AnyRows& left, const AnyRows& right, AnyRows& result) {
  NoWinners none;
  compose<A>(left, right, result, none);
}

/// The same for one row of weights, or several, that are dense: so is the result.
template <Algebra A>
void compose(const AnyRows& left, const Table& right, Table& result) {
  std::visit([&](const auto& l) { compose<A>(l, right, result); }, left);
}

}  // namespace sigmax::kernels
