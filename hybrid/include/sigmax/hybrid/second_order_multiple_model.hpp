#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <sigmax/core/logarithm.hpp>
#include <sigmax/core/table.hpp>
#include <sigmax/hybrid/multiple_model_filter.hpp>
#include <sigmax/hybrid/sound.hpp>

namespace sigmax {

/// The second-order multiple-model filter: with a random mode GPB2 (Tugnait 1982; Bar-Shalom, Li, Kirubarajan 2001,
/// 11.6.5), with a fuzzy mode the Viterbi filter (Averbuch, Itzikowitz, Kapon 1991), which keeps the best predecessor
/// of each mode. The mode's kind is the only difference, and HIMM : Viterbi = IMM : GPB2.
///
///     SecondOrderMultipleModel filter{std::tuple{dwna<3>(3.0), dwpa<3>(3.0)}, transition, start};
///
/// Each of the M² pairs of a predecessor l and a mode j predicts and updates; the predecessors of a mode then collapse
/// *after* the measurement, by their weights π(j|l) ⊗ b(l) ⊗ Λ_lj. There is no mixed start: of `Interaction`, its
/// readings (`mixed_start`, `mixed_covariance`, `mixing_weights`) do not concern that collapse,
/// `MixedCovariance::envelope` only the output; `mixing_tie` is the tie among predecessors. `step` allocates nothing.
template <class Models, ScalableUncertainty Kind>
class SecondOrderMultipleModel : public MultipleModelFilter<Models, Kind> {
  using Filter = MultipleModelFilter<Models, Kind>;

 public:
  using Filter::belief;
  using Filter::estimates;
  using Filter::modes;
  using typename Filter::Estimates;
  using typename Filter::Measurement;

  /// As InteractingMultipleModel.
  SecondOrderMultipleModel(Models models, ModeTransition<Kind> transition, Estimates start,
                           Interaction<Kind> interaction = {})
      : Filter(std::move(models), std::move(transition), std::move(start), interaction),
        predicted_(detail::pairs_for(estimates())),
        pairs_(predicted_),
        pair_innovations_(modes()),
        log_fit_(modes() * modes()),
        log_weight_(modes()),
        joint_(modes(), modes()),
        predecessor_(modes(), modes()) {}
  template <int N, int MaxN>
  SecondOrderMultipleModel(Models models, ModeTransition<Kind> transition, const Gaussian<N, MaxN>& start,
                           Interaction<Kind> interaction = {})
      : SecondOrderMultipleModel(models, std::move(transition), Components<Models>(models).shares(models, start),
                                 interaction) {}

  /// One cycle; what it takes and throws is as of InteractingMultipleModel.
  template <SensorOfBank<Models> Sensor>
  void step(double dt, const MeasurementOf<Sensor>& z, const Sensor& sensor, double gate = no_gate) {
    this->require(dt, z);
    bool taken = false;
    this->located(dt, [&] {
      branch(dt);
      for_each_mode(system_.models(), [&](auto j) {
        for (std::size_t l = 0; l < modes(); ++l) {
          const std::size_t pair = j * modes() + l;
          log_fit_[pair] = log_zero;
          if (!lives(l, j)) continue;
          this->assign(update(mode(system_.models(), j), mode(predicted_, j)[l], z, sensor, mode(pairs_, j)[l]),
                       pair_innovations_[l]);
          log_fit_[pair] = joint_(j, l) - 0.5 * pair_innovations_[l].squared_distance;
          joint_(j, l) += this->log_likelihood(j, pair_innovations_[l]);
        }
        summarize(j);
      });
      taken = this->passes(gate, log_fit_.size(), [this](std::size_t pair) { return log_fit_[pair]; });
      if (taken) merge(pairs_, this->next().estimates);
    });
    if (!taken) return step(dt);
    this->conclude(true);
  }

  /// The same with a measurement of the position, which leads the state of every model.
  void step(double dt, const Measurement& z, double gate = no_gate) requires(Filter::axes > 0) {
    step(dt, z, PositionSensor<Filter::axes>{}, gate);
  }

  /// One cycle without a measurement.
  void step(double dt) {
    this->require(dt);
    this->located(dt, [&] {
      branch(dt);
      merge(predicted_, this->next().estimates);
    });
    this->conclude(false);
  }

