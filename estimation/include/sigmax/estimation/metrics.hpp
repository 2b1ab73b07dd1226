#pragma once

#include <stdexcept>

#include <Eigen/Cholesky>

#include <sigmax/estimation/gaussian.hpp>
#include <sigmax/estimation/root_mean_square.hpp>

namespace sigmax {

/// Normalised estimation error squared, eᵀ P⁻¹ e: χ² with as many degrees of freedom as there are states if the
/// estimate is consistent. Of the innovation and its S the same number is the NIS. Throws std::domain_error if P is not
/// positive definite.
template <int N, int MaxN>
double normalized_error_squared(const Vector<N, MaxN>& error, const SquareMatrix<N, MaxN>& covariance) {
  const Eigen::LLT<SquareMatrix<N, MaxN>> factor(covariance);
  if (factor.info() != Eigen::Success)
    throw std::domain_error("the covariance of a normalised error is not positive definite");
  return factor.matrixL().solve(error).squaredNorm();
}

/// NEES of an estimate against the truth.
template <int N, int MaxN>
double nees(const Gaussian<N, MaxN>& estimate, const Vector<N, MaxN>& truth) {
  return normalized_error_squared<N, MaxN>(estimate.mean - truth, estimate.covariance);
}

}  // namespace sigmax
