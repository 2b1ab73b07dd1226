#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <sigmax/hybrid/components.hpp>
#include <sigmax/hybrid/gate.hpp>
#include <sigmax/hybrid/hybrid_estimate.hpp>
#include <sigmax/hybrid/interaction.hpp>
#include <sigmax/hybrid/jump_markov_system.hpp>
#include <sigmax/hybrid/mixture.hpp>

namespace sigmax {

/// The innovation of a model: of any sensor, of six quantities at most.
struct AnyInnovation {
  int size = 0;
  std::array<double, max_measurement_size> residual_numbers{};
  std::array<double, max_measurement_size * max_measurement_size> covariance_numbers{};
  double squared_distance = 0.0;  ///< d² = νᵀ S⁻¹ ν
  double log_likelihood = 0.0;    ///< in the form in force

  Eigen::Map<const Eigen::VectorXd> residual() const { return {residual_numbers.data(), size}; }            ///< ν
  Eigen::Map<const Eigen::MatrixXd> covariance() const { return {covariance_numbers.data(), size, size}; }  ///< S
  detail::ConstView view() const { return {residual_numbers.data(), covariance_numbers.data(), size}; }
};

/// A measurement of any sensor of all models.
struct Seen {
  detail::ConstView z;
  detail::SensorOfModels sensor;
};

/// What the multiple-model filters share: models and mode, the estimates, and the output, in plain numbers. They differ
/// in how they `measure` and `miss`. What users write is a BankFilter of one of them, with the types of their models.
///
/// Mode weights are kept as logarithms. References to estimates, innovations and states live as long as the filter, and
/// show what the last step left.
template <ScalableUncertainty Kind>
class MultipleModelFilter {
 public:
  using kind = Kind;
  using State = HybridEstimate<Kind>;

  virtual ~MultipleModelFilter() = default;

  std::size_t modes() const { return system_.models().size(); }
  const JumpMarkovSystem<Kind>& system() const { return system_; }
  const Interaction<Kind>& interaction() const { return interaction_; }

  /// What is believed of the mode now; weights normalised by the mode's own ⊕, as logarithms.
  const Belief<Kind>& belief() const { return state().belief; }

  /// The most likely mode, (64); ties by the output rule.
  std::size_t most_likely_mode() const { return state().most_likely_mode; }

  /// The estimates of the models, one each, in their own components.
  const Estimates& estimates() const { return state().estimates; }

  /// All that the next step depends on.
  const State& state() const { return states_[current_]; }

  /// Goes on from another state, as a step back or a smoother may want. Throws std::invalid_argument if it does not fit
  /// the models or is not finite.
  virtual void restore(const State& state);

  /// Reinitialises the filter; nothing is known of the mode. Every model starts from its own estimate, or from its
  /// components of one estimate in the order of `components()`. Throws std::invalid_argument if a start does not fit
  /// the models or is not finite.
  void restart(const Estimates& starts);
  void restart(detail::ConstView start);

  /// Changes the coordinates of the state: p → A p + b for the position along the axes, A p for its derivatives;
  /// further components stay. A by columns. For models whose components are ordered by derivative. The filter goes on
  /// as if the coordinates had been these from the start, except that StateAugmentation::borrowed_variance borrows
  /// along the axes.
  virtual void transform(const double* A, const double* b, int axes);

  /// One cycle, with a measurement or without; see BankFilter.
  void step(double dt, const Seen* seen = nullptr, const Gate& gate = {});

  /// The record of the last step for a smoother, with the arguments of that step. A measurement that is not linear is
  /// linearised where its mode predicted it. Throws std::logic_error without a measurement if the step had one.
  RecordedStep<Kind> recorded(double dt, const Seen* seen = nullptr) const;

  /// The names of all components; components of the largest model lead.
  const std::vector<std::string>& components() const { return components_.names(); }
  int component_count() const { return components_.size(); }

  /// Step 4: the selected model's estimate if the mode is fuzzy, (65), (66). If it is random, the moment-matched one,
  /// (67), (68), by default with the spread of the means that the print omits. In the order of `components()`,
  /// augmented by the rule in force. The state is the filter's own, or another, as a smoothed one.
  virtual void output(const State& state, detail::View result) const;
  void output(detail::View result) const { output(state(), result); }

  /// The estimate of the most likely mode alone, whatever the mode's kind.
  void most_likely_output(const State& state, detail::View result) const;

  /// β of, ∫ max_j π_j N(x; xʲ, Σʲ) dx, in [1, Σ π]. Near 1 the modes' estimates agree, or only one mode is
  /// possible. Near Σ π the estimates exclude each other.
  double beta() const requires SelectiveAlgebra<AlgebraOf<Kind>>;

  /// Whether the last step had a measurement, and it passed the gate.
  bool accepted() const { return accepted_; }

  /// The last innovation of each model; of value after a step with a measurement, accepted or not.
  const std::vector<AnyInnovation>& innovations() const { return innovations_; }

  /// Normalised innovation squared of the predicted measurement, its mixture over the mode collapsed as the mode's kind
  /// asks, with the weights before the measurement. Throws std::logic_error if the last step had no measurement.
  double nis() const;

  /// How well the last measurement was predicted, log ⊕ⱼ w_j ⊗ Λ_j, with the weights before it and the likelihoods of
  /// `innovations()`. With a random mode it is log p(z_k | z_1:k−1), which summed over the steps is the prequential
  /// log-likelihood. With a fuzzy mode it is the maximum, which is no density of z: it only grows with the weights, and
  /// so is never better than where all is possible. Of value after a step with a measurement, accepted or not.
  double log_evidence() const;

