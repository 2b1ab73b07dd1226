#pragma once

#include <functional>
#include <utility>

#include <sigmax/hybrid/any_target.hpp>
#include <sigmax/hybrid/detection.hpp>
#include <sigmax/hybrid/multiple_model_filter.hpp>

/// What a TargetChoice, and a detection in plain data, become: of one target and of many.
namespace sigmax::detail {

/// A function whose result is inside it, and copied with it.
template <class Base, class Own>
std::function<Base&()> held(Own own) {
  return [own = std::move(own)]() mutable -> Base& { return own; };
}

/// The filter of a choice, `held`; its state before it starts means nothing. Throws std::invalid_argument, saying what,
/// if the choice makes no sense.
template <ScalableUncertainty Kind>
std::function<MultipleModelFilter<Kind>&()> chosen_filter(const TargetChoice& choice);

/// A detection with its sensor. Throws std::invalid_argument if its numbers do not fit the sensor.
Detection chosen_detection(const AnyDetection& detection, int axes);

/// An estimate of each model: it has the leading components of `wide`, if it needs them all, or else of `narrow`. A
/// rate of turn behind them, which no start tells, is that of the choice.
Estimates chosen_start(const TargetChoice& choice, ConstView wide, ConstView narrow);

/// Writes the output of a state, the filter's own or another.
template <ScalableUncertainty Kind>
void tell(const MultipleModelFilter<Kind>& filter, const HybridEstimate<Kind>& state, bool most_likely_output,
          TargetPoint& result) {
  const auto n = static_cast<std::size_t>(filter.component_count());
  result.mean.resize(n);
  result.covariance.resize(n * n);
  const View output{result.mean.data(), result.covariance.data(), filter.component_count()};
  if (most_likely_output)
    filter.most_likely_output(state, output);
  else
    filter.output(state, output);
  result.weights.resize(state.belief.size());
  for (std::size_t j = 0; j < result.weights.size(); ++j) result.weights[j] = state.belief[j];
  result.most_likely_mode = state.most_likely_mode;
}

}  // namespace sigmax::detail
