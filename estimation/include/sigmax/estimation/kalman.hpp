#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include <sigmax/estimation/cholesky.hpp>
#include <sigmax/estimation/sensing.hpp>
#include <sigmax/estimation/sensors.hpp>

namespace sigmax {

/// What a measurement told beyond its prediction.
template <int M, int MaxM = M>
struct Innovation {
  Vector<M, MaxM> residual;          ///< ν = z − h(x)
  SquareMatrix<M, MaxM> covariance;  ///< S, (31)
  double squared_distance = 0.0;     ///< d² = νᵀ S⁻¹ ν, the NIS
  double log_likelihood = 0.0;       ///< log N(ν; 0, S)

  Innovation() = default;
  /// The same in a type of other bounds.
  template <int OtherM, int OtherMaxM>
  explicit Innovation(const Innovation<OtherM, OtherMaxM>& other)
      : residual(other.residual),
        covariance(other.covariance),
        squared_distance(other.squared_distance),
        log_likelihood(other.log_likelihood) {}
};

/// The innovation of a sensor's measurement.
template <Sensing Sensor>
using InnovationOf = Innovation<Sensor::measurement_size, detail::max_measurement_size_of<Sensor>>;

namespace detail {

/// What the sums and products of one step may lose of the terms that they are made of.
inline constexpr double rounding = 128.0 * std::numeric_limits<double>::epsilon();

/// P = F P Fᵀ + Q, each variance with the rounding of the terms of F P Fᵀ, before they may cancel. `result` may be
/// `prior`.
template <class Transition, class Noise, int N, int MaxN>
void predict_covariance(const Transition& F, const Noise& Q, const SquareMatrix<N, MaxN>& prior,
                        SquareMatrix<N, MaxN>& result) {
  const Vector<N, MaxN> terms = F.cwiseAbs2() * prior.diagonal();
  SquareMatrix<N, MaxN> FP(prior.rows(), prior.cols());  // column by column, which makes for longer vectors
  for (Eigen::Index j = 0; j < prior.cols(); ++j) FP.col(j) = F.lazyProduct(prior.col(j));
  result.resizeLike(prior);
  for (Eigen::Index j = 0; j < prior.cols(); ++j) result.col(j) = FP.lazyProduct(F.row(j).transpose());
  result += Q;
  result.diagonal() += rounding * terms;
  detail::mirror_lower(result);
}

}  // namespace detail

/// Prediction, (27) and (28): x = F x + u, P = F P Fᵀ + G Q Gᵀ. `result` may be `prior`. The form without `result`
/// returns it.
template <LinearMotion Model>
void predict(const Model& model, const EstimateOf<Model>& prior, double dt, EstimateOf<Model>& result) {
  const auto& F = model.transition(dt);
  result.mean = (F * prior.mean).eval() + model.known_input(dt);
  detail::predict_covariance(F, model.process_covariance(dt), prior.covariance, result.covariance);
}

/// Cov(x_k−1, x_k | z_1:k−1) = P Fᵀ, n × n: what a smoother needs of a prediction beside its result.
template <LinearMotion Model>
StateMatrixOf<Model> prediction_covariance(const Model& model, const EstimateOf<Model>& prior, double dt) {
  return prior.covariance * model.transition(dt).transpose();
}

namespace detail {

/// Cholesky's factor of S. A pivot that drowned in the rounding of S, as where one model's spread is 10⁸ times as wide
/// as the measurement, is lifted above it.
template <int M, int MaxM>
std::optional<SquareMatrix<M, MaxM>> factorised(SquareMatrix<M, MaxM>& S) {
  auto L = detail::cholesky_factor(S);
  bool drowned = !L;
  for (Eigen::Index k = 0; !drowned && k < S.rows(); ++k) drowned = !((*L)(k, k) * (*L)(k, k) >= rounding * S(k, k));
  if (!drowned) return L;
  S.diagonal() *= 1.0 + rounding;
  return detail::cholesky_factor(S);
}

/// Fills in the squared distance and the log-likelihood of an innovation whose residual and covariance S are known, and
/// returns S⁻¹. `model` is its name, for messages: what depends on sizes alone is compiled once for them.
template <int M, int MaxM>
SquareMatrix<M, MaxM> score(std::string_view model, const Gaussian<M, MaxM>& measurement,
                            Innovation<M, MaxM>& innovation) {
  const auto L = factorised(innovation.covariance);
  if (!L)
    throw std::domain_error("the innovation covariance of model '" + std::string(model) + "' is not positive definite");
  const SquareMatrix<M, MaxM> L_inverse = detail::lower_inverse(*L);  // S⁻¹ = L⁻ᵀ L⁻¹
  const Vector<M, MaxM> whitened = L_inverse * innovation.residual;
  innovation.squared_distance = whitened.squaredNorm();
  innovation.log_likelihood = -0.5 * innovation.squared_distance - L->diagonal().array().log().sum() -
                              0.5 * static_cast<double>(measurement.size()) * std::log(2.0 * std::numbers::pi);
  if (!std::isfinite(innovation.squared_distance)) {  // infinite also for a finite measurement that is too far off
    if (!detail::all_finite(measurement))
      throw std::invalid_argument("a measurement of model '" + std::string(model) +
                                  "', or its covariance, is not finite");
    if (!innovation.residual.allFinite() || !innovation.covariance.allFinite())
      throw std::domain_error("the estimate of model '" + std::string(model) + "' is not finite");
    innovation.squared_distance = std::numeric_limits<double>::infinity();  // where terms of both signs overflowed
    innovation.log_likelihood = -innovation.squared_distance;
  }
  return L_inverse.transpose() * L_inverse;
}

/// Stands for H = [I 0].
template <int M>
struct LeadingComponents {
  static constexpr int ColsAtCompileTime = M;
  static constexpr int MaxColsAtCompileTime = M;
  static constexpr Eigen::Index cols() { return M; }
};

/// Joseph's update with the matrix [H 0] of a linear sensor, or the Jacobian of another, of which only H is given.
template <class MeasurementMatrix, int N, int max_N, int M, int MaxM>
Innovation<M, MaxM> update_by(std::string_view model, const MeasurementMatrix& H, const Vector<M, MaxM>& residual,
                              const Gaussian<N, max_N>& prior, const Gaussian<M, MaxM>& measurement,
                              Gaussian<N, max_N>& posterior) {
  constexpr bool leading = std::is_same_v<MeasurementMatrix, LeadingComponents<M>>;
  constexpr int K = MeasurementMatrix::ColsAtCompileTime;
  constexpr int max_K = MeasurementMatrix::MaxColsAtCompileTime;
  constexpr int rest_size = N == Eigen::Dynamic ? N : N - K;
  constexpr int max_rest_size = N == Eigen::Dynamic ? max_N : N - K;
  const auto seen = extent<K>(H.cols());
  const auto rest = extent<rest_size>(prior.size() - H.cols());
  using Gain = RectangularMatrix<N, M, max_N, MaxM>;
  const auto& P = prior.covariance;
  const auto& R = measurement.covariance;

  Innovation<M, MaxM> innovation;
  innovation.residual = residual;
  Gain PHt;
  if constexpr (leading) {
    PHt = P.leftCols(seen);
    innovation.covariance = P.topLeftCorner(seen, seen) + R;
  } else {
    PHt = P.leftCols(seen).lazyProduct(H.transpose());
    innovation.covariance = R;
    innovation.covariance += H.lazyProduct(PHt.topRows(seen));
  }
  const SquareMatrix<M, MaxM> S_inverse = score(model, measurement, innovation);
  const Gain W = PHt.lazyProduct(S_inverse);

  // I − W [H 0] = [A 0; −B I], so that the zeros and ones cost nothing; if H is I, A is R S⁻¹, which does not cancel.
  SquareMatrix<K, max_K> A;
  const auto B = [&] {
    if constexpr (leading)
      return W.bottomRows(rest);
    else
      return RectangularMatrix<rest_size, K, max_rest_size, max_K>(W.bottomRows(rest).lazyProduct(H));
  }();
  if constexpr (leading) {
    A = R.lazyProduct(S_inverse);
  } else {
    A = SquareMatrix<K, max_K>::Identity(H.cols(), H.cols());
    A -= W.topRows(seen).lazyProduct(H);
  }
  SquareMatrix<N, max_N> AP(prior.size(), prior.size());
  AP.topRows(seen) = A.lazyProduct(P.topRows(seen));
  AP.bottomRows(rest) = P.bottomRows(rest);
  AP.bottomRows(rest) -= B.lazyProduct(P.topRows(seen));
  SquareMatrix<N, max_N> result(prior.size(), prior.size());
  result.leftCols(seen) = AP.leftCols(seen).lazyProduct(A.transpose());
  result.rightCols(rest) = AP.rightCols(rest);
  result.bottomRightCorner(rest, rest) -= AP.bottomLeftCorner(rest, seen).lazyProduct(B.transpose());  // mirrored
  const Gain WR = W.lazyProduct(R);
  result += WR.lazyProduct(W.transpose());
  Vector<N, max_N> terms(prior.size());  // of the variances in (I − WH) P (I − WH)ᵀ, before they cancel
  terms.head(seen) = A.cwiseAbs2() * P.diagonal().head(seen);
  terms.tail(rest) = P.diagonal().tail(rest) + B.cwiseAbs2() * P.diagonal().head(seen);
  result.diagonal() += rounding * terms;
  detail::mirror_lower(result);

  posterior.mean = prior.mean + W * innovation.residual;
  posterior.covariance = result;
  return innovation;
}

}  // namespace detail

/// Update, (29), (31), (32), and instead of (30) Joseph's form (I − WH) P (I − WH)ᵀ + W R Wᵀ, which keeps P symmetric
/// and positive semi-definite. Of a sensor that is not linear, H = ∂h/∂x and ν = z − h(x) at the prior's mean, by the
/// sensor's own difference: the extended Kalman filter's update. `posterior` may be `prior`.
/// Throws std::domain_error if h or its Jacobian is not finite, S is not positive definite or the prior not finite,
/// std::invalid_argument if the measurement is not finite, naming the model.
template <StateModel Model, SensorOf<Model> Sensor>
InnovationOf<Sensor> update(const Model& model, const EstimateOf<Model>& prior,
                            const MeasurementOf<Sensor>& measurement, const Sensor& sensor,
                            EstimateOf<Model>& posterior) {
  if constexpr (measures_leading_components<Sensor>) {
    constexpr int M = Sensor::measurement_size;
    detail::require_seen<Sensor>(model);
    const Vector<M> residual = measurement.mean - prior.mean.template head<M>();
    return detail::update_by(model.name(), detail::LeadingComponents<M>{}, residual, prior, measurement, posterior);
  } else if constexpr (LinearSensorOf<Sensor, Model>) {
    const auto& H = measurement_matrix(model, sensor);
    const MeasuredOf<Sensor> residual = measurement.mean - H * prior.mean;
    return detail::update_by(model.name(), H, residual, prior, measurement, posterior);
  } else {
    const auto H = detail::jacobian_of_seen(model, sensor, prior.mean);
    const auto residual =
        measurement_difference(sensor, measurement.mean, predicted_measurement(model, sensor, prior.mean));
    return detail::update_by(model.name(), H, residual, prior, measurement, posterior);
  }
}

/// Update by a measurement of the position, which leads the state.
template <StateModel Model>
  requires(axes_of<Model> > 0)
Innovation<Model::axes> update(const Model& model, const EstimateOf<Model>& prior,
                               const Gaussian<Model::axes>& measurement, EstimateOf<Model>& posterior) {
  return update(model, prior, measurement, PositionSensor<Model::axes>{}, posterior);
}

/// @{
/// The same verbs, returning the estimate.
template <StateModel Model>
EstimateOf<Model> predict(const Model& model, const EstimateOf<Model>& prior, double dt) {
  EstimateOf<Model> result = prior;
  predict(model, prior, dt, result);
  return result;
}
template <StateModel Model, SensorOf<Model> Sensor>
EstimateOf<Model> update(const Model& model, const EstimateOf<Model>& prior, const MeasurementOf<Sensor>& measurement,
                         const Sensor& sensor) {
  EstimateOf<Model> result = prior;
  update(model, prior, measurement, sensor, result);
  return result;
}
template <StateModel Model>
  requires(axes_of<Model> > 0)
EstimateOf<Model> update(const Model& model, const EstimateOf<Model>& prior, const Gaussian<Model::axes>& measurement) {
  return update(model, prior, measurement, PositionSensor<Model::axes>{});
}
/// @}

}  // namespace sigmax
