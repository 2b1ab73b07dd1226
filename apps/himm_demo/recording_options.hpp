#pragma once

#include <CLI/App.hpp>
#include <array>
#include <optional>
#include <vector>

#include "himm_demo/filter_settings.hpp"
#include "himm_demo/recording.hpp"

namespace sigmax::apps {

/// The options that say what a recording's columns mean, and which of its rows count. `recording` outlives the app.
void add_recording(CLI::App& app, RecordingOptions& recording);

/// --radar and --radar-at.
void add_simulated_radar(CLI::App& app, std::optional<std::array<double, 3>>& radar,
                         std::optional<std::array<double, 3>>& radar_at);

/// The filters that the settings name for a recording: a radar is as accurate as the simulated one, if there is one.
/// Throws InputError for what cannot be, and for keys that nobody knows.
std::vector<FilterSettings> filters_for_recording(const Settings& settings,
                                                  const std::optional<std::array<double, 3>>& radar);

/// Takes velocities and range rates for measurements where a filter knows their accuracy.
void take_what_filters_know(const std::vector<FilterSettings>& filters, RecordingOptions& recording);

}  // namespace sigmax::apps
