#pragma once

#include <sigmax/hybrid/cross_validation.hpp>

#include "himm_demo/filters/settings.hpp"
#include "records/plots.hpp"
#include "report/result.hpp"
#include "shell/progress.hpp"

namespace sigmax::apps {

/// What settings are judged by, always less is better.
enum class Objective {
  prequential,  ///< minus the log_score of the measurements, in nats
  rmse,         ///< root mean square of the distance from the truth, in m
  density       ///< minus the logarithm of the density that the estimate gives the true position, in nats
};

/// The options of `himm_demo tune`.
struct TuneOptions {
  std::vector<std::string> files;
  RecordingOptions recording;  ///< of each of them
  RadarOptions radar;
  std::string truth;                             ///< how it judges, "rmse" or "density", or empty
  Objective objective = Objective::prequential;  ///< what that says
  std::vector<std::string> models;  ///< sets to choose from, as dwna+dwpa; empty: those of the filter, and each alone
  std::vector<std::string> fixed;   ///< what is not fitted
  std::size_t folds = 4;
  std::size_t starts = 2;
  std::uint64_t seed = 1;
  int threads = 0;
  FilterOptions filters;
  std::string out;      ///< a file for the settings, or empty
  std::string summary;  ///< a file for what was found, or empty
  OutputOptions page;   ///< its report and command

  bool fits(std::string_view what) const;
};

/// A row: the number of its track, and its own there.
struct RowPlace {
  std::size_t track, row;
  bool operator==(const RowPlace&) const = default;
};

/// A measured quantity: the kind of plot, and the place of a component or its number in the plot.
using QuantityKey = std::pair<AnyPlot::Sensor, int>;

/// One target of a recording; its positions are about one point, and the tags of its plots are their numbers.
struct TuneTrack {
  std::string file;
  std::vector<Row> rows;
};

/// Whose accuracy is to be fitted: what a sensor measured where the row does not say how well.
struct TuneSensor {
  std::size_t rows = 0;
  bool position = false;
  bool stated = false;  ///< whether rows tell how well they measured
  bool apart = false;   ///< whether its positions scatter otherwise along x than along y
  bool radar = false;
  bool bearing = false;  ///< alone
  bool velocity = false;
  bool range_rate = false;
  /// Of quantities that come in whole steps, as altitudes in 25 ft do: the standard deviation of the rounding.
  std::map<QuantityKey, double> rounding{};
  /// How wide its stray measurements scatter: six times what nine in ten changes of a quantity from the row of a track
  /// before, of any sensor, stay below, those that are none left out.
  std::map<QuantityKey, double> stray_width{};

  /// Whether any of these components ever changes.
  bool sees(int from, int to) const;

  /// The greatest rounding of quantities of a kind, from one to another; 0 if there is none, infinite if none changes.
  double rounding_of(AnyPlot::Sensor kind, int from, int to) const;
};

/// All recordings, read once.
struct TuneData {
  int axes = 3;
  bool has_truth = false;
  bool geodetic = false;            ///< whether positions were places
  bool crosses = false;             ///< whether bearings alone may start a track
  bool moves_alone = false;         ///< whether there were velocities alone
  std::vector<TuneTrack> tracks{};  ///< those long enough to be followed
  std::size_t too_short = 0;        ///< tracks that are not
  std::size_t measurements = 0;
  std::map<std::string, TuneSensor, std::less<>> sensors{};  ///< "" if the rows name none
  std::vector<std::string> notes{};                          ///< sentences on what does not count
  double step_s = 0.0;                                       ///< the median time between a track's measurements
  double long_step_s = 1.0;                                  ///< that nine in ten do not exceed
  double longest_step_s = 0.0;
  bool uneven_steps = false;  ///< whether one in ten is twice as long as another one in ten, or more

  /// The greatest of the sensors' stray widths of a quantity; 0 if it never changes.
  double stray_width(const QuantityKey& quantity) const;

  /// The density, as a logarithm, of a stray measurement of this kind: the same for all settings.
  double log_stray(const std::string& sensor, const AnyPlot& plot) const;

  /// The share of all rows with a loss that were predicted no better than stray ones are, see `losses`.
  double share_of_strays(const RowLosses& losses) const;

  RowFolds folds(std::size_t count) const;

