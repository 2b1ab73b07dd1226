#include <sigmax/hybrid/fixed_interval_smoother.hpp>

#include <algorithm>
#include <cmath>

#include <sigmax/core/logarithm.hpp>
#include <sigmax/estimation/covariance_root.hpp>
#include <sigmax/estimation/dense.hpp>
#include <sigmax/estimation/filtering.hpp>

#include "multiple_model_filter.hpp"

namespace sigmax {
namespace {

using detail::ConstView;
using detail::View;

static_assert(AnyModel::max_state_size <= detail::small_size);

void write_root(const double* covariance, int n, const AnyModel& model, double* root) {
  if (const int component = detail::covariance_root(covariance, n, root))
    detail::refuse_covariance(model.name(), component);
}

}  // namespace

template <ScalableUncertainty Kind>
FixedIntervalSmoother<Kind>::FixedIntervalSmoother(const MultipleModelFilter<Kind>& filter)
    : system_(filter.system()),
      interaction_(filter.interaction()),
      components_(system_.models()),
      entries_(filter.lenders(filter.estimates())),
      state_(filter.state()),
      pairs_(detail::pairs_of(filter.estimates())),
      filtered_(filter.estimates()),
      log_weight_(modes()),
      weights_(modes()),
      joint_(modes(), modes()) {
  const int greatest = filter.component_count();
  for (std::size_t i = 0; i < modes(); ++i) {
    const int n = filtered_.view(i).n;
    evidence_.emplace_back(greatest);  // room for what the largest model tells
    nothing_.emplace_back(n);
    parts_.emplace_back(modes());
    for (FutureEvidence& part : parts_.back()) part.clear(greatest);
    roots_.emplace_back(static_cast<std::size_t>(n * n));
  }
}

template <ScalableUncertainty Kind>
void FixedIntervalSmoother<Kind>::begin(const Step& last) {
  state_ = last.state;
  filtered_ = last.state.estimates;
  for (std::size_t j = 0; j < modes(); ++j) {
    evidence_[j].clear(filtered_.view(j).n);
    if (!last.seen.empty()) evidence_[j].add(last.seen[j]);
  }
  dt_ = last.dt;
}

template <ScalableUncertainty Kind>
void FixedIntervalSmoother<Kind>::step(const Step& before) {
  const State& filtered = before.state;
  const auto& transition = system_.transition(dt_);
  for (std::size_t i = 0; i < modes(); ++i) {
    const ConstView estimate = filtered.estimates.view(i);
    write_root(estimate.covariance, estimate.n, system_.models()[i], roots_[i].data());
  }
  for (std::size_t j = 0; j < modes(); ++j) {
    const auto pair = [&](std::size_t i) { return joint_(i, j); };
    for (std::size_t i = 0; i < modes(); ++i) joint_(i, j) = filtered.belief.log(i) + std::log(transition(i, j));
    if (detail::log_total<Kind>(modes(), pair) == log_zero || state_.belief.log(j) == log_zero) {
      for (std::size_t i = 0; i < modes(); ++i) joint_(i, j) = log_zero;
      continue;
    }
    for (std::size_t i = 0; i < modes(); ++i)
      if (joint_(i, j) != log_zero) joint_(i, j) += smooth_pair(filtered.estimates, i, j);
    const double log_total = detail::log_total<Kind>(modes(), pair);
    for (std::size_t i = 0; i < modes(); ++i) joint_(i, j) += state_.belief.log(j) - log_total;
  }
  merge(before);
  dt_ = before.dt;
}

/// The estimate of mode i given mode j next and all that came to be known in j, and what that tells of i; returns the
/// logarithm of the evidence.
template <ScalableUncertainty Kind>
double FixedIntervalSmoother<Kind>::smooth_pair(const Estimates& filtered, std::size_t i, std::size_t j) {
  const AnyModel& model = system_.models()[j];
  const ConstView of_i = filtered.view(i), known = filtered_.view(j);
  const int n = known.n, m = of_i.n;
  detail::SmallVector mean(n), moved(n);
  detail::SmallMatrix start_covariance(n, n), F(n, n), Q(n, n), root(n, n), B = detail::SmallMatrix::Zero(n, m);
  detail::Scratch<512> A(n * 2 * n);
  const View start{mean.data(), start_covariance.data(), n};  // the estimate of i in the components of j
  const auto& map = components_.of_model(j)[i];
  const Estimates& lenders = interaction_.augmentation == StateAugmentation::prior ? entries_ : filtered;
  const detail::Mixture::Part part{of_i, &map};
  detail::Mixture{lenders.view(j), {&part, 1}, interaction_.augmentation}.read(part, start);
  detail::linearised_step(model.ref(), start, dt_, moved.data(), F.data(), Q.data());

  int noises = 0;  // the columns of A
  const auto add_noise = [&](const detail::SmallMatrix& columns) {
    for (int a = 0; a < n; ++a)
      if (!columns.col(a).isZero(0.0)) Eigen::Map<Eigen::VectorXd>(A + noises++ * n, n) = columns.col(a);
  };
  write_root(Q.data(), n, model, root.data());
  add_noise(root);
  for (int b = 0; b < n; ++b) {
    const int in_i = map.in_source[static_cast<std::size_t>(b)];
    if (in_i < 0) continue;
    B.col(in_i) = F.col(b);
    start_covariance.row(b).setZero();
    start_covariance.col(b).setZero();
  }
  if (!start_covariance.isZero(0.0)) {  // what begins in j is noise, too
    write_root(start_covariance.data(), n, model, root.data());
    add_noise(F * root);
  }
  moved -= Eigen::Map<const Eigen::VectorXd>(known.mean, n);
  FutureEvidence& told = parts_[i][j];
  const double carried = evidence_[j].carry_back(moved.data(), B.data(), m, A, noises, told);
  const View pair = pairs_.view(i * modes() + j);
  detail::copy(of_i, pair);
  return carried + told.meet(roots_[i].data(), pair);
}

/// The belief of k, and for each of its modes one estimate; a mode that leads nowhere keeps its own.
template <ScalableUncertainty Kind>
void FixedIntervalSmoother<Kind>::merge(const Step& before) {
  for (std::size_t i = 0; i < modes(); ++i)
    log_weight_[i] = detail::log_total<Kind>(modes(), [&](std::size_t j) { return joint_(i, j); });
  state_.belief.assign([&](std::size_t i) { return log_weight_[i]; });
  filtered_ = before.state.estimates;
  detail::Parts parts(static_cast<int>(modes()));
  for (std::size_t i = 0; i < modes(); ++i) {
    const View result = state_.estimates.view(i);
    FutureEvidence& evidence = evidence_[i];
    if (log_weight_[i] == log_zero) {
      evidence.clear(result.n);
      detail::copy(filtered_.view(i), result);
      continue;
    }
    const auto log_weight = [&](std::size_t j) { return joint_(i, j) - log_weight_[i]; };
    for (std::size_t j = 0; j < modes(); ++j) {
      weights_[j] = std::exp(log_weight(j));
      parts[j] = {pairs_.view(i * modes() + j)};
    }
    const std::size_t best = detail::select(modes(), log_weight, i, Tie::stay);
    detail::collapse(Collapse<Kind>{}, {result, {parts.data(), modes()}}, weights_.data(), best, result);
    const FutureEvidence& seen = before.seen.empty() ? nothing_[i] : before.seen[i];
    if constexpr (SelectiveAlgebra<AlgebraOf<Kind>>) {
      evidence = parts_[i][best];
      evidence.add(seen);
    } else {
      detail::collapse(parts_[i], weights_, roots_[i].data(), seen, evidence);
    }
  }
  state_.most_likely_mode = detail::select(
      modes(), [&](std::size_t i) { return state_.belief.log(i); }, state_.most_likely_mode, interaction_.output_tie);
}

template class FixedIntervalSmoother<Random>;
template class FixedIntervalSmoother<Fuzzy>;

}  // namespace sigmax
