#pragma once

#include <sigmax/estimation/dense.hpp>
#include <sigmax/estimation/gaussian.hpp>
#include <sigmax/estimation/root_mean_square.hpp>

namespace sigmax {

/// Normalised estimation error squared, eᵀ P⁻¹ e: χ² with as many degrees of freedom as there are states if the
/// estimate is consistent. Of the innovation and its S the same number is the NIS. Throws std::domain_error if P is not
/// positive definite.
template <int N, int MaxN>
double normalized_error_squared(const Vector<N, MaxN>& error, const SquareMatrix<N, MaxN>& covariance) {
  return detail::normalized_error_squared(error.data(), covariance.data(), static_cast<int>(error.size()));
}

/// NEES of an estimate against the truth.
template <int N, int MaxN>
double nees(const Gaussian<N, MaxN>& estimate, const Vector<N, MaxN>& truth) {
  return normalized_error_squared<N, MaxN>(estimate.mean - truth, estimate.covariance);
}

}  // namespace sigmax
