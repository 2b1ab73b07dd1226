#pragma once

#include <cstddef>

#include <sigmax/core/kernels/compose.hpp>
#include <sigmax/core/uncertainty.hpp>

namespace sigmax::kernels {

using sigmax::detail::AnyAlgebra;

/// The parts of result(i, k) = ⊕_j right(i, j) ⊗ left(j, k), each stored row by row: `right` is rows × inner, `left` is
/// inner × columns, `result` is rows × columns and neither of them.
struct DenseParts {
  const double* right;
  const double* left;
  double* result;
  std::size_t rows, inner, columns;
};

/// Whether the compiled kernels are faster than plain loops.
inline bool worth_tiling(const DenseParts& parts) {
  return parts.rows >= 4 && parts.columns >= 8 && parts.inner >= 4 && parts.rows * parts.inner * parts.columns >= 512;
}

/// Composes dense tables by the widest vectors that the machine has, found out when the program runs. False,
/// and nothing is done that matters, for an algebra of another's, numbers out of range, and without Highway.
///
/// The numbers are those of the plain loops: to the bit where ⊕ selects, to rounding where it adds. Products below the
/// least normal number, 2^−1022, cost no more than others and are not lost; a result there is within 2^−1074 of that of
/// the plain loops.
bool compose_tiled(const AnyAlgebra& algebra, const DenseParts& parts);

}  // namespace sigmax::kernels
