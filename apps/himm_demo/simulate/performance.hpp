#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <sigmax/core/mean_interval.hpp>

#include "himm_demo/experiment/experiment.hpp"
#include "result/report.hpp"
#include "study/study.hpp"

namespace sigmax::apps {

/// What all runs say of one filter, or of the raw measurement. Samples and phases are counted from 0; what is by sample
/// is NaN before the first estimate.
class Performance {
 public:
  /// Of the measurement, if there is no filter.
  explicit Performance(const Experiment& experiment, const FilterSettings* filter = nullptr);

  const FilterSettings* filter() const { return filter_; }
  std::string name() const { return filter_ ? filter_->name : "measurement"; }

  /// What is summed up of a sample beside squared errors by axis, which come first, and the weights, which come last.
  enum Figure : std::size_t { nees_position = 3, nees_velocity, nis, nis_count, weight_count, first_weight };

  /// The numbers of a run go into a row, and out of it into the sums; `row` begins behind them afterwards.
  void append(const Trace& trace, Study::Row& row) const;
  void add(std::span<const double>& row);

  double rmse(std::size_t sample, std::size_t axis) const;
  double rmse_half_width(std::size_t sample, std::size_t axis) const;  ///< at 95 % confidence

  /// The mean of NEES or NIS at a sample, over a phase, or over all of them; 3 if consistent, or 6 with the velocity.
  double at(std::size_t sample, Figure figure) const;
  double mean(Figure figure, std::optional<std::size_t> phase = std::nullopt) const;

  /// Means of the models' weights, as they are told of a sample; empty before the first estimate.
  std::vector<double> told_weights(std::size_t sample) const;

  /// Root mean square over the samples of a phase: by axis, and of the distance.
  double phase_rmse(std::size_t phase, std::size_t axis) const;
  double phase_rmse(std::size_t phase) const;
  double peak_rmse(std::size_t axis) const;  ///< of all phases

  /// When the manoeuvre model's weight first crosses the other's upwards after the onset, in (fractional) samples, over
  /// the runs that crossed, how many those are, and of the averaged curves. None of it holds for a filter without a
  /// manoeuvre model, or a smoothed one, which knows of the manoeuvre before it begins.
  std::optional<Interval> cross_time_of_runs() const;
  std::optional<std::size_t> runs_crossed() const;
  std::optional<double> cross_time_of_curves() const;

  /// This RMSE minus that of another one in one phase and axis, paired by run (delta method).
  Interval minus(const Performance& other, std::size_t phase, std::size_t axis) const;

 private:
  std::vector<double> weights(std::size_t sample) const;
  double sum(std::size_t sample, std::size_t figure) const { return sums_[sample * figures_ + figure]; }
  double runs() const { return static_cast<double>(experiment_.runs); }

  const Experiment& experiment_;
  const FilterSettings* filter_;
  std::optional<std::size_t> manoeuvre_;  // its model
  std::size_t figures_;
  std::vector<double> sums_;                                // over the runs, in their order
  std::vector<RunningMean> spread_;                         // of squared errors, by sample and axis
  std::array<std::vector<double>, squares> run_squares_{};  // by run
  std::vector<double> crossings_;
};

/// Of the measurement, then of the filters, so far of no run; and all numbers of a run, which are added to all of them.
std::vector<Performance> performances(const Experiment& experiment);
Study::Row row_of(const std::vector<Performance>& performances, const TracedRun& run);
void add(std::span<const double> row, std::vector<Performance>& performances);

/// So many filters that not all can be told apart at once.
inline bool crowded(const Experiment& experiment) { return experiment.filters.size() > 6; }

/// The experiment as the views of a page: curves over the samples of all runs (Figs. 2–11), of the measurement and all
/// filters, and of the first runs each, up to 8, fewer if many filters would make the page great.
std::vector<View> views_of(const Experiment& experiment, const std::vector<Performance>& found);

/// Of the first view what ends the output on a terminal: the RMSE in x, and the weights.
std::vector<LineChart> charts_of(const View& view);

}  // namespace sigmax::apps
