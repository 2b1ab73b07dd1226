#include <sigmax/estimation/dense.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace sigmax::detail {
namespace {

/// With as many rows as the compiler knows, which are kept in registers.
template <int Rows>
void multiply_rows(const double* A, int a_column, Strided B, double* C, int c_column, int inner, int columns,
                   Into into) {
  const double sign = into == Into::minus ? -1.0 : 1.0;
  for (int j = 0; j < columns; ++j) {
    double sum[static_cast<std::size_t>(Rows)];
    double* const result = C + j * c_column;
    for (int i = 0; i < Rows; ++i) sum[i] = into == Into::only ? 0.0 : result[i];
    for (int k = 0; k < inner; ++k) {
      const double factor = sign * B.numbers[k * B.row + j * B.column];
      for (int i = 0; i < Rows; ++i) sum[i] += A[i + k * a_column] * factor;
    }
    for (int i = 0; i < Rows; ++i) result[i] = sum[i];
  }
}

using Multiply = void (*)(const double*, int, Strided, double*, int, int, int, Into);
constexpr std::array<Multiply, 10> by_rows{multiply_rows<1>, multiply_rows<2>, multiply_rows<3>, multiply_rows<4>,
                                           multiply_rows<5>, multiply_rows<6>, multiply_rows<7>, multiply_rows<8>,
                                           multiply_rows<9>, multiply_rows<10>};

}  // namespace

void multiply(const double* A, int a_column, Strided B, double* C, int c_column, int rows, int inner, int columns,
              Into into) {
  constexpr int most = by_rows.size();
  for (int first = 0; first < rows; first += most) {
    const int part = std::min(rows - first, most);
    by_rows[static_cast<std::size_t>(part - 1)](A + first, a_column, B, C + first, c_column, inner, columns, into);
  }
}

void multiply_transposed(const double* A, int a_column, const double* B, int b_column, double* C, int c_column,
                         int rows, int inner, int columns) {
  for (int k = 0; k < columns; ++k)
    for (int i = 0; i < rows; ++i) {
      double sum = 0.0;
      for (int j = 0; j < inner; ++j) sum += A[j + i * a_column] * B[j + k * b_column];
      C[i + k * c_column] = sum;
    }
}

bool cholesky_factor(const double* S, int n, double* L) {
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

void lower_solve(const double* L, int n, double* z) {
  for (int k = 0; k < n; ++k) {
    z[k] /= L[k + k * n];
    for (int i = k + 1; i < n; ++i) z[i] -= z[k] * L[i + k * n];
  }
}

double normalized_error_squared(const double* error, const double* P, int n) {
  Scratch L(n * n);
  Scratch<32> whitened(n);
  if (!cholesky_factor(P, n, L))
    throw std::domain_error("the covariance of a normalised error is not positive definite");
  std::copy_n(error, n, whitened.data());
  lower_solve(L, n, whitened);
  double sum = 0.0;
  for (int i = 0; i < n; ++i) sum += whitened[i] * whitened[i];
  return sum;
}

void lower_inverse(const double* L, int n, double* inverse) {
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
