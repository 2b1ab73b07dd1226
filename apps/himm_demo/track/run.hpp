#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sigmax/estimation/consistency.hpp>
#include <sigmax/estimation/root_mean_square.hpp>

#include "himm_demo/filters/settings.hpp"
#include "recording/plots.hpp"
#include "result/result.hpp"

namespace sigmax::apps {

class AtomicFile;
class TrackPage;
class TrackShares;

/// The options of `himm_demo track`.
struct TrackOptions {
  RecordingOptions recording;
  RadarOptions radar;
  std::uint64_t seed = 1;
  std::string config;
  std::vector<std::string> sets;
  bool print_config = false;
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
  /// The variance of positions' innovations, and what of it is the prediction's: the rest is the sensor's.
  double innovation_variance = 0.0, predicted_variance = 0.0;
  std::size_t count = 0;
};
using SumsByPart = std::array<Sums, parts.size()>;

/// What one filter made of the recording.
struct FilterOutcome {
  SumsByPart sums;
  std::size_t rejected = 0;                                ///< by the gate
  std::size_t restarts = 0;                                ///< after a gap
  std::map<std::string, std::vector<ModeStay>> histories;  ///< of each track, if the filter is to explain
};

/// Measurements out of the validity of their standard conversion, r σ_α² / σ_r < 0.4, of all of a radar's.
struct Validity {
  static constexpr double limit = 0.4;
  std::size_t outside = 0;
  std::size_t measurements = 0;
  std::size_t first_line = 0;
  double first_value = 0.0;
  double first_range = 0.0;
  double sigma_range_needed = 0.0;
};

/// Measurements that no filter expects: an NIS above 30 is beyond the 0.999998 quantile of χ² with three degrees of
/// freedom.
struct Outliers {
  static constexpr double limit = 30.0;
  std::size_t count = 0;
  std::size_t worst_line = 0;
  double worst_nis = 0.0;
};

/// Tracks of which a filter's gate turned many measurements away: a fifth, and at least five; and the worst of them.
struct Refusals {
  std::size_t many = 0;  ///< filters on tracks
  std::string track;
  const FilterSettings* filter = nullptr;
  std::size_t rejected = 0;
  std::size_t measurements = 1;
};

/// What all filters made of all targets of one recording.
struct TrackOutcome {
  std::vector<FilterOutcome> filters;
  SumsByPart raw;  ///< of the measurements, where the truth is known
  std::size_t rows = 0;
  std::size_t measurements = 0;
  std::size_t partial = 0;  ///< of these with a position along some axes only
  std::size_t bearings = 0;
  std::size_t tracks = 0;
  std::vector<std::string> never_started;                 ///< tracks that are too short for a filter
  std::map<std::string, std::size_t> sensors;             ///< the rows of each
  std::map<std::string, std::size_t> velocity_unknown;    ///< those of them with one that no filter knows how to take
  std::map<std::string, std::size_t> range_rate_unknown;  ///< the same of range rates
  std::size_t refused_by_all = 0;                         ///< measurements that every filter's gate turned away
  std::size_t first_refused_line = 0;                     ///< of the first of them
  std::size_t predicted = 0;                              ///< tracks, up to the time that was asked for
  std::optional<Geodetic> origin;  ///< from where positions are counted, if that is one place for all tracks
  Validity validity;
  Outliers outliers;
  Refusals refusals;
};

/// Where a run puts what it finds row by row; null where nobody wants it.
struct TrackSinks {
  AtomicFile* estimates = nullptr;  ///< estimates.csv
  TrackPage* page = nullptr;
};

/// Runs all filters over a recording, or over the tracks of this rank: then the outcome is the first rank's, and
/// without meaning in others. Throws InputError with file and line.
TrackOutcome run_track(const TrackOptions& options, RecordingReader& recording,
                       const std::vector<FilterSettings>& filters, TrackSinks sinks, TrackShares& shares);

}  // namespace sigmax::apps
