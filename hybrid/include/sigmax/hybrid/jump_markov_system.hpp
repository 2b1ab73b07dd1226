#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <sigmax/core/relation.hpp>
#include <sigmax/hybrid/bank.hpp>

namespace sigmax {

/// A system whose model jumps with its mode r_k, (47), (48): random with a transition probability (49), or fuzzy with a
/// transition possibility (50). Which of both it is, is the kind of the mode.
template <class Models, Uncertainty Kind>
class JumpMarkovSystem {
 public:
  /// Throws std::invalid_argument unless the transition leads from a mode variable to itself and has one outcome for
  /// each model.
  JumpMarkovSystem(Models models, Relation<Kind, Kind> transition)
      : models_(std::move(models)), transition_(std::move(transition)) {
    check::same(transition_.from(), transition_.to(), "JumpMarkovSystem");
    if (transition_.to().size() != mode_count(models_))
      throw std::invalid_argument("the mode variable '" + transition_.to().name() + "' has " +
                                  std::to_string(transition_.to().size()) + " outcomes, but there are " +
                                  std::to_string(mode_count(models_)) + " models");
  }

  const Models& models() const { return models_; }
  const Relation<Kind, Kind>& transition() const { return transition_; }
  const Variable<Kind>& mode_variable() const { return transition_.to(); }

 private:
  Models models_;
  Relation<Kind, Kind> transition_;
};

}  // namespace sigmax
