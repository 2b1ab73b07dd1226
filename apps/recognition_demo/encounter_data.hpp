#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <sigmax/recognition/counts.hpp>
#include <sigmax/recognition/discretization.hpp>

#include "recognition_demo/contest.hpp"

namespace sigmax::apps {

/// How often aircraft of each class were seen in each bin of four features: altitude above ground (ft), airspeed (kt),
/// vertical rate (ft/min) and turn rate (°/s).
struct EncounterData {
  Counts counts;
  std::vector<Discretization> bins;  ///< of each feature
  double lowest_ft;                  ///< where the first layer of altitude begins
};

/// Reads class,feature,bin,lower,upper,count; other features are ignored. Throws InputError with file, line, column and
/// value where bins leave a gap, and for a class or a feature without counts.
EncounterData read_encounter(const std::string& file);

/// One report of a recording.
struct TrackReport {
  double time_s;
  Readings readings;
};

struct TrackReports {
  std::vector<TrackReport> reports;
  std::size_t rows = 0;           ///< of the recording
  std::size_t on_the_ground = 0;  ///< rows below the first layer of altitude
  double ground_ft = 0.0;
};

/// Reads a recording and reports every so many seconds while it flies; the turn rate is that between the row and the
/// one before, if that is at most 15 s earlier. Throws InputError with file, line, column and value.
TrackReports read_track(const std::string& file, const EncounterData& data, double every_s,
                        std::optional<double> ground_ft);

}  // namespace sigmax::apps
