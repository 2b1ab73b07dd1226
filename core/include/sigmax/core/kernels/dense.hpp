#pragma once

#include <algorithm>
#include <cstddef>

#include <sigmax/core/algebra.hpp>
#include <sigmax/core/table.hpp>

namespace sigmax::kernels {

/// result(i, k) = ⊕_j right(i, j) ⊗ left(j, k): every composition of dense tables goes through here.
/// `result` must not be `right` or `left`.
template <Algebra A>
void compose(const Table& left, const Table& right, Table& result) {
  result.reshape(right.rows(), left.columns());
  const std::size_t columns = left.columns();
  for (std::size_t i = 0; i < right.rows(); ++i) {
    double* const out = result.row(i).data();
    const double* const weights = right.row(i).data();
    std::fill_n(out, columns, A::zero());
    for (std::size_t j = 0; j < left.rows(); ++j) {
      const double weight = weights[j];
      const double* const row = left.row(j).data();
      for (std::size_t k = 0; k < columns; ++k) out[k] = A::plus(out[k], A::times(weight, row[k]));
    }
  }
}

}  // namespace sigmax::kernels
