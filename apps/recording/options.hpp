#pragma once

#include <array>
#include <optional>

#include "recording/recording.hpp"

namespace CLI {
class App;
}

namespace sigmax::apps {

/// A radar that is simulated, if it is, and where a radar stands.
struct RadarOptions {
  std::optional<std::array<double, 3>> sigma;  ///< standard deviations in m, degrees and degrees
  std::optional<Position> at;                  ///< in m; else at the origin

  Position place() const { return at.value_or(Position{}); }
};

/// The options that say what a recording's columns mean, and which of its rows count; and --radar and --radar-at. All
/// outlive the app.
void add_recording(CLI::App& app, RecordingOptions& recording, RadarOptions& radar);

/// Throws UsageError where a radar cannot measure what a recording holds.
void refuse_radar(const RadarOptions& radar, const RecordingReader& recording);

}  // namespace sigmax::apps
