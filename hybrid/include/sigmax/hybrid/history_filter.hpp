#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <sigmax/core/compose.hpp>
#include <sigmax/core/logarithm.hpp>
#include <sigmax/core/table.hpp>
#include <sigmax/hybrid/history_set.hpp>
#include <sigmax/hybrid/multiple_model_filter.hpp>
#include <sigmax/hybrid/sound.hpp>

namespace sigmax {

/// What a HistoryFilter keeps and shows.
template <ScalableUncertainty Kind>
struct HistoryRules {
  std::size_t histories = 24;     ///< so many at most, and at least one of each mode
  double least_log_weight = -12;  ///< beside the best; what is below is dropped, but for the last one of a mode
  double cut = SelectiveAlgebra<AlgebraOf<Kind>> ? 0.05 : 0.0;  ///< the output is of the histories with so much of the
                                                                ///< best one's weight; 1 is the best alone
  double tempering = 1.0;  ///< Λ counts as Λ^τ; below 1 for models that are too sure of themselves
};

/// The filter over mode histories: of a fuzzy mode the HIMM that takes and by their word, of a random mode
/// the multiple-model filter that prunes and never merges (Andersson 1985; Gustafsson 2000, chapter 10).
///
///     HistoryFilter filter{std::tuple{dwna<3>(3.0), dwpa<3>(1.0)}, transition, start};
///     for (const auto& [dt, z] : measurements) filter.step(dt, z);
///
/// Where the variable is the whole history h of the mode, nothing needs to be collapsed: what is known of the state is
/// exactly p⁺(x) ∝ ⊕_h π(h|Z) ⊗ N(x; x^h, P^h), with one Kalman filter for each history. A step branches each of them
/// into every mode, keeps the greatest, and updates these. A model that begins with a component that the mode before
/// lacked starts it by the lift; with Lift::prior, the default here, each scale of the prior is a branch of its own.
/// Only dropping histories approximates. `step` allocates nothing.
///
/// `belief()` is the ⊕ over the histories of each mode, `estimates()` their collapse by the mode's kind, as of the
/// other filters; docs/histories.md derives it.
template <class Models, ScalableUncertainty Kind>
class HistoryFilter : public MultipleModelFilter<Models, Kind> {
  using Filter = MultipleModelFilter<Models, Kind>;

 public:
  using Filter::belief;
  using Filter::estimates;
  using Filter::modes;
  using Filter::most_likely_mode;
  using typename Filter::Estimate;
  using typename Filter::Estimates;
  using typename Filter::Measurement;
  using Rules = HistoryRules<Kind>;
  using State = HistorySet<Models>;

  /// As InteractingMultipleModel. Throws std::invalid_argument also if a rule makes no sense.
  HistoryFilter(Models models, ModeTransition<Kind> transition, Estimates start, const Rules& rules = {},
                Interaction<Kind> interaction = {Lift::prior})
      : Filter(std::move(models), std::move(transition), std::move(start), std::move(interaction)),
        rules_(rules),
        branches_(branches(interaction_)),
        entries_(branches_, estimates()),
        log_transition_(modes(), modes()),
        lacks_(modes() * modes()),
        innovation_of_(rules.histories),
        log_prior_(rules.histories),
        weight_(rules.histories),
        log_of_mode_(modes()),
        sets_{State{estimates(), rules.histories}, State{estimates(), rules.histories}},
        predicted_(sets_[0]) {
    require_rules();
    candidates_.reserve(rules.histories * modes() * branches_ + modes());
    for (std::size_t s = 0; s < branches_; ++s)
      Components<Models>::entries(system_.models(), interaction_.entry, interaction_.entry.scales[s], entries_[s]);
    for (std::size_t l = 0; l < modes(); ++l)
      for (std::size_t j = 0; j < modes(); ++j) {
        const auto& in_source = this->correspondences(j)[l].in_source;
        lacks_[l * modes() + j] = std::count(in_source.begin(), in_source.end(), -1) > 0;
      }
    begin();
  }
  template <int N, int MaxN>
  HistoryFilter(Models models, ModeTransition<Kind> transition, const Gaussian<N, MaxN>& start, const Rules& rules = {},
                Interaction<Kind> interaction = {Lift::prior})
      : HistoryFilter(models, std::move(transition), Components<Models>(models).shares(models, start), rules,
                      std::move(interaction)) {}

