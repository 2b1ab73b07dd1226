#pragma once

#include <CLI/App.hpp>
#include <array>
#include <optional>

#include "himm_demo/recording.hpp"

namespace sigmax::apps {

/// The options that say what a recording's columns mean, and which of its rows count. `recording` outlives the app.
void add_recording(CLI::App& app, RecordingOptions& recording);

/// --radar and --radar-at.
void add_simulated_radar(CLI::App& app, std::optional<std::array<double, 3>>& radar,
                         std::optional<std::array<double, 3>>& radar_at);

}  // namespace sigmax::apps
