#pragma once

#include <sigmax/estimation/radar.hpp>

#include "himm_demo/filters/settings.hpp"
#include "report/report.hpp"
#include "shell/random.hpp"
#include "study/study.hpp"

namespace sigmax::apps {

inline constexpr std::array<const char*, 3> axis_names = {"x", "y", "z"};
inline constexpr std::array<const char*, 3> phase_names = {"before", "during", "after"};  ///< the manoeuvre

/// Samples first … last, counted from one.
struct Phase {
  int first, last;
};

/// A manoeuvring target and how often it is seen, section VI.A.
struct Scenario {
  double step_s;
  Vector<3> position, velocity;
  Vector<3> acceleration;       ///< while it manoeuvres
  int last_accelerated;         ///< the transition k → k + 1 uses it for k from the onset to here
  std::array<Phase, 3> phases;  ///< in the order of their names
  bool noise_on_velocity;       ///< process noise acts on position and velocity, or on position only

  int samples() const { return phases[2].last; }
  int onset() const { return phases[1].first; }
};

/// Accuracies of the radar: as the data are made, and as the filters believe them (Table I, section VI.C).
struct Group {
  Polar data;
  Polar model;
  double sigma_w;  ///< of the filters; the data always have 3 m/s²
};

/// Scenario 1 or 2 of the paper.
Scenario scenario(int number, Preset preset);

/// Group 1 to 4 of the paper, for the radar of the scenario.
Group group(int number, int scenario_number);

/// One target and what the radar saw of it.
struct Recording {
  std::vector<Vector<6>> truth;  ///< position and velocity at every sample
  std::vector<Polar> measured;
};

/// Draws a target with process noise of 3 m/s² and its measurements.
Recording simulate(const Scenario& scenario, const Polar& sigma, RandomStream& random);

/// One filter at one sample; NaN where there is no estimate. The measurement has errors alone.
struct Sample {
  Vector<3> error = Vector<3>::Constant(nan);                   ///< of the position
  SquareMatrix<3> covariance = SquareMatrix<3>::Constant(nan);  ///< of the position, as the filter states it
  double nees_position = nan, nees_velocity = nan;
  double nis = nan;  ///< NaN, too, where the gate turned the measurement away
  std::vector<double> weights{};
};
using Trace = std::vector<Sample>;

/// A run of the experiment: the target, and the traces of the measurement and of each filter.
struct TracedRun {
  std::vector<Vector<6>> truth;
  std::vector<Trace> traces;
};

/// The experiment of section VI.
struct Experiment {
  Scenario scenario;
  Group group;
  std::vector<FilterSettings> filters;
  int runs;
  std::uint64_t seed;
  int mode_sample_shift;  ///< added to the sample of mode curves: −1 in the released program, else 0

  std::size_t samples() const { return static_cast<std::size_t>(scenario.samples()); }

  /// What the radar sees of the run with that number, counted from 0; the seed and the number decide what is drawn.
  Recording recording(std::uint64_t number) const;

  /// The same run through all filters. Throws std::runtime_error, naming run, filter and sample, where a filter throws.
  TracedRun traced(std::uint64_t number) const;
};

/// With the accuracies and σ_w that the filters of a group believe.
FilterDefaults defaults_of(Preset preset, const Group& parameters);

/// That of a scenario and group, with the filters that the settings name. Throws InputError for what cannot be.
Experiment experiment_of(Preset preset, int scenario_number, int group_number, const Settings& settings, int runs,
                         std::uint64_t seed);

/// What runs of an experiment add up to: figures by batch of runs, so that their statistics are paired, and means by
/// sample. All is told of the measurement, number 0, and of the filters from number 1 on; samples and phases are
/// counted from 0.
///
///     Tally tally(experiment);
///     for (std::uint64_t run = 0; run < 100; run += 10) tally.add(tally.row(run, run + 10));
///     tally.rmse(1, 0, 2).interval();   // of the first filter before the manoeuvre, along z
class Tally {
 public:
  /// The figures of a run, as they follow each other in a row. Those of the weights are 0 for a filter without a
  /// manoeuvre model, and for a smoothed one, which knows of the manoeuvre before it begins.
  enum Figure : std::size_t {
    square = 0,               ///< by phase and axis: mean square error
    onset_z = square + 9,     ///< of z in ten samples before and ten from the onset on
    lead = onset_z + 2,       ///< by phase: share of samples with the manoeuvre's model
    switches = lead + 3,      ///< by phase: how often the lead changes
    crossing = switches + 3,  ///< when the model's weight first crosses the others' after the onset, in samples …
    crossed,                  ///< … and in how many runs it does
    curve,                    ///< the model's lead in weight, in 16 samples from two before the onset on
    figures = curve + 16
  };

