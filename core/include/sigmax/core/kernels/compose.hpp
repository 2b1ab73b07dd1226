#pragma once

#include <sigmax/core/rows.hpp>
#include <sigmax/core/uncertainty.hpp>

namespace sigmax::kernels {

using sigmax::detail::AnyAlgebra;

/// result(i, k) = ⊕_j right(i, j) ⊗ left(j, k), stored as fits: dense if a part must be, banded if both parts are, else
/// sparse. `result` is neither of the parts.
void compose(const AnyAlgebra& algebra, const AnyRows& left, const AnyRows& right, AnyRows& result);

/// The same of tables, into one of the shape that it needs.
void compose_shaped(const AnyAlgebra& algebra, const Table& left, const Table& right, Table& result);

/// The same where `right` is dense: so is the result. If that has room, only large tables allocate: once a thread for
/// tiles, and for scaled copies where products underflow.
void compose(const AnyAlgebra& algebra, const AnyRows& left, const Table& right, Table& result);
inline void compose(const AnyAlgebra& algebra, const Table& left, const Table& right, Table& result) {
  result.reshape(right.rows(), left.columns());
  compose_shaped(algebra, left, right, result);
}

template <Algebra A, class Left, class Right, class Result>
void compose(const Left& left, const Right& right, Result& result) {
  compose(sigmax::detail::any_algebra<A>(), left, right, result);
}

}  // namespace sigmax::kernels
