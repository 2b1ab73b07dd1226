#include <sigmax/hybrid/history_filter.hpp>

#include <tuple>

#include <sigmax/hybrid/sound.hpp>

#include "multiple_model_filter.hpp"

namespace sigmax {

using detail::View;

HistorySet::HistorySet(const Estimates& starts, std::size_t room) : histories_(room) {
  for (std::size_t j = 0; j < starts.size(); ++j) {
    const int n = starts.view(j).n;
    sizes_.push_back(n);
    stride_ = std::max(stride_, static_cast<std::size_t>(n * (n + 1)));
  }
  numbers_.resize(room * stride_);
  resize(starts.size());
}

std::size_t best_of(std::span<const History> histories, std::optional<std::size_t> mode) {
  std::size_t best = histories.size();
  for (std::size_t h = 0; h < histories.size(); ++h)
    if (!mode || histories[h].mode == *mode)
      if (best == histories.size() || histories[h].log_weight > histories[best].log_weight) best = h;
  return best;
}

template <ScalableUncertainty Kind>
HistoriesOfModes<Kind>::HistoriesOfModes(const std::vector<AnyModel>& models, ModeTransition<Kind> transition,
                                         const Estimates& start, const HistoryRules<Kind>& rules,
                                         const Interaction<Kind>& interaction)
    : Filter(models, std::move(transition), start, interaction),
      rules_(rules),
      branches_(interaction.augmentation == StateAugmentation::prior ? interaction.entry.scales.size() : 1),
      entries_(branches_, start),
      log_transition_(modes(), modes()),
      lacks_(modes() * modes()),
      innovation_of_(rules.histories),
      log_prior_(rules.histories),
      compared_(modes()),
      weight_(rules.histories),
      log_of_mode_(modes()),
      predicted_(start, std::max(rules.histories, modes())) {
  now().histories = next().histories = predicted_;
  require_rules();
  candidates_.reserve(rules.histories * modes() * branches_ + modes());
  for (std::size_t s = 0; s < branches_; ++s)
    detail::write_entries(models, interaction.entry, interaction.entry.scales[s], entries_[s]);
  for (std::size_t l = 0; l < modes(); ++l)
    for (std::size_t j = 0; j < modes(); ++j)
      lacks_[l * modes() + j] = std::ranges::count(this->correspondences(j)[l].in_source, -1) > 0;
  begin();
}

template <ScalableUncertainty Kind>
void HistoriesOfModes<Kind>::require_rules() const {
  using std::to_string;
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw std::invalid_argument(what);
  };
  require(rules_.histories >= modes(), to_string(rules_.histories) + " histories of " + to_string(modes()) +
                                           " modes; expected at least one of each");
  require(rules_.least_log_weight < 0.0, "histories are dropped below a weight that is not below the best one's");
  require(rules_.cut >= 0.0 && rules_.cut <= 1.0,
          "the cut of the output is " + to_string(rules_.cut) + "; expected 0 to 1");
  require(rules_.tempering > 0.0 && rules_.tempering <= 1.0,
          "the likelihood counts to the power of " + to_string(rules_.tempering) + "; expected more than 0, at most 1");
}

template <ScalableUncertainty Kind>
bool HistoriesOfModes<Kind>::measure(double dt, const Seen& seen, double limit) {
  branch(dt, predicted_);
  HistorySet& set = next().histories;
  compared_ = set.size();
  for (std::size_t h = 0; h < set.size(); ++h) {
    this->update_model(set[h].mode, predicted_.view(h), seen, set.view(h), innovation_of_[h]);
    log_prior_[h] = set[h].log_weight;
    set[h].log_weight += rules_.tempering * innovation_of_[h].log_likelihood;
  }
  if (!this->passes(limit)) return false;
  summarize();
  show_innovations();
  return true;
}

template <ScalableUncertainty Kind>
void HistoriesOfModes<Kind>::miss(double dt) {
  branch(dt, next().histories);
  summarize();
}

template <ScalableUncertainty Kind>
void HistoriesOfModes<Kind>::restore(const State& state) {
  if (state.histories.room() != rules_.histories)
    throw std::invalid_argument("a state with room for " + std::to_string(state.histories.room()) +
                                " histories; the filter has " + std::to_string(rules_.histories));
  Filter::restore(state);
}

template <ScalableUncertainty Kind>
void HistoriesOfModes<Kind>::transform(const double* A, const double* b, int axes) {
  Filter::transform(A, b, axes);
  HistorySet& set = now().histories;
  for (std::size_t h = 0; h < set.size(); ++h) detail::transform(A, b, axes, set.view(h));
}

