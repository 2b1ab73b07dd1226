#pragma once

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

#include <sigmax/estimation/gaussian.hpp>

namespace sigmax::detail {

/// The lower triangular L with L Lᵀ = P by Cholesky's algorithm, for semi-definite P too: a pivot that is zero to
/// rounding gives a column of zeros. Only the lower triangle of P is read.
/// Throws std::domain_error, naming the model, if P is not positive semi-definite or not finite.
template <int N, int MaxN>
SquareMatrix<N, MaxN> covariance_root(const Eigen::Matrix<double, N, N, 0, MaxN, MaxN>& P, std::string_view model) {
  const Eigen::Index n = P.rows();
  const double negligible = 4.0 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
  constexpr double accumulated = 1e-10;  // of earlier rounding, relative to the variance
  const auto refuse = [&](Eigen::Index k) {
    throw std::domain_error("the covariance of model '" + std::string(model) +
                            "' is not positive semi-definite, as its component " + std::to_string(k + 1) + " shows");
  };
  SquareMatrix<N, MaxN> L = SquareMatrix<N, MaxN>::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    double pivot = P(k, k);
    for (Eigen::Index j = 0; j < k; ++j) pivot -= L(k, j) * L(k, j);
    if (!(pivot >= -accumulated * P(k, k) && pivot < std::numeric_limits<double>::infinity())) refuse(k);
    const bool zero = pivot <= negligible * P(k, k);
    if (!zero) L(k, k) = std::sqrt(pivot);
    for (Eigen::Index i = k + 1; i < n; ++i) {
      double entry = P(i, k);
      for (Eigen::Index j = 0; j < k; ++j) entry -= L(i, j) * L(k, j);
      if (!zero)
        L(i, k) = entry / L(k, k);
      else if (!(entry * entry <= accumulated * P(k, k) * P(i, i)))  // no covariance without variance
        refuse(i);
    }
  }
  return L;
}

}  // namespace sigmax::detail