  const Rules& rules() const { return rules_; }

  /// One cycle; what it takes and throws is as of InteractingMultipleModel.
  template <SensorOfBank<Models> Sensor>
  void step(double dt, const MeasurementOf<Sensor>& z, const Sensor& sensor, double gate = no_gate) {
    this->require(dt, z);
    bool taken = false;
    this->located(dt, [&] {
      branch(dt, predicted_.estimates());
      State& next = next_set();
      for_each_history(next, [&](auto j, std::size_t h) {
        auto& innovation = innovation_of_[h];
        const auto& model = mode(system_.models(), j);
        this->assign(update(model, predicted_.estimates(j)[h], z, sensor, next.estimates(j)[h]), innovation);
        log_prior_[h] = next[h].log_weight;
        next[h].log_weight += rules_.tempering * this->log_likelihood(j, innovation);
      });
      taken = this->passes(gate, next.size(),
                           [this](std::size_t h) { return log_prior_[h] - 0.5 * innovation_of_[h].squared_distance; });
      if (taken) weigh(next);
    });
    if (!taken) return step(dt);
    show_innovations();
    conclude(true);
  }

  /// The same with a measurement of the position, which leads the state of every model.
  void step(double dt, const Measurement& z, double gate = no_gate) requires(Filter::axes > 0) {
    step(dt, z, PositionSensor<Filter::axes>{}, gate);
  }

  /// One cycle without a measurement.
  void step(double dt) {
    this->require(dt);
    this->located(dt, [&] {
      branch(dt, next_set().estimates());
      weigh(next_set());
    });
    conclude(false);
  }

  /// The histories that are kept, and all that the next step depends on.
  const State& state() const { return sets_[current_]; }

  /// As of the other filters.
  void restore(const State& state) {
    if (state.room() != rules_.histories)
      throw std::invalid_argument("a state with room for " + std::to_string(state.room()) +
                                  " histories; the filter has " + std::to_string(rules_.histories));
    sets_[current_] = state;
    summarize(sets_[current_]);
    this->next().most_likely_mode = state.most_likely_mode;
    Filter::restore(this->next());
  }
  template <class Start>
  void restart(const Start& start) {
    Filter::restart(start);
    begin();
  }
  void transform(const SquareMatrix<Eigen::Dynamic, 3>& A, const Vector<Eigen::Dynamic, 3>& b) {
    Filter::transform(A, b);
    State& set = sets_[current_];
    for_each_history(set, [&](auto j, std::size_t h) { sigmax::transform(A, b, set.estimates(j)[h]); });
  }

  /// The mean, with its spread, of the histories in the α-cut: those whose weight is `cut` times the best one's or
  /// more, by their weights on the ratio scale, (34). With cut = 1 it is the best history's, (64)–(66); of a random
  /// mode with cut = 0, (67) and (68) over all histories.
  Estimate estimate() const {
    const State& set = state();
    const auto& receiver = this->output_receiver(Filter::state());
    const double greatest = set[set.best()].log_weight;
    double total = 0.0;
    const auto in_cut = [&](std::size_t h) {
      const double weight = std::exp(set[h].log_weight - greatest);
      return weight >= rules_.cut ? weight : 0.0;
    };
    for (std::size_t h = 0; h < set.size(); ++h) total += in_cut(h);
    Estimate result = receiver;
    const auto weight = [&](std::size_t h) { return in_cut(h) / total; };
    detail::match_moments(OutputMixture{*this, receiver}, weight, weight, result);
    return result;
  }
  /// That of another state by modes, say a smoothed one: as of the other filters.
  using Filter::estimate;

  /// Normalised innovation squared of the predicted measurement, a mixture over the histories collapsed as the mode's
  /// kind asks. Throws std::logic_error if the last step had no measurement.
  double nis() const { return normalized_innovation().squaredNorm(); }

