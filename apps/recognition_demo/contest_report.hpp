#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "recognition_demo/contest.hpp"
#include "support/output.hpp"

namespace sigmax::apps {

using Json = nlohmann::ordered_json;

/// Some of 1 … reports to show: 1, 2, 5, 10, 20, … and the last.
std::vector<std::size_t> shown_reports(std::size_t reports);

/// Prints the accuracy after some numbers of reports, the belief in the truth, and each difference from the first.
void print_scores(const std::vector<Score>& scores, const std::string& what_is_counted = "reports");

/// curves.csv, not yet committed: report,classifier,accuracy.
AtomicFile curves_file(const std::vector<Score>& scores, const OutputDirectory& directory);

/// All figures that `print_scores` prints.
Json as_json(const std::vector<Score>& scores);
Json as_json(const Interval& interval);

/// What every summary begins with.
Json summary_of(const std::string& command);

/// summary.json, not yet committed.
AtomicFile summary_file(const Json& summary, const OutputDirectory& directory);

/// "Wrote a.csv and summary.json to DIR", after an empty line.
void print_written(const std::vector<std::string>& files, const std::string& directory);

}  // namespace sigmax::apps
