#pragma once

#include <sigmax/hybrid/cross_validation.hpp>

#include "himm_demo/filters/settings.hpp"
#include "recording/doubts.hpp"
#include "recording/plots.hpp"
#include "result/result.hpp"

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
  std::string config;
  std::vector<std::string> sets;
  bool print_config = false;
  std::string out;      ///< a file for the settings, or empty
  std::string summary;  ///< a file for what was found, or empty
  OutputOptions page;   ///< its report and command

  bool fits(std::string_view what) const;
};

/// One target of a recording; its positions are about one point, and the tags of its plots are their numbers.
struct TuneTrack {
  std::string file;
  std::vector<Row> rows;
};

/// Whose accuracy is to be fitted: what a sensor measured where the row does not say how well.
struct TuneSensor {
  std::size_t rows = 0;
  bool position = false;
  bool radar = false;
  bool bearing = false;  ///< alone
  bool velocity = false;
  bool range_rate = false;
};

/// All recordings, read once.
struct TuneData {
  int axes = 3;
  bool has_truth = false;
  bool geodetic = false;     ///< whether positions were places
  bool moves_alone = false;  ///< whether there were velocities alone
  Position radar_at{};
  std::vector<TuneTrack> tracks{};  ///< those long enough to be followed
  std::size_t too_short = 0;        ///< tracks that are not
  std::size_t measurements = 0;
  std::map<std::string, TuneSensor, std::less<>> sensors{};  ///< "" if the rows name none
  std::vector<std::string> notes{};                          ///< sentences on what does not count
  double volume = 1.0;                                       ///< of the box that holds all measurements, in m² or m³
  double radar_volume = 1.0;                                 ///< the same of a radar's, in its own space

  RowFolds folds(std::size_t count) const;

  /// What the rows of a track are to a filter.
  std::vector<AnyPlot> plots(const TuneTrack& track, const FilterSettings& settings) const;
};

/// Reads all files. Throws InputError, with file and line, for what `track` refuses too, for files of different axes,
/// and where there is too little to fit.
TuneData read_tune_data(const TuneOptions& options);

/// What a filter loses at each row, see Objective; of the RMSE the squared distance. `look(track, now)`, if given, sees
/// what the filter knows after each row, the tag of `now`.
///
/// With a gate a measurement may be a false one: the loss is that of g p(z) + (1 − g) / V, with g the probability of
/// the gate and V the volume of all measurements, so that nothing is gained by turning measurements away. The filter
/// never starts again after rejections, so that all settings are judged on the same rows. Throws std::domain_error
/// where the filter fails.
using Look = std::function<void(std::size_t track, const TargetPoint& now)>;
RowLosses losses(const TuneData& data, const FilterSettings& settings, Objective objective, const Look& look = {});

/// The choice as `losses` runs it.
TargetChoice judged_choice(const TuneData& data, const FilterSettings& settings);

/// The mean of the rows that count: nats a row, or of the RMSE its logarithm.
double objective_of(const RowLosses& losses, Objective objective, const RowCounts& counts = {});

/// The same as people read it: nats a row, or the RMSE in m.
double figure_of(double value, Objective objective);

/// One way to set a filter, judged.
struct Candidate {
  std::string name;
  FilterSettings settings{};  ///< fitted to all rows
  double fitted = 0.0;        ///< the objective over all rows, which those settings have seen
  double held_out = 0.0;      ///< the same over all rows, each with settings that have not seen its fold
  MeanDifference gain{};      ///< of the held-out loss of a row on that of the settings before
};

/// What tuning found for one filter.
struct TunedFilter {
  std::vector<Candidate> candidates;  ///< the settings before come first, with nothing fitted
  std::vector<std::size_t> numbers;   ///< so many were fitted of each
  std::vector<RowLosses> held_out;    ///< of each
  Selected selected;

  const Candidate& before() const { return candidates.front(); }
  const Candidate& best() const { return candidates[selected.best]; }
  const Candidate& simple() const { return candidates[selected.simple]; }
};

/// Whether this build has an optimiser.
bool can_search();

/// The filter with each set of models that is to be tried. Throws UsageError for a name that is no motion.
struct ModelSet {
  std::string name;
  FilterSettings settings;
};
std::vector<ModelSet> model_sets(const FilterSettings& settings, const TuneOptions& options);

/// So much work is a filter's tuning, in calls of `advance`.
std::size_t work_of(const FilterSettings& settings, const TuneData& data, const TuneOptions& options);

/// Fits every candidate to all rows and, for its held-out loss, to all but each fold. The result is that of the seed,
/// on any number of threads.
TunedFilter tune(const FilterSettings& settings, const TuneData& data, const TuneOptions& options,
                 const std::function<void(std::size_t work)>& advance);

}  // namespace sigmax::apps