  /// The same with weights that sum to one, log ⊕ⱼ (w_j / Σᵢ w_i) ⊗ Λ_j: what settings are compared by, with either
  /// kind of mode. Minus this is the length of a code for z, in nats: with a random mode that of the mixture; with a
  /// fuzzy mode that of a code which names a mode and then z in it, at most log(modes) longer than the mixture of the
  /// same weights. Its exponential integrates over z to one, or to less.
  double log_score() const;

  /// The distance of the last measurement that a gate compares with a quantile of χ²: −2 log ⊕ⱼ w_j ⊗ exp(−d_j²/2),
  /// with the weights before it and each model's squared distance. With one model it is the NIS. With several it is at
  /// most d_j² − 2 log w_j for each j, so a measurement that one possible mode expects passes. Valid after a step with
  /// a measurement, accepted or not.
  double gate_distance() const;

  /// @{
  /// What the smoother and other compiled code ask.
  /// The innovation of the predicted measurement in its own standard deviations, L⁻¹ν with S = LLᵀ; its size.
  int normalized_innovation(double* numbers) const;
  const detail::Correspondence* correspondences(std::size_t j) const { return components_.of_model(j); }
  /// The estimates that an augmentation borrows from: estimates of the receiving models, or the prior of
  /// StateAugmentation::prior.
  const Estimates& lenders(const Estimates& estimates) const {
    return interaction_.augmentation == StateAugmentation::prior ? entries_ : estimates;
  }
  /// @}

 protected:
  MultipleModelFilter(const std::vector<AnyModel>& models, ModeTransition<Kind> transition, const Estimates& start,
                      const Interaction<Kind>& interaction);
  MultipleModelFilter(const MultipleModelFilter&) = default;
  MultipleModelFilter& operator=(const MultipleModelFilter&) = default;

  const AnyModel& model(std::size_t j) const { return system_.models()[j]; }

  /// @{
  /// The four steps, with a measurement, if it passes the gate, or without one, into `next`.
  virtual bool measure(double dt, const Seen& seen, double limit) = 0;
  virtual void miss(double dt) = 0;
  /// What each mode predicted of the last measurement, with its weights.
  virtual Estimates predicted() const = 0;
  /// After a restart.
  virtual void begin() {}
  /// @}

  State& now() { return states_[current_]; }
  /// What the step is writing: until `conclude`, all that is public shows the state before.
  State& next() { return states_[1 - current_]; }

  /// A number of the state, another one whenever it changes; the next state's is one more.
  std::size_t version() const { return version_; }

  /// What the models along independent axes do in a step of `dt` seconds.
  const std::vector<detail::AxisLaw>& laws(double dt);

  /// Begins a step: the prior of the mode, (51) or (53).
  void predict_mode(double dt);

  /// (60): an estimate of model j, moved on by the step that was begun. `result` may be `prior`.
  void predict_model(std::size_t j, detail::ConstView prior, double dt, detail::View result) const;

  /// (61), with the likelihood in the form in force. `posterior` may be `prior`. Throws std::domain_error if the
  /// likelihood is no number.
  void update_model(std::size_t j, detail::ConstView prior, const Seen& seen, detail::View posterior,
                    AnyInnovation& innovation) const;

  /// What stands of estimates of the models, augmented, for the components of the receiver: written to `parts`.
  detail::Mixture mixture(detail::ConstView receiver, const detail::Correspondence* maps, const Estimates& estimates,
                          detail::Mixture::Part* parts) const;

  /// Whether the measurement of the step being taken is not beyond the limit of the gate; its distance, if it is not
  /// that of the predictors.
  bool passes(double limit, std::optional<double> distance = std::nullopt);

  /// The predictions of the last measurement, the logarithms of their weights before it, and the most likely one. There
  /// is one for each mode, or for each history.
  struct Predictors {
    std::span<const AnyInnovation> innovations;
    std::span<const double> log_weights;
    std::size_t most_likely;
  };
  virtual Predictors predictors() const;

  /// What an augmentation of the output borrows: for each component from the most likely model that has it.
  void output_receiver(const State& state, detail::View result) const;

  /// The next state becomes the state; its most likely mode is (64).
  void conclude(bool accepted);

  /// One Gaussian for innovations, as the mode's kind asks.
  static AnyInnovation collapsed(std::span<const AnyInnovation> innovations, const double* weights, std::size_t winner);
  /// A residual in its own standard deviations, and the sum of their squares; infinite if the covariance is not
  /// positive definite.
  static double normalize(const AnyInnovation& innovation, double* numbers);

  static auto logs_of(const Belief<Kind>& belief) {
    return [&belief](std::size_t j) { return belief.log(j); };
  }

  JumpMarkovSystem<Kind> system_;
  Interaction<Kind> interaction_;
  detail::Components components_;
  std::vector<AnyInnovation> innovations_;
  Belief<Kind> prior_;
  std::size_t mode_before_ = 0;  ///< the most likely one before the last step

 private:
  template <class Act>
  auto of_output(const State& state, const Act& act) const;
  AnyInnovation predicted_innovation() const;
  void forget_mode();
  void require(double dt, const Seen* seen) const;
  std::string this_step(double dt) const;

  Estimates entries_;                  ///< what StateAugmentation::prior knows of each model's components
  std::vector<detail::AxisLaw> laws_;  ///< of the models along independent axes, for steps of laws_dt_ seconds
  double laws_dt_ = std::numeric_limits<double>::quiet_NaN();
  std::array<State, 2> states_;
  std::size_t current_ = 0;
  std::size_t steps_ = 0, version_ = 1;
  std::optional<double> gate_distance_ = 0.0;  ///< empty if not computed yet
  bool seen_ = false;                          ///< whether the last step had a measurement
  bool accepted_ = false;
};

extern template class MultipleModelFilter<Random>;
extern template class MultipleModelFilter<Fuzzy>;

}  // namespace sigmax
