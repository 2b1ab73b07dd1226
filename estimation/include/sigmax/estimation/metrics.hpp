#pragma once

#include <cmath>
#include <cstddef>

#include <sigmax/estimation/dense.hpp>
#include <sigmax/estimation/gaussian.hpp>

namespace sigmax {

/// Root mean square of errors added one by one; 0 before the first.
class RootMeanSquare {
 public:
  void add(double error) { add_square(error * error); }
  void add_square(double square) {
    sum_ += square;
    ++count_;
  }
  std::size_t count() const { return count_; }
  double value() const { return count_ == 0 ? 0.0 : std::sqrt(sum_ / static_cast<double>(count_)); }

 private:
  double sum_ = 0.0;
  std::size_t count_ = 0;
};

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
