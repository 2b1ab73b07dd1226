#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

#include <sigmax/core/logarithm.hpp>
#include <sigmax/estimation/kalman.hpp>

namespace sigmax {

/// A Gaussian possibility function, (33): π(x) = exp(−½ (x−m)ᵀ Σ⁻¹ (x−m)), with sup π = 1.
///
///     GaussianPossibility position{Gaussian<2>{m, P}};
///     position({1.0, 2.0});   // how possible
///
/// It is kept by m and Σ, so Σ may be singular; π is then zero off the support m + range Σ, and on it the distance is
/// measured within. In the linear-Gaussian case the recursion (36), (37) takes m and Σ where the Kalman filter takes
/// mean and covariance (docs/max_inference.md has the proof), so `predict` and `update` are those of kalman.hpp.
template <int N>
class GaussianPossibility {
 public:
  /// The ratio-scale transform (34) of a Gaussian density: same m, same Σ, without the factor √((2π)ᴺ det Σ).
  /// Throws std::invalid_argument if a number is not finite, std::domain_error if Σ is not positive semi-definite.
  explicit GaussianPossibility(Gaussian<N> density) : density_(std::move(density)) {
    if (!density_.mean.allFinite() || !density_.covariance.allFinite())
      throw std::invalid_argument("a Gaussian possibility function needs finite numbers");
    // Σ = Σ_k d_k l_k l_kᵀ, the greatest remaining variance first; what is left when none remains must be rounding.
    SquareMatrix<N> rest = density_.covariance;
    threshold_ = 10 * N * std::numeric_limits<double>::epsilon() * rest.diagonal().cwiseAbs().maxCoeff();
    for (Eigen::Index pivot = 0; rank_ < N && rest.diagonal().maxCoeff(&pivot) > threshold_; ++rank_) {
      const double d = rest(pivot, pivot);
      const Vector<N> l = rest.col(pivot) / d;
      rest -= d * l * l.transpose();
      rest.row(pivot).setZero();
      rest.col(pivot).setZero();
      factors_[static_cast<std::size_t>(rank_)] = {pivot, d, l};
    }
    if (!(rest.cwiseAbs().maxCoeff() <= threshold_))
      throw std::domain_error("the covariance of a Gaussian possibility function is not positive semi-definite");
  }

  const Vector<N>& mean() const { return density_.mean; }
  const SquareMatrix<N>& covariance() const { return density_.covariance; }

  /// The transform back, (35): the Gaussian density in proportion to π.
  const Gaussian<N>& density() const { return density_; }

  /// π(x).
  double operator()(const Vector<N>& x) const { return std::exp(log(x)); }

  /// log π(x); −∞ off the support. Points within about 1e-7 of the largest deviation √Σ_ii count as on it.
  double log(const Vector<N>& x) const {
    Vector<N> y = x - mean();
    double squared_distance = 0.0;
    for (Eigen::Index k = 0; k < rank_; ++k) {
      const auto& [pivot, d, l] = factors_[static_cast<std::size_t>(k)];
      const double component = y(pivot);
      squared_distance += component * component / d;
      y -= component * l;
    }
    return y.squaredNorm() <= threshold_ ? -0.5 * squared_distance : log_zero;
  }

 private:
  struct Factor {
    Eigen::Index pivot;
    double d;
    Vector<N> l;
  };
  Gaussian<N> density_;
  std::array<Factor, std::size_t{N}> factors_;  // LDLᵀ with pivots, columns in the order of the state
  Eigen::Index rank_ = 0;
  double threshold_ = 0.0;  // variances below are rounding
};

template <int N>
GaussianPossibility(Gaussian<N, N>) -> GaussianPossibility<N>;

/// The possibility function of a model's state, whose size the type says.
template <LinearMotion Model>
  requires(Model::state_size > 0)
using PossibilityOf = GaussianPossibility<Model::state_size>;

/// Prediction by supremum, (36): π(x_k) = sup over x_{k−1} of π(x_k|x_{k−1}) π(x_{k−1}).
template <LinearMotion Model>
PossibilityOf<Model> predict(const Model& model, const PossibilityOf<Model>& prior, double dt) {
  Gaussian<Model::state_size> moments = prior.density();
  predict(model, moments, dt, moments);
  return PossibilityOf<Model>{moments};
}

/// Update by supremum, (37): π(x|z) = π(z|x) π(x) / sup over x of the same, with a linear sensor, the position's if
/// none is given. Throws as the Kalman filter's does.
template <LinearMotion Model, LinearSensorOf<Model> Sensor = PositionSensor<axes_of<Model>>>
PossibilityOf<Model> update(const Model& model, const PossibilityOf<Model>& prior,
                            const MeasurementOf<Sensor>& measurement, const Sensor& sensor = {}) {
  Gaussian<Model::state_size> moments = prior.density();
  update(model, moments, measurement, sensor, moments);
  return PossibilityOf<Model>{moments};
}

/// The logarithm of the supremum by which (37) divides, how possible the measurement was: −d²/2. It differs from the
/// log-likelihood log N(ν; 0, S) by exactly ½ log((2π)ᴹ det S).
template <int M>
double log_possibility(const Innovation<M>& innovation) {
  return -0.5 * innovation.squared_distance;
}

}  // namespace sigmax
