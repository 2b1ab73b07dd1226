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
concept SigmaPointMember = StateModel<Filter> && Motion<typename Filter::MotionType> && requires(const Filter& member) {
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
    offsets_.middleCols(centre, n) =
        std::sqrt(weights.spread) * detail::covariance_root(estimate.covariance, member.name());
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

  /// Σ wᵢ aᵢ aᵢᵀ over deviations from a mean.
  template <int A, int MaxA>
  SquareMatrix<A, MaxA> covariance(const Columns<A, MaxA>& a) const {
    const RectangularMatrix<count, A, max_count, MaxA> rows = a.transpose();  // sums run along memory
    const RectangularMatrix<count, A, max_count, MaxA> weighted = covariance_weights_.asDiagonal() * rows;
    SquareMatrix<A, MaxA> result(a.rows(), a.rows());
    for (Eigen::Index column = 0; column < a.rows(); ++column)
      for (Eigen::Index row = column; row < a.rows(); ++row)
        result(row, column) = weighted.col(row).dot(rows.col(column));
    detail::mirror_lower(result);
    return result;
  }

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
      deviations.col(i) = propagated(member.motion(), StateOf<Filter>(x + points.offsets().col(i)), dt);
    const StateOf<Filter> first = deviations.col(0);
    deviations.colwise() -= first;  // about one of them, so that large weights of either sign cancel little
    const StateOf<Filter> shift = deviations * points.mean_weights();
    mean = first + shift;
    deviations.colwise() -= shift;
  }
};

/// h of the points about a mean, a column each. Points that the sensor cannot tell from the mean share one evaluation.
template <SigmaPointMember Filter, SensorOf<Filter> Sensor>
auto seen_points(const Filter& member, const SigmaPoints<Filter>& points, const StateOf<Filter>& mean,
                 const Sensor& sensor, Eigen::Index measured) {
  const auto as_the_mean = [&](Eigen::Index i) {
    if constexpr (SeesLeading<Sensor>)
      return points.offsets().col(i).template head<Sensor::seen_size>().isZero(0.0);
    else
      return points.offsets().col(i).isZero(0.0);
  };
  typename SigmaPoints<Filter>::template Columns<Sensor::measurement_size, max_measurement_size_of<Sensor>> seen;
  seen.resize(measured, points.size());
  Eigen::Index at_mean = -1;  // the first that is seen there
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    if (at_mean >= 0 && as_the_mean(i)) {
      seen.col(i) = seen.col(at_mean);
      continue;
    }
    seen.col(i) = predicted_measurement(member.motion(), sensor, StateOf<Filter>(mean + points.offsets().col(i)));
    if (at_mean < 0 && as_the_mean(i)) at_mean = i;
  }
  return seen;
}

/// Returns a symmetric sum of squares. Only a negative weight can take its definiteness away: throws std::domain_error
/// if it did.
template <SigmaPointMember Filter>
auto proved_semidefinite(const Filter& member, StateMatrixOf<Filter> covariance) {
  detail::mirror_lower(covariance);
  if (member.weights().centre_of_covariance < 0.0) detail::covariance_root(covariance, member.name());
  return covariance;
}

}  // namespace detail

/// x = Σ wᵢ f(χᵢ), P = Σ wᵢ (f(χᵢ) − x)(·)ᵀ + Q over the sigma points χ; where f is linear this is the Kalman filter's
/// prediction, and is computed so. `result` may be `prior`.
/// Throws std::domain_error if a covariance is not positive semi-definite or f is not finite, naming the model.
template <SigmaPointMember Filter>
void predict(const Filter& member, const EstimateOf<Filter>& prior, double dt, EstimateOf<Filter>& result) {
  if constexpr (LinearMotion<typename Filter::MotionType>) {
    predict(member.motion(), prior, dt, result);
  } else if constexpr (detail::ChosenMotion<typename Filter::MotionType>) {
    detail::predict_as_chosen(member, prior, dt, result);
  } else {
    const SigmaPoints<Filter> points(member, prior);
    const detail::Propagated<Filter> images(member, points, prior.mean, dt);
    result.covariance = detail::proved_semidefinite(
        member, points.covariance(images.deviations) + member.motion().process_covariance(dt));
    result.mean = images.mean;
  }
}

