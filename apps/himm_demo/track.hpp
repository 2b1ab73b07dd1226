#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "himm_demo/recording.hpp"
#include "result/output_options.hpp"
#include "support/command_line.hpp"

namespace sigmax::apps {

/// The options of `himm_demo track`.
struct TrackOptions {
  RecordingOptions recording;
  std::optional<std::array<double, 3>> radar;     ///< a simulated one's standard deviations: m, degrees, degrees
  std::optional<std::array<double, 3>> radar_at;  ///< where a radar stands, simulated or not, in m
  std::uint64_t seed = 1;
  std::string config;
  std::vector<std::string> sets;
  bool print_config = false;
  std::optional<double> predict_to;     ///< a time, up to which targets that ended before are predicted
  bool predict_to_time_of_day = false;  ///< whether that is one, so of the last day
  bool iso_times = false;               ///< a column with dates and times beside the seconds
  OutputOptions output;
};

/// `himm_demo track`: each target of a recording through every filter.
void add_track(CLI::App& program, const std::string& command);

}  // namespace sigmax::apps
