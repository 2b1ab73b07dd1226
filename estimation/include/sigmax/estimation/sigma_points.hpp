#pragma once

#include <cmath>
#include <type_traits>

#include <sigmax/estimation/covariance_root.hpp>
#include <sigmax/estimation/kalman.hpp>
#include <sigmax/estimation/member.hpp>

namespace sigmax {

/// How a filter spreads its points over N(x, P) with P = L Lᵀ: at x ± √spread Lᵢ, each with the weight 1/(2 spread),
/// and at x itself with a weight for means and another for covariances.
struct SigmaPointWeights {
  double spread;
  double centre_of_mean;
  double centre_of_covariance;
};

/// A filter that replaces integrals over a Gaussian by sums over sigma points: `Unscented`, `Cubature`.
template <class Filter>
concept SigmaPointMember = NonlinearModel<typename Filter::ModelType> && requires(const Filter& member) {
  { Filter::has_centre } -> std::convertible_to<bool>;
  { member.weights() } -> std::convertible_to<SigmaPointWeights>;
};

/// The points of a member over an estimate; a column each, the centre, if any, first.
template <SigmaPointMember Filter>
class SigmaPoints {
  static constexpr int N = Filter::state_size;
  static constexpr int max_N = Filter::max_state_size;
  static constexpr int centre = Filter::has_centre ? 1 : 0;

 public:
  static constexpr int count = N == Eigen::Dynamic ? N : 2 * N + centre;
  static constexpr int max_count = 2 * max_N + centre;
  template <int Rows, int MaxRows = Rows>
  using Columns = RectangularMatrix<Rows, count, MaxRows, max_count>;

  /// Throws std::domain_error, naming the model, if the estimate's covariance is not positive semi-definite.
  SigmaPoints(const Filter& member, const EstimateOf<Filter>& estimate) {
    const Eigen::Index n = estimate.size();
    const SigmaPointWeights weights = member.weights();
    offsets_.setZero(n, 2 * n + centre);
    offsets_.middleCols(centre, n) = std::sqrt(weights.spread) * covariance_root(estimate.covariance, member.name());
    offsets_.rightCols(n) = -offsets_.middleCols(centre, n);
    mean_weights_.setConstant(2 * n + centre, 0.5 / weights.spread);
    covariance_weights_ = mean_weights_;
    if constexpr (Filter::has_centre) {
      mean_weights_(0) = weights.centre_of_mean;
      covariance_weights_(0) = weights.centre_of_covariance;
    }
  }

  Eigen::Index size() const { return offsets_.cols(); }
  /// Where the points lie about the mean.
  const Columns<N, max_N>& offsets() const { return offsets_; }
  const Vector<count, max_count>& mean_weights() const { return mean_weights_; }

  /// Σ wᵢ aᵢ bᵢᵀ over deviations from two means.
  template <int A, int MaxA, int B, int MaxB>
  RectangularMatrix<A, B, MaxA, MaxB> covariance(const Columns<A, MaxA>& a, const Columns<B, MaxB>& b) const {
    const Columns<A, MaxA> weighted = a * covariance_weights_.asDiagonal();
    return weighted.lazyProduct(b.transpose());
  }

 private:
  Columns<N, max_N> offsets_;
  Vector<count, max_count> mean_weights_;
  Vector<count, max_count> covariance_weights_;
};

namespace detail {

/// What f makes of the points over an estimate: its mean, and the deviations from it.
template <SigmaPointMember Filter>
struct Propagated {
  using Columns = typename SigmaPoints<Filter>::template Columns<Filter::state_size, Filter::max_state_size>;
  StateOf<Filter> mean;
  Columns deviations;

