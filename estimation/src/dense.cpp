#include <sigmax/estimation/dense.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "products.hpp"

namespace sigmax::detail {
namespace {

using Multiply = void (*)(const double*, int, Strided, double*, int, int, int, Into);
constexpr std::array<Multiply, 10> by_rows{
    multiply_rows<1, 0>, multiply_rows<2, 0>, multiply_rows<3, 0>, multiply_rows<4, 0>, multiply_rows<5, 0>,
    multiply_rows<6, 0>, multiply_rows<7, 0>, multiply_rows<8, 0>, multiply_rows<9, 0>, multiply_rows<10, 0>};

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

bool cholesky_factor(const double* S, int n, double* L) { return cholesky_factor<0>(S, n, L); }

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

void lower_inverse(const double* L, int n, double* inverse) { lower_inverse<0>(L, n, inverse); }

}  // namespace sigmax::detail
