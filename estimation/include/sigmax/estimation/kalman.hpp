#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include <Eigen/Cholesky>

#include <sigmax/estimation/model.hpp>

namespace sigmax {

/// What a measurement told beyond its prediction.
template <int M>
struct Innovation {
  Vector<M> residual;             ///< ν = z − H x
  SquareMatrix<M> covariance;     ///< S, (31)
  double squared_distance = 0.0;  ///< d² = νᵀ S⁻¹ ν, the NIS
  double log_likelihood = 0.0;    ///< log N(ν; 0, S)
};

/// Prediction, (27) and (28): x = F x + u, P = F P Fᵀ + G Q Gᵀ. `result` may be `prior`.
template <LinearModel Model>
void predict(const Model& model, const EstimateOf<Model>& prior, double dt, EstimateOf<Model>& result) {
  const auto& F = model.transition(dt);
  const typename std::remove_cvref_t<decltype(prior.covariance)> FP = F * prior.covariance;
  result.mean = (F * prior.mean).eval() + model.known_input(dt);
  result.covariance.noalias() = FP * F.transpose();
  result.covariance += model.process_covariance(dt);
  mirror_lower(result.covariance);
}

/// Update, (29), (31), (32), and instead of (30) Joseph's form (I − WH) P (I − WH)ᵀ + W R Wᵀ, which keeps P symmetric
/// and positive semi-definite. `posterior` may be `prior`.
/// Throws std::domain_error if S is not positive definite, naming the model.
template <LinearModel Model>
Innovation<Model::measurement_size> update(const Model& model, const EstimateOf<Model>& prior,
                                           const MeasurementOf<Model>& measurement, EstimateOf<Model>& posterior) {
  constexpr int N = Model::state_size;
  constexpr int max_N = Model::max_state_size;
  constexpr int M = Model::measurement_size;
  using Gain = RectangularMatrix<N, M, max_N, M>;
  const auto& P = prior.covariance;
  const auto& R = measurement.covariance;

  Innovation<M> innovation;
  Gain PHt;
  if constexpr (measures_leading_components<Model>) {
    innovation.residual = measurement.mean - prior.mean.template head<M>();
    PHt = P.template leftCols<M>();
    innovation.covariance = P.template topLeftCorner<M, M>() + R;
  } else {
    const auto& H = model.measurement_matrix();
    innovation.residual = measurement.mean - H * prior.mean;
    PHt = P * H.transpose();
    innovation.covariance = H * PHt + R;
  }

  const Eigen::LLT<SquareMatrix<M>> S(innovation.covariance);
  if (S.info() != Eigen::Success)
    throw std::domain_error("the innovation covariance of model '" + std::string(model.name()) +
                            "' is not positive definite");
  // L⁻¹ column by column: for vectors of this size Eigen's triangular solver is unrolled. S⁻¹ = L⁻ᵀ L⁻¹.
  SquareMatrix<M> L_inverse;
  for (int column = 0; column < M; ++column) L_inverse.col(column) = S.matrixL().solve(Vector<M>::Unit(column));
  const Vector<M> whitened = L_inverse * innovation.residual;
  innovation.squared_distance = whitened.squaredNorm();
  innovation.log_likelihood = -0.5 * innovation.squared_distance - S.matrixLLT().diagonal().array().log().sum() -
                              0.5 * M * std::log(2.0 * std::numbers::pi);
  const SquareMatrix<M> S_inverse = L_inverse.transpose() * L_inverse;
  const Gain W = PHt.lazyProduct(S_inverse);

  SquareMatrix<N, max_N> result;
  if constexpr (measures_leading_components<Model>) {
    // I − WH = [R S⁻¹ 0; −W₂ I], so that the zeros and ones cost nothing, and I − W₁ does not cancel.
    constexpr int rest_size = N == Eigen::Dynamic ? N : N - M;
    const auto rest = extent<rest_size>(model.size() - M);
    const SquareMatrix<M> A = R * S_inverse;
    const auto W2 = W.bottomRows(rest);
    SquareMatrix<N, max_N> AP(model.size(), model.size());
    AP.template topRows<M>() = A.lazyProduct(P.template topRows<M>());
    AP.bottomRows(rest) = P.bottomRows(rest);
    AP.bottomRows(rest) -= W2.lazyProduct(P.template topRows<M>());
    result.resizeLike(P);
    result.template leftCols<M>() = AP.template leftCols<M>().lazyProduct(A.transpose());
    result.rightCols(rest) = AP.rightCols(rest);
    result.rightCols(rest) -= AP.template leftCols<M>().lazyProduct(W2.transpose());
  } else {
    const auto& H = model.measurement_matrix();
    const SquareMatrix<N, max_N> A = SquareMatrix<N, max_N>::Identity(model.size(), model.size()) - W * H;
    const SquareMatrix<N, max_N> AP = A * P;
    result.noalias() = AP * A.transpose();
  }
  const Gain WR = W.lazyProduct(R);
  result += WR.lazyProduct(W.transpose());
  mirror_lower(result);

  posterior.mean = prior.mean + W * innovation.residual;
  posterior.covariance = result;
  return innovation;
}

}  // namespace sigmax