  Propagated(const Filter& member, const SigmaPoints<Filter>& points, const StateOf<Filter>& x, double dt)
      : deviations(x.size(), points.size()) {
    for (Eigen::Index i = 0; i < points.size(); ++i)
      deviations.col(i) = propagated(member.model(), StateOf<Filter>(x + points.offsets().col(i)), dt);
    const StateOf<Filter> first = deviations.col(0);
    deviations.colwise() -= first;  // about one of them, so that large weights of either sign cancel little
    const StateOf<Filter> shift = deviations * points.mean_weights();
    mean = first + shift;
    deviations.colwise() -= shift;
  }
};

/// Returns a symmetric sum of squares. Only a negative weight can take its definiteness away: throws std::domain_error
/// if it did.
template <SigmaPointMember Filter>
auto proved_semidefinite(const Filter& member, SquareMatrix<Filter::state_size, Filter::max_state_size> covariance) {
  mirror_lower(covariance);
  if (member.weights().centre_of_covariance < 0.0) covariance_root(covariance, member.name());
  return covariance;
}

}  // namespace detail

/// x = Σ wᵢ f(χᵢ), P = Σ wᵢ (f(χᵢ) − x)(·)ᵀ + Q over the sigma points χ; where f is linear this is the Kalman filter's
/// prediction, and is computed so. `result` may be `prior`.
/// Throws std::domain_error if a covariance is not positive semi-definite or f is not finite, naming the model.
template <SigmaPointMember Filter>
void predict(const Filter& member, const EstimateOf<Filter>& prior, double dt, EstimateOf<Filter>& result) {
  if constexpr (LinearMotion<typename Filter::ModelType>) {
    predict(member.model(), prior, dt, result);
  } else {
    const SigmaPoints<Filter> points(member, prior);
    const detail::Propagated<Filter> images(member, points, prior.mean, dt);
    result.covariance = detail::proved_semidefinite(
        member, points.covariance(images.deviations, images.deviations) + member.model().process_covariance(dt));
    result.mean = images.mean;
  }
}

/// Cov(x_k−1, x_k | z_1:k−1) = Σ wᵢ (χᵢ − x)(f(χᵢ) − x̄)ᵀ, for smoothing.
template <SigmaPointMember Filter>
SquareMatrix<Filter::state_size, Filter::max_state_size> prediction_covariance(const Filter& member,
                                                                               const EstimateOf<Filter>& prior,
                                                                               double dt) {
  const SigmaPoints<Filter> points(member, prior);
  return points.covariance(points.offsets(), detail::Propagated<Filter>(member, points, prior.mean, dt).deviations);
}

/// Update with points drawn anew over the prediction: z̄ = Σ wᵢ h(χᵢ), S = Σ wᵢ (h(χᵢ) − z̄)(·)ᵀ + R,
/// W = Σ wᵢ (χᵢ − x)(h(χᵢ) − z̄)ᵀ S⁻¹, and instead of P − W S Wᵀ the equal sum of squares
/// Σ wᵢ (χᵢ − x − W (h(χᵢ) − z̄))(·)ᵀ + W R Wᵀ, which is Joseph's form if h is linear. `posterior` may be `prior`.
/// Throws std::domain_error if a covariance is not positive (semi-)definite or h is not finite, std::invalid_argument
/// if the measurement is not finite, naming the model.
template <SigmaPointMember Filter>
Innovation<Filter::measurement_size> update(const Filter& member, const EstimateOf<Filter>& prior,
                                            const MeasurementOf<Filter>& measurement, EstimateOf<Filter>& posterior) {
  constexpr int N = Filter::state_size;
  constexpr int max_N = Filter::max_state_size;
  constexpr int M = Filter::measurement_size;
  const auto& model = member.model();
  const SigmaPoints<Filter> points(member, prior);

  typename SigmaPoints<Filter>::template Columns<M> seen(M, points.size());
  const auto see = [&](Eigen::Index i) {
    seen.col(i) = predicted_measurement(model, StateOf<Filter>(prior.mean + points.offsets().col(i)));
  };
  see(0);  // which there is, as a compiler may not see
  for (Eigen::Index i = 1; i < points.size(); ++i) see(i);
  const Vector<M> predicted = measurement_mean(model, seen, points.mean_weights());
  for (Eigen::Index i = 0; i < points.size(); ++i)
    seen.col(i) = measurement_difference(model, Vector<M>(seen.col(i)), predicted);

  Innovation<M> innovation;
  innovation.residual = measurement_difference(model, measurement.mean, predicted);
  innovation.covariance = points.covariance(seen, seen);
  innovation.covariance += measurement.covariance;
  mirror_lower(innovation.covariance);
  const SquareMatrix<M> S_inverse = detail::score(member, measurement, innovation);
  const RectangularMatrix<N, M, max_N, M> W = points.covariance(points.offsets(), seen).lazyProduct(S_inverse);

  const typename SigmaPoints<Filter>::template Columns<N, max_N> rest = points.offsets() - W.lazyProduct(seen);
  const RectangularMatrix<N, M, max_N, M> WR = W.lazyProduct(measurement.covariance);
  posterior.covariance =
      detail::proved_semidefinite(member, points.covariance(rest, rest) + WR.lazyProduct(W.transpose()));
  posterior.mean = prior.mean + W * innovation.residual;
  return innovation;
}

}  // namespace sigmax
