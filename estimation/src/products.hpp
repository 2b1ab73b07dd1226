#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>

#include <sigmax/estimation/dense.hpp>

namespace sigmax::detail {

/// C ± A B with as many rows as the compiler knows, which are kept in registers, in pairs; if Inner is not 0, also with
/// as many products in each sum.
template <int Rows, int Inner>
inline void multiply_rows(const double* A, int a_column, Strided B, double* C, int c_column, int inner, int columns,
                          Into into) {
  using Pair = double __attribute__((vector_size(16)));
  constexpr std::size_t pairs = Rows / 2;
  constexpr int last = Rows - 1;
  const double sign = into == Into::minus ? -1.0 : 1.0;
  for (int j = 0; j < columns; ++j) {
    double* const result = C + j * c_column;
    Pair sum[pairs + 1]{};
    double odd = 0.0;
    if (into != Into::only) {
      std::memcpy(sum, result, pairs * sizeof(Pair));
      odd = result[last];
    }
    for (int k = 0; k < (Inner > 0 ? Inner : inner); ++k) {
      const double factor = sign * B.numbers[k * B.row + j * B.column];
      const double* const column = A + k * a_column;
      for (std::size_t i = 0; i < pairs; ++i) {
        Pair part;
        std::memcpy(&part, column + 2 * i, sizeof(Pair));
        sum[i] += part * factor;
      }
      if constexpr (Rows % 2 != 0) odd += column[last] * factor;
    }
    std::memcpy(result, sum, pairs * sizeof(Pair));
    if constexpr (Rows % 2 != 0) result[last] = odd;
  }
}

/// The same where Rows may be 0, if the compiler does not know them.
template <int Rows, int Inner>
inline void multiply(const double* A, int a_column, Strided B, double* C, int c_column, int rows, int inner,
                     int columns, Into into = Into::only) {
  if constexpr (Rows > 0)
    multiply_rows<Rows, Inner>(A, a_column, B, C, c_column, inner, columns, into);
  else
    multiply(A, a_column, B, C, c_column, rows, inner, columns, into);
}

/// Cholesky's factor of as many rows as the compiler knows, if Rows is not 0.
template <int Rows>
inline bool cholesky_factor(const double* S, int rows, double* L) {
  const int n = Rows > 0 ? Rows : rows;
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i) {
      if (i < k) {
        L[i + k * n] = 0.0;
        continue;
      }
      double sum = 0.0;
      for (int j = 0; j < k; ++j) sum += L[i + j * n] * L[k + j * n];
      const double rest = S[i + k * n] - sum;
      if (i == k && rest <= 0.0) return false;
      L[i + k * n] = i == k ? std::sqrt(rest) : rest / L[k + k * n];
    }
  return true;
}

/// L⁻¹ likewise.
template <int Rows>
inline void lower_inverse(const double* L, int rows, double* inverse) {
  const int n = Rows > 0 ? Rows : rows;
  for (int column = 0; column < n; ++column) {
    for (int row = 0; row < column; ++row) inverse[row + column * n] = 0.0;
    inverse[column + column * n] = 1.0 / L[column + column * n];
    for (int row = column + 1; row < n; ++row) {
      double sum = 0.0;
      for (int k = column; k < row; ++k) sum += L[row + k * n] * inverse[k + column * n];
      inverse[row + column * n] = -sum / L[row + row * n];
    }
  }
}

}  // namespace sigmax::detail
