#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <sigmax/core/compose.hpp>
#include <sigmax/core/update.hpp>
#include <sigmax/estimation/kalman.hpp>
#include <sigmax/estimation/kinematic_model.hpp>
#include <sigmax/hybrid/collapse.hpp>
#include <sigmax/hybrid/components.hpp>
#include <sigmax/hybrid/jump_markov_system.hpp>
#include <sigmax/hybrid/mixture.hpp>

namespace sigmax {

/// The choices that the paper leaves open; the defaults are argued in docs/readings.md.
template <Uncertainty Kind>
struct Interaction {
  Lift lift = Lift::borrowed_variance;
  Collapse<Kind> collapse = {};
  Tie output_tie = Tie::stay;
};

/// The interacting multiple-model filter, section V: with a random mode the IMM of Blom and Bar-Shalom, with a fuzzy
/// mode the HIMM of Mei, Xu and Liu. The mode's kind is the only difference.
///
///     InteractingMultipleModel filter{std::tuple{dwna<3>(3.0), dwpa<3>(3.0)}, transition, start};
///     for (const auto& [dt, z] : measurements) filter.step(dt, z);
///
/// `Models` is a std::tuple of models or a std::vector of one run-time model type. Mode weights are kept as logarithms.
/// `step` allocates nothing.
template <class Models, Uncertainty Kind>
class InteractingMultipleModel {
 public:
  static constexpr int measurement_size = Bank<Models>::measurement_size;
  using Measurement = Gaussian<measurement_size>;
  using Estimates = typename Bank<Models>::Estimates;
  /// An estimate in the components of all models together.
  using Estimate = typename Components<Models>::Estimate;

  /// Starts every model from its own estimate; nothing is known of the mode. Throws std::invalid_argument if the
  /// transition does not fit the models, or a start is not finite or of another size than its model.
  InteractingMultipleModel(Models models, Relation<Kind, Kind> transition, Estimates start,
                           Interaction<Kind> interaction = {})
      : system_(std::move(models), std::move(transition)),
        interaction_(interaction),
        estimates_(std::move(start)),
        mixed_(estimates_),
        innovations_(modes()),
        belief_(uninformative(system_.mode_variable())),
        prior_(belief_),
        move_in_(invert(system_.transition(), belief_)),
        likelihood_(system_.mode_variable()),
        components_(system_.models()) {
    if (mode_count(estimates_) != modes())
      throw std::invalid_argument("there are " + std::to_string(modes()) + " models, but " +
                                  std::to_string(mode_count(estimates_)) + " starts");
    move_in_.unreachable.reserve(modes());
    for_each_mode(system_.models(), [&](auto j) { require_start(mode(system_.models(), j), mode(estimates_, j)); });
    winner_ = select(modes(), log_weight(), 0, Tie::first);
  }

  /// Starts every model from the components that it has of one estimate, given in the order of `components()`.
  template <int N, int MaxN>
  InteractingMultipleModel(Models models, Relation<Kind, Kind> transition, const Gaussian<N, MaxN>& start,
                           Interaction<Kind> interaction = {})
      : InteractingMultipleModel(models, std::move(transition), Components<Models>(models).shares(models, start),
                                 interaction) {}

  /// One cycle, `dt` ≥ 0 seconds after the last, with the measurement z and its covariance R.
  /// Throws std::invalid_argument if dt or the measurement is not finite, std::domain_error if S is not positive
  /// definite or every mode is excluded.
  void step(double dt, const Measurement& z) {
    require_step(dt);
    if (!all_finite(z)) throw std::invalid_argument("a measurement, or its covariance, is not finite");
    interact();
    for_each_mode(system_.models(), [&](auto j) {  // step 2, (60), (61)
      const auto& model = mode(system_.models(), j);
      auto& estimate = mode(estimates_, j);
      predict(model, mode(mixed_, j), dt, estimate);
      innovations_[j] = update(model, estimate, z, estimate);
      likelihood_.set_log(j, innovations_[j].log_likelihood);
    });
    update(prior_, likelihood_, belief_);  // step 3, (62), (63)
    choose();
    measured_ = true;
  }

  /// One cycle without a measurement: the models predict and the mode moves on.
  void step(double dt) {
    require_step(dt);
    interact();
    for_each_mode(system_.models(),
                  [&](auto j) { predict(mode(system_.models(), j), mode(mixed_, j), dt, mode(estimates_, j)); });
    belief_ = prior_;
    choose();
    measured_ = false;
  }

  std::size_t modes() const { return mode_count(system_.models()); }
  const JumpMarkovSystem<Models, Kind>& system() const { return system_; }

  /// What is believed of the mode now; weights normalised by the mode's own ⊕, as logarithms.
  const Belief<Kind>& belief() const { return belief_; }

  /// The most likely mode, (64); ties by the output rule.
  std::size_t most_likely_mode() const { return winner_; }

  /// The estimates of the models, one each, in their own components.
  const Estimates& estimates() const { return estimates_; }

  /// The names of all components, those of the largest model first.
  const std::vector<std::string>& components() const { return components_.names(); }

