#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/core/logarithm.hpp>
#include <sigmax/estimation/cholesky.hpp>
#include <sigmax/estimation/linearised.hpp>
#include <sigmax/hybrid/components.hpp>
#include <sigmax/hybrid/hybrid_estimate.hpp>
#include <sigmax/hybrid/interaction.hpp>
#include <sigmax/hybrid/jump_markov_system.hpp>
#include <sigmax/hybrid/kinematic_step.hpp>
#include <sigmax/hybrid/mixture.hpp>
#include <sigmax/hybrid/sound.hpp>

namespace sigmax {

/// A gate that every measurement passes.
inline constexpr double no_gate = std::numeric_limits<double>::infinity();

/// What the multiple-model filters share: models and mode, the estimates, and the output. They differ in their `step`.
///
/// `Models` is a std::tuple of models or a std::vector of one run-time model type. Mode weights are kept as logarithms.
/// References to estimates, innovations and states live as long as the filter, and show what the last step left.
template <class Models, ScalableUncertainty Kind>
class MultipleModelFilter {
 public:
  using ModelsType = Models;
  using kind = Kind;
  static constexpr int axes = Bank<Models>::axes;
  /// A measurement of the position, which every model has if any has: that of the default sensor.
  using Measurement = Gaussian<axes>;
  using Estimates = typename Bank<Models>::Estimates;
  using State = HybridEstimate<Models, Kind>;
  /// An estimate in the components of all models together.
  using Estimate = typename Components<Models>::Estimate;

  std::size_t modes() const { return mode_count(system_.models()); }
  const JumpMarkovSystem<Models, Kind>& system() const { return system_; }
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
  void restore(const State& state) {
    check::starts(system_.models(), state.estimates);
    check::same(system_.mode_variable(), state.belief.variable(), "restore");
    states_[current_] = state;
    measured_ = false;
  }

  /// Starts again as if new, and nothing is known of the mode: every model from its own estimate, or from the
  /// components that it has of one estimate, given in the order of `components()`. Throws std::invalid_argument if a
  /// start does not fit the models or is not finite.
  void restart(const Estimates& starts) {
    check::starts(system_.models(), starts);
    states_[current_].estimates = starts;
    forget_mode();
  }
  template <int N, int MaxN>
  void restart(const Gaussian<N, MaxN>& start) {
    if (!detail::all_finite(start)) throw std::invalid_argument("the start is not finite");
    components_.shares(start, states_[current_].estimates);
    forget_mode();
  }

  /// Tells the state in other coordinates, p → A p + b of the position along the axes, A p of its derivatives; further
  /// components stay. For models whose components are ordered by derivative. Goes on as if it had been told so from the
  /// start, but for Lift::borrowed_variance, which borrows along the axes.
  void transform(const SquareMatrix<Eigen::Dynamic, 3>& A, const Vector<Eigen::Dynamic, 3>& b) {
    for_each_mode(system_.models(), [&](auto j) { sigmax::transform(A, b, mode(states_[current_].estimates, j)); });
  }

  /// The names of all components, those of the largest model first.
  const std::vector<std::string>& components() const { return components_.names(); }

  /// Where the components of mode j's model stand in each model.
  const Correspondence* correspondences(std::size_t j) const { return components_.of_model(j); }

  /// The estimates that a lift borrows from: those of the receiving models, or what Lift::prior knows before.
  const Estimates& lenders(const Estimates& estimates) const {
    return interaction_.lift == Lift::prior ? entries_ : estimates;
  }

  /// Step 4: the selected model's estimate if the mode is fuzzy, (65), (66); the moment-matched one if it is random,
  /// (67), (68) with the spread of the means that the print omits, if nothing else was chosen. In `components()`,
  /// lifted by the rule in force. Of the filter's own state, or another, say a smoothed one.
  Estimate estimate() const { return estimate(state()); }
  Estimate estimate(const State& state) const { return output(interaction_.collapse, state); }