  /// Means by sample: the squared errors by axis, NEES and NIS, and the weights of the models.
  enum BySample : std::size_t { squared = 0, nees_position = 3, nees_velocity, nis, weight };

  /// With means by sample a row is to be of one run.
  explicit Tally(Experiment experiment, bool by_sample = false);

  /// The runs first … last − 1; any thread may call it.
  Study::Row row(std::uint64_t first, std::uint64_t last) const;

  /// Throws std::runtime_error for a row of another tally.
  void add(std::span<const double> row);

  std::size_t size() const { return 1 + experiment.filters.size(); }
  std::string name(std::size_t of) const;
  /// Null of the measurement.
  const FilterSettings* filter(std::size_t of) const { return of == 0 ? nullptr : &experiment.filters[of - 1]; }
  /// Whether a crossing can be told of it.
  bool has_manoeuvre(std::size_t of) const { return manoeuvre_[of].has_value(); }
  /// Who has this name.
  std::optional<std::size_t> place(std::string_view name) const;

  /// The mean of a figure over the runs, and the RMSE of a phase and axis in m.
  Statistic mean(std::size_t of, std::size_t figure) const;
  Statistic rmse(std::size_t of, std::size_t phase, std::size_t axis) const;
  /// The mean over axes and phases of RMSE over that of the measurement.
  Statistic over_measurement(std::size_t of) const;

  /// Cross-times: the mean of the runs that crossed, each of them where a row is of one run, and that of the averaged
  /// curves by batch, NaN if it is not soon after the onset.
  Statistic cross_time(std::size_t of) const;
  std::vector<double> cross_times(std::size_t of) const;
  Statistic cross_time_of_batches(std::size_t of) const;

  /// By sample: a mean over the runs, NaN before the first estimate; the RMSE along an axis, with its half width at 95
  /// % confidence; the models' mean weights as they are told of it, or none.
  double mean_at(std::size_t of, std::size_t sample, std::size_t figure) const;
  double rmse_at(std::size_t of, std::size_t sample, std::size_t axis) const;
  double half_width_at(std::size_t of, std::size_t sample, std::size_t axis) const;
  std::vector<double> weights_at(std::size_t of, std::size_t sample) const;

  /// Over samples: where the averaged weights cross, the greatest RMSE along an axis, and the mean NEES or NIS of a
  /// phase: 3 if consistent, 6 with the velocity.
  std::optional<double> cross_time_of_curves(std::size_t of) const;
  double peak_rmse(std::size_t of, std::size_t axis) const;
  double mean_of(std::size_t of, BySample figure, std::size_t phase) const;

  const Experiment experiment;

 private:
  void add_figures(const Trace& trace, std::size_t of, double* sums) const;
  std::size_t at(std::size_t of, std::size_t sample) const { return (of * experiment.samples() + sample) * width_; }
  const std::vector<double>& column(std::size_t of, std::size_t figure) const;
  std::vector<double> weights(std::size_t of, std::size_t sample) const;

  std::vector<std::optional<std::size_t>> manoeuvre_;  // the model that stands for it
  std::size_t width_ = 0;                              // of the means of a sample
  std::vector<std::vector<double>> columns_;           // by batch: how many runs, then figures
  std::vector<RunningMean> means_;                     // over the runs, in their order
};

/// So many filters that not all can be told apart at once.
inline bool crowded(const Experiment& experiment) { return experiment.filters.size() > 6; }

/// A tally by sample on a page: curves over the samples of all runs (Figs. 2–11), and the track of the first.
std::vector<Panel> panels_of(const Tally& tally);

}  // namespace sigmax::apps