  /// Step 4: the selected model's estimate if the mode is fuzzy, (65), (66); the moment-matched one if it is random,
  /// (67), (68) with the spread of the means that the print omits. In `components()`, lifted by the rule in force.
  Estimate estimate() const {
    const Estimate receiver = carried();
    Estimate result = receiver;
    collapse(interaction_.collapse, mixture(receiver, components_.of_all()), weight(), winner_, result);
    return result;
  }

  /// The estimate of the most likely mode alone, whatever the mode's kind.
  Estimate most_likely_estimate() const {
    const Estimate receiver = carried();
    Estimate result = receiver;
    collapse(Selection{}, mixture(receiver, components_.of_all()), weight(), winner_, result);
    return result;
  }

  /// Whether the last step had a measurement.
  bool measured() const { return measured_; }

  /// The last innovation of each model; of value only if `measured()`.
  const std::vector<Innovation<measurement_size>>& innovations() const { return innovations_; }

  /// Normalised innovation squared of the predicted measurement, its mixture over the mode collapsed as the mode's kind
  /// asks, with the weights before the measurement. NaN-free: throws std::logic_error if the last step had no
  /// measurement.
  double nis() const {
    if (!measured_) throw std::logic_error("nis() after a step without a measurement");
    Measurement predicted;
    collapse(
        interaction_.collapse, InnovationMixture<measurement_size>{innovations_},
        [this](std::size_t j) { return prior_[j]; }, predicted_mode_, predicted);
    const Eigen::LLT<SquareMatrix<measurement_size>> S(predicted.covariance);
    return S.matrixL().solve(predicted.mean).squaredNorm();
  }

 private:
  template <class Receiver>
  LiftedMixture<Receiver, Estimates> mixture(const Receiver& receiver, const Correspondence* maps) const {
    return {receiver, estimates_, maps, interaction_.lift};
  }

  /// What a lift of the output borrows: for each component from the most likely model that has it.
  Estimate carried() const {
    return components_.carried(estimates_, [this](const auto& has) {
      const auto log_weight_if_it_has_it = [&](std::size_t l) {
        return has(l) ? std::max(belief_.log(l), std::numeric_limits<double>::lowest()) : log_zero;
      };
      return select(modes(), log_weight_if_it_has_it, winner_, interaction_.output_tie);
    });
  }

  auto log_weight() const {
    return [this](std::size_t j) { return belief_.log(j); };
  }
  auto weight() const {
    return [this](std::size_t j) { return belief_[j]; };
  }

  /// Step 1: prior and move-in weights of the mode, (51), (52) or (53), (54), and the mixed starts.
  void interact() {
    compose(system_.transition(), belief_, prior_);
    invert(system_.transition(), belief_, move_in_);
    const auto move_in = [this](std::size_t l, std::size_t j) { return move_in_.relation(j, l); };
    for_each_mode(estimates_, [&](auto j) {
      const auto& own = mode(estimates_, j);
      auto& mixed = mode(mixed_, j);
      if (prior_.log(j) == log_zero)  // (52) is 0/0: nothing moves in, the filter keeps its state
        mixed = own;
      else
        mix(interaction_.collapse, mixture(own, components_.of_model(j)), move_in, modes(), j, own, mixed);
    });
  }

  /// The winner before the measurement, for `nis`, and after it, (64).
  void choose() {
    const auto prior = [this](std::size_t j) { return prior_.log(j); };
    predicted_mode_ = select(modes(), prior, winner_, interaction_.output_tie);
    winner_ = select(modes(), log_weight(), winner_, interaction_.output_tie);
  }

  template <class Model>
  static void require_start(const Model& model, const EstimateOf<Model>& start) {
    if (start.mean.size() != model.size() || start.covariance.rows() != model.size())
      throw std::invalid_argument("the start of model '" + std::string(model.name()) + "' has " +
                                  std::to_string(start.mean.size()) + " components; expected " +
                                  std::to_string(model.size()));
    if (!all_finite(start))
      throw std::invalid_argument("the start of model '" + std::string(model.name()) + "' is not finite");
  }

  static void require_step(double dt) {
    if (!(dt >= 0.0 && std::isfinite(dt)))
      throw std::invalid_argument("a step of " + std::to_string(dt) + " s; expected a finite one that is not negative");
  }

  JumpMarkovSystem<Models, Kind> system_;
  Interaction<Kind> interaction_;
  Estimates estimates_;
  Estimates mixed_;
  std::vector<Innovation<measurement_size>> innovations_;
  Belief<Kind> belief_;
  Belief<Kind> prior_;
  Inverse<Kind, Kind> move_in_;
  Likelihood<Kind> likelihood_;
  Components<Models> components_;
  std::size_t predicted_mode_ = 0;
  std::size_t winner_ = 0;
  bool measured_ = false;
};

template <class Models, Uncertainty Kind, class Start>
InteractingMultipleModel(Models, Relation<Kind, Kind>, Start) -> InteractingMultipleModel<Models, Kind>;
template <class Models, Uncertainty Kind, class Start>
InteractingMultipleModel(Models, Relation<Kind, Kind>, Start, Interaction<Kind>)
    -> InteractingMultipleModel<Models, Kind>;

}  // namespace sigmax
