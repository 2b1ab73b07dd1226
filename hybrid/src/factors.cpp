#include "factors.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace sigmax::detail {
namespace {

double norm(const double* numbers, int count) {
  double greatest = 0.0;
  for (int i = 0; i < count; ++i) greatest = std::max(greatest, std::abs(numbers[i]));
  if (!(greatest > 0.0)) return greatest;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += numbers[i] / greatest * (numbers[i] / greatest);
  return greatest * std::sqrt(sum);
}

void swap_rows(double* matrix, int rows, int columns, int a, int b) {
  for (int k = 0; k < columns; ++k) std::swap(matrix[a + k * rows], matrix[b + k * rows]);
}

}  // namespace

Triangle::Triangle(double* matrix, int rows, int all_columns, int columns)
    : matrix_(matrix), rows_(rows), columns_(std::min(columns, rows)) {
  for (int c = 0; c < columns_; ++c) {
    auto& [lead, v0, scale] = reflections_[c];
    double* const column = matrix + c * rows;
    lead = c;
    for (int i = c + 1; i < rows; ++i)
      if (std::abs(column[i]) > std::abs(column[lead])) lead = i;
    if (lead != c) swap_rows(matrix, rows, all_columns, c, lead);
    const double first = column[c];
    const double diagonal = std::copysign(norm(column + c, rows - c), -first);
    v0 = first - diagonal;  // 1 − scale (v0, v)(v0, v)ᵀ, with v left below the diagonal
    scale = diagonal == 0.0 ? 0.0 : -1.0 / (diagonal * v0);
    for (int other = c + 1; other < all_columns; ++other) reflect(matrix + other * rows, c);
    column[c] = diagonal;
  }
}

void Triangle::reflect(double* column, int c) const {
  const auto& [lead, v0, scale] = reflections_[c];
  const double* const v = matrix_ + c * rows_;
  double product = v0 * column[c];
  for (int i = c + 1; i < rows_; ++i) product += v[i] * column[i];
  product *= scale;
  column[c] -= product * v0;
  for (int i = c + 1; i < rows_; ++i) column[i] -= product * v[i];
}

double Triangle::log_determinant() const {
  double sum = 0.0;
  for (int c = 0; c < columns_; ++c) sum += std::log(std::abs(matrix_[c + c * rows_]));
  return sum;
}

void Triangle::orthogonal(double* Q, int count) const {
  std::fill_n(Q, rows_ * count, 0.0);
  for (int k = 0; k < count; ++k) Q[k + k * rows_] = 1.0;
  for (int c = columns_; c-- > 0;)
    for (int other = c; other < count; ++other) reflect(Q + other * rows_, c);
  for (int c = columns_; c-- > 0;)  // all last, as every exchange of rows moved the earlier v, too
    if (reflections_[c].lead != c) swap_rows(Q, rows_, count, c, reflections_[c].lead);
}

void Triangle::copy_to(double* triangle) const {
  for (int k = 0; k < columns_; ++k)
    for (int i = 0; i < columns_; ++i) triangle[i + k * columns_] = i <= k ? matrix_[i + k * rows_] : 0.0;
}

void solve(double* M, int n, double* B, int columns) {
  for (int c = 0; c < n; ++c) {
    int lead = c;
    for (int i = c + 1; i < n; ++i)
      if (std::abs(M[i + c * n]) > std::abs(M[lead + c * n])) lead = i;
    if (lead != c) {
      swap_rows(M, n, n, c, lead);
      swap_rows(B, n, columns, c, lead);
    }
    for (int i = c + 1; i < n; ++i) {
      const double factor = M[i + c * n] / M[c + c * n];
      for (int k = c + 1; k < n; ++k) M[i + k * n] -= factor * M[c + k * n];
      for (int k = 0; k < columns; ++k) B[i + k * n] -= factor * B[c + k * n];
    }
  }
  for (int k = 0; k < columns; ++k)
    for (int i = n; i-- > 0;) {
      for (int c = i + 1; c < n; ++c) B[i + k * n] -= M[i + c * n] * B[c + k * n];
      B[i + k * n] /= M[i + i * n];
    }
}

void eigen(double* M, int n, double* values, double* vectors) {
  std::fill_n(vectors, n * n, 0.0);
  for (int i = 0; i < n; ++i) vectors[i + i * n] = 1.0;
  for (int sweep = 0; sweep < 64; ++sweep) {
    double off = 0.0, on = 0.0;
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < n; ++i) (i == k ? on : off) += M[i + k * n] * M[i + k * n];
    if (!(off > 1e-40 * on)) break;
    for (int p = 0; p < n; ++p)
      for (int q = p + 1; q < n; ++q) {
        if (M[p + q * n] == 0.0) continue;
        const double half_cotangent = (M[q + q * n] - M[p + p * n]) / (2.0 * M[p + q * n]);
        const double t =
            std::copysign(1.0, half_cotangent) / (std::abs(half_cotangent) + std::hypot(half_cotangent, 1.0));
        const double c = 1.0 / std::hypot(t, 1.0), s = t * c;
        const auto rotate = [&](double& a, double& b) {
          const double was = a;
          a = c * was - s * b;
          b = s * was + c * b;
        };
        for (int k = 0; k < n; ++k) rotate(M[k + p * n], M[k + q * n]);
        for (int k = 0; k < n; ++k) rotate(M[p + k * n], M[q + k * n]);
        for (int k = 0; k < n; ++k) rotate(vectors[k + p * n], vectors[k + q * n]);
      }
  }
  for (int i = 0; i < n; ++i) values[i] = M[i + i * n];
}

int basis_of(const double* M, int n, double negligible, double* basis) {
  Scratch<1024> rest(n * n);
  std::copy_n(M, n * n, rest.data());
  double least = 0.0;
  for (int found = 0; found < n; ++found) {
    int lead = 0;
    double greatest = -1.0;
    for (int k = 0; k < n; ++k)
      if (const double length = norm(rest + k * n, n); length > greatest) {
        greatest = length;
        lead = k;
      }
    if (found == 0) least = negligible * greatest;
    if (!(greatest > least)) return found;
    double* const axis = basis + found * n;
    for (int i = 0; i < n; ++i) axis[i] = rest[i + lead * n] / greatest;
    for (int again = 0; again < 2; ++again)  // the second time for the rounding of the first
      for (int k = 0; k < n; ++k) {
        double along = 0.0;
        for (int i = 0; i < n; ++i) along += axis[i] * rest[i + k * n];
        for (int i = 0; i < n; ++i) rest[i + k * n] -= along * axis[i];
      }
  }
  return n;
}

}  // namespace sigmax::detail
