#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "himm_demo/experiment.hpp"
#include "support/campaign.hpp"
#include "support/statistic.hpp"

namespace sigmax::apps {

/// What decides every figure of `himm_demo reproduce`.
struct ReproduceChoice {
  int runs = 1000;
  std::uint64_t seed = 1;
};

/// The readings of (57) by which there is a filter himm_…; `envelope` is without.
inline constexpr std::array<const char*, 5> himm_readings = {"selected", "own", "own_recentred", "released",
                                                             "envelope"};

/// The reading that a preset takes for the paper's.
std::string_view reading_of(Preset preset);

/// The ten samples before the manoeuvre and the ten from its first on, for which the paper looks at the z axis.
struct Onset {
  Phase before;
  Phase after;
};
Onset onset_of(const Scenario& scenario);

/// The figures of one filter in one batch of runs, as they follow each other in a row: sums over the runs.
struct FigureColumns {
  static constexpr std::size_t square = 0;     ///< by phase and axis: mean square error
  static constexpr std::size_t onset_z = 9;    ///< before and after the onset
  static constexpr std::size_t lead = 11;      ///< by phase: share of samples in which the manoeuvre model leads
  static constexpr std::size_t switches = 14;  ///< by phase: how often the lead changes
  static constexpr std::size_t crossing = 17;  ///< cross-times …
  static constexpr std::size_t crossed = 18;   ///< … and of how many runs
  static constexpr std::size_t curve = 19;     ///< weight of the manoeuvre model over the other's, from the onset on
  static constexpr std::size_t curve_samples = 16;
  static constexpr std::size_t count = curve + curve_samples;
};

/// One scenario and group under one preset, with all that was found there.
class Condition {
 public:
  Condition(Preset preset, int scenario_number, int group_number, const ReproduceChoice& choice);

  Preset preset() const { return preset_; }
  int scenario_number() const { return scenario_number_; }
  int group_number() const { return group_number_; }
  const Scenario& scenario() const { return experiment_.scenario; }
  const std::vector<FilterSettings>& filters() const { return experiment_.filters; }
  int sample_shift() const { return experiment_.mode_sample_shift; }

  /// The runs first … last − 1 of all filters, as one row: how many they are, the measurement's mean square errors, and
  /// FigureColumns for each filter.
  std::vector<double> batch(std::uint64_t first, std::uint64_t last) const;

  /// Takes the next batch's row.
  void add(const std::vector<double>& row);

  /// Whether there is such a filter here, or the measurement.
  bool has(std::string_view filter) const;

  /// The mean of one column over the runs. `filter` may be "measurement" for mean square errors.
  Statistic mean(std::string_view filter, std::size_t column) const;

  /// RMSE of a phase and axis in m.
  Statistic rmse(std::string_view filter, std::size_t phase, std::size_t axis) const;

  /// The mean cross-time of the runs that crossed.
  Statistic cross_time_of_runs(std::string_view filter) const;

  /// Where the averaged curves cross; NaN if not soon after the onset.
  Statistic cross_time_of_curves(std::string_view filter) const;

 private:
  std::size_t place(std::string_view filter) const;

  Preset preset_;
  int scenario_number_;
  int group_number_;
  Experiment experiment_;
  std::vector<std::vector<double>> columns_;  // by column and batch
};

/// Both presets, both scenarios and all groups, in this order.
std::vector<Condition> conditions(const ReproduceChoice& choice);

/// All runs, in batches whose number does not depend on the runs (but for few).
Campaign campaign_of(const ReproduceChoice& choice, const std::vector<Condition>& conditions);

/// Gives the rows of that campaign to the conditions.
void take_rows(const CellRows& rows, std::vector<Condition>& conditions);

}  // namespace sigmax::apps
