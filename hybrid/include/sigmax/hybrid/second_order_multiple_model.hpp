#pragma once

#include <vector>

#include <sigmax/core/table.hpp>
#include <sigmax/hybrid/bank_filter.hpp>

namespace sigmax {

/// The second-order multiple-model filter in plain numbers; see SecondOrderMultipleModel.
template <ScalableUncertainty Kind>
class SecondOrderFilter : public MultipleModelFilter<Kind> {
  using Filter = MultipleModelFilter<Kind>;

 public:
  using Filter::belief;
  using Filter::estimates;
  using Filter::modes;

  SecondOrderFilter(const std::vector<AnyModel>& models, ModeTransition<Kind> transition, const Estimates& start,
                    const Interaction<Kind>& interaction = {});

 private:
  using Filter::next;

  bool measure(double dt, const Seen& seen, double limit) override;
  void miss(double dt) override;
  Estimates predicted() const override;
  void branch(double dt);
  void merge(const Estimates& pairs);
  void collapse_predecessors(const Estimates& pairs, Estimates& merged) const;
  void weigh(std::size_t j);
  void summarize(std::size_t j);

  bool unreachable(std::size_t j) const { return this->prior_.log(j) == log_zero; }
  bool lives(std::size_t l, std::size_t j) const { return joint_(j, l) != log_zero || (l == j && unreachable(j)); }
  std::size_t best(std::size_t j) const;
  std::size_t pair(std::size_t l, std::size_t j) const { return j * modes() + l; }

  Estimates predicted_;                          ///< of mode j: one for each predecessor l, at `pair(l, j)`
  Estimates pairs_;                              ///< the same, after the measurement
  std::vector<AnyInnovation> pair_innovations_;  ///< of the mode at hand
  std::vector<double> log_fit_;                  ///< of all pairs, for the gate
  std::vector<double> log_weight_;               ///< of each mode
  Table joint_;        ///< logarithms of π(j|l) ⊗ b(l), and with the measurement ⊗ Λ_lj, at (j, l)
  Table predecessor_;  ///< the same, given j
};

extern template class SecondOrderFilter<Random>;
extern template class SecondOrderFilter<Fuzzy>;

/// The second-order multiple-model filter. With a random mode it is GPB2 (Tugnait 1982; Bar-Shalom, Li, Kirubarajan
/// 2001, 11.6.5). With a fuzzy mode it is the Viterbi filter (Averbuch, Itzikowitz, Kapon 1991), which keeps the best
/// predecessor of each mode. The mode's kind is the only difference, and HIMM : Viterbi = IMM : GPB2.
///
///     SecondOrderMultipleModel filter{std::tuple{dwna<3>(3.0), dwpa<3>(3.0)}, transition, start};
///
/// Each of the M² pairs of a predecessor l and a mode j predicts and updates; the predecessors of a mode then collapse
/// *after* the measurement, by their weights π(j|l) ⊗ b(l) ⊗ Λ_lj. There is no mixed start: of `Interaction`, its
/// readings (`mixed_start`, `mixed_covariance`, `mixing_weights`) do not concern that collapse,
/// `MixedCovariance::envelope` only the output; `mixing_tie` is the tie among predecessors. `step` allocates nothing.
/// Made of what an InteractingMultipleModel is made of.
template <class Models, ScalableUncertainty Kind>
class SecondOrderMultipleModel : public BankFilter<Models, SecondOrderFilter<Kind>> {
 public:
  using BankFilter<Models, SecondOrderFilter<Kind>>::BankFilter;
};

template <class Models, ScalableUncertainty Kind, class Start, class... Rules>
SecondOrderMultipleModel(Models, Relation<Kind, Kind>, Start, Rules...) -> SecondOrderMultipleModel<Models, Kind>;
template <class Models, class Transition, class Start, class... Rules>
SecondOrderMultipleModel(Models, Transition, Start, Rules...)
    -> SecondOrderMultipleModel<Models, typename Transition::kind>;

}  // namespace sigmax
