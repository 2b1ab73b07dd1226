#pragma once

#include <cstddef>
#include <memory>

/// Plain loops over matrices of run-time size, stored by columns: they compile 25 times as fast as expressions of
/// fixed-size types, and run faster (docs/benchmarks.md, "Building").
namespace sigmax::detail {

/// Room for so many numbers: on the stack if they are few, else allocated.
template <int Few = 256, class Number = double>
class Scratch {
 public:
  explicit Scratch(int size) {
    if (size > Few) many_ = std::make_unique<Number[]>(static_cast<std::size_t>(size));
  }
  Number* data() { return many_ ? many_.get() : few_; }
  const Number* data() const { return many_ ? many_.get() : few_; }
  operator Number*() { return data(); }

 private:
  Number few_[static_cast<std::size_t>(Few)];
  std::unique_ptr<Number[]> many_;
};

/// A matrix with the entry (i, k) at numbers[i · row + k · column].
struct Strided {
  const double* numbers;
  int row, column;
};
inline Strided columns_of(const double* numbers, int rows) { return {numbers, 1, rows}; }
inline Strided transposed(const double* numbers, int rows) { return {numbers, rows, 1}; }

/// C ± A B, or A B alone: C is rows × columns, A rows × inner, and both have their columns so far apart.
enum class Into { only, plus, minus };
void multiply(const double* A, int a_column, Strided B, double* C, int c_column, int rows, int inner, int columns,
              Into into = Into::only);

/// C = Aᵀ B: C is rows × columns, and A and B have `inner` rows.
void multiply_transposed(const double* A, int a_column, const double* B, int b_column, double* C, int c_column,
                         int rows, int inner, int columns);

/// The lower triangle over the upper one, so that rounding cannot make a covariance unsymmetric.
inline void mirror_lower(double* matrix, int n) {
  for (int k = 1; k < n; ++k)
    for (int i = 0; i < k; ++i) matrix[i + k * n] = matrix[k + i * n];
}

/// Cholesky's factor: the lower triangular L with L Lᵀ = S; false if S is not positive definite. Only the lower
/// triangle of S is read. NaN gives NaN.
bool cholesky_factor(const double* S, int n, double* L);

/// The x of L x = z, in its place.
void lower_solve(const double* L, int n, double* z);

/// eᵀ P⁻¹ e. Throws std::domain_error if P is not positive definite.
double normalized_error_squared(const double* error, const double* P, int n);

}  // namespace sigmax::detail
