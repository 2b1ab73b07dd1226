#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <tuple>
#include <variant>
#include <vector>

#include <sigmax/core/relation.hpp>
#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/estimation/independent_axes.hpp>
#include <sigmax/estimation/member.hpp>
#include <sigmax/hybrid/bank.hpp>
#include <sigmax/hybrid/hybrid_estimate.hpp>
#include <sigmax/hybrid/kinematic_plan.hpp>

/// Which filters may take the short step of kinematic_plan.hpp, and when.
namespace sigmax::detail::kinematic {

/// Along how many axes a motion goes, and its order along each; zero if it is none along independent axes, or one whose
/// F_s is not made of shears.
struct Shape {
  int axes = 0, order = 0;
  bool operator==(const Shape&) const = default;
};

/// @{
/// The law of a motion over one step, and its shape.
template <class Moves>
Shape describe(const Moves&, double, Law&) {
  return {};
}
template <int A, class MotionLaw>
Shape describe(const IndependentAxes<A, MotionLaw>& motion, double dt, Law& law) {
  constexpr int order = MotionLaw::order;
  const auto at = [](int a, int b) { return static_cast<std::size_t>(triangle(a) + b); };
  const SquareMatrix<order> F = motion.law().transition(dt);
  const SquareMatrix<order> Q = motion.law().process_covariance(dt);
  for (int a = 0; a + 1 < order; ++a)
    if (F(a, a) != 1.0) return {};
  law.shears = {};
  if constexpr (order == 2) law.shears[0] = F(0, 1);
  if constexpr (order == 3) {
    if (F(1, 2) == 0.0 && F(0, 2) != 0.0) return {};
    const double last = F(1, 2) == 0.0 ? 0.0 : F(0, 2) / F(1, 2);
    law.shears = {F(0, 1) - last, F(1, 2), last};
  }
  law.scale = F(order - 1, order - 1);
  for (int a = 0; a < order; ++a)
    for (int b = 0; b <= a; ++b) {
      law.squared[at(a, b)] = F(b, a) * F(b, a);
      law.Q[at(a, b)] = Q(a, b);
    }
  const auto input = motion.known_input(dt);
  for (int i = 0; i < order * A; ++i) law.u[static_cast<std::size_t>(i)] = input(i);
  return {A, order};
}
template <int MaxStateSize, class... Moves>
Shape describe(const AnyMotion<MaxStateSize, Moves...>& motion, double dt, Law& law) {
  return motion.visit([&](const auto& chosen) { return describe(chosen, dt, law); });
}
template <class Model>
  requires requires(const Model& model) { model.motion(); }
Shape describe(const Model& model, double dt, Law& law) { return describe(model.motion(), dt, law); }
/// @}

/// @{
/// Whether a model may move along independent axes.
template <class Model>
inline constexpr bool may_be = false;
template <int A, class MotionLaw>
inline constexpr bool may_be<IndependentAxes<A, MotionLaw>> = true;
template <int MaxStateSize, class... Moves>
inline constexpr bool may_be<AnyMotion<MaxStateSize, Moves...>> = (may_be<Moves> || ...);
template <class Model>
  requires requires { typename Model::MotionType; }
inline constexpr bool may_be<Model> = may_be<typename Model::MotionType>;
/// @}

template <class Models>
inline constexpr bool may_all_be = false;
template <class... Model>
inline constexpr bool may_all_be<std::tuple<Model...>> = sizeof...(Model) <= max_modes && (may_be<Model> && ...);
template <class Model>
inline constexpr bool may_all_be<std::vector<Model>> = may_be<Model>;

/// The short step and output of a bank, where it has them.
template <class Models, ScalableUncertainty Kind>
class Shortcut {
 public:
  static constexpr bool possible = may_all_be<Models>;
  using State = HybridEstimate<Models, Kind>;

