#pragma once

#include <deque>

#include <sigmax/estimation/consistency.hpp>
#include <sigmax/estimation/root_mean_square.hpp>

#include "himm_demo/track/page.hpp"

namespace sigmax::apps {

/// The options of `himm_demo track`.
struct TrackOptions {
  RecordingOptions recording;
  RadarOptions radar;
  std::uint64_t seed = 1;
  FilterOptions filters;
  std::string predict_to_text;          ///< as it was given
  std::optional<double> predict_to;     ///< a time, up to which targets that ended before are predicted
  bool predict_to_time_of_day = false;  ///< whether that is one, so of the last day
  bool iso_times = false;               ///< a column with dates and times beside the seconds
  OutputOptions output;
};

/// Rows that are judged together: all, or by the aircraft's bank where the recording tells it.
struct Part {
  std::string_view name;
  bool (*holds)(std::optional<double> roll_deg);
};
inline constexpr std::array<Part, 3> parts = {{
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
  RunningMean predicted_share;  ///< of the variance of positions' innovations; the rest is the sensor's

  std::size_t count() const { return sigma[0].count(); }  ///< of the filter's estimates
};
using SumsByPart = std::array<Sums, parts.size()>;

/// Whether innovations lean to one side, by means of some that follow each other.
class Lean {
 public:
  void add(double innovation);
  /// How far on the average, in standard deviations; 0 where that is little, or chance.
  double mean() const;

 private:
  RunningMean some_, means_;
};

/// What one filter made of the recording.
struct FilterOutcome {
  SumsByPart sums;
  InnovationTally with_velocity{};       ///< of positions, in rows with a velocity
  InnovationTally without_velocity{};    ///< and in others
  RunningMean nis_first{}, nis_again{};  ///< a quantity, of rows later than, or as late as, the one before
  std::map<std::string, std::array<Lean, 8>> leans{};  ///< of each sensor's quantities, and along and across the way
  std::size_t rejected = 0;                            ///< by the gate
  std::size_t restarts = 0;                            ///< after a gap
  Counted given_up;                                    ///< tracks, after rejections in a row
  Counted lost;                                        ///< measurements that it does not expect so, but another one
  Counted lost_by_far;                                 ///< those of them at which it is elsewhere
  std::map<std::string, std::vector<ModeStay>> histories;  ///< of each track, if the filter is to explain
};

/// Measurements out of the validity of their standard conversion, r σ_α² / σ_r < 0.4, of all of a radar's.
struct Validity {
  static constexpr double limit = 0.4;
  std::size_t outside = 0, measurements = 0, first_line = 0;
  double first_value = 0.0, first_range = 0.0, sigma_range_needed = 0.0;
};

/// Measurements that no filter expects: an NIS above 30 is beyond the 0.999998 quantile of χ² with three degrees of
/// freedom.
struct Outliers {
  static constexpr double limit = 30.0, by_far = 300.0;
  std::size_t count = 0, worst_line = 0;
  double worst_nis = 0.0;
};

/// Tracks of which a filter's gate turned many measurements away: a fifth, and at least five; and the worst of them.
struct Refusals {
  std::size_t many = 0;  ///< filters on tracks
  std::string track;
  const FilterSettings* filter = nullptr;
  std::size_t rejected = 0, measurements = 1;
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
  std::string why_silent() const;
};

/// What all filters made of all targets of one recording.
struct TrackOutcome {
  std::vector<FilterOutcome> filters;
  SumsByPart raw;          ///< of the measurements, where the truth is known
  double last_time = nan;  ///< of any row
  std::size_t rows = 0, measurements = 0;
  std::size_t partial = 0;  ///< of these with a position along some axes only
  std::size_t bearings = 0;
  std::array<std::size_t, 3> by_default{};     ///< with a position, a range, an azimuth whose sigma nobody gave
  std::vector<std::string> places;             ///< sentences on where the sensors stand
  bool some_unplaced = false;                  ///< whether some stand where all others do
  std::map<std::string, TrackTally> each;      ///< of a recording of tracks
  std::vector<std::string> never_started;      ///< tracks that are too short for a filter
  std::map<std::string, std::size_t> sensors;  ///< the rows of each
  std::map<std::string, std::size_t> velocity_unknown;    ///< those of them with one that no filter knows how to take
  std::map<std::string, std::size_t> range_rate_unknown;  ///< the same of range rates
  Counted refused_by_all;                                 ///< measurements that every filter's gate turned away
  std::size_t predicted = 0;                              ///< tracks, up to the time that was asked for
  std::size_t unpredicted = 0;                            ///< those of them of which a filter begins anew before
  std::optional<Geodetic> origin;  ///< from where positions are counted, if that is one place for all tracks
  Validity validity;
  Outliers outliers;
  Refusals refusals;
};

/// What may be wrong with the recording, or with the settings for it, in sentences: findings of its checks come first.
std::vector<std::string> warnings_of(const TrackOptions& options, const RecordingReader& recording,
                                     const std::vector<FilterSettings>& filters, const TrackOutcome& outcome,
                                     std::vector<std::string> findings);

/// Where a run puts what it finds row by row; null where nobody wants it.
struct TrackSinks {
  ResultFiles* files = nullptr;  ///< for estimates.csv
  TrackPage* page = nullptr;
  std::function<void(const Row&, const LocalFrame*)> rows{};  ///< before a simulated radar sees them
};

/// Runs all filters over a recording. Throws InputError with file and line.
TrackOutcome run_track(const TrackOptions& options, RecordingReader& recording,
                       const std::vector<FilterSettings>& filters, TrackSinks sinks);

}  // namespace sigmax::apps
