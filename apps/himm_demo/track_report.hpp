#pragma once

#include <string>
#include <vector>

#include "himm_demo/track_run.hpp"

namespace sigmax::apps {

/// What a run found, as text for people and as data, and what may be wrong.
struct TrackReport {
  std::string text;
  std::string summary;  ///< JSON
  std::vector<std::string> warnings;
};

TrackReport report(const TrackOptions& options, const RecordingReader& recording,
                   const std::vector<FilterSettings>& filters, const TrackOutcome& outcome);

}  // namespace sigmax::apps
