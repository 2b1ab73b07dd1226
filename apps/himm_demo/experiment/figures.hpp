#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "himm_demo/experiment/scenario.hpp"
#include "himm_demo/filters/settings.hpp"
#include "himm_demo/trace.hpp"

namespace sigmax::apps {

/// The experiment of section VI.
struct Experiment {
  Scenario scenario;
  Group group;
  std::vector<FilterSettings> filters;
  int runs;
  std::uint64_t seed;
  int mode_sample_shift;  ///< added to the sample of mode curves: −1 in the released program, else 0

  /// The run with that number, through all filters.
  TracedRun traced(std::uint64_t number) const;

  /// The sample whose weights are told of one, both counted from 0.
  std::optional<std::size_t> mode_sample(std::size_t sample) const;
};

/// Mean square errors are by phase and axis: 3 · phase + axis.
inline constexpr std::size_t squares = 9;

/// Adds those of a run, by its errors at each sample.
void add_squares(const Scenario& scenario, const std::vector<std::array<double, 3>>& error, double* sums);

/// When the manoeuvre model's weight first crosses the others' upwards after the onset, in fractional samples counted
/// from one, as `difference(sample)` has it for samples counted from 0.
template <class Difference>
std::optional<double> cross_time(const Experiment& experiment, const Difference& difference) {
  const auto crossing = first_crossing(experiment.scenario.phases[1].first, experiment.scenario.samples,
                                       [&](int sample) { return difference(static_cast<std::size_t>(sample - 1)); });
  return crossing ? std::optional(*crossing + experiment.mode_sample_shift) : std::nullopt;
}

}  // namespace sigmax::apps
