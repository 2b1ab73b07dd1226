#include <sigmax/hybrid/future_evidence.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "factors.hpp"

namespace sigmax {

using namespace detail;

namespace {

/// The top rows of some columns of a matrix, into another with its own number of rows.
void copy_block(const double* from, int from_rows, int rows, int columns, double* to, int to_rows) {
  for (int k = 0; k < columns; ++k) std::copy_n(from + k * from_rows, rows, to + k * to_rows);
}

/// T⁻ᵀ Mᵀ with the triangle T of a matrix of n columns.
void solve_transposed(const Triangle& triangle, const double* M, int n, double* result) {
  Scratch<1024> T(n * n);
  triangle.copy_to(T);
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i) {
      double rest = M[k + i * n];
      for (int j = 0; j < i; ++j) rest -= T[j + i * n] * result[j + k * n];
      result[i + k * n] = rest / T[i + i * n];
    }
}

}  // namespace

void FutureEvidence::clear(int n) {
  n_ = n;
  rows_ = 0;
  numbers_.reserve(static_cast<std::size_t>(n) * static_cast<std::size_t>(n + 1));
  numbers_.clear();
}

double* FutureEvidence::write(int rows) {
  rows_ = rows;
  numbers_.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(n_ + 1));
  return numbers_.data();
}

void FutureEvidence::add(const double* other_R, const double* other_r, int other_rows) {
  if (other_rows == 0) return;
  const int all = rows_ + other_rows, n = n_;
  Scratch<640> stack(all * (n + 1));
  copy_block(R(), rows_, rows_, n + 1, stack, all);
  copy_block(other_R, other_rows, other_rows, n, stack + rows_, all);
  std::copy_n(other_r, other_rows, stack + rows_ + n * all);
  const Triangle triangle(stack, all, n + 1, n);
  const int kept = std::min(n, all);
  double* const result = write(kept);
  copy_block(stack, all, kept, n + 1, result, kept);
  for (int k = 0; k < n; ++k)
    for (int i = k + 1; i < kept; ++i) result[i + k * kept] = 0.0;
}

void FutureEvidence::transform(const double* A, int axes) {
  double inverse[9] = {}, copy[9];
  for (int i = 0; i < axes; ++i) inverse[i + i * axes] = 1.0;
  std::copy_n(A, axes * axes, copy);
  solve(copy, axes, inverse, axes);
  Scratch block(rows_ * axes);
  for (int d = 0; d + axes <= n_; d += axes) {
    double* const columns = numbers_.data() + d * rows_;
    std::copy_n(columns, rows_ * axes, block.data());
    multiply(block, rows_, columns_of(inverse, axes), columns, rows_, rows_, axes, axes);
  }
}

double FutureEvidence::carry_back(const double* offset, const double* B, int m, const double* A, int q,
                                  FutureEvidence& result) const {
  result.clear(m);
  if (rows_ == 0) return 0.0;
  const int all = rows_ + q;
  Scratch<640> work(all * (q + m + 1));
  std::fill_n(work.data(), all * (q + m + 1), 0.0);
  multiply(R(), rows_, columns_of(A, n_), work, all, rows_, n_, q);
  multiply(R(), rows_, columns_of(B, n_), work + q * all, all, rows_, n_, m);
  double* const last = work + (q + m) * all;
  std::copy_n(r(), rows_, last);
  multiply(R(), rows_, columns_of(offset, n_), last, all, rows_, n_, 1, Into::minus);
  for (int i = 0; i < q; ++i) work[rows_ + i + i * all] = 1.0;
  const Triangle triangle(work, all, q + m + 1, q);
  copy_block(work + q + q * all, all, rows_, m + 1, result.write(rows_), rows_);
  return -triangle.log_determinant();
}

double FutureEvidence::meet(const double* L, View estimate) const {
  const int n = estimate.n, all = rows_ + n;
  Scratch<640> work(all * (n + 1));
  Scratch root(n * n);
  std::fill_n(work.data(), all * (n + 1), 0.0);
  multiply(R(), rows_, columns_of(L, n), work, all, rows_, n, n);
  std::copy_n(r(), rows_, work + n * all);
  for (int i = 0; i < n; ++i) work[rows_ + i + i * all] = 1.0;
  const Triangle triangle(work, all, n + 1, n);
  solve_transposed(triangle, L, n, root);  // its columns are those of (L T⁻¹)ᵀ
  const double* const told = work + n * all;
  multiply(told, 1, columns_of(root, n), estimate.mean, 1, 1, n, n, Into::plus);
  multiply_transposed(root, n, root, n, estimate.covariance, n, n, n, n);
  mirror_lower(estimate.covariance, n);
  double squared = 0.0;
  for (int i = n; i < all; ++i) squared += told[i] * told[i];
  return -triangle.log_determinant() - 0.5 * squared;
}

