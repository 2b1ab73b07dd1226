#pragma once

#include <cmath>
#include <optional>

#include <sigmax/estimation/gaussian.hpp>

namespace sigmax::detail {

/// Cholesky's factor: the lower triangular L with L Lᵀ = S, or nothing if S is not positive definite. NaN gives NaN.
/// For matrices of a few rows, in plain loops: Eigen's LLT is made for large ones and takes seconds to compile.
template <int N, int MaxN>
std::optional<SquareMatrix<N, MaxN>> cholesky_factor(const SquareMatrix<N, MaxN>& S) {
  SquareMatrix<N, MaxN> L = SquareMatrix<N, MaxN>::Zero(S.rows(), S.cols());
  for (Eigen::Index k = 0; k < S.rows(); ++k)
    for (Eigen::Index i = k; i < S.rows(); ++i) {
      double sum = 0.0;
      for (Eigen::Index j = 0; j < k; ++j) sum += L(i, j) * L(k, j);
      const double rest = S(i, k) - sum;
      if (i == k && rest <= 0.0) return std::nullopt;
      L(i, k) = i == k ? std::sqrt(rest) : rest / L(k, k);
    }
  return L;
}

/// The x of L x = z.
template <int N, int MaxN>
Vector<N, MaxN> lower_solve(const SquareMatrix<N, MaxN>& L, Vector<N, MaxN> z) {
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    z(k) /= L(k, k);
    for (Eigen::Index row = k + 1; row < z.size(); ++row) z(row) -= z(k) * L(row, k);
  }
  return z;
}

/// L⁻¹ of a lower triangular L.
template <int N, int MaxN>
SquareMatrix<N, MaxN> lower_inverse(const SquareMatrix<N, MaxN>& L) {
  SquareMatrix<N, MaxN> inverse = SquareMatrix<N, MaxN>::Zero(L.rows(), L.cols());
  for (Eigen::Index column = 0; column < L.cols(); ++column) {
    inverse(column, column) = 1.0 / L(column, column);
    for (Eigen::Index row = column + 1; row < L.rows(); ++row) {
      double sum = 0.0;
      for (Eigen::Index k = column; k < row; ++k) sum += L(row, k) * inverse(k, column);
      inverse(row, column) = -sum / L(row, row);
    }
  }
  return inverse;
}

}  // namespace sigmax::detail
