#include <sigmax/estimation/dense.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kernels/kernels.hpp"

namespace sigmax::detail {
void multiply(const double* A, int a_column, Strided B, double* C, int c_column, int rows, int inner, int columns,
              Into into) {
  kernels().product(A, a_column, B, C, c_column, rows, inner, columns, into);
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

}  // namespace sigmax::detail