namespace detail {
namespace {

void set_identity(double* M, int n) {
  std::fill_n(M, n * n, 0.0);
  for (int i = 0; i < n; ++i) M[i + i * n] = 1.0;
}

/// G (P⁻¹ + GᵀG)⁻¹ Gᵀ with P = L Lᵀ.
void known(const double* G, const double* L, int n, double* result) {
  Scratch<1024> K(n * n), half(n * n);
  Scratch<640> work(2 * n * n);
  multiply(G, n, columns_of(L, n), K, n, n, n, n);
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i) {
      work[i + k * 2 * n] = K[i + k * n];
      work[n + i + k * 2 * n] = i == k ? 1.0 : 0.0;
    }
  solve_transposed(Triangle(work, 2 * n, n, n), K, n, half);
  multiply_transposed(half, n, half, n, result, n, n, n, n);
}

/// The evidence with the information GᵀZG and the vector Gᵀy, with what was seen.
void finish(const double* G, double* Z, double* y, int n, const FutureEvidence& seen, FutureEvidence& result) {
  constexpr double least = 1e-8;
  Scratch<1024> triangle(n * n), factor(n * n);
  std::copy_n(G, n * n, triangle.data());
  if (seen.rows() > 0) {
    const int all = n + seen.rows();
    Scratch<640> stack(all * n), U(all * n);
    Scratch<1024> product(n * n), sum(n * n);
    copy_block(G, n, n, n, stack, all);
    copy_block(seen.R(), seen.rows(), seen.rows(), n, stack + n, all);
    const Triangle both(stack, all, n, n);
    both.orthogonal(U, n);
    both.copy_to(triangle);
    // Z and y of both, in the new triangle's directions: Z of G's rows, and one of those of what was seen.
    multiply(Z, n, {U, 1, all}, product, n, n, n, n);
    Scratch<32> told(n);
    multiply_transposed(U, all, product, n, sum, n, n, n, n);
    multiply_transposed(U + n, all, U + n, all, Z, n, n, seen.rows(), n);
    multiply_transposed(U, all, y, n, told, n, n, n, 1);
    multiply_transposed(U + n, all, seen.r(), seen.rows(), y, n, n, seen.rows(), 1);
    for (int i = 0; i < n * n; ++i) Z[i] += sum[i];
    for (int i = 0; i < n; ++i) y[i] += told[i];
  }
  bool sure = cholesky_factor(Z, n, factor);
  for (int i = 0; sure && i < n; ++i) sure = factor[i + i * n] > std::sqrt(least);
  result.clear(n);
  if (sure) {
    double* const R = result.write(n);
    multiply_transposed(factor, n, triangle, n, R, n, n, n, n);
    std::copy_n(y, n, R + n * n);
    lower_solve(factor, n, R + n * n);
    return;
  }
  // Along its axes, within what the triangle can reach: beyond that Z has no meaning.
  Scratch<1024> scaled(n * n), basis(n * n), within(n * n), product(n * n), vectors(n * n);
  Scratch<32> values(n);
  for (int k = 0; k < n; ++k) {
    double squared = 0.0;
    for (int i = 0; i < n; ++i) squared += triangle[i + k * n] * triangle[i + k * n];
    const double scale = 1.0 / std::max(std::sqrt(squared), std::numeric_limits<double>::min());
    for (int i = 0; i < n; ++i) scaled[i + k * n] = scale * triangle[i + k * n];
  }
  const int reached = basis_of(scaled, n, 1e-12, basis);
  if (reached == 0) return;  // nothing was told
  multiply(Z, n, columns_of(basis, n), product, n, n, n, reached);
  multiply_transposed(basis, n, product, n, within, reached, reached, n, reached);
  eigen(within, reached, values, vectors);
  const auto kept = static_cast<int>(
      std::count_if(values.data(), values.data() + reached, [](double value) { return value > least; }));
  double* const R = result.write(kept);
  Scratch<32> axis(n);
  int row = 0;
  for (int a = 0; a < reached; ++a) {
    if (!(values[a] > least)) continue;
    multiply(basis, n, columns_of(vectors + a * reached, reached), axis, n, n, reached, 1);
    const double root = std::sqrt(values[a]);
    double told = 0.0;
    for (int i = 0; i < n; ++i) told += axis[i] * y[i];
    for (int k = 0; k < n; ++k) {
      double entry = 0.0;
      for (int i = 0; i < n; ++i) entry += axis[i] * triangle[i + k * n];
      R[row + k * kept] = root * entry;
    }
    R[row + n * kept] = told / root;
    ++row;
  }
}

}  // namespace