/// Cov(x_k−1, x_k | z_1:k−1) = Σ wᵢ (χᵢ − x)(f(χᵢ) − x̄)ᵀ, for smoothing.
template <SigmaPointMember Filter>
StateMatrixOf<Filter> prediction_covariance(const Filter& member, const EstimateOf<Filter>& prior, double dt) {
  if constexpr (LinearMotion<typename Filter::MotionType>) {
    return prediction_covariance(member.motion(), prior, dt);
  } else if constexpr (detail::ChosenMotion<typename Filter::MotionType>) {
    return detail::covariance_as_chosen(member, prior, dt);
  } else {
    const SigmaPoints<Filter> points(member, prior);
    return points.covariance(points.offsets(), detail::Propagated<Filter>(member, points, prior.mean, dt).deviations);
  }
}

/// Update with points drawn anew over the prediction: z̄ = Σ wᵢ h(χᵢ), S = Σ wᵢ (h(χᵢ) − z̄)(·)ᵀ + R,
/// W = Σ wᵢ (χᵢ − x)(h(χᵢ) − z̄)ᵀ S⁻¹, and instead of P − W S Wᵀ the equal sum of squares
/// Σ wᵢ (χᵢ − x − W (h(χᵢ) − z̄))(·)ᵀ + W R Wᵀ. Where h is linear this is Joseph's form, and is computed so. `posterior`
/// may be `prior`. Throws std::domain_error if a covariance is not positive (semi-)definite or h is not finite,
/// std::invalid_argument if the measurement is not finite, naming the model.
template <SigmaPointMember Filter, SensorOf<Filter> Sensor>
InnovationOf<Sensor> update(const Filter& member, const EstimateOf<Filter>& prior,
                            const MeasurementOf<Sensor>& measurement, const Sensor& sensor,
                            EstimateOf<Filter>& posterior) {
  if constexpr (LinearSensorOf<Sensor, Filter>) {
    return update(member.motion(), prior, measurement, sensor, posterior);
  } else {
    constexpr int N = Filter::state_size;
    constexpr int max_N = Filter::max_state_size;
    constexpr int M = Sensor::measurement_size;
    constexpr int max_M = detail::max_measurement_size_of<Sensor>;
    using Gain = RectangularMatrix<N, M, max_N, max_M>;
    const SigmaPoints<Filter> points(member, prior);

    auto seen = detail::seen_points(member, points, prior.mean, sensor, measurement.size());
    const MeasuredOf<Sensor> predicted = measurement_mean(sensor, seen, points.mean_weights());
    for (Eigen::Index i = 0; i < points.size(); ++i)
      seen.col(i) = measurement_difference(sensor, MeasuredOf<Sensor>(seen.col(i)), predicted);

    InnovationOf<Sensor> innovation;
    innovation.residual = measurement_difference(sensor, measurement.mean, predicted);
    innovation.covariance = points.covariance(seen);
    innovation.covariance += measurement.covariance;
    detail::mirror_lower(innovation.covariance);
    const SquareMatrix<M, max_M> S_inverse = detail::score(member.name(), measurement, innovation);
    const Gain W = points.covariance(points.offsets(), seen).lazyProduct(S_inverse);

    const typename SigmaPoints<Filter>::template Columns<N, max_N> rest = points.offsets() - W.lazyProduct(seen);
    const Gain WR = W.lazyProduct(measurement.covariance);
    posterior.covariance = detail::proved_semidefinite(member, points.covariance(rest) + WR.lazyProduct(W.transpose()));
    posterior.mean = prior.mean + W * innovation.residual;
    return innovation;
  }
}

}  // namespace sigmax