  /// @{
  /// As of the other filters, over the histories rather than the modes; tempering does not enter.
  Vector<Eigen::Dynamic, max_measurement_size> normalized_innovation() const {
    if (!this->measured()) throw std::logic_error("nis() after a step without a measurement");
    const std::size_t size = state().size();
    std::size_t best = 0;
    for (std::size_t h = 1; h < size; ++h)
      if (log_prior_[h] > log_prior_[best]) best = h;
    return Filter::normalized(Filter::collapsed_innovation(
        innovation_of_, [&](std::size_t h) { return h < size ? std::exp(log_prior_[h]) : 0.0; }, best));
  }
  double log_evidence() const {
    return detail::log_combine<AlgebraOf<Kind>>(
        state().size(), [this](std::size_t h) { return log_prior_[h] + innovation_of_[h].log_likelihood; },
        Filter::unit);
  }
  double log_score() const {
    return log_evidence() - detail::log_combine<Sigma>(
                                state().size(), [this](std::size_t h) { return log_prior_[h]; }, Filter::unit);
  }
  /// @}

  /// As InteractingMultipleModel. A non-linear measurement is linearised about what the mode predicted: that of its
  /// histories, by their weights after the measurement.
  template <Sensing Sensor>
  RecordedStep<Models, Kind> recorded(double dt, const MeasurementOf<Sensor>& z, const Sensor& sensor) const {
    Estimates predicted = estimates();
    collapse_modes(state(), predicted_, predicted);
    return this->recorded_by(dt, z, sensor, predicted);
  }
  RecordedStep<Models, Kind> recorded(double dt, const Measurement& z) const requires(Filter::axes > 0) {
    return recorded(dt, z, PositionSensor<Filter::axes>{});
  }
  RecordedStep<Models, Kind> recorded(double dt) const { return this->recorded_as_missed(dt); }

 private:
  using Pairs = typename Bank<Models>::Pairs;
  using Filter::innovations_;
  using Filter::interaction_;
  using Filter::prior_;
  using Filter::system_;

  /// A history and a mode that it may go on with.
  struct Candidate {
    History history;
    std::size_t entry;  ///< the scale of what begins
    bool best_of_mode;
  };

  /// The histories as the parts of a mixture in the components of the output.
  struct OutputMixture {
    const HistoryFilter& filter;
    const Estimate& receiver;

    template <class Visit>
    void visit_all(const Visit& visit) const {
      filter.for_each_history(filter.state(), [&](auto j, std::size_t h) {
        visit(h, Lifted(receiver, filter.state().estimates(j)[h], filter.correspondences_of_output()[j],
                        filter.interaction_.lift));
      });
    }
  };

  static std::size_t branches(const Interaction<Kind>& interaction) {
    return interaction.lift == Lift::prior ? interaction.entry.scales.size() : 1;
  }

  void require_rules() const {
    if (rules_.histories < modes())
      throw std::invalid_argument(std::to_string(rules_.histories) + " histories of " + std::to_string(modes()) +
                                  " modes; expected at least one of each");
    if (!(rules_.least_log_weight < 0.0))
      throw std::invalid_argument("histories are dropped below a weight that is not below the best one's");
    if (!(rules_.cut >= 0.0 && rules_.cut <= 1.0))
      throw std::invalid_argument("the cut of the output is " + std::to_string(rules_.cut) + "; expected 0 to 1");
    if (!(rules_.tempering > 0.0 && rules_.tempering <= 1.0))
      throw std::invalid_argument("the likelihood counts to the power of " + std::to_string(rules_.tempering) +
                                  "; expected more than 0, at most 1");
  }

  State& next_set() { return sets_[1 - current_]; }

  /// Calls visit(mode, place) for every history.
  template <class Set, class Visit>
  void for_each_history(Set& set, const Visit& visit) const {
    for_each_mode(system_.models(), [&](auto j) {
      for (std::size_t h = 0; h < set.size(); ++h)
        if (set[h].mode == j) visit(j, h);
    });
  }

