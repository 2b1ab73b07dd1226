#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sigmax::apps {

/// The options of `himm_demo track`.
struct TrackOptions {
  std::string file;
  std::vector<std::string> columns;             ///< NAME=HEADER
  std::optional<std::array<double, 3>> origin;  ///< latitude and longitude in degrees, altitude in m
  std::optional<std::array<double, 3>> radar;   ///< standard deviations: m, degrees, degrees
  std::array<double, 3> radar_at = {0.0, 0.0, 0.0};
  std::uint64_t seed = 1;
  std::string config;
  std::vector<std::string> sets;
  std::string out;
  bool quiet = false;
  bool print_config = false;
  std::string command;
};

/// Tracks one recording through every filter, and reports.
void track_and_report(const TrackOptions& options);

}  // namespace sigmax::apps