template <ScalableUncertainty Kind>
void HistoriesOfModes<Kind>::output(const State& state, View result) const {
  const HistorySet& set = state.histories;
  const auto count = static_cast<int>(set.size());
  if (count == 0) return Filter::output(state, result);
  detail::Scratch mean(result.n), covariance(result.n * result.n);
  const View receiver{mean, covariance, result.n};
  this->output_receiver(state, receiver);
  const double greatest = set[best_of(set.all())].log_weight;
  detail::OfModes weights(count);
  detail::Parts parts(count);
  double total = 0.0;
  for (std::size_t h = 0; h < set.size(); ++h) {
    const double weight = std::exp(set[h].log_weight - greatest);
    weights[h] = weight >= rules_.cut ? weight : 0.0;
    total += weights[h];
    parts[h] = {set.view(h), this->components_.of_all() + set[h].mode};
  }
  for (std::size_t h = 0; h < set.size(); ++h) weights[h] /= total;
  detail::match_moments({receiver, {parts.data(), set.size()}, interaction_.augmentation}, weights, weights, result);
}

template <ScalableUncertainty Kind>
typename MultipleModelFilter<Kind>::Predictors HistoriesOfModes<Kind>::predictors() const {
  const auto best = std::max_element(log_prior_.begin(), log_prior_.begin() + static_cast<std::ptrdiff_t>(compared_));
  return {{innovation_of_.data(), compared_},
          {log_prior_.data(), compared_},
          static_cast<std::size_t>(best - log_prior_.begin())};
}

/// Those of its histories, by their weights after the measurement.
template <ScalableUncertainty Kind>
Estimates HistoriesOfModes<Kind>::predicted() const {
  Estimates predicted = estimates();
  collapse_modes(this->state().histories, predicted_, predicted);
  return predicted;
}

/// One history for each mode, as each starts.
template <ScalableUncertainty Kind>
void HistoriesOfModes<Kind>::begin() {
  HistorySet& set = now().histories;
  set.resize(modes());
  for (std::size_t j = 0; j < modes(); ++j) {
    set[j] = {j, j, belief().log(j)};
    detail::copy(estimates().view(j), set.view(j));
  }
}

/// Every history goes on into every mode; the greatest are kept and predict.
template <ScalableUncertainty Kind>
void HistoriesOfModes<Kind>::branch(double dt, HistorySet& predicted) {
  this->predict_mode(dt);
  propose();
  keep();
  const HistorySet& before = this->state().histories;
  const HistorySet& after = next().histories;
  predicted.resize(after.size());
  for (std::size_t h = 0; h < after.size(); ++h) {
    const std::size_t j = after[h].mode, parent = after[h].parent, l = before[parent].mode;
    predicted[h] = after[h];
    const View estimate = predicted.view(h);
    if (l == j) {
      this->predict_model(j, before.view(parent), dt, estimate);
      continue;
    }
    const Estimates& lenders =
        interaction_.augmentation == StateAugmentation::prior ? entries_[candidates_[h].entry] : estimates();
    const detail::Mixture::Part part{before.view(parent), this->correspondences(j) + l};
    detail::Mixture{lenders.view(j), {&part, 1}, interaction_.augmentation}.read(part, estimate);
    this->predict_model(j, estimate, dt, estimate);
  }
}

/// All ways to go on. A mode that nothing reaches goes on by itself, with no weight.
template <ScalableUncertainty Kind>
void HistoriesOfModes<Kind>::propose() {
  const auto& transition = system_.transition();
  for (std::size_t l = 0; l < modes(); ++l)
    for (std::size_t j = 0; j < modes(); ++j) log_transition_(l, j) = std::log(transition(l, j));
  const HistorySet& before = this->state().histories;
  const double share = SelectiveAlgebra<AlgebraOf<Kind>> ? 0.0 : std::log(static_cast<double>(branches_));
  candidates_.clear();
  for (std::size_t j = 0; j < modes(); ++j) {
    std::size_t best = candidates_.size();
    for (std::size_t h = 0; h < before.size(); ++h) {
      const std::size_t l = before[h].mode;
      const double log_weight = before[h].log_weight + log_transition_(l, j);
      if (log_weight == log_zero) continue;
      const bool begins = lacks_[l * modes() + j];
      for (std::size_t entry = 0; entry < (begins ? branches_ : 1); ++entry) {
        candidates_.push_back({{j, h, begins ? log_weight - share : log_weight}, entry, false});
        if (candidates_.back().history.log_weight > candidates_[best].history.log_weight) best = candidates_.size() - 1;
      }
    }
    if (best == candidates_.size()) candidates_.push_back({{j, best_of(before.all(), j), log_zero}, 0, false});
    candidates_[best].best_of_mode = true;
  }
}