  /// The estimate of the most likely mode alone, whatever the mode's kind.
  Estimate most_likely_estimate() const { return most_likely_estimate(state()); }
  Estimate most_likely_estimate(const State& state) const { return output(Selection{}, state); }

  /// β of, ∫ max_j π_j N(x; xʲ, Σʲ) dx, in [1, Σ π]: near 1 the modes' estimates agree or all but one are hardly
  /// possible, near Σ π they exclude each other.
  double beta() const requires SelectiveAlgebra<AlgebraOf<Kind>> {
    Estimate result = output_receiver(state());
    const Estimate receiver = result;
    return detail::match_envelope(
        mixture(receiver, components_.of_all(), estimates()), [this](std::size_t j) { return belief()[j]; }, result);
  }

  /// Whether the last step had a measurement, and took it.
  bool measured() const { return measured_; }

  /// The last innovation of each model, its likelihood in the form in force; of value only if `measured()`.
  const std::vector<AnyInnovation>& innovations() const { return innovations_; }

  /// Normalised innovation squared of the predicted measurement, its mixture over the mode collapsed as the mode's kind
  /// asks, with the weights before the measurement. Throws std::logic_error if the last step had no
  /// measurement.
  double nis() const { return normalized_innovation().squaredNorm(); }

  /// The innovation of that predicted measurement in its own standard deviations, L⁻¹ν with S = LLᵀ. If the filter is
  /// right, its numbers have mean 0 and variance 1 and tell nothing of those of other steps. Throws as `nis`.
  Vector<Eigen::Dynamic, max_measurement_size> normalized_innovation() const {
    if (!measured_) throw std::logic_error("nis() after a step without a measurement");
    return normalized(collapsed_innovation(
        innovations_, [this](std::size_t j) { return prior_[j]; }, predicted_mode_));
  }

  /// What was believed of the mode before the last measurement.
  const Belief<Kind>& predicted_belief() const { return prior_; }

  /// How well the last measurement was predicted, log ⊕ⱼ w_j ⊗ Λ_j, with the weights before it and the likelihoods of
  /// `innovations()`. With a random mode it is log p(z_k | z_1:k−1), which summed over the steps is the prequential
  /// log-likelihood. With a fuzzy mode it is the maximum, which is no density of z: it only grows with the weights, and
  /// so is never better than where all is possible. Of value after a step with a measurement, taken or not.
  double log_evidence() const {
    return detail::log_combine<AlgebraOf<Kind>>(
        modes(), [this](std::size_t j) { return prior_.log(j) + innovations_[j].log_likelihood; }, unit);
  }

  /// The same with weights that sum to one, log ⊕ⱼ (w_j / Σᵢ w_i) ⊗ Λ_j: what settings are compared by, with either
  /// kind of mode. Minus this is the length of a code for z, in nats: with a random mode that of the mixture; with a
  /// fuzzy mode that of a code which names a mode and then z in it, at most log(modes) longer than the mixture of the
  /// same weights. Its exponential integrates over z to one, or to less.
  double log_score() const { return log_evidence() - detail::log_combine<Sigma>(modes(), logs_of(prior_), unit); }

  /// How far the last measurement lay from all that was thought possible, −2 log ⊕ⱼ w_j ⊗ exp(−d_j²/2) with the weights
  /// before it and each model's squared distance: what a gate compares with a quantile of χ². With one model it is the
  /// NIS; with several it is never more than d_j² − 2 log w_j, so that a measurement that any possible mode expects
  /// passes. Of value after a step with a measurement, taken or not.
  double gate_distance() const {
    return gate_distance_ ? *gate_distance_ : distance_of(modes(), [this](std::size_t j) { return log_fit(j); });
  }

 protected:
  /// Whether there may be a short form of the step and the output; see `shortened`.
  static constexpr bool shortens = detail::kinematic::Shortcut<Models, Kind>::possible;

