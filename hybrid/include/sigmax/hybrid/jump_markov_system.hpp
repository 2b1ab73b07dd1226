#pragma once

#include <concepts>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/core/relation.hpp>
#include <sigmax/hybrid/bank.hpp>

namespace sigmax {

/// A function of the time step that gives a mode's transition: `transition(dt)`, as TimedTransition does.
template <class Function, class Kind>
concept TransitionOverTime = requires(const Function& transition, double dt) {
  { transition(dt) } -> std::same_as<Relation<Kind, Kind>>;
};

/// How a mode moves on in one step: by one relation whatever the time between two scans, or by a function of that time.
template <ScalableUncertainty Kind>
class ModeTransition {
 public:
  using kind = Kind;

  ModeTransition(Relation<Kind, Kind> per_scan) : relation_(std::move(per_scan)) {}

  /// A function that can also write, `transition(dt, relation)`, is asked to, so that a step allocates nothing.
  template <TransitionOverTime<Kind> Function>
  ModeTransition(Function transition) : relation_(transition(0.0)) {
    if constexpr (std::invocable<const Function&, double, Relation<Kind, Kind>&>)
      write_ = std::move(transition);
    else
      write_ = [transition = std::move(transition)](double dt, Relation<Kind, Kind>& result) {
        result = transition(dt);
      };
  }

  /// p(r_k | r_{k−1}) or π(r_k | r_{k−1}) for a step of `dt` seconds. Computed only if the step changed.
  const Relation<Kind, Kind>& over(double dt) {
    if (write_ && dt != dt_) {
      write_(dt, relation_);
      dt_ = dt;
    }
    return relation_;
  }

  /// The relation computed last. Before the first step of a function: that of dt = 0.
  const Relation<Kind, Kind>& last() const { return relation_; }

 private:
  Relation<Kind, Kind> relation_;
  std::function<void(double, Relation<Kind, Kind>&)> write_;  ///< empty if the relation serves every step
  double dt_ = 0.0;
};

/// A system whose model jumps with its mode r_k, (47), (48): random with a transition probability (49), or fuzzy with a
/// transition possibility (50). Which of both it is, is the kind of the mode.
template <ScalableUncertainty Kind>
class JumpMarkovSystem {
 public:
  /// Throws std::invalid_argument unless the transition leads from a mode variable to itself and has one outcome for
  /// each model.
  JumpMarkovSystem(std::vector<AnyModel> models, ModeTransition<Kind> transition)
      : models_(std::move(models)), transition_(std::move(transition)) {
    check::same(this->transition().from(), this->transition().to(), "JumpMarkovSystem");
    if (mode_variable().size() != models_.size())
      throw std::invalid_argument("the mode variable '" + mode_variable().name() + "' has " +
                                  std::to_string(mode_variable().size()) + " outcomes, but there are " +
                                  std::to_string(models_.size()) + " models");
  }

  const std::vector<AnyModel>& models() const { return models_; }

  /// The transition of the last step, and that of a step of `dt` seconds.
  const Relation<Kind, Kind>& transition() const { return transition_.last(); }
  const Relation<Kind, Kind>& transition(double dt) { return transition_.over(dt); }

  const Variable<Kind>& mode_variable() const { return transition().to(); }

 private:
  std::vector<AnyModel> models_;
  ModeTransition<Kind> transition_;
};

/// The transition of a mode that never changes: with it a multiple-model filter is a static (autonomous) bank, whose
/// models run alone and are compared by all that they predicted.
template <ScalableUncertainty Kind>
Relation<Kind, Kind> identity(const Variable<Kind>& mode) {
  Table table(mode.size(), mode.size());
  for (std::size_t i = 0; i < mode.size(); ++i) table(i, i) = AlgebraOf<Kind>::one();
  return {mode, mode, std::move(table), detail::ByLaw{}};
}

}  // namespace sigmax
