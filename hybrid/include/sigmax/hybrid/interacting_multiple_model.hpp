#pragma once

#include <cstddef>
#include <tuple>
#include <utility>

#include <sigmax/core/compose.hpp>
#include <sigmax/core/update.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/hybrid/multiple_model_filter.hpp>
#include <sigmax/hybrid/sound.hpp>

namespace sigmax {

/// The interacting multiple-model filter, section V: with a random mode the IMM of Blom and Bar-Shalom, with a fuzzy
/// mode the HIMM of Mei, Xu and Liu. The mode's kind is the only difference.
///
///     InteractingMultipleModel filter{std::tuple{dwna<3>(3.0), dwpa<3>(3.0)}, transition, start};
///     for (const auto& [dt, z] : measurements) filter.step(dt, z);
///
/// The predecessors of a mode collapse *before* the measurement, into one start for each model: M predictions and
/// updates. SecondOrderMultipleModel lets them collapse after it. With `MixedStart::common` it is the GPB1 filter, with
/// the transition `identity(mode)` a static bank. `step` allocates nothing.
template <class Models, ScalableUncertainty Kind>
class InteractingMultipleModel : public MultipleModelFilter<Models, Kind> {
  using Filter = MultipleModelFilter<Models, Kind>;

 public:
  using Filter::belief;
  using Filter::estimates;
  using Filter::modes;
  using typename Filter::Estimates;
  using typename Filter::Measurement;

  /// Starts every model from its own estimate; nothing is known of the mode. The transition is a relation that serves
  /// every step, or a function of the step such as TimedTransition. Throws std::invalid_argument if the transition does
  /// not fit the models, or a start is not finite or of another size than its model.
  InteractingMultipleModel(Models models, ModeTransition<Kind> transition, Estimates start,
                           Interaction<Kind> interaction = {})
      : Filter(std::move(models), std::move(transition), std::move(start), interaction),
        predicted_(estimates()),
        move_in_(invert(system_.transition(), belief())),
        likelihood_(system_.mode_variable()) {
    move_in_.unreachable.reserve(modes());
  }

  /// Starts every model from the components that it has of one estimate, given in the order of `components()`.
  template <int N, int MaxN>
  InteractingMultipleModel(Models models, ModeTransition<Kind> transition, const Gaussian<N, MaxN>& start,
                           Interaction<Kind> interaction = {})
      : InteractingMultipleModel(models, std::move(transition), Components<Models>(models).shares(models, start),
                                 interaction) {}

  /// One cycle, `dt` ≥ 0 seconds after the last, with the measurement z, its covariance R, and the sensor that measured
  /// it: another one each time, if need be. If its `gate_distance()` is above `gate`, it counts as missed.
  /// Throws std::invalid_argument if dt or the measurement is not finite, std::domain_error, saying in which step, if S
  /// is not positive definite or every mode is excluded. The filter's state is then what it was before.
  template <SensorOfBank<Models> Sensor>
  void step(double dt, const MeasurementOf<Sensor>& z, const Sensor& sensor, double gate = no_gate) {
    this->require(dt, z);
    if constexpr (Filter::shortens)
      if (this->is_position(sensor, z.size()) && this->shortened(dt, &z, gate, predicted_)) return;
    bool taken = false, concluded = false;
    this->located(dt, [&] {
      mix(dt);                                       // step 1, (51)–(59)
      for_each_mode(system_.models(), [&](auto j) {  // step 2, (60), (61)
        const auto& model = mode(system_.models(), j);
        auto& estimate = mode(this->next().estimates, j);
        predict(model, estimate, dt, mode(predicted_, j));
        this->assign(update(model, mode(predicted_, j), z, sensor, estimate), innovations_[j]);
      });
      taken = this->passes(gate, modes(),
                           [this](std::size_t j) { return prior_.log(j) - 0.5 * innovations_[j].squared_distance; });
      if (!taken) {
        concluded = shortened_miss(dt);
        if (!concluded) coast();
        return;
      }
      for_each_mode(system_.models(), [&](auto j) {
        check::sound(mode(system_.models(), j), mode(this->next().estimates, j));
        likelihood_.set_log(j, this->log_likelihood(j, innovations_[j]));
      });
      update(prior_, likelihood_, this->next().belief);  // step 3, (62), (63)
    });
    if (!concluded) this->conclude(taken);  // (64); step 4 is `estimate`
  }