  MultipleModelFilter(Models models, ModeTransition<Kind> transition, Estimates start, Interaction<Kind> interaction)
      : system_(std::move(models), std::move(transition)),
        interaction_(interaction),
        innovations_(modes()),
        prior_(uninformative(system_.mode_variable())),
        components_(system_.models()),
        entries_(start),
        shortcut_(system_.models(), interaction_),
        states_{State{start, prior_}, State{start, prior_}} {
    check::starts(system_.models(), start);
    check::prior(interaction_.entry);
    Components<Models>::entries(system_.models(), interaction_.entry, interaction_.entry.root_mean_square(), entries_);
    forget_mode();
  }

  /// Whether so many numbers of a sensor are the position along all axes of models that have a short step.
  template <class Sensor>
  bool is_position([[maybe_unused]] const Sensor& sensor, Eigen::Index size) const {
    if constexpr (detail::ChosenSensor<Sensor>)
      return sensor.visit([&](const auto& chosen) { return is_position(chosen, size); });
    else if constexpr (measures_leading_components<Sensor>)
      return Sensor::axes == shortcut_.axes() && size == Sensor::axes;
    else
      return false;
  }

  /// What the step is writing: until `conclude`, all that is public shows the state before.
  State& next() { return states_[1 - current_]; }

  /// Begins a step: the prior of the mode, (51) or (53), and the mode that it favours.
  void predict_mode(double dt) {
    measured_ = false;
    compose(system_.transition(dt), belief(), prior_);
    predicted_mode_ = detail::select(modes(), logs_of(prior_), most_likely_mode(), interaction_.output_tie);
  }

  /// The estimates, or others, as a mixture in the components of `receiver`.
  template <class Receiver>
  LiftedMixture<Receiver, Estimates> mixture(const Receiver& receiver, const Correspondence* maps,
                                             const Estimates& estimates) const {
    return {receiver, estimates, maps, interaction_.lift};
  }

  /// How well a model explained the measurement in mode j. Throws std::domain_error if that is no number.
  double log_likelihood(std::size_t j, const AnyInnovation& innovation) const {
    if (std::isnan(innovation.log_likelihood))
      throw std::domain_error("the likelihood in mode '" + system_.mode_variable().label(j) + "' is not a number");
    return innovation.log_likelihood;
  }

  /// Whether the measurement of the step being taken passes the gate; `log_fit(i)` is the logarithm of the weight of
  /// hypothesis i ⊗ exp(−d_i²/2).
  template <class LogFit>
  bool passes(double gate, std::size_t hypotheses, const LogFit& log_fit) {
    gate_distance_ = distance_of(hypotheses, log_fit);
    return gate == no_gate || *gate_distance_ <= gate;
  }

  /// The same of one hypothesis for each mode; the distance is computed only if it is asked for.
  bool passes(double gate) {
    gate_distance_.reset();
    return gate == no_gate || gate_distance() <= gate;
  }

  /// A step by the short form for motions along independent axes, with a measurement of the position or none. False if
  /// it must be the general one; nothing has changed then.
  template <class Measurement>
  bool shortened(double dt, const Measurement* z, double gate, Estimates& predicted) {
    if (!shortcut_.prepare(system_.models(), dt, system_.transition(dt))) return false;
    detail::kinematic::Told told;
    const auto take = [&](const double* mean, const double* covariance) {
      if (!shortcut_.step(state(), mean, covariance, next(), told)) return false;
      const auto prior = prior_.logs(detail::ByLaw{});
      const auto posterior = next().belief.logs(detail::ByLaw{});
      for_each_mode(predicted, [&](auto j) {
        const std::size_t at = j;
        prior[at] = told.log_prior[at];
        posterior[at] = told.log_posterior[at];
        auto& mean_of_j = mode(predicted, j).mean;
        for (Eigen::Index i = 0; i < mean_of_j.size(); ++i)
          mean_of_j(i) = told.predicted[at][static_cast<std::size_t>(i)];
      });
      return true;
    };
    if (!take(z ? z->mean.data() : nullptr, z ? z->covariance.data() : nullptr)) return false;
    predicted_mode_ = detail::select(modes(), logs_of(prior_), most_likely_mode(), interaction_.output_tie);
    bool taken = z != nullptr;
    if (z) {
      for (std::size_t j = 0; j < modes(); ++j) assign(told, j, innovations_[j]);
      taken = passes(gate);
    }
    if (z && !taken && !take(nullptr, nullptr)) return false;
    conclude(taken);
    return true;
  }

