#pragma once

#include <string>
#include <vector>

#include "himm_demo/track/run.hpp"
#include "result/result.hpp"

namespace sigmax::apps {

/// Puts what a run found into a result: in words, as facts and as tables. Returns what may be wrong.
std::vector<std::string> report(const TrackOptions& options, const RecordingReader& recording,
                                const std::vector<FilterSettings>& filters, const TrackOutcome& outcome,
                                Result& result);

}  // namespace sigmax::apps
