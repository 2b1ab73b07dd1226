#pragma once

#include <cstddef>
#include <vector>

#include <sigmax/core/table.hpp>
#include <sigmax/hybrid/bank_filter.hpp>

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

/// The filter over histories in plain numbers; see HistoryFilter.
template <ScalableUncertainty Kind>
class HistoriesOfModes : public MultipleModelFilter<Kind> {
  using Filter = MultipleModelFilter<Kind>;

 public:
  using State = HybridEstimate<Kind>;
  using Filter::belief;
  using Filter::estimates;
  using Filter::modes;

  HistoriesOfModes(const std::vector<AnyModel>& models, ModeTransition<Kind> transition, const Estimates& start,
                   const HistoryRules<Kind>& rules = {},
                   const Interaction<Kind>& interaction = {StateAugmentation::prior});

  /// @{
  /// As of the other filters.
  void restore(const State& state) override;
  void transform(const double* A, const double* b, int axes) override;
  /// @}

  /// The mean, with its spread, of the histories in the α-cut: those whose weight is `cut` times the best one's or
  /// more, by their weights on the ratio scale, (34). With cut = 1 it is the best history's, (64)–(66); of a random
  /// mode with cut = 0, (67) and (68) over all histories. Of a state without histories, say a smoothed one: as of the
  /// other filters.
  void output(const State& state, detail::View result) const override;
  using Filter::output;

 private:
  using Filter::interaction_;
  using Filter::next;
  using Filter::now;
  using Filter::system_;

  /// A history and a mode that it may go on with.
  struct Candidate {
    History history;
    std::size_t entry;  ///< the scale of what begins
    bool best_of_mode;
  };

  void require_rules() const;
  /// The histories: of the innovation's distance, the evidence and the score, in which tempering does not enter.
  typename Filter::Predictors predictors() const override;
  void begin() override;
  bool measure(double dt, const Seen& seen, double limit) override;
  void miss(double dt) override;
  Estimates predicted() const override;
  void branch(double dt, HistorySet& predicted);
  void propose();
  void keep();
  void normalize(HistorySet& set) const;
  void summarize();
  void collapse_modes(const HistorySet& set, const HistorySet& source, Estimates& collapsed) const;
  void show_innovations();

  HistoryRules<Kind> rules_;
  std::size_t branches_;            ///< so many where a component begins
  std::vector<Estimates> entries_;  ///< what is known of it, in each
  std::vector<Candidate> candidates_;
  Table log_transition_;
  std::vector<bool> lacks_;                   ///< whether mode l lacks what j has, at l · modes + j
  std::vector<AnyInnovation> innovation_of_;  ///< of each history
  std::vector<double> log_prior_;             ///< of each, before the measurement
  std::size_t compared_;                      ///< so many predicted the last measurement
  std::vector<double> weight_;                ///< of each, given its mode
  std::vector<double> log_of_mode_;
  HistorySet predicted_;
};

extern template class HistoriesOfModes<Random>;
extern template class HistoriesOfModes<Fuzzy>;

/// The filter over mode histories. With a fuzzy mode it is the HIMM by and as printed. With a random mode
/// it is the multiple-model filter that prunes and never merges (Andersson 1985; Gustafsson 2000, chapter 10).
///
///     HistoryFilter filter{std::tuple{dwna<3>(3.0), dwpa<3>(1.0)}, transition, start};
///     for (const auto& [dt, z] : measurements) filter.step(dt, z);
///
/// Where the variable is the whole history h of the mode, nothing needs to be collapsed: what is known of the state is
/// exactly p⁺(x) ∝ ⊕_h π(h|Z) ⊗ N(x; x^h, P^h), with one Kalman filter for each history. A step branches each of them
/// into every mode, keeps the greatest, and updates these. A model that begins with a component that the mode before
/// lacked starts it by the augmentation; with StateAugmentation::prior, the default here, each scale of the prior is a
/// branch of its own. Only dropping histories approximates. `step` allocates nothing.
///
/// `belief()` is the ⊕ over the histories of each mode, `estimates()` their collapse by the mode's kind, as of the
/// other filters; docs/histories.md derives it. Made of models, transition, start, and optionally HistoryRules<Kind>
/// and an Interaction<Kind>. Throws std::invalid_argument also if a rule makes no sense.
template <class Models, ScalableUncertainty Kind>
class HistoryFilter : public BankFilter<Models, HistoriesOfModes<Kind>> {
 public:
  using BankFilter<Models, HistoriesOfModes<Kind>>::BankFilter;
};

template <class Models, ScalableUncertainty Kind, class Start, class... Rules>
HistoryFilter(Models, Relation<Kind, Kind>, Start, Rules...) -> HistoryFilter<Models, Kind>;
template <class Models, class Transition, class Start, class... Rules>
HistoryFilter(Models, Transition, Start, Rules...) -> HistoryFilter<Models, typename Transition::kind>;

}  // namespace sigmax
