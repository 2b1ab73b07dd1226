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
#include <sigmax/hybrid/jump_markov_system.hpp>
#include <sigmax/hybrid/lift.hpp>

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
  using Estimate = Gaussian<Eigen::Dynamic, Bank<Models>::max_components>;

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
        likelihood_(system_.mode_variable()) {
    if (mode_count(estimates_) != modes())
      throw std::invalid_argument("there are " + std::to_string(modes()) + " models, but " +
                                  std::to_string(mode_count(estimates_)) + " starts");
    move_in_.unreachable.reserve(modes());
    for_each_mode(system_.models(), [&](auto j) { require_start(mode(system_.models(), j), mode(estimates_, j)); });
    relate_components();
    winner_ = select(modes(), log_weight(), 0, Tie::first);
  }

  /// Starts every model from the components that it has of one estimate, given in the order of `components()`.
  template <int N, int MaxN>
  InteractingMultipleModel(Models models, Relation<Kind, Kind> transition, const Gaussian<N, MaxN>& start,
                           Interaction<Kind> interaction = {})
      : InteractingMultipleModel(models, std::move(transition), starts_from(models, start), interaction) {}

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
  const std::vector<std::string>& components() const { return components_; }

  /// Step 4: the selected model's estimate if the mode is fuzzy, (65), (66); the moment-matched one if it is random,
  /// (67), (68) with the spread of the means that the print omits. In `components()`, lifted by the rule in force.
  Estimate estimate() const {
    const Estimate receiver = carried();
    Estimate result = receiver;
    collapse(interaction_.collapse, mixture(receiver, output_maps_), weight(), winner_, result);
    return result;
  }

  /// The estimate of the most likely mode alone, whatever the mode's kind.
  Estimate most_likely_estimate() const {
    const Estimate receiver = carried();
    Estimate result = receiver;
    collapse(Selection{}, mixture(receiver, output_maps_), weight(), winner_, result);
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
        interaction_.collapse, Residuals{innovations_}, [this](std::size_t j) { return prior_[j]; }, predicted_mode_,
        predicted);
    const Eigen::LLT<SquareMatrix<measurement_size>> S(predicted.covariance);
    return S.matrixL().solve(predicted.mean).squaredNorm();
  }

 private:
  /// The models' estimates as parts of a mixture in the components of a receiver.
  template <class Receiver>
  struct Mixture {
    const Receiver& receiver;
    const Estimates& estimates;
    const Correspondence* maps;
    Lift lift;

    template <class Visit>
    void visit_all(const Visit& visit) const {
      for_each_mode(estimates,
                    [&](auto l) { visit(std::size_t{l}, Lifted(receiver, mode(estimates, l), maps[l], lift)); });
    }
    template <class Visit>
    void visit(std::size_t wanted, const Visit& visit) const {
      for_each_mode(estimates, [&](auto l) {
        if (l == wanted) visit(Lifted(receiver, mode(estimates, l), maps[l], lift));
      });
    }
  };

  /// The innovations as parts of a mixture.
  struct Residuals {
    struct Part {
      const Innovation<measurement_size>& innovation;
      const auto& mean() const { return innovation.residual; }
      void add_covariance(double weight, SquareMatrix<measurement_size>& covariance) const {
        covariance += weight * innovation.covariance;
      }
    };
    const std::vector<Innovation<measurement_size>>& innovations;

    template <class Visit>
    void visit_all(const Visit& visit) const {
      for (std::size_t l = 0; l < innovations.size(); ++l) visit(l, Part{innovations[l]});
    }
    template <class Visit>
    void visit(std::size_t wanted, const Visit& visit) const {
      visit(Part{innovations[wanted]});
    }
  };

  template <class Receiver>
  Mixture<Receiver> mixture(const Receiver& receiver, const std::vector<Correspondence>& maps,
                            std::size_t first = 0) const {
    return {receiver, estimates_, maps.data() + first, interaction_.lift};
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
        mix(interaction_.collapse, mixture(own, mixing_maps_, j * modes()), move_in, modes(), j, own, mixed);
    });
  }

  /// The winner before the measurement, for `nis`, and after it, (64).
  void choose() {
    const auto prior = [this](std::size_t j) { return prior_.log(j); };
    predicted_mode_ = select(modes(), prior, winner_, interaction_.output_tie);
    winner_ = select(modes(), log_weight(), winner_, interaction_.output_tie);
  }

  /// For each component the value and variance of the most likely model that has it: what a lift of the output borrows.
  Estimate carried() const {
    const auto n = static_cast<Eigen::Index>(components_.size());
    Estimate result{Vector<Eigen::Dynamic, Bank<Models>::max_components>::Zero(n),
                    SquareMatrix<Eigen::Dynamic, Bank<Models>::max_components>::Zero(n, n)};
    if (interaction_.lift == Lift::zero) return result;
    const auto carrier = [&](Eigen::Index i) {
      const auto log_weight_if_it_has_it = [&](std::size_t l) {
        const bool has_it = output_maps_[l].in_source[static_cast<std::size_t>(i)] >= 0;
        return has_it ? std::max(belief_.log(l), std::numeric_limits<double>::lowest()) : log_zero;
      };
      return select(modes(), log_weight_if_it_has_it, winner_, interaction_.output_tie);
    };
    for_each_mode(estimates_, [&](auto l) {
      const auto& estimate = mode(estimates_, l);
      const auto& from = output_maps_[l].in_source;
      for (Eigen::Index i = 0; i < n; ++i) {
        if (carrier(i) != l) continue;
        result.mean(i) = estimate.mean(from[static_cast<std::size_t>(i)]);
        for (Eigen::Index k = 0; k < n; ++k)
          if (carrier(k) == l)
            result.covariance(i, k) =
                estimate.covariance(from[static_cast<std::size_t>(i)], from[static_cast<std::size_t>(k)]);
      }
    });
    return result;
  }

  /// All components of the models, those of the largest (the first of them on a tie) leading.
  static std::vector<std::string> all_components(const Models& models) {
    std::vector<std::string> all;
    for_each_mode(models, [&](auto j) {
      const auto own = std::vector<std::string>(mode(models, j).components());
      if (own.size() > all.size()) all = own;
    });
    for_each_mode(models, [&](auto j) {
      for (const auto& component : mode(models, j).components())
        if (std::find(all.begin(), all.end(), component) == all.end()) all.push_back(component);
    });
    if (all.size() > static_cast<std::size_t>(Bank<Models>::max_components))
      throw std::invalid_argument("the models have " + std::to_string(all.size()) +
                                  " different components, but their type allows " +
                                  std::to_string(Bank<Models>::max_components));
    return all;
  }

  void relate_components() {
    const Models& models = system_.models();
    components_ = all_components(models);
    for_each_mode(models, [&](auto j) {
      output_maps_.emplace_back(components_, mode(models, j).components());
      for_each_mode(models, [&](auto l) {
        mixing_maps_.emplace_back(mode(models, j).components(), mode(models, l).components());
      });
    });
  }

  template <int N, int MaxN>
  static Estimates starts_from(const Models& models, const Gaussian<N, MaxN>& start) {
    const auto components = all_components(models);
    if (static_cast<std::size_t>(start.size()) != components.size())
      throw std::invalid_argument("the start has " + std::to_string(start.size()) +
                                  " components, but the models have " + std::to_string(components.size()));
    Estimates starts = estimates_for(models);
    for_each_mode(models, [&](auto j) {
      const Correspondence map(mode(models, j).components(), components);
      auto& own = mode(starts, j);
      own.mean.resize(mode(models, j).size());
      own.covariance.setZero(own.mean.size(), own.mean.size());
      const Lifted dropped(own, start, map, Lift::zero);
      own.mean = dropped.mean();
      dropped.add_covariance(1.0, own.covariance);
    });
    return starts;
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
  std::vector<std::string> components_;
  std::vector<Correspondence> mixing_maps_;  ///< of source l in receiver j, at j · modes + l
  std::vector<Correspondence> output_maps_;  ///< of source l in components_
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
