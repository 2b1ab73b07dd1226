#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "himm_demo/track_run.hpp"
#include "result/report.hpp"

namespace sigmax::apps {

/// What a run found, as text for people and as data, and what may be wrong.
struct TrackReport {
  std::string text;
  std::string description;          ///< the beginning of the text, up to the tables
  std::vector<ReportTable> tables;  ///< those of the text
  nlohmann::ordered_json summary;
  std::vector<std::string> warnings;
};

TrackReport report(const TrackOptions& options, const RecordingReader& recording,
                   const std::vector<FilterSettings>& filters, const TrackOutcome& outcome);

}  // namespace sigmax::apps
