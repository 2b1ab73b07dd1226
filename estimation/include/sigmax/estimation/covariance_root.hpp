#pragma once

#include <string_view>

namespace sigmax::detail {

/// The lower triangular L with L Lᵀ = P, n × n by columns, by Cholesky's algorithm. P may be semi-definite: a pivot
/// that is zero to rounding gives a column of zeros. Only the lower triangle of P is read. Returns zero, or the number,
/// from one, of the component that shows that P is not positive semi-definite or not finite.
int covariance_root(const double* P, int n, double* L);

/// The x of L Lᵀ x = z, in its place; where a column of L is zero, so is that component of x.
void solve_by_root(const double* L, int n, double* z);

/// Throws std::domain_error, naming the model.
[[noreturn]] void refuse_covariance(std::string_view model, int component);

}  // namespace sigmax::detail