  /// The state with what a measurement tells each mode, linearised where the mode predicted it.
  template <Sensing Sensor>
  RecordedStep<Models, Kind> recorded_by(double dt, const MeasurementOf<Sensor>& z, const Sensor& sensor,
                                         const Estimates& predicted) const {
    RecordedStep<Models, Kind> result{dt, state(), {}};
    if (!measured_) return result;
    for_each_mode(system_.models(), [&](auto j) {
      const auto seen = linearised_measurement(mode(system_.models(), j), mode(predicted, j), z, sensor);
      constexpr int max_n = Bank<Models>::max_state_size;
      constexpr int max_rows = detail::max_measurement_size_of<Sensor>;
      const auto root = detail::noise_root(seen.R);
      const RectangularMatrix<Eigen::Dynamic, Eigen::Dynamic, max_rows, max_n> R = root.matrixL().solve(seen.H);
      const Vector<Eigen::Dynamic, max_rows> r =
          root.matrixL().solve(seen.residual) - R * (mode(estimates(), j).mean - mode(predicted, j).mean);
      auto& evidence = result.seen.emplace_back();
      evidence.clear(R.cols());
      evidence.add(R, r);
    });
    return result;
  }
  RecordedStep<Models, Kind> recorded_as_missed(double dt) const {
    if (measured_) throw std::logic_error("recorded(dt) after a step with a measurement; expected recorded(dt, z)");
    return {dt, state(), {}};
  }

  /// What a lift of the output borrows: for each component from the most likely model that has it.
  Estimate output_receiver(const State& state) const {
    return components_.carried(lenders(state.estimates), [&](const auto& has) {
      const auto log_weight_if_it_has_it = [&](std::size_t l) {
        return has(l) ? std::max(state.belief.log(l), std::numeric_limits<double>::lowest()) : log_zero;
      };
      return detail::select(modes(), log_weight_if_it_has_it, state.most_likely_mode, interaction_.output_tie);
    });
  }

  /// Where all components stand in each model.
  const Correspondence* correspondences_of_output() const { return components_.of_all(); }

  /// The next state becomes the state; its most likely mode is (64).
  void conclude(bool measured) {
    next().most_likely_mode =
        detail::select(modes(), logs_of(next().belief), most_likely_mode(), interaction_.output_tie);
    current_ = 1 - current_;
    measured_ = measured;
    ++steps_;
  }

  using Predicted = Gaussian<Eigen::Dynamic, max_measurement_size>;

  /// One Gaussian for the innovations, as the mode's kind asks.
  template <class Weight>
  static Predicted collapsed_innovation(const std::vector<AnyInnovation>& innovations, const Weight& weight,
                                        std::size_t winner) {
    const Eigen::Index m = innovations[winner].residual.size();
    Predicted result{decltype(Predicted::mean)(m), decltype(Predicted::covariance)(m, m)};
    collapse(Collapse<Kind>{}, InnovationMixture{innovations}, weight, winner, result);
    return result;
  }
  /// Its mean in its own standard deviations; infinite if the covariance is not positive definite.
  static decltype(Predicted::mean) normalized(const Predicted& innovation) {
    const auto L = detail::cholesky_factor(innovation.covariance);
    if (L) return detail::lower_solve(*L, innovation.mean);
    return decltype(innovation.mean)::Constant(innovation.mean.size(), std::numeric_limits<double>::infinity());
  }

