#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <sigmax/estimation/gaussian.hpp>

namespace sigmax {

/// What came to be known of a state after it was predicted: the likelihood exp(yᵀu − uᵀYu/2) of its distance u from
/// that prediction, which makes the smoothed estimate of it. Another prediction of the same state can meet it.
///
/// Y is what the smoothed information matrix has more than the predicted one. In a direction in which it has less, as
/// may be where mixtures were collapsed on the way, Y is zero.
template <int N, int MaxN>
class FutureEvidence {
 public:
  /// Throws std::domain_error, naming the model, if the predicted covariance is not positive definite.
  FutureEvidence(const Gaussian<N, MaxN>& predicted, const Gaussian<N, MaxN>& smoothed, std::string_view model)
      : predicted_(predicted.mean) {
    const Eigen::LLT<Matrix> L(predicted.covariance);
    if (L.info() != Eigen::Success)
      throw std::domain_error("the predicted covariance of model '" + std::string(model) +
                              "' is not positive definite");
    // In the coordinates W in which the prediction is N(0, I), the smoothed covariance is diagonal, too.
    const Matrix whitening = L.matrixL().solve(identity());
    const Matrix half = whitening.lazyProduct(smoothed.covariance);
    Matrix white = half.lazyProduct(whitening.transpose());
    mirror_lower(white);
    const Eigen::SelfAdjointEigenSolver<Matrix> axes(white);
    const Matrix W = whitening.transpose().lazyProduct(axes.eigenvectors());
    const Vector<N, MaxN> variance = axes.eigenvalues().cwiseMax(1e-12);
    const Vector<N, MaxN> moved = W.transpose().lazyProduct(smoothed.mean - predicted.mean);
    const Vector<N, MaxN> gained = (variance.cwiseInverse().array() - 1.0).max(0.0).sqrt();
    root_ = W * gained.asDiagonal();
    y_ = W.lazyProduct(moved.cwiseQuotient(variance));
  }

  /// The estimate in which another prediction of the state and the evidence meet; returns the logarithm of its
  /// evidence, up to a number that is the same for all predictions. `result` may be `prediction`.
  double meet(const Gaussian<N, MaxN>& prediction, Gaussian<N, MaxN>& result) const {
    const Vector<N, MaxN> u = prediction.mean - predicted_;
    const Vector<N, MaxN> seen = root_.transpose().lazyProduct(u);
    const Vector<N, MaxN> rest = y_ - root_.lazyProduct(seen);
    const Matrix PR = prediction.covariance.lazyProduct(root_);
    Matrix G = root_.transpose().lazyProduct(PR);
    G += identity();
    const Eigen::LLT<Matrix> factor(G);
    const Matrix crossed = PR.transpose();
    const Matrix gain = factor.matrixL().solve(crossed);
    result.covariance = prediction.covariance - gain.transpose().lazyProduct(gain);
    mirror_lower(result.covariance);
    const Vector<N, MaxN> moved = result.covariance.lazyProduct(rest);
    result.mean = prediction.mean + moved;
    return 0.5 * rest.dot(moved) + y_.dot(u) - 0.5 * seen.squaredNorm() -
           factor.matrixLLT().diagonal().array().log().sum();
  }

 private:
  using Matrix = SquareMatrix<N, MaxN>;
  Matrix identity() const { return Matrix::Identity(predicted_.size(), predicted_.size()); }

  Vector<N, MaxN> predicted_;
  Matrix root_;  ///< Y = R Rᵀ
  Vector<N, MaxN> y_;
};

}  // namespace sigmax