/// The best of each mode and then the greatest, as many as there is room for, of equals the first proposed; their
/// weights are normalised.
template <ScalableUncertainty Kind>
void HistoriesOfModes<Kind>::keep() {
  double greatest = log_zero;
  for (const Candidate& each : candidates_) greatest = std::max(greatest, each.history.log_weight);
  const auto dropped = [&](const Candidate& each) {
    return !each.best_of_mode && each.history.log_weight < greatest + rules_.least_log_weight;
  };
  candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), dropped), candidates_.end());
  const auto last =
      candidates_.begin() + std::min(std::ssize(candidates_), static_cast<std::ptrdiff_t>(rules_.histories));
  std::partial_sort(candidates_.begin(), last, candidates_.end(), [](const Candidate& a, const Candidate& b) {
    if (a.best_of_mode != b.best_of_mode) return a.best_of_mode;
    const History &x = a.history, &y = b.history;
    if (x.log_weight != y.log_weight) return x.log_weight > y.log_weight;
    return std::tie(x.mode, x.parent, a.entry) < std::tie(y.mode, y.parent, b.entry);
  });
  candidates_.erase(last, candidates_.end());
  HistorySet& set = next().histories;
  set.resize(candidates_.size());
  for (std::size_t h = 0; h < set.size(); ++h) set[h] = candidates_[h].history;
  normalize(set);
}

template <ScalableUncertainty Kind>
void HistoriesOfModes<Kind>::normalize(HistorySet& set) const {
  const double total = detail::log_total<Kind>(set.size(), [&](std::size_t h) { return set[h].log_weight; });
  if (total == log_zero) check::excluded(system_.mode_variable());
  for (std::size_t h = 0; h < set.size(); ++h) set[h].log_weight -= total;
}

/// The next histories, normalised, and by modes: what the other filters have.
template <ScalableUncertainty Kind>
void HistoriesOfModes<Kind>::summarize() {
  HistorySet& set = next().histories;
  normalize(set);
  for (std::size_t j = 0; j < modes(); ++j)
    log_of_mode_[j] = detail::log_total<Kind>(
        set.size(), [&](std::size_t h) { return set[h].mode == j ? set[h].log_weight : log_zero; });
  for (std::size_t h = 0; h < set.size(); ++h) {
    const double log_mode = log_of_mode_[set[h].mode];
    weight_[h] = log_mode == log_zero ? 1.0 : std::exp(set[h].log_weight - log_mode);
  }
  next().belief.assign([&](std::size_t j) { return log_of_mode_[j]; });
  collapse_modes(set, set, next().estimates);
  for (std::size_t h = 0; h < set.size(); ++h) check::sound(this->model(set[h].mode), set.view(h));
}

/// One estimate for the histories of each mode, which `source` has, by sum and moments or by selection.
template <ScalableUncertainty Kind>
void HistoriesOfModes<Kind>::collapse_modes(const HistorySet& set, const HistorySet& source,
                                            Estimates& collapsed) const {
  detail::Parts parts(static_cast<int>(set.size()));
  detail::OfModes weights(static_cast<int>(set.size()));
  for (std::size_t j = 0; j < modes(); ++j) {
    std::size_t count = 0, best = 0;
    for (std::size_t h = 0; h < set.size(); ++h) {
      if (set[h].mode != j) continue;
      parts[count] = {source.view(h)};
      weights[count] = weight_[h];
      if (weights[count] > weights[best]) best = count;
      ++count;
    }
    detail::collapse(Collapse<Kind>{}, {collapsed.view(j), {parts.data(), count}}, weights, best, collapsed.view(j));
  }
}

/// The innovation of a mode is that of the history that was its best before the measurement.
template <ScalableUncertainty Kind>
void HistoriesOfModes<Kind>::show_innovations() {
  const HistorySet& set = next().histories;
  std::fill(log_of_mode_.begin(), log_of_mode_.end(), log_zero);
  for (std::size_t h = set.size(); h-- > 0;)
    if (const std::size_t j = set[h].mode; log_prior_[h] >= log_of_mode_[j]) {
      log_of_mode_[j] = log_prior_[h];
      this->innovations_[j] = innovation_of_[h];
    }
}

template class HistoriesOfModes<Random>;
template class HistoriesOfModes<Fuzzy>;

}  // namespace sigmax
