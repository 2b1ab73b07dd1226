#include <sigmax/hybrid/second_order_multiple_model.hpp>

#include <sigmax/hybrid/sound.hpp>

#include "multiple_model_filter.hpp"

namespace sigmax {

template <ScalableUncertainty Kind>
SecondOrderFilter<Kind>::SecondOrderFilter(const std::vector<AnyModel>& models, ModeTransition<Kind> transition,
                                           const Estimates& start, const Interaction<Kind>& interaction)
    : Filter(models, std::move(transition), start, interaction),
      predicted_(detail::pairs_of(start)),
      pairs_(predicted_),
      pair_innovations_(modes()),
      log_fit_(modes() * modes()),
      log_weight_(modes()),
      joint_(modes(), modes()),
      predecessor_(modes(), modes()) {}

template <ScalableUncertainty Kind>
bool SecondOrderFilter<Kind>::measure(double dt, const Seen& seen, double limit) {
  branch(dt);
  for (std::size_t j = 0; j < modes(); ++j) {
    for (std::size_t l = 0; l < modes(); ++l) {
      log_fit_[pair(l, j)] = log_zero;
      if (!lives(l, j)) continue;
      this->update_model(j, predicted_.view(pair(l, j)), seen, pairs_.view(pair(l, j)), pair_innovations_[l]);
      log_fit_[pair(l, j)] = joint_(j, l) - 0.5 * pair_innovations_[l].squared_distance;
      joint_(j, l) += pair_innovations_[l].log_likelihood;
    }
    summarize(j);
  }
  const auto log_fit = [this](std::size_t each) { return log_fit_[each]; };
  const bool taken = this->passes(limit, -2.0 * detail::log_total<Kind>(log_fit_.size(), log_fit));
  if (taken) merge(pairs_);
  return taken;
}

template <ScalableUncertainty Kind>
void SecondOrderFilter<Kind>::miss(double dt) {
  branch(dt);
  merge(predicted_);
}

/// Those of its predecessors, by their weights after the measurement.
template <ScalableUncertainty Kind>
Estimates SecondOrderFilter<Kind>::predicted() const {
  Estimates predicted = estimates();
  collapse_predecessors(predicted_, predicted);
  return predicted;
}

/// Every pair predicts from its predecessor's estimate, read in the components of the mode's model.
template <ScalableUncertainty Kind>
void SecondOrderFilter<Kind>::branch(double dt) {
  this->predict_mode(dt);
  const auto& transition = this->system_.transition();
  detail::Parts parts(static_cast<int>(modes()));
  for (std::size_t j = 0; j < modes(); ++j) {
    for (std::size_t l = 0; l < modes(); ++l) joint_(j, l) = belief().log(l) + std::log(transition(l, j));
    weigh(j);
    const auto lender = this->lenders(estimates()).view(j);
    const auto mixture = this->mixture(lender, this->correspondences(j), estimates(), parts);
    for (std::size_t l = 0; l < modes(); ++l) {
      if (!lives(l, j)) continue;
      const detail::View each = predicted_.view(pair(l, j));
      mixture.read(parts[l], each);
      this->predict_model(j, each, dt, each);
    }
  }
}

/// The belief is the ⊕ of the pairs' weights, and the predecessors of each mode collapse.
template <ScalableUncertainty Kind>
void SecondOrderFilter<Kind>::merge(const Estimates& pairs) {
  Estimates& merged = next().estimates;
  next().belief.assign([&](std::size_t j) { return log_weight_[j]; });
  collapse_predecessors(pairs, merged);
  for (std::size_t j = 0; j < modes(); ++j) check::sound(this->model(j), merged.view(j));
}

/// By sum and moments or by selection.
template <ScalableUncertainty Kind>
void SecondOrderFilter<Kind>::collapse_predecessors(const Estimates& pairs, Estimates& merged) const {
  detail::Parts parts(static_cast<int>(modes()));
  for (std::size_t j = 0; j < modes(); ++j) {
    for (std::size_t l = 0; l < modes(); ++l) parts[l] = {pairs.view(pair(l, j))};
    detail::collapse(Collapse<Kind>{}, {merged.view(j), {parts.data(), modes()}}, predecessor_.row(j).data(), best(j),
                     merged.view(j));
  }
}

/// The logarithm of the weight of mode j, and the weights of its predecessors given j. An excluded mode keeps those
/// that it had before the measurement, and one that nothing reaches is its own predecessor.
template <ScalableUncertainty Kind>
void SecondOrderFilter<Kind>::weigh(std::size_t j) {
  const auto log = [&](std::size_t l) { return joint_(j, l); };
  log_weight_[j] = detail::log_total<Kind>(modes(), log);
  for (std::size_t l = 0; l < modes(); ++l)
    if (log_weight_[j] != log_zero)
      predecessor_(j, l) = std::exp(log(l) - log_weight_[j]);
    else if (unreachable(j))
      predecessor_(j, l) = l == j ? 1.0 : 0.0;
}

template <ScalableUncertainty Kind>
std::size_t SecondOrderFilter<Kind>::best(std::size_t j) const {
  Tie tie = Tie::stay;
  if constexpr (SelectiveAlgebra<AlgebraOf<Kind>>) tie = this->interaction_.collapse.mixing_tie;
  return detail::select(
      modes(), [&](std::size_t l) { return std::log(predecessor_(j, l)); }, j, tie);
}

/// The innovation of a mode is that of its predicted measurement, a mixture by the weights before the measurement; from
/// then on its predecessors have those after it.
template <ScalableUncertainty Kind>
void SecondOrderFilter<Kind>::summarize(std::size_t j) {
  AnyInnovation& innovation = this->innovations_[j];
  const std::size_t winner = best(j);
  const double before = log_weight_[j], own = pair_innovations_[j].log_likelihood;
  innovation = Filter::collapsed(pair_innovations_, predecessor_.row(j).data(), winner);
  weigh(j);
  double whitened[max_measurement_size];
  innovation.squared_distance = Filter::normalize(innovation, whitened);
  innovation.log_likelihood = before == log_zero ? own : log_weight_[j] - before;
}

template class SecondOrderFilter<Random>;
template class SecondOrderFilter<Fuzzy>;

}  // namespace sigmax
