#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Cholesky>

#include <sigmax/estimation/kalman.hpp>

namespace sigmax {

/// What one step of a filter left, for smoothing: its duration in s and what it knew then.
template <class State>
struct FilteredStep {
  double dt;  ///< since the step before; ignored for the first
  State state;
};

namespace detail {

/// The estimate of x given all of what is known of y later, where y was predicted from x and smoothed since:
///
///   A = Cov(x, y) P_y⁻¹,   x + A (yˢ − y),   P_x + A (Pˢ_y − P_y) Aᵀ
///
/// `cross` is Cov(x, y), size of x times size of y. `result` may be any of the others. Throws std::domain_error, naming
/// the model, if P_y is not positive semi-definite.
template <int N, int MaxN, int M, int MaxM>
void step_back(const Gaussian<N, MaxN>& filtered, const RectangularMatrix<N, M, MaxN, MaxM>& cross,
               const Gaussian<M, MaxM>& predicted, const Gaussian<M, MaxM>& smoothed, std::string_view model,
               Gaussian<N, MaxN>& result) {
  const Eigen::LDLT<SquareMatrix<M, MaxM>> factor(predicted.covariance);
  if (factor.info() != Eigen::Success || !factor.isPositive())
    throw std::domain_error("the predicted covariance of model '" + std::string(model) +
                            "' is not positive semi-definite");
  const RectangularMatrix<M, N, MaxM, MaxN> crossed = cross.transpose();
  const RectangularMatrix<M, N, MaxM, MaxN> gain = factor.solve(crossed);  // Aᵀ
  const Vector<M, MaxM> moved = smoothed.mean - predicted.mean;
  const SquareMatrix<M, MaxM> gained = smoothed.covariance - predicted.covariance;
  const RectangularMatrix<M, N, MaxM, MaxN> product = gained.lazyProduct(gain);
  result.mean = filtered.mean + gain.transpose().lazyProduct(moved);
  result.covariance = filtered.covariance + gain.transpose().lazyProduct(product);
  mirror_lower(result.covariance);
}

}  // namespace detail

/// One step back of the smoother of Rauch, Tung and Striebel (1965): from what was known at k to what is known of k at
/// the end, where the next step took `dt` seconds and `next` is smoothed already. Works on every model and member that
/// has `predict` and `prediction_covariance`. `result` may be `filtered` or `next`.
template <class Model>
void smooth_step(const Model& model, const EstimateOf<Model>& filtered, double dt, const EstimateOf<Model>& next,
                 EstimateOf<Model>& result) {
  EstimateOf<Model> predicted;
  predict(model, filtered, dt, predicted);
  const RectangularMatrix<Model::state_size, Model::state_size, Model::max_state_size, Model::max_state_size> cross =
      prediction_covariance(model, filtered, dt);
  detail::step_back(filtered, cross, predicted, next, model.name(), result);
}

/// The smoothed estimates of a whole interval, one for each filtered one; the last is itself.
///
///     std::vector<FilteredStep<EstimateOf<Model>>> record;   // grows with the interval
///     … predict, update, record.push_back({dt, estimate}); …
///     const auto smoothed = smooth(model, record);
template <class Model>
std::vector<EstimateOf<Model>> smooth(const Model& model, const std::vector<FilteredStep<EstimateOf<Model>>>& record) {
  std::vector<EstimateOf<Model>> smoothed(record.size());
  if (!record.empty()) smoothed.back() = record.back().state;
  for (std::size_t k = record.size(); k-- > 1;)
    smooth_step(model, record[k - 1].state, record[k].dt, smoothed[k], smoothed[k - 1]);
  return smoothed;
}

}  // namespace sigmax