  /// With the likelihood in the form in force.
  template <int M, int MaxM>
  void assign(const Innovation<M, MaxM>& from, AnyInnovation& to) const {
    static_assert(MaxM <= max_measurement_size, "a sensor measures more quantities at once than a filter keeps");
    to = AnyInnovation(from);
    if (interaction_.likelihood == LikelihoodForm::possibility) to.log_likelihood = -0.5 * to.squared_distance;
  }

  static double unit(std::size_t) { return 1.0; }

  void assign(const detail::kinematic::Told& told, std::size_t j, AnyInnovation& to) const {
    const int A = shortcut_.axes();
    to.residual = Eigen::Map<const Eigen::VectorXd>(told.residual[j].data(), A);
    to.covariance = Eigen::Map<const Eigen::MatrixXd>(told.S[j].data(), A, A);
    to.squared_distance = told.squared_distance[j];
    to.log_likelihood = -0.5 * told.squared_distance[j];
    if (interaction_.likelihood == LikelihoodForm::density)
      to.log_likelihood -= 0.5 * (told.log_determinant[j] + A * std::log(2.0 * std::numbers::pi));
  }

  static auto logs_of(const Belief<Kind>& belief) {
    return [&belief](std::size_t j) { return belief.log(j); };
  }

  /// Runs `action`; a domain_error is rethrown with the number of the step.
  template <class Action>
  void located(double dt, const Action& action) const {
    try {
      action();
    } catch (const std::domain_error& error) {
      throw std::domain_error(this_step(dt) + ": " + error.what());
    }
  }

  void require(double dt) const {
    if (!(dt >= 0.0 && std::isfinite(dt)))
      throw std::invalid_argument(this_step(dt) + ": expected a finite time that is not negative");
  }
  template <int M, int MaxM>
  void require(double dt, const Gaussian<M, MaxM>& z) const {
    require(dt);
    if (!detail::all_finite(z))
      throw std::invalid_argument(this_step(dt) + ": the measurement, or its covariance, is not finite");
  }

 private:
  void forget_mode() {
    states_[current_].belief = Belief{uninformative(system_.mode_variable())};
    states_[current_].most_likely_mode = detail::select(modes(), logs_of(belief()), 0, interaction_.output_tie);
    measured_ = false;
  }

  std::string this_step(double dt) const {
    return "step " + std::to_string(steps_ + 1) + " of " + std::to_string(dt) + " s";
  }

  double log_fit(std::size_t j) const { return prior_.log(j) - 0.5 * innovations_[j].squared_distance; }

  /// −2 log ⊕ of the hypotheses' weights and how well they fit.
  template <class LogFit>
  static double distance_of(std::size_t hypotheses, const LogFit& log_fit) {
    return -2.0 * detail::log_combine<AlgebraOf<Kind>>(hypotheses, log_fit, unit);
  }

  template <class Rule>
  Estimate output(const Rule& rule, const State& state) const {
    if constexpr (shortens) {
      Estimate result;
      if (shortcut_.output(rule, state, result)) return result;
    }
    const Estimate receiver = output_receiver(state);
    Estimate result = receiver;
    collapse(
        rule, mixture(receiver, components_.of_all(), state.estimates), [&](std::size_t j) { return state.belief[j]; },
        state.most_likely_mode, result);
    return result;
  }

 protected:
  JumpMarkovSystem<Models, Kind> system_;
  Interaction<Kind> interaction_;
  std::vector<AnyInnovation> innovations_;
  Belief<Kind> prior_;

 private:
  Components<Models> components_;
  Estimates entries_;  ///< what Lift::prior knows of each model's components
  detail::kinematic::Shortcut<Models, Kind> shortcut_;
  std::array<State, 2> states_;
  std::size_t current_ = 0;
  std::size_t predicted_mode_ = 0;
  std::size_t steps_ = 0;
  std::optional<double> gate_distance_ = 0.0;  ///< empty if not computed yet
  bool measured_ = false;
};

}  // namespace sigmax