  /// The same with a measurement of the position, which leads the state of every model.
  void step(double dt, const Measurement& z, double gate = no_gate) requires(Filter::axes > 0) {
    step(dt, z, PositionSensor<Filter::axes>{}, gate);
  }

  /// One cycle without a measurement: the models predict and the mode moves on.
  void step(double dt) {
    this->require(dt);
    if (shortened_miss(dt)) return;
    this->located(dt, [&] {
      mix(dt);
      for_each_mode(system_.models(), [&](auto j) {
        predict(mode(system_.models(), j), mode(this->next().estimates, j), dt, mode(predicted_, j));
      });
      coast();
    });
    this->conclude(false);
  }

  /// What the last step left for a smoother; it takes what the step took. A measurement that the gate rejected counts
  /// as missed. Throws std::logic_error without a measurement if the step had one.
  template <Sensing Sensor>
  RecordedStep<Models, Kind> recorded(double dt, const MeasurementOf<Sensor>& z, const Sensor& sensor) const {
    return this->recorded_by(dt, z, sensor, predicted_);
  }
  RecordedStep<Models, Kind> recorded(double dt, const Measurement& z) const requires(Filter::axes > 0) {
    return recorded(dt, z, PositionSensor<Filter::axes>{});
  }
  RecordedStep<Models, Kind> recorded(double dt) const { return this->recorded_as_missed(dt); }

 private:
  using Filter::innovations_;
  using Filter::interaction_;
  using Filter::prior_;
  using Filter::system_;

  /// A step without a measurement by the short form, the same whether there was none or the gate rejected it.
  bool shortened_miss([[maybe_unused]] double dt) {
    if constexpr (Filter::shortens)
      return this->template shortened<Measurement>(dt, nullptr, no_gate, predicted_);
    else
      return false;
  }

  /// What is predicted is what is known.
  void coast() {
    for_each_mode(system_.models(), [&](auto j) {
      mode(this->next().estimates, j) = mode(predicted_, j);
      check::sound(mode(system_.models(), j), mode(predicted_, j));
    });
    this->next().belief = prior_;
  }

  /// Step 1: prior and move-in weights of the mode, (51), (52) or (53), (54), and the mixed starts.
  void mix(double dt) {
    this->predict_mode(dt);
    invert(system_.transition(), belief(), move_in_);
    const bool common = interaction_.mixed_start == MixedStart::common;
    for_each_mode(estimates(), [&](auto j) {
      const auto& own = mode(estimates(), j);
      auto& mixed = mode(this->next().estimates, j);
      if (prior_.log(j) == log_zero) {  // (52) is 0/0: nothing moves in, the filter keeps its state
        mixed = own;
        return;
      }
      const auto move_in = [&](std::size_t l) { return common ? belief()[l] : move_in_.relation(j, l); };
      const auto transposed = [&](std::size_t l) { return common ? belief()[l] : move_in_.relation(l, j); };
      sigmax::mix(interaction_.collapse,
                  this->mixture(mode(this->lenders(estimates()), j), this->correspondences(j), estimates()), move_in,
                  transposed, modes(), common ? this->most_likely_mode() : std::size_t{j}, own, mixed);
    });
  }

  Estimates predicted_;  ///< before the measurement
  Inverse<Kind, Kind> move_in_;
  Likelihood<Kind> likelihood_;
};

template <class Models, ScalableUncertainty Kind, class Start>
InteractingMultipleModel(Models, Relation<Kind, Kind>, Start) -> InteractingMultipleModel<Models, Kind>;
template <class Models, ScalableUncertainty Kind, class Start>
InteractingMultipleModel(Models, Relation<Kind, Kind>, Start, Interaction<Kind>)
    -> InteractingMultipleModel<Models, Kind>;
template <class Models, class Transition, class Start>
InteractingMultipleModel(Models, Transition, Start) -> InteractingMultipleModel<Models, typename Transition::kind>;
template <class Models, class Transition, class Start, ScalableUncertainty Kind>
InteractingMultipleModel(Models, Transition, Start, Interaction<Kind>) -> InteractingMultipleModel<Models, Kind>;

}  // namespace sigmax