  /// What the rows of a track are to a filter.
  std::vector<AnyPlot> plots(const TuneTrack& track, const FilterSettings& settings) const;
};

/// What this share of the numbers is below; they come into another order.
double quantile(std::vector<double>& numbers, double share);

/// Reads all files; a filter's settings say where sensors stand. Throws InputError, with file and line, for what
/// `track` refuses too, for files of different axes, and where there is too little to fit.
TuneData read_tune_data(const TuneOptions& options, const FilterSettings& settings);

/// What a filter loses at each row, see Objective; of the RMSE the squared distance. `look(track, now)`, if given, sees
/// what the filter knows after each row, the tag of `now`.
///
/// A share of all measurements may be stray ones, see robust_log_score, so that none of them can outweigh the others.
/// All settings are judged on the same rows, those after a track's first start: what is taken for another start was
/// predicted no better than a stray one. `set_aside`, if given, gets the rows that the gate turned away. Throws
/// std::domain_error where the filter fails.
using Look = std::function<void(std::size_t track, const TargetPoint& now)>;
RowLosses losses(const TuneData& data, const FilterSettings& settings, Objective objective, const Look& look = {},
                 std::vector<RowPlace>* set_aside = nullptr);

/// The choice as `losses` runs it.
TargetChoice judged_choice(const TuneData& data, const FilterSettings& settings);

/// Leaves out, as misses, the rows of positions and velocities that are stray ones more likely than not by what all
/// others, also those after them, say with these settings: what a filter cannot know where it predicts far ahead. None
/// where they would be more than one in ten.
std::vector<RowPlace> leave_out_strays(TuneData& data, const FilterSettings& settings);

/// The mean of the rows that count: nats a row, or of the RMSE its logarithm.
double objective_of(const RowLosses& losses, Objective objective, const RowCounts& counts = {});

/// The same as people read it: nats a row, or the RMSE in m.
double figure_of(double value, Objective objective);

/// A number that was fitted. A standard error that is infinite says that the rows do not tell the number.
struct FittedNumber {
  std::string name;
  double value = 0.0;
  double error = 0.0;
  bool at_rounding = false;  ///< whether it is as small as the rounding of its column allows
  bool sensor = false;       ///< whether it is a sensor's
};

/// Settings that were fitted to rows, at the end their noises by one factor more.
struct Fitted {
  FilterSettings settings{};
  double fitted = infinity;  ///< the objective over these rows
  std::vector<FittedNumber> numbers{};
  double widened = 1.0;  ///< that factor, of standard deviations
};

/// One way to set a filter, fitted to all rows, and judged.
struct Candidate : Fitted {
  std::string name;
  double held_out = 0.0;  ///< the objective over all rows, each with settings that have not seen its fold
  MeanDifference gain{};  ///< of the held-out loss of a row on that of the settings before
};

/// What tuning found for one filter.
struct TunedFilter {
  std::vector<Candidate> candidates;  ///< the settings before come first, with nothing fitted
  std::vector<std::size_t> numbers;   ///< so many were fitted of each
  std::vector<RowLosses> held_out;    ///< of each
  Selected selected;
  std::vector<RowPlace> strays{};  ///< rows that nothing was fitted to, nor judged by
  double by_unscented = 0.0;       ///< so much less all rows lose by the best settings with a UKF in place of an EKF

  const Candidate& before() const { return candidates.front(); }
  const Candidate& best() const { return candidates[selected.best]; }
  const Candidate& simple() const { return candidates[selected.simple]; }
};

/// Whether this build has an optimiser.
bool can_search();

/// The filter with each set of models that is to be tried; where steps vary and nobody asks for sets, its models of a
/// fixed step give way to those of continuous time, with sojourn times. Throws UsageError for a name that is no motion.
struct ModelSet {
  std::string name;
  FilterSettings settings;
};
std::vector<ModelSet> model_sets(const FilterSettings& settings, const TuneOptions& options, const TuneData& data);

/// So much work is a filter's tuning, in calls of `advance`.
std::size_t work_of(const FilterSettings& settings, const TuneData& data, const TuneOptions& options);

/// Fits every candidate to all rows and, for its held-out loss, to all but each fold. What `similar` found, if it is
/// given, is where the search begins. The result is that of the seed, on any number of threads.
TunedFilter tune(const FilterSettings& settings, const TuneData& data, const TuneOptions& options,
                 const TunedFilter* similar, Progress& progress);

}  // namespace sigmax::apps