  /// One history for each mode, as each starts.
  void begin() {
    State& set = sets_[current_];
    set.resize(modes());
    set.most_likely_mode = most_likely_mode();
    for_each_mode(system_.models(), [&](auto j) {
      set[j] = {j, j, belief().log(j)};
      set.estimates(j)[j] = mode(estimates(), j);
    });
  }

  /// Every history goes on into every mode; the greatest are kept and predict.
  void branch(double dt, Pairs& predicted) {
    this->predict_mode(dt);
    propose();
    keep();
    const State& before = state();
    const State& after = next_set();
    for_each_history(after, [&](auto j, std::size_t h) {
      const std::size_t parent = after[h].parent;
      const auto& model = mode(system_.models(), j);
      auto& estimate = mode(predicted, j)[h];
      if (before[parent].mode == j) return predict(model, before.estimates(j)[parent], dt, estimate);
      for_each_mode(system_.models(), [&](auto l) {
        if (l != before[parent].mode) return;
        const auto& lender = mode(interaction_.lift == Lift::prior ? entries_[candidates_[h].entry] : estimates(), j);
        const Lifted read(lender, before.estimates(l)[parent], this->correspondences(j)[l], interaction_.lift);
        estimate.mean = read.mean();
        estimate.covariance.setZero();
        read.add_covariance(1.0, estimate.covariance);
      });
      predict(model, estimate, dt, estimate);
    });
  }

