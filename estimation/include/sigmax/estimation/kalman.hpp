#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <type_traits>

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

namespace detail {

/// What the sums and products of one step may lose of the terms that they are made of.
inline constexpr double rounding = 128.0 * std::numeric_limits<double>::epsilon();

/// P = F P Fᵀ + Q, each variance with the rounding of the terms of F P Fᵀ, before they may cancel. `result` may be
/// `prior`.
template <class Transition, class Noise, int N, int MaxN>
void predict_covariance(const Transition& F, const Noise& Q, const SquareMatrix<N, MaxN>& prior,
                        SquareMatrix<N, MaxN>& result) {
  const Vector<N, MaxN> terms = F.cwiseAbs2() * prior.diagonal();
  const SquareMatrix<N, MaxN> FP = F * prior;
  result.noalias() = FP * F.transpose();
  result += Q;
  result.diagonal() += rounding * terms;
  mirror_lower(result);
}

}  // namespace detail

/// Prediction, (27) and (28): x = F x + u, P = F P Fᵀ + G Q Gᵀ. `result` may be `prior`.
template <LinearMotion Model>
void predict(const Model& model, const EstimateOf<Model>& prior, double dt, EstimateOf<Model>& result) {
  const auto& F = model.transition(dt);
  result.mean = (F * prior.mean).eval() + model.known_input(dt);
  detail::predict_covariance(F, model.process_covariance(dt), prior.covariance, result.covariance);
}

/// Cov(x_k−1, x_k | z_1:k−1) = P Fᵀ, n × n: what a smoother needs of a prediction beside its result.
template <LinearMotion Model>
SquareMatrix<Model::state_size, Model::max_state_size> prediction_covariance(const Model& model,
                                                                             const EstimateOf<Model>& prior,
                                                                             double dt) {
  return prior.covariance * model.transition(dt).transpose();
}

