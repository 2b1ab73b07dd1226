#pragma once

#include <sigmax/estimation/gaussian.hpp>

#include "himm_demo/experiment/scenario.hpp"
#include "himm_demo/filters/settings.hpp"

namespace sigmax::apps {

/// Of the position, by sample.
using Errors = std::vector<Vector<3>>;

/// One filter in one run, sample by sample; NaN where there is no estimate.
struct Trace {
  std::size_t samples;
  Errors error = Errors(samples, Vector<3>::Constant(nan));
  /// Of the position, as the filter states it.
  std::vector<SquareMatrix<3>> covariance = std::vector<SquareMatrix<3>>(samples, SquareMatrix<3>::Constant(nan));
  std::vector<double> nees_position = std::vector(samples, nan), nees_velocity = nees_position, nis = nees_position;
  std::vector<std::vector<double>> weights = std::vector<std::vector<double>>(samples);
};

/// A run of the experiment: the target, what its radar measured, and what each filter made of it.
struct TracedRun {
  std::vector<Vector<6>> truth;
  Trace measurement;
  std::vector<Trace> filters;
};

/// What the experiment's radar saw, sample by sample, as the filter takes it.
std::vector<AnyPlot> plots_of(const FilterSettings& filter, double step_s, std::span<const Polar> seen);

/// By how much the radar was wrong.
Errors errors_of(const Recording& recording);

/// Leads a filter through a recording and calls visit(point) for each estimate, with the number of its sample, from 0,
/// as its tag. Throws std::runtime_error, naming filter and sample, where a filter throws.
void follow(const FilterSettings& filter, double step_s, const Recording& recording,
            const std::function<void(const TargetPoint&)>& visit);

/// The model that stands for the manoeuvre: the last that does, if another does not. Its crossing is a delay; a
/// smoothed filter has none, since it knows of the manoeuvre before that begins.
std::optional<std::size_t> manoeuvre_model(const FilterSettings& filter);

/// The weight of a model minus the greatest of the others; 0 without weights.
double weight_difference(const std::vector<double>& weights, std::size_t model);

/// The mean of value(sample) over the samples of a phase; there, they are counted from 0.
template <class Value>
double phase_mean(const Phase& phase, const Value& value) {
  double sum = 0.0;
  for (int k = phase.first; k <= phase.last; ++k) sum += value(static_cast<std::size_t>(k - 1));
  return sum / (phase.last - phase.first + 1);
}

/// The experiment of section VI.
struct Experiment {
  Scenario scenario;
  Group group;
  std::vector<FilterSettings> filters;
  int runs;
  std::uint64_t seed;
  int mode_sample_shift;  ///< added to the sample of mode curves: −1 in the released program, else 0

  std::size_t samples() const { return static_cast<std::size_t>(scenario.samples()); }

  /// The run with that number, counted from 0; nothing but the seed and the number decides what is drawn.
  TracedRun traced(std::uint64_t number) const;
};

/// That of a scenario and group, with the filters that the settings name. Throws InputError for what cannot be.
Experiment experiment_of(Preset preset, int scenario_number, int group_number, const Settings& settings, int runs,
                         std::uint64_t seed);

/// Mean square errors are by phase and axis: 3 · phase + axis.
inline constexpr std::size_t squares = 9;

/// Adds those of a run, by its errors at each sample.
void add_squares(const Scenario& scenario, const Errors& error, double* sums);

/// When the manoeuvre model's weight first crosses the others' upwards after the onset, in fractional samples counted
/// from one, interpolated; `difference(sample)` has it for samples counted from 0.
template <class Difference>
std::optional<double> cross_time(const Experiment& experiment, const Difference& difference) {
  const Scenario& scenario = experiment.scenario;
  for (int k = std::max(scenario.onset(), 2); k <= scenario.samples(); ++k) {
    const double previous = difference(static_cast<std::size_t>(k - 2)),
                 now = difference(static_cast<std::size_t>(k - 1));
    if (previous <= 0.0 && now > 0.0) return k - 1 + previous / (previous - now) + experiment.mode_sample_shift;
  }
  return std::nullopt;
}

}  // namespace sigmax::apps
