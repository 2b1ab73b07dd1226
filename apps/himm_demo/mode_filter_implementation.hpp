#pragma once

#include <type_traits>
#include <utility>

#include <sigmax/hybrid/fixed_interval_smoother.hpp>
#include <sigmax/hybrid/mode_transition.hpp>

#include "himm_demo/mode_filter.hpp"

namespace sigmax::apps {

// Included only by the files that instantiate it: several, since that is most of the program's compile time.

template <Uncertainty Kind>
ModeTransition<Kind> transition_of(const FilterSettings& settings) {
  const Variable<Kind> mode{"mode", settings.models};
  if (settings.scheme == Scheme::independent) return identity(mode);
  if (!settings.sojourn_s.empty()) return TimedTransition<Kind>(mode, rates_of_sojourns(settings.sojourn_s));
  return Relation<Kind, Kind>{mode, mode, settings.transition};
}

template <Uncertainty Kind>
Interaction<Kind> interaction_of(const FilterSettings& settings) {
  Interaction<Kind> interaction;
  interaction.lift = settings.lift;
  interaction.output_tie = settings.output_tie;
  interaction.mixed_start = settings.scheme == Scheme::common_start ? MixedStart::common : MixedStart::of_each_mode;
  interaction.likelihood = settings.likelihood;
  if constexpr (std::is_same_v<Kind, Fuzzy>)
    interaction.collapse = {settings.mixed_covariance, settings.mixing_tie};
  else
    interaction.collapse = {settings.imm_mixing, settings.output_spread};
  return interaction;
}

template <class Models>
ModeFilter<Models>::ModeFilter(const FilterSettings& settings, const Models& models, const Starts& starts)
    : filter_(made(settings, models, starts)), most_likely_output_(settings.most_likely_output) {}

template <class Models>
auto ModeFilter<Models>::made(const FilterSettings& settings, const Models& models, const Starts& starts) -> Filter {
  const auto make = [&]<Uncertainty Kind>(Kind) -> Filter {
    const auto transition = transition_of<Kind>(settings);
    const auto interaction = interaction_of<Kind>(settings);
    if (settings.scheme == Scheme::second_order)
      return SecondOrderMultipleModel<Models, Kind>(models, transition, starts, interaction);
    return InteractingMultipleModel<Models, Kind>(models, transition, starts, interaction);
  };
  return settings.fuzzy ? make(Fuzzy{}) : make(Random{});
}

template <class Models>
bool ModeFilter<Models>::step(double dt, const std::optional<Measurement>& z, double gate) {
  z_ = z;
  return std::visit(
      [&](auto& filter) {
        if (z)
          filter.step(dt, *z, gate);
        else
          filter.step(dt);
        return filter.measured();
      },
      filter_);
}

template <class Models>
const std::vector<std::string>& ModeFilter<Models>::components() const {
  return std::visit([](const auto& filter) -> const std::vector<std::string>& { return filter.components(); }, filter_);
}

template <class Models>
template <class AnyFilter>
auto ModeFilter<Models>::output_of(const AnyFilter& filter, const typename AnyFilter::State& state) const -> Output {
  Output output{most_likely_output_ ? filter.most_likely_estimate(state) : filter.estimate(state),
                std::vector<double>(filter.modes()), state.most_likely_mode};
  for (std::size_t j = 0; j < filter.modes(); ++j) output.weights[j] = state.belief[j];
  return output;
}

template <class Models>
auto ModeFilter<Models>::output() const -> Output {
  return std::visit([&](const auto& filter) { return output_of(filter, filter.state()); }, filter_);
}

template <class Models>
std::optional<double> ModeFilter<Models>::nis() const {
  return std::visit([](const auto& filter) { return filter.measured() ? std::optional(filter.nis()) : std::nullopt; },
                    filter_);
}

template <class Models>
void ModeFilter<Models>::record(double dt) {
  std::visit(
      [&](const auto& filter) {
        auto step = z_ ? filter.recorded(dt, *z_) : filter.recorded(dt);
        std::get<std::vector<decltype(step)>>(record_).push_back(std::move(step));
      },
      filter_);
}

template <class Models>
auto ModeFilter<Models>::smoothed() const -> std::vector<Output> {
  return std::visit(
      [&](const auto& filter) {
        std::vector<Output> outputs;
        for (const auto& state : smooth(filter, std::get<std::vector<decltype(filter.recorded(0.0))>>(record_)))
          outputs.push_back(output_of(filter, state));
        return outputs;
      },
      filter_);
}

}  // namespace sigmax::apps