namespace detail {

/// Cholesky's factor of S. A pivot that drowned in the rounding of S, as where one model's spread is 10⁸ times as wide
/// as the measurement, is lifted above it.
template <int M>
Eigen::LLT<SquareMatrix<M>> factorised(SquareMatrix<M>& S) {
  Eigen::LLT<SquareMatrix<M>> factors(S);
  if (factors.info() == Eigen::Success &&
      (factors.matrixLLT().diagonal().array().square() >= rounding * S.diagonal().array()).all())
    return factors;
  S.diagonal() *= 1.0 + rounding;
  return factors.compute(S);
}

/// Fills in the squared distance and the log-likelihood of an innovation whose residual and covariance S are known, and
/// returns S⁻¹.
template <class Model>
SquareMatrix<Model::measurement_size> score(const Model& model, const MeasurementOf<Model>& measurement,
                                            Innovation<Model::measurement_size>& innovation) {
  constexpr int M = Model::measurement_size;
  const Eigen::LLT<SquareMatrix<M>> S = factorised<M>(innovation.covariance);
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
  if (!std::isfinite(innovation.squared_distance)) {  // infinite also for a finite measurement that is too far off
    if (!all_finite(measurement))
      throw std::invalid_argument("a measurement of model '" + std::string(model.name()) +
                                  "', or its covariance, is not finite");
    if (std::isnan(innovation.squared_distance))
      throw std::domain_error("the estimate of model '" + std::string(model.name()) + "' is not finite");
  }
  return L_inverse.transpose() * L_inverse;
}

/// Stands for H = [I 0].
struct LeadingComponents {};

/// The update of kalman.hpp with the measurement matrix of a linear model, or the Jacobian of another.
template <class Model, class MeasurementMatrix>
Innovation<Model::measurement_size> update_by(const Model& model, const MeasurementMatrix& H,
                                              const Vector<Model::measurement_size>& residual,
                                              const EstimateOf<Model>& prior, const MeasurementOf<Model>& measurement,
                                              EstimateOf<Model>& posterior) {
  constexpr int N = Model::state_size;
  constexpr int max_N = Model::max_state_size;
  constexpr int M = Model::measurement_size;
  constexpr bool leading = std::is_same_v<MeasurementMatrix, LeadingComponents>;
  using Gain = RectangularMatrix<N, M, max_N, M>;
  const auto& P = prior.covariance;
  const auto& R = measurement.covariance;

  Innovation<M> innovation;
  innovation.residual = residual;
  Gain PHt;
  if constexpr (leading) {
    PHt = P.template leftCols<M>();
    innovation.covariance = P.template topLeftCorner<M, M>() + R;
  } else {
    PHt = P * H.transpose();
    innovation.covariance = H * PHt + R;
  }
  const SquareMatrix<M> S_inverse = score(model, measurement, innovation);
  const Gain W = PHt.lazyProduct(S_inverse);

  SquareMatrix<N, max_N> result;
  Vector<N, max_N> terms(prior.size());  // of the variances in (I − WH) P (I − WH)ᵀ, before they cancel
  if constexpr (leading) {
    // I − WH = [R S⁻¹ 0; −W₂ I], so that the zeros and ones cost nothing, and I − W₁ does not cancel.
    constexpr int rest_size = N == Eigen::Dynamic ? N : N - M;
    const auto rest = extent<rest_size>(prior.size() - M);
    const SquareMatrix<M> A = R * S_inverse;
    const auto W2 = W.bottomRows(rest);
    SquareMatrix<N, max_N> AP(prior.size(), prior.size());
    AP.template topRows<M>() = A.lazyProduct(P.template topRows<M>());
    AP.bottomRows(rest) = P.bottomRows(rest);
    AP.bottomRows(rest) -= W2.lazyProduct(P.template topRows<M>());
    terms.template head<M>() = A.cwiseAbs2() * P.diagonal().template head<M>();
    terms.tail(rest) = P.diagonal().tail(rest) + W2.cwiseAbs2() * P.diagonal().template head<M>();
    result.resizeLike(P);
    result.template leftCols<M>() = AP.template leftCols<M>().lazyProduct(A.transpose());
    result.rightCols(rest) = AP.rightCols(rest);
    result.rightCols(rest) -= AP.template leftCols<M>().lazyProduct(W2.transpose());
  } else {
    const SquareMatrix<N, max_N> A = SquareMatrix<N, max_N>::Identity(prior.size(), prior.size()) - W * H;
    const SquareMatrix<N, max_N> AP = A * P;
    result.noalias() = AP * A.transpose();
    terms = A.cwiseAbs2() * P.diagonal();
  }
  const Gain WR = W.lazyProduct(R);
  result += WR.lazyProduct(W.transpose());
  result.diagonal() += rounding * terms;
  mirror_lower(result);

  posterior.mean = prior.mean + W * innovation.residual;
  posterior.covariance = result;
  return innovation;
}

}  // namespace detail

/// Update, (29), (31), (32), and instead of (30) Joseph's form (I − WH) P (I − WH)ᵀ + W R Wᵀ, which keeps P symmetric
/// and positive semi-definite. `posterior` may be `prior`.
/// Throws std::domain_error if S is not positive definite or the prior not finite, std::invalid_argument if the
/// measurement is not finite, naming the model.
template <LinearModel Model>
Innovation<Model::measurement_size> update(const Model& model, const EstimateOf<Model>& prior,
                                           const MeasurementOf<Model>& measurement, EstimateOf<Model>& posterior) {
  constexpr int M = Model::measurement_size;
  if constexpr (measures_leading_components<Model>) {
    const Vector<M> residual = measurement.mean - prior.mean.template head<M>();
    return detail::update_by(model, detail::LeadingComponents{}, residual, prior, measurement, posterior);
  } else {
    const auto& H = model.measurement_matrix();
    const Vector<M> residual = measurement.mean - H * prior.mean;
    return detail::update_by(model, H, residual, prior, measurement, posterior);
  }
}

}  // namespace sigmax
