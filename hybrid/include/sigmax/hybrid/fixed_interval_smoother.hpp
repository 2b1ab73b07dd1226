#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <sigmax/core/logarithm.hpp>
#include <sigmax/core/table.hpp>
#include <sigmax/estimation/rts_smoother.hpp>
#include <sigmax/hybrid/multiple_model_filter.hpp>

namespace sigmax {

template <class Models, Uncertainty Kind>
class FixedIntervalSmoother {
 public:
  using State = HybridEstimate<Models, Kind>;
  bool corrected = true;

  explicit FixedIntervalSmoother(const MultipleModelFilter<Models, Kind>& filter)
      : filter_(filter), system_(filter.system()),
        pairs_(pairs_for(filter.estimates())),
        log_weight_(filter.modes()), joint_(filter.modes(), filter.modes()),
        successor_(filter.modes(), filter.modes()) {}

  void step(const State& filtered, double dt, State& smoothed) {
    const auto& transition = system_.transition(dt);
    for_each_mode(filtered.estimates, [&](auto i) {
      for_each_mode(filtered.estimates, [&](auto j) {
        joint_(i, j) = filtered.belief.log(i) + std::log(transition(i, j));
        if (joint_(i, j) == log_zero || smoothed.belief.log(j) == log_zero) return;
        const double likelihood = smooth_pair(i, j, filtered.estimates, dt, mode(smoothed.estimates, j), mode(pairs_, i)[j]);
        if (corrected) joint_(i, j) += likelihood;
      });
    });
    const std::size_t n = filter_.modes();
    for (std::size_t j = 0; j < n; ++j) {
      const double total = log_combine<AlgebraOf<Kind>>(n, [&](std::size_t i) { return joint_(i, j); }, [](std::size_t) { return 1.0; });
      for (std::size_t i = 0; i < n; ++i) joint_(i, j) = joint_(i, j) == log_zero ? log_zero : joint_(i, j) - total + smoothed.belief.log(j);
    }
    for (std::size_t i = 0; i < n; ++i) {
      log_weight_[i] = log_combine<AlgebraOf<Kind>>(n, [&](std::size_t j) { return joint_(i, j); }, [](std::size_t) { return 1.0; });
      for (std::size_t j = 0; j < n; ++j)
        successor_(i, j) = log_weight_[i] == log_zero ? 0.0 : std::exp(joint_(i, j) - log_weight_[i]);
    }
    smoothed.belief.assign([&](std::size_t i) { return log_weight_[i]; });
    for_each_mode(filtered.estimates, [&](auto i) {
      auto& result = mode(smoothed.estimates, i);
      if (log_weight_[i] == log_zero) { result = mode(filtered.estimates, i); return; }
      const auto& pairs = mode(pairs_, i);
      const std::size_t best = select(n, [&](std::size_t j) { return std::log(successor_(i, j)); }, i, Tie::stay);
      collapse(Collapse<Kind>{}, EstimateMixture<typename std::decay_t<decltype(pairs)>::value_type>{pairs},
               [&](std::size_t j) { return successor_(i, j); }, best, result);
    });
    smoothed.most_likely_mode = select(n, [&](std::size_t i) { return smoothed.belief.log(i); }, smoothed.most_likely_mode, filter_.interaction().output_tie);
  }

 private:
  template <class I, class J, class Next, class Result>
  double smooth_pair(I i, J j, const typename Bank<Models>::Estimates& filtered, double dt, const Next& next, Result& result) {
    const auto& model = mode(system_.models(), j);
    const auto& of_i = mode(filtered, i);
    Next start = mode(filtered, j);
    const auto& in_i = filter_.correspondences(j)[i].in_source;  // of the components of j
    const auto& in_j = filter_.correspondences(i)[j].in_source;
    {
      const Lifted read(mode(filtered, j), of_i, filter_.correspondences(j)[i], filter_.interaction().lift);
      start.mean = read.mean(); start.covariance.setZero(); read.add_covariance(1.0, start.covariance);
    }
    Next predicted;
    predict(model, start, dt, predicted);
    const auto cross = prediction_covariance(model, start, dt);
    using Cross = typename CrossOf<Result, Next>::type;
    Cross with_next(of_i.size(), next.size());
    for (Eigen::Index a = 0; a < of_i.size(); ++a) {
      if (in_j[std::size_t(a)] >= 0) { with_next.row(a) = cross.row(in_j[std::size_t(a)]); continue; }
      Next column; column.mean.setZero(next.size());
      for (Eigen::Index b = 0; b < next.size(); ++b)
        column.mean(b) = in_i[std::size_t(b)] >= 0 ? of_i.covariance(a, in_i[std::size_t(b)]) : 0.0;
      with_next.row(a) = start.covariance.ldlt().solve(column.mean).transpose() * cross;
    }
    step_back(of_i, with_next, predicted, next, model.name(), result);
    const auto f = predicted.covariance.ldlt();
    const auto nu = (next.mean - predicted.mean).eval();
    return -0.5 * nu.dot(f.solve(nu)) - 0.5 * f.vectorD().array().log().sum() - 0.5 * double(nu.size()) * std::log(2 * std::numbers::pi);
  }
  template <class A, class B> struct CrossOf;
  template <int N, int MaxN, int M, int MaxM> struct CrossOf<Gaussian<N, MaxN>, Gaussian<M, MaxM>> { using type = RectangularMatrix<N, M, MaxN, MaxM>; };

  MultipleModelFilter<Models, Kind> filter_;
  JumpMarkovSystem<Models, Kind> system_;
  typename Bank<Models>::Pairs pairs_;
  std::vector<double> log_weight_;
  Table joint_;
  Table successor_;
};

template <class Models, Uncertainty Kind>
std::vector<HybridEstimate<Models, Kind>> smooth(const MultipleModelFilter<Models, Kind>& filter, const std::vector<FilteredStep<HybridEstimate<Models, Kind>>>& record, bool corrected) {
  FixedIntervalSmoother<Models, Kind> smoother(filter);
  smoother.corrected = corrected;
  std::vector<HybridEstimate<Models, Kind>> smoothed;
  for (const auto& step : record) smoothed.push_back(step.state);
  for (std::size_t k = record.size(); k-- > 1;) {
    auto state = smoothed[k];
    smoother.step(record[k - 1].state, record[k].dt, state);
    smoothed[k - 1] = state;
  }
  return smoothed;
}

}  // namespace sigmax
