#pragma once

#include <sigmax/estimation/radar.hpp>

#include "records/recording.hpp"
#include "shell/command_line.hpp"

namespace sigmax::apps {

class RandomStream;

/// The position that a plot tells, a radar's or of components; 0 along what those do not have, nothing if there is
/// none.
std::optional<Position> position_of(const AnyPlot& plot, int axes);

/// What a radar with these standard deviations measures.
Polar measured(Polar exact, const Polar& sigma, RandomStream& random);

/// A stream of random numbers for each track, whichever others a file holds.
RandomStream stream_of(std::uint64_t seed, std::string_view track);

/// A radar that is simulated, if it is, and where a radar stands.
struct RadarOptions {
  std::optional<std::array<double, 3>> sigma;  ///< standard deviations in m, degrees and degrees
  std::optional<Position> at;                  ///< in m; else at the origin

  Position place() const { return at.value_or(Position{}); }
};

/// Takes a position for the truth and sees it by a simulated radar, or misses what lacks an axis. Throws InputError
/// with file and line where it comes out behind the radar.
void see_by_radar(Row& row, const std::optional<Position>& position, int axes, const RadarOptions& radar,
                  RandomStream& random, const std::string& file);

/// The options that say what a recording's columns mean, and which of its rows count; and --radar and --radar-at. All
/// outlive the app.
void add_recording(Subcommand app, RecordingOptions& recording, RadarOptions& radar);

/// Throws UsageError where a radar cannot measure what a recording holds.
void refuse_radar(const RadarOptions& radar, const RecordingReader& recording);

}  // namespace sigmax::apps