  /// As InteractingMultipleModel. A non-linear measurement is linearised about what the mode predicted: that of its
  /// predecessors, by their weights after the measurement.
  template <Sensing Sensor>
  RecordedStep<Models, Kind> recorded(double dt, const MeasurementOf<Sensor>& z, const Sensor& sensor) const {
    Estimates predicted = estimates();
    collapse_predecessors(predicted_, predicted);
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

  /// Every pair predicts from its predecessor's estimate, read in the components of the mode's model.
  void branch(double dt) {
    this->predict_mode(dt);
    const auto& transition = system_.transition();
    for_each_mode(system_.models(), [&](auto j) {
      for (std::size_t l = 0; l < modes(); ++l) joint_(j, l) = belief().log(l) + std::log(transition(l, j));
      weigh(j);
      const auto& own = mode(estimates(), j);
      const auto read = this->mixture(mode(this->lenders(estimates()), j), this->correspondences(j), estimates());
      for (std::size_t l = 0; l < modes(); ++l) {
        if (!lives(l, j)) continue;
        auto& pair = mode(predicted_, j)[l];
        if (l == j)
          pair = own;
        else
          collapse(Selection{}, read, unweighted, l, pair);
        predict(mode(system_.models(), j), pair, dt, pair);
      }
    });
  }

  /// The belief is the ⊕ of the pairs' weights, and the predecessors of each mode collapse.
  void merge(const Pairs& pairs, Estimates& merged) {
    this->next().belief.assign([&](std::size_t j) { return log_weight_[j]; });
    collapse_predecessors(pairs, merged);
    for_each_mode(merged, [&](auto j) { check::sound(mode(system_.models(), j), mode(merged, j)); });
  }

  /// By sum and moments or by selection.
  void collapse_predecessors(const Pairs& pairs, Estimates& merged) const {
    for_each_mode(merged, [&](auto j) {
      using Each = std::decay_t<decltype(mode(merged, j))>;
      collapse(Collapse<Kind>{}, EstimateMixture<Each>{mode(pairs, j)}, weight(j), best(j), mode(merged, j));
    });
  }

  /// The logarithm of the weight of mode j, and the weights of its predecessors given j. An excluded mode keeps those
  /// that it had before the measurement, and one that nothing reaches is its own predecessor.
  void weigh(std::size_t j) {
    const auto log = [&](std::size_t l) { return joint_(j, l); };
    log_weight_[j] = detail::log_combine<AlgebraOf<Kind>>(modes(), log, [](std::size_t) { return 1.0; });
    for (std::size_t l = 0; l < modes(); ++l)
      if (log_weight_[j] != log_zero)
        predecessor_(j, l) = std::exp(log(l) - log_weight_[j]);
      else if (unreachable(j))
        predecessor_(j, l) = l == j ? 1.0 : 0.0;
  }

  bool unreachable(std::size_t j) const { return prior_.log(j) == log_zero; }
  bool lives(std::size_t l, std::size_t j) const { return joint_(j, l) != log_zero || (l == j && unreachable(j)); }
  auto weight(std::size_t j) const {
    return [this, j](std::size_t l) { return predecessor_(j, l); };
  }
  std::size_t best(std::size_t j) const {
    Tie tie = Tie::stay;
    if constexpr (SelectiveAlgebra<AlgebraOf<Kind>>) tie = interaction_.collapse.mixing_tie;
    return detail::select(
        modes(), [&](std::size_t l) { return std::log(predecessor_(j, l)); }, j, tie);
  }

  /// The innovation of a mode is that of its predicted measurement, a mixture by the weights before the measurement;
  /// from then on its predecessors have those after it.
  void summarize(std::size_t j) {
    const std::size_t winner = best(j);
    const typename Filter::Predicted predicted = this->collapsed_innovation(pair_innovations_, weight(j), winner);
    const double before = log_weight_[j];
    weigh(j);
    const double log_likelihood = before == log_zero ? pair_innovations_[j].log_likelihood : log_weight_[j] - before;
    innovations_[j].residual = predicted.mean;
    innovations_[j].covariance = predicted.covariance;
    innovations_[j].squared_distance = Filter::normalized(predicted).squaredNorm();
    innovations_[j].log_likelihood = log_likelihood;
  }

  static double unweighted(std::size_t) { return 1.0; }

  Pairs predicted_;
  Pairs pairs_;                                  ///< of mode j: one for each predecessor
  std::vector<AnyInnovation> pair_innovations_;  ///< of the mode at hand
  std::vector<double> log_fit_;                  ///< of all pairs, for the gate
  std::vector<double> log_weight_;               ///< of each mode
  Table joint_;        ///< logarithms of π(j|l) ⊗ b(l), and with the measurement ⊗ Λ_lj, at (j, l)
  Table predecessor_;  ///< the same, given j
};

template <class Models, ScalableUncertainty Kind, class Start>
SecondOrderMultipleModel(Models, Relation<Kind, Kind>, Start) -> SecondOrderMultipleModel<Models, Kind>;
template <class Models, ScalableUncertainty Kind, class Start>
SecondOrderMultipleModel(Models, Relation<Kind, Kind>, Start, Interaction<Kind>)
    -> SecondOrderMultipleModel<Models, Kind>;
template <class Models, class Transition, class Start>
SecondOrderMultipleModel(Models, Transition, Start) -> SecondOrderMultipleModel<Models, typename Transition::kind>;
template <class Models, class Transition, class Start, ScalableUncertainty Kind>
SecondOrderMultipleModel(Models, Transition, Start, Interaction<Kind>) -> SecondOrderMultipleModel<Models, Kind>;

}  // namespace sigmax