void collapse(const std::vector<FutureEvidence>& parts, const std::vector<double>& weights, const double* L,
              const FutureEvidence& seen, FutureEvidence& result) {
  const int n = seen.size();
  int count = 0;
  for (std::size_t j = 0; j < parts.size(); ++j)
    if (weights[j] > 0.0) count += parts[j].rows();
  const int all = std::max(count, n);
  Scratch<640> stack(all * n), U(all * n);
  std::fill_n(stack.data(), all * n, 0.0);
  int first = 0;
  for (std::size_t j = 0; j < parts.size(); ++j) {
    if (!(weights[j] > 0.0)) continue;
    const int rows = parts[j].rows();
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < rows; ++i) stack[first + i + k * all] = std::sqrt(weights[j]) * parts[j].R()[i + k * rows];
    first += rows;
  }
  Scratch<1024> G(n * n), H(n * n), empty(n * n), N(n * n), rest(n * n), solved(n * (n + 1)), X(n * n), Xi(n * n);
  const Triangle triangle(stack, all, n, n);
  triangle.orthogonal(U, n);
  triangle.copy_to(G);
  known(G, L, n, H);
  multiply_transposed(U + count, all, U + count, all, empty, n, n, all - count, n);

  Scratch<640> q_of(static_cast<int>(parts.size()) * n);
  Scratch<32> q(n), y(n);
  std::fill_n(X.data(), n * n, 0.0);
  std::fill_n(q.data(), n, 0.0);
  first = 0;
  for (std::size_t j = 0; j < parts.size(); ++j) {
    const double w = weights[j];
    if (!(w > 0.0)) continue;
    const int rows = parts[j].rows();
    multiply_transposed(U + first, all, U + first, all, N, n, n, rows, n);
    for (int i = 0; i < n * n; ++i) N[i] = (i % (n + 1) == 0 ? 1.0 : 0.0) - empty[i] - N[i] / w;
    set_identity(rest, n);
    multiply(N, n, columns_of(H, n), rest, n, n, n, n, Into::minus);
    std::copy_n(N.data(), n * n, solved.data());
    double* const q_j = solved + n * n;
    multiply_transposed(U + first, all, parts[j].r(), rows, q_j, n, n, rows, 1);
    for (int i = 0; i < n; ++i) q_j[i] /= std::sqrt(w);
    solve(rest, n, solved, n + 1);
    for (int i = 0; i < n * n; ++i) X[i] += w * solved[i];
    for (int i = 0; i < n; ++i) q[i] += w * q_j[i];
    std::copy_n(q_j, n, q_of + static_cast<int>(j) * n);
    first += rows;
  }
  for (std::size_t j = 0; j < parts.size(); ++j) {
    if (!(weights[j] > 0.0)) continue;
    const double* const q_j = q_of + static_cast<int>(j) * n;
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < n; ++i) X[i + k * n] += weights[j] * (q_j[i] - q[i]) * (q_j[k] - q[k]);
  }
  for (int k = 0; k < n; ++k)
    for (int i = k; i < n; ++i) X[i + k * n] = X[k + i * n] = 0.5 * (X[i + k * n] + X[k + i * n]);
  set_identity(rest, n);
  multiply(X, n, columns_of(H, n), rest, n, n, n, n, Into::plus);
  std::copy_n(X.data(), n * n, Xi.data());
  solve(rest, n, Xi, n);
  Scratch<32> Hq(n);
  multiply(H, n, columns_of(q, n), Hq, n, n, n, 1);
  std::copy_n(q.data(), n, y.data());
  multiply(Xi, n, columns_of(Hq, n), y, n, n, n, 1, Into::minus);
  double* const Z = X;
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i) Z[i + k * n] = (i == k ? 1.0 : 0.0) - 0.5 * (Xi[i + k * n] + Xi[k + i * n]);
  finish(G, Z, y, n, seen, result);
}

}  // namespace detail
}  // namespace sigmax
