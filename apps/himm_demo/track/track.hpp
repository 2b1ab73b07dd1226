#pragma once

#include <set>

#include <sigmax/earth/earth_target.hpp>
#include <sigmax/estimation/consistency.hpp>
#include <sigmax/estimation/root_mean_square.hpp>
#include <sigmax/hybrid/any_target.hpp>

#include "himm_demo/filters/settings.hpp"
#include "records/recording.hpp"
#include "report/result.hpp"

namespace sigmax::apps {

/// Rows that are judged together: all, or by the aircraft's bank where the recording tells it.
struct Part {
  std::string_view name;
  bool (*holds)(std::optional<double> roll_deg);
};
inline constexpr std::array<Part, 3> row_parts = {{
    {"all", [](std::optional<double>) { return true; }},
    {"|roll| > 15°", [](std::optional<double> roll) { return roll && std::abs(*roll) > 15.0; }},
    {"|roll| < 3°", [](std::optional<double> roll) { return roll && std::abs(*roll) < 3.0; }},
}};

/// What is added up over the rows of one part.
struct Sums {
  std::array<RootMeanSquare, 3> error;
  std::array<RootMeanSquare, 3> sigma;  ///< as the filter states it
  std::vector<double> weights;
  InnovationTally innovations;

  std::size_t count() const { return sigma[0].count(); }  ///< of the filter's estimates
};
using SumsByPart = std::array<Sums, row_parts.size()>;

template <class Add>
void add_by_part(SumsByPart& sums, std::optional<double> roll, const Add& add) {
  for (std::size_t p = 0; p < row_parts.size(); ++p)
    if (row_parts[p].holds(roll)) add(sums[p]);
}

/// What one filter made of the recording.
struct FilterOutcome {
  SumsByPart sums;
  std::map<std::string, InnovationTally> sensors{};        ///< the innovations of each
  std::size_t rejected = 0;                                ///< by the gate
  std::size_t restarts = 0;                                ///< after a gap
  std::map<std::string, std::vector<ModeStay>> histories;  ///< of each track, if the filter is to explain

  /// An estimate of a row, whose measurement had so many quantities; and its innovation, with that of its sensor
  /// before.
  void add(const Row& row, const TargetPoint& point, std::size_t size, int axes);
  void add_innovation(const std::string& sensor, const TargetPoint& point, std::size_t size,
                      std::vector<double>& before);
};

/// What the list of tracks says of one of them.
struct TrackTally {
  struct Nis {
    double sum = 0.0;  ///< of so many measured quantities
    std::size_t quantities = 0;
    std::size_t rejected = 0;  ///< by the gate
  };
  std::size_t rows = 0, measurements = 0;
  double first_time = nan, last_time = nan;
  double way_m = 0.0;                ///< from estimate to estimate of the first filter
  std::vector<Nis> nis{};            ///< of each filter
  std::size_t estimates = 0;         ///< of all filters
  std::optional<Position> before{};  ///< the last estimate

  void goes_to(const std::vector<double>& mean, int axes);
  std::string reason_without_estimates() const;
};

/// Measurements that every filter's gate turned away, and the least expected of them: how far off it is.
struct Refused : Counted {
  std::size_t worst_line = 0;
  double log_evidence = infinity, metres = 0.0;
};

/// What all filters made of all targets of one recording.
struct TrackOutcome {
  std::vector<FilterOutcome> filters;
  SumsByPart raw;  ///< of the measurements, where the truth is known
  std::size_t rows = 0, measurements = 0;
  std::size_t partial = 0;  ///< of these with a position along some axes only
  std::size_t bearings = 0;
  std::set<std::string> by_default;            ///< keys, with their value, of accuracies that nobody gave
  std::vector<std::string> places;             ///< sentences on where the sensors stand
  bool some_unplaced = false;                  ///< whether some stand where all others do
  std::map<std::string, TrackTally> each;      ///< of the tracks
  std::vector<std::string> never_started;      ///< tracks that are too short for a filter
  std::map<std::string, std::size_t> sensors;  ///< the rows of each
  std::map<std::string, std::map<std::string, std::size_t>>
      unused;                      ///< those with a number that no filter takes, and why
  std::size_t predicted = 0;       ///< tracks, up to the time that was asked for
  std::size_t unpredicted = 0;     ///< the part of them whose filter restarts before that time
  std::optional<Geodetic> origin;  ///< from where positions are counted, if that is one place for all tracks
  Refused refused_by_all;
  std::size_t outliers = 0;  ///< measurements whose NIS is above `outlier_nis` for every filter
  Counted unsuited;          ///< a radar's measurements for which the standard conversion does not hold

