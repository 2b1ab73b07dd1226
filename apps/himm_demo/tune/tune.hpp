#pragma once

#ifdef SIGMAX_TUNING
#include <sigmax/estimation/consistency.hpp>
#include <sigmax/tuning/target.hpp>
#include <sigmax/tuning/tune.hpp>
#endif

#include "himm_demo/filters/settings.hpp"
#include "report/result.hpp"

namespace sigmax::apps {

/// The options of `himm_demo tune`.
struct TuneOptions {
  std::vector<std::string> files;
  RecordingOptions recording;  ///< of each of them
  RadarOptions radar;
  bool truth = false;               ///< whether it judges by the RMSE against the truth rather than by the log_score
  std::vector<std::string> models;  ///< sets to choose from, as dwna+dwpa; empty: those of the filter, and each alone
  std::vector<std::string> fixed;   ///< what is not fitted
  std::size_t folds = 4;
  std::size_t starts = 2;
  std::uint64_t seed = 1;
  int threads = 0;
  FilterOptions filters;
  std::string out;       ///< a file for the settings, or empty
  OutputOptions output;  ///< its summary, report and command

  bool fits(std::string_view what) const { return std::ranges::find(fixed, what) == fixed.end(); }
};

/// Tunes, prints and writes.
void run_tune(TuneOptions options);

#ifdef SIGMAX_TUNING

/// Whose accuracy is to be fitted: what a sensor measured where the row does not say how well.
struct TuneSensor {
  bool position = false;
  bool radar = false;
  bool bearing = false;  ///< alone
  bool velocity = false;
  bool range_rate = false;
  /// Of quantities that come in whole steps, as altitudes in 25 ft do: the standard deviation of the rounding, infinite
  /// where they never change.
  std::map<MeasuredQuantity, double> rounding{};

  /// The greatest of quantities of a kind, from one to another; 0 if there is none, infinite if none changes.
  double rounding_of(Sensor kind, int from, int to) const;
};

/// One target of a recording; its positions are about one point, and the tags of its detections are their numbers.
struct TuneTrack {
  std::string file;
  std::vector<Row> rows;
};

/// All recordings, read once.
struct TuneData {
  int axes = 3;
  bool has_truth = false;
  bool geodetic = false;             ///< whether positions were places
  bool crosses = false;              ///< whether bearings alone may start a track
  bool has_only_velocities = false;  ///< whether there were velocities alone
  std::vector<TuneTrack> tracks{};   ///< those long enough to be followed
  std::size_t too_short = 0;         ///< tracks that are not
  std::size_t measurements = 0;
  std::map<std::string, TuneSensor, std::less<>> sensors{};  ///< "" if the rows name none
  std::vector<std::string> notes{};                          ///< sentences on what does not count
  TrackScale scale{{}};
  RobustLoss robust{{}, scale};
  double most_strays = 0.05;  ///< the share of rows that settings may take for stray ones

  RowFolds folds(std::size_t count) const;
};

/// Reads all files; a filter's settings say where sensors stand. Throws InputError, with file and line, for what
/// `track` refuses too, for files of different axes, and where there is too little to fit.
TuneData read_tune_data(const TuneOptions& options, const FilterSettings& settings);

/// What a filter loses at each row, in nats; by the truth the squared distance from it. `look(track, now)`, if given,
/// sees what the filter knows after each row, the tag of `now`; each fourth row from one on may be withheld. Throws
/// std::domain_error where the filter fails.
inline constexpr std::size_t no_row = std::numeric_limits<std::size_t>::max();
using Look = std::function<void(std::size_t track, const TargetPoint& now)>;
RowLosses losses(const TuneData& data, const FilterSettings& settings, bool by_truth, const Look& look = {},
                 std::size_t withhold = no_row);

/// The number in the middle; they come into another order.
double median(std::vector<double>& numbers);

/// What is made least: nats a row, or of the RMSE its logarithm.
double objective_of(const TuneData& data, const RowLosses& losses, bool by_truth, const RowCounts& counts = {});

/// A number that was fitted. A standard error that is infinite says that it is not identifiable.
struct FittedNumber {
  std::string name;
  double value = 0.0;
  double error = 0.0;
  bool at_rounding = false;  ///< whether it is as small as the rounding of its column allows
};

/// One way to set a filter.
struct Candidate {
  std::string name;
  FilterSettings settings;  ///< as `track` reads them from what is written
  std::size_t fitted_numbers = 0;
  RowLosses losses;       ///< of all rows by these settings
  RowLosses held_out;     ///< each row's by numbers that have not seen its fold
  MeanDifference gain{};  ///< of the held-out loss of a row on that of the settings before
  std::vector<FittedNumber> numbers{};
};

/// What tuning found for one filter.
struct TunedFilter {
  std::vector<Candidate> candidates;  ///< the settings before come first, with nothing fitted
  Selected selected{};

  const Candidate& before() const { return candidates.front(); }
  const Candidate& best() const { return candidates[selected.best]; }
  const Candidate& simple() const { return candidates[selected.simple]; }
};

/// The filter with each set of models that is to be tried; where steps vary and nobody asks for sets, its models of a
/// fixed step give way to those of continuous time, with sojourn times. Throws UsageError for a name that is no motion.
std::vector<std::pair<std::string, FilterSettings>> model_sets(const FilterSettings& settings,
                                                               const TuneOptions& options, const TuneData* data);

/// Fits every candidate to all rows and, for its held-out loss, to all but each fold. None is better than the settings
/// before unless it is so held out, as written and read again over all rows, and in each fold at rows that are
/// withheld, in the median. It takes as many rows for stray ones as those before do.
TunedFilter tune(const FilterSettings& settings, TuneData& data, const TuneOptions& options);

/// What one filter's innovations say of its settings.
struct Diagnosis {
  struct Part {
    std::string name;
    InnovationTally innovations{};
    double weight = 0.0;  ///< mean, of a mode
  };
  std::vector<Part> sensors;
  std::vector<Part> modes;       ///< rows of which the mode is the most likely
  std::optional<double> rmse_m;  ///< where the truth is known
};

/// Throws InputError where the filter fails or makes no estimate.
Diagnosis diagnose(const TuneData& data, const FilterSettings& settings, bool by_truth);

/// What is wrong with a sensor, in words.
std::string_view verdict_of(const InnovationTally& sensor);

#endif

}  // namespace sigmax::apps
