#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sigmax/estimation/metrics.hpp>

#include "himm_demo/nis_tally.hpp"
#include "himm_demo/track.hpp"
#include "himm_demo/track_warnings.hpp"

namespace sigmax::apps {

class AtomicFile;
class EstimateLines;
class TrackPage;
class TrackShares;

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
  NisTally nis;
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
  const EstimateLines* lines = nullptr;  ///< of estimates.csv
  AtomicFile* estimates = nullptr;       ///< where they go, in the first rank
  TrackPage* page = nullptr;
};

/// Runs all filters over a recording, or over the tracks of this rank: then the outcome is the first rank's, and
/// without meaning in others. Throws InputError with file and line.
TrackOutcome run_track(const TrackOptions& options, RecordingReader& recording,
                       const std::vector<FilterSettings>& filters, TrackSinks sinks, TrackShares& shares);

}  // namespace sigmax::apps