  /// What a row of the recording holds, before a simulated radar sees it.
  void count(const Row& row, const RecordingReader& recording, const std::vector<FilterSettings>& own);
  /// Whether a filter's standard conversion of a radar's measurement to a position is biased.
  void judge_conversion(const Row& row, int axes, const std::vector<FilterSettings>& own);
  /// Says why no filter started. Throws InputError.
  [[noreturn]] void refuse_nothing(const RecordingReader& recording, const RecordingOptions& options,
                                   bool several_places) const;
};

/// Beyond the 0.999998 quantile of χ² with three degrees of freedom.
inline constexpr double outlier_nis = 30.0;

/// The standard conversion holds while r σ_α² / σ_r is below this (Bar-Shalom, Li, Kirubarajan 2001, 10.4).
inline constexpr double most_conversion_bias = 0.4;

class TrackPage;

/// The options of `himm_demo track`.
struct TrackOptions {
  RecordingOptions recording;
  RadarOptions radar;
  std::uint64_t seed = 1;
  FilterOptions filters;
  std::string predict_to_text;          ///< as it was given
  std::optional<double> predict_to;     ///< a time, up to which targets that ended before are predicted
  bool predict_to_time_of_day = false;  ///< whether that is one, so of the last day
  OutputOptions output;
};

/// Where a run puts what it finds row by row; null where nobody wants it.
struct TrackSinks {
  ResultFiles* files = nullptr;  ///< for estimates.csv
  TrackPage* page = nullptr;
  std::function<void(const Row&, const LocalFrame*)> rows{};  ///< before a simulated radar sees them
};

/// Runs all filters over a recording. Throws InputError with file and line.
TrackOutcome run_track(const TrackOptions& options, RecordingReader& recording,
                       const std::vector<FilterSettings>& filters, TrackSinks sinks);

/// The gate that is proposed where there are outliers.
inline constexpr double outlier_gate = 0.9999;

/// What that makes of outliers; nothing where there are none, or where a recording comes only once.
std::optional<TrackOutcome> with_gate(TrackOptions options, const RecordingOptions& what,
                                      std::vector<FilterSettings> filters, const TrackOutcome& outcome);

/// Whether the filters are consistent with the measurements, or what is wrong, with its number and the one thing to do.
/// `gated` is the outcome with that gate, if it was tried.
std::string verdict_of(const TrackOptions& options, const RecordingReader& recording,
                       const std::vector<FilterSettings>& filters, const TrackOutcome& outcome,
                       const TrackOutcome* gated);

/// estimates.csv: a row for each filter and step; or tracks.csv, of tracks that were associated, with their existence.
class EstimatesFile {
 public:
  /// Without files it keeps nothing.
  EstimatesFile(ResultFiles* files, const std::vector<FilterSettings>& filters, const RecordingReader& recording,
                bool associated = false);

  explicit operator bool() const { return file_ && *file_; }
  void write(const std::string& track, const FilterSettings& filter, const EarthPoint& point, double existence = nan) {
    track_ = track;
    existence_ = existence;
    if (*this) file_->write(each(cells_, [&](const auto& cell) { return cell(point, filter); }));
  }

 private:
  std::vector<std::function<Cell(const EarthPoint&, const FilterSettings&)>> cells_;
  std::string track_;
  double existence_ = nan;
  std::optional<RowFile> file_;
};

}  // namespace sigmax::apps
