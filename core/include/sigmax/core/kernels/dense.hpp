#pragma once

#include <algorithm>
#include <cstddef>

#include <sigmax/core/algebra.hpp>
#include <sigmax/core/kernels/accumulate.hpp>
#include <sigmax/core/table.hpp>

namespace sigmax::kernels {

/// result(i, k) = ⊕_j right(i, j) ⊗ left(j, k), a dense table of parts that may be stored in any way. Allocates nothing
/// if `result` has room. `result` must not be `right` or `left`.
template <Algebra A, class Left, class Right, class Winners>
void compose(const Left& left, const Right& right, Table& result, Winners& winners) {
  result.reshape(right.rows(), left.columns());
  winners.assign(result.size());
  for (std::size_t i = 0; i < right.rows(); ++i) {
    const auto weights = right.entries(i);
    double* const out = result.row(i).data();
    std::fill_n(out, left.columns(), A::zero());
    for (std::size_t j = 0; j < weights.size(); ++j)
      accumulate<A>(weights.value(j), left.entries(weights.index(j)), out, weights.index(j),
                    winners.from(result.offset(i)));
  }
}
template <Algebra A, class Left, class Right>
void compose(const Left& left, const Right& right, Table& result) {
  NoWinners none;
  compose<A>(left, right, result, none);
}

}  // namespace sigmax::kernels
