#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <sigmax/core/mean_interval.hpp>

#include "himm_demo/filters/settings.hpp"
#include "himm_demo/scenario.hpp"
#include "himm_demo/trace.hpp"

namespace sigmax::apps {

/// When the manoeuvre model's weight first crosses the other's upwards after the onset, in (fractional) samples. None
/// of it holds for a filter without a manoeuvre model, or a smoothed one, which knows of the manoeuvre before it
/// begins.
struct CrossTime {
  std::optional<Interval> mean_of_runs;  ///< over the runs that crossed
  std::optional<std::size_t> runs_crossed;
  std::optional<double> of_averaged_curves;
};

/// What the runs say of one filter, or of the raw measurement.
struct Performance {
  std::vector<std::array<double, 3>> rmse;            ///< per sample and axis; NaN before the first estimate
  std::array<std::array<double, 3>, 3> phase_rmse{};  ///< by phase and axis: root mean square over its samples
  std::array<double, 3> position_rmse{};     ///< by phase: of the distance, the root of the axes' sum of squares
  std::array<double, 3> peak{};              ///< greatest RMSE of a sample of any phase
  std::array<double, 3> nees_position{};     ///< mean by phase; 3 if consistent
  std::array<double, 3> nees_velocity{};     ///< of position and velocity; 6 if consistent
  std::array<double, 3> nis{};               ///< mean by phase; 3 if consistent
  std::vector<std::vector<double>> weights;  ///< mean per sample and model; empty before the first estimate
  std::vector<std::array<double, 3>> rmse_half_width;  ///< of `rmse`, at 95 % confidence
  std::vector<double> nees_by_sample;                  ///< mean of the runs, of the position
  std::vector<double> nis_by_sample;                   ///< mean of the runs that took the measurement
  CrossTime cross_time;
  /// By phase, axis and run: mean square error.
  std::array<std::array<std::vector<double>, 3>, 3> run_mean_squares{};
};

/// The experiment of section VI.
struct Experiment {
  Scenario scenario;
  Group group;
  std::vector<FilterSettings> filters;
  int runs;
  std::uint64_t seed;
  int threads;
  int mode_sample_shift;  ///< added to the sample of mode curves: −1 in the released program, else 0
  int kept_runs = 0;      ///< so many of the first runs are kept sample by sample
};

/// Performance of the measurement, and of each filter.
struct Outcome {
  Performance measurement;
  std::vector<Performance> filters;
  std::vector<TracedRun> runs;  ///< the first ones, as many as are kept
};

/// Runs the experiment; `advance` is called after each run, by any thread. The outcome does not depend on the number of
/// threads. Throws what a filter throws, naming filter, run and sample.
Outcome run(const Experiment& experiment, const std::function<void()>& advance);

/// CPU time of a step of each filter in ns, on one thread: the median over some of the runs. Not reproducible.
std::vector<double> nanoseconds_per_step(const Experiment& experiment);

/// RMSE of `a` minus RMSE of `b` in one phase and axis, paired by run (delta method).
Interval paired_difference(const Performance& a, const Performance& b, std::size_t phase, std::size_t axis);

}  // namespace sigmax::apps