  /// All ways to go on. A mode that nothing reaches goes on by itself, with no weight.
  void propose() {
    const auto& transition = system_.transition();
    for (std::size_t l = 0; l < modes(); ++l)
      for (std::size_t j = 0; j < modes(); ++j) log_transition_(l, j) = std::log(transition(l, j));
    const State& before = state();
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
          if (candidates_.back().history.log_weight > candidates_[best].history.log_weight)
            best = candidates_.size() - 1;
        }
      }
      if (best == candidates_.size()) candidates_.push_back({{j, last_of(j), log_zero}, 0, false});
      candidates_[best].best_of_mode = true;
    }
  }

  /// The best of the histories that end in mode j.
  std::size_t last_of(std::size_t j) const {
    const State& set = state();
    std::size_t best = set.size();
    for (std::size_t h = 0; h < set.size(); ++h)
      if (set[h].mode == j && (best == set.size() || set[h].log_weight > set[best].log_weight)) best = h;
    return best;
  }

  /// The best of each mode and then the greatest, as many as there is room for, of equals the first proposed; their
  /// weights are normalised.
  void keep() {
    double greatest = log_zero;
    for (const Candidate& each : candidates_) greatest = std::max(greatest, each.history.log_weight);
    const auto dropped = [&](const Candidate& each) {
      return !each.best_of_mode && each.history.log_weight < greatest + rules_.least_log_weight;
    };
    candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), dropped), candidates_.end());
    const std::size_t kept = std::min(candidates_.size(), rules_.histories);
    const auto last = candidates_.begin() + static_cast<std::ptrdiff_t>(kept);
    std::partial_sort(candidates_.begin(), last, candidates_.end(), [](const Candidate& a, const Candidate& b) {
      if (a.best_of_mode != b.best_of_mode) return a.best_of_mode;
      const History &x = a.history, &y = b.history;
      if (x.log_weight != y.log_weight) return x.log_weight > y.log_weight;
      return std::tie(x.mode, x.parent, a.entry) < std::tie(y.mode, y.parent, b.entry);
    });
    candidates_.erase(last, candidates_.end());
    State& next = next_set();
    next.resize(candidates_.size());
    for (std::size_t h = 0; h < next.size(); ++h) next[h] = candidates_[h].history;
    normalize(next);
  }

  void normalize(State& set) const {
    const double total = detail::log_combine<AlgebraOf<Kind>>(
        set.size(), [&](std::size_t h) { return set[h].log_weight; }, [](std::size_t) { return 1.0; });
    if (total == log_zero) check::excluded(system_.mode_variable());
    for (std::size_t h = 0; h < set.size(); ++h) set[h].log_weight -= total;
  }

  void weigh(State& set) {
    normalize(set);
    summarize(set);
  }

  /// The histories by modes: what the other filters have.
  void summarize(const State& set) {
    for (std::size_t j = 0; j < modes(); ++j)
      log_of_mode_[j] = detail::log_combine<AlgebraOf<Kind>>(
          set.size(), [&](std::size_t h) { return set[h].mode == j ? set[h].log_weight : log_zero; },
          [](std::size_t) { return 1.0; });
    for (std::size_t h = 0; h < set.size(); ++h) {
      const double log_mode = log_of_mode_[set[h].mode];
      weight_[h] = log_mode == log_zero ? 1.0 : std::exp(set[h].log_weight - log_mode);
    }
    this->next().belief.assign([&](std::size_t j) { return log_of_mode_[j]; });
    collapse_modes(set, set, this->next().estimates);
    for_each_history(set, [&](auto j, std::size_t h) { check::sound(mode(system_.models(), j), set.estimates(j)[h]); });
  }

  /// One estimate for the histories of each mode, which `source` has, by sum and moments or by selection.
  void collapse_modes(const State& set, const State& source, Estimates& collapsed) const {
    for_each_mode(collapsed, [&](auto j) {
      const auto weight = [&](std::size_t h) { return h < set.size() && set[h].mode == j ? weight_[h] : 0.0; };
      std::size_t best = 0;
      for (std::size_t h = 1; h < set.size(); ++h)
        if (weight(h) > weight(best)) best = h;
      using Each = std::decay_t<decltype(mode(collapsed, j))>;
      collapse(Collapse<Kind>{}, EstimateMixture<Each>{source.estimates(j)}, weight, best, mode(collapsed, j));
    });
  }

  /// The innovation of a mode is that of the history that was its best before the measurement.
  void show_innovations() {
    const State& set = next_set();
    for (std::size_t j = 0; j < modes(); ++j) {
      double greatest = log_zero;
      for (std::size_t h = set.size(); h-- > 0;)
        if (set[h].mode == j && log_prior_[h] >= greatest) {
          greatest = log_prior_[h];
          innovations_[j] = innovation_of_[h];
        }
    }
  }

  void conclude(bool measured) {
    Filter::conclude(measured);
    current_ = 1 - current_;
    sets_[current_].most_likely_mode = most_likely_mode();
  }

  Rules rules_;
  std::size_t branches_;            ///< so many where a component begins
  std::vector<Estimates> entries_;  ///< what is known of it, in each
  std::vector<Candidate> candidates_;
  Table log_transition_;
  std::vector<bool> lacks_;                   ///< whether mode l lacks what j has, at l · modes + j
  std::vector<AnyInnovation> innovation_of_;  ///< of each history
  std::vector<double> log_prior_;             ///< of each, before the measurement
  std::vector<double> weight_;                ///< of each, given its mode
  std::vector<double> log_of_mode_;
  std::array<State, 2> sets_;
  std::size_t current_ = 0;
  State predicted_;
};

template <class Models, ScalableUncertainty Kind, class Start>
HistoryFilter(Models, Relation<Kind, Kind>, Start) -> HistoryFilter<Models, Kind>;
template <class Models, ScalableUncertainty Kind, class Start>
HistoryFilter(Models, Relation<Kind, Kind>, Start, HistoryRules<Kind>) -> HistoryFilter<Models, Kind>;
template <class Models, ScalableUncertainty Kind, class Start>
HistoryFilter(Models, Relation<Kind, Kind>, Start, HistoryRules<Kind>, Interaction<Kind>)
    -> HistoryFilter<Models, Kind>;
template <class Models, class Transition, class Start>
HistoryFilter(Models, Transition, Start) -> HistoryFilter<Models, typename Transition::kind>;
template <class Models, class Transition, class Start, ScalableUncertainty Kind>
HistoryFilter(Models, Transition, Start, HistoryRules<Kind>) -> HistoryFilter<Models, Kind>;
template <class Models, class Transition, class Start, ScalableUncertainty Kind>
HistoryFilter(Models, Transition, Start, HistoryRules<Kind>, Interaction<Kind>) -> HistoryFilter<Models, Kind>;

}  // namespace sigmax
