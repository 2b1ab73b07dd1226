#pragma once

#include <optional>
#include <string>
#include <vector>

#include "himm_demo/filter_settings.hpp"
#include "himm_demo/recording.hpp"
#include "himm_demo/tracker.hpp"
#include "support/output.hpp"

namespace sigmax::apps {

/// Writes estimates.csv: a row for each filter and step.
class EstimatesFile {
 public:
  EstimatesFile(const OutputDirectory& directory, const std::vector<FilterSettings>& filters,
                const RecordingReader& recording);

  template <int Axes>
  void add(const std::string& track, const FilterSettings& settings, const TrackPoint<Axes>& point);

  AtomicFile& file() { return file_; }

 private:
  void cell(std::optional<double> value);

  AtomicFile file_;
  const RecordingReader& recording_;
  std::vector<std::string> models_;
  bool turns_ = false;
};

}  // namespace sigmax::apps
