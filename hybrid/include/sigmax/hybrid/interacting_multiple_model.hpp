#pragma once

#include <vector>

#include <sigmax/core/likelihood.hpp>
#include <sigmax/core/update.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/hybrid/bank_filter.hpp>
#include <sigmax/hybrid/fast_path.hpp>

namespace sigmax {

/// The interacting multiple-model filter in plain numbers; see InteractingMultipleModel.
template <ScalableUncertainty Kind>
class InteractingFilter : public MultipleModelFilter<Kind> {
  using Filter = MultipleModelFilter<Kind>;

 public:
  using State = HybridEstimate<Kind>;
  using Filter::belief;
  using Filter::estimates;
  using Filter::modes;

  InteractingFilter(const std::vector<AnyModel>& models, ModeTransition<Kind> transition, const Estimates& start,
                    const Interaction<Kind>& interaction = {});

  void output(const State& state, detail::View result) const override;
  using Filter::output;

  /// @{
  /// For a bank of tracks: the fast path, made ready for steps of `dt` seconds; false if they must be general.
  bool prepare_fast_path(double dt);
  const detail::FastPath<Kind>& fast_path() const { return fast_path_; }
  /// @}

 private:
  using Filter::innovations_;
  using Filter::interaction_;
  using Filter::next;
  using Filter::prior_;
  using Filter::system_;

  bool measure(double dt, const Seen& seen, double limit) override;
  void miss(double dt) override;
  bool try_fast_path(double dt, const Seen* seen);
  Estimates predicted() const override { return predicted_; }
  void mix(double dt);

  Estimates predicted_;  ///< before the measurement
  Inverse<Kind, Kind> move_in_;
  Likelihood<Kind> likelihood_;
  detail::FastPath<Kind> fast_path_;
};

extern template class InteractingFilter<Random>;
extern template class InteractingFilter<Fuzzy>;

/// The interacting multiple-model filter, section V: with a random mode the IMM of Blom and Bar-Shalom, with a fuzzy
/// mode the HIMM of Mei, Xu and Liu. The mode's kind is the only difference.
///
///     InteractingMultipleModel filter{std::tuple{dwna<3>(3.0), dwpa<3>(3.0)}, transition, start};
///     for (const auto& [dt, z] : measurements) filter.step(dt, z);
///
/// The predecessors of a mode collapse *before* the measurement, into one start for each model: M predictions and
/// updates. SecondOrderMultipleModel lets them collapse after it. With `MixedStart::common` it is the GPB1 filter, with
/// the transition `identity(mode)` a static bank. `step` allocates nothing.
///
/// Made of models, transition, start, and optionally an Interaction<Kind>.
template <class Models, ScalableUncertainty Kind>
class InteractingMultipleModel : public BankFilter<Models, InteractingFilter<Kind>> {
 public:
  using BankFilter<Models, InteractingFilter<Kind>>::BankFilter;
};

template <class Models, ScalableUncertainty Kind, class Start, class... Rules>
InteractingMultipleModel(Models, Relation<Kind, Kind>, Start, Rules...) -> InteractingMultipleModel<Models, Kind>;
template <class Models, class Transition, class Start, class... Rules>
InteractingMultipleModel(Models, Transition, Start, Rules...)
    -> InteractingMultipleModel<Models, typename Transition::kind>;

}  // namespace sigmax