  Shortcut(const Models& models, const Interaction<Kind>& interaction) {
    if constexpr (possible) {
      if (mode_count(models) > static_cast<std::size_t>(max_modes) || interaction.lift == Lift::prior) return;
      plan_.modes = static_cast<int>(mode_count(models));
      plan_.lift = interaction.lift;
      plan_.output_tie = interaction.output_tie;
      plan_.likelihood = interaction.likelihood;
      steps_ = interaction.mixed_start == MixedStart::of_each_mode;
      if constexpr (SelectiveAlgebra<AlgebraOf<Kind>>) {
        plan_.mixing_tie = interaction.collapse.mixing_tie;
        plan_.mixed_covariance = interaction.collapse.mixed_covariance;
        if (plan_.mixed_covariance == MixedCovariance::envelope) return;
        steps_ = steps_ && plan_.mixed_covariance != MixedCovariance::released;
      } else {
        steps_ = steps_ && interaction.collapse.mixing_weights == MixingWeights::correct;
      }
      outputs_ = true;
      for_each_mode(models, [&](auto j) {
        Law law;
        const Shape shape = describe(mode(models, j), 1.0, law);
        if (std::size_t{j} == 0) plan_.axes = shape.axes;
        plan_.order[std::size_t{j}] = shape.order;
        outputs_ = outputs_ && shape.order > 0 && shape.axes == plan_.axes;
      });
      steps_ = steps_ && outputs_;
    }
  }

  /// Makes ready for a step; false if it must be the general one.
  bool prepare(const Models& models, double dt, const Relation<Kind, Kind>& transition) {
    const Table* const table = std::get_if<Table>(&transition.rows());
    if (!steps_ || !table) return false;
    for (std::size_t i = 0; i < table->size(); ++i) plan_.transition[i] = table->data()[i];
    if (dt != dt_) {
      dt_ = dt;
      described_ = true;
      for_each_mode(models, [&](auto j) {
        const std::size_t at = j;
        described_ = described_ && describe(mode(models, j), dt, plan_.law[at]) == Shape{plan_.axes, plan_.order[at]};
      });
    }
    return described_;
  }

  /// Along which all models move, if there is a short step.
  int axes() const { return plan_.axes; }

  /// One step with the measurement z and its R, or none. False if it must be the general one.
  bool step(const State& now, const double* z, const double* R, State& next, Told& told) const {
    Track before = track_of(now), after = track_of(next);
    return kinematic::step(plan_, SelectiveAlgebra<AlgebraOf<Kind>>, before, z, R, after, told);
  }

  /// One step of a block of tracks; see the function of this name.
  template <class Number>
  unsigned step_block(Number* block, const Number* measurements) const {
    return kinematic::step_block(plan_, SelectiveAlgebra<AlgebraOf<Kind>>, block, measurements);
  }

  /// The output of a state by selection or by moment matching; false if it must be the general one.
  template <class Estimate>
  bool output(const Selection&, const State& state, Estimate& result) const {
    return output(true, state, result);
  }
  template <class Estimate>
  bool output(const MomentMatching& rule, const State& state, Estimate& result) const {
    return rule.output_spread == OutputSpread::included && output(false, state, result);
  }

 private:
  template <class Estimate>
  bool output(bool selects, const State& state, Estimate& result) const {
    if (!outputs_) return false;
    int size = 0;
    for (int j = 0; j < plan_.modes; ++j) size = std::max(size, plan_.state_size(j));
    result.mean.resize(size);
    result.covariance.resize(size, size);
    kinematic::output(plan_, selects, track_of(state), result.mean.data(), result.covariance.data());
    return true;
  }

  /// A view: the compiled step writes into the one that it is given to write to, and no other.
  static Track track_of(const State& state) {
    Track track;
    for_each_mode(state.estimates, [&](auto j) {
      const auto& estimate = mode(state.estimates, j);
      track.mean[std::size_t{j}] = const_cast<double*>(estimate.mean.data());
      track.covariance[std::size_t{j}] = const_cast<double*>(estimate.covariance.data());
      track.weight[std::size_t{j}] = state.belief[j];
    });
    track.most_likely = state.most_likely_mode;
    return track;
  }

  Plan plan_;
  double dt_ = std::numeric_limits<double>::quiet_NaN();
  bool steps_ = false;
  bool outputs_ = false;
  bool described_ = false;
};

}  // namespace sigmax::detail::kinematic
