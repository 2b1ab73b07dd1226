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
                const RecordingReader& recording, bool iso_times);

  template <int Axes>
  void add(const std::string& track, const FilterSettings& settings, const TrackPoint<Axes>& point);

  /// The same of a point in a frame: positions are written about `anchor`, and all else along east, north and up at the
  /// point.
  template <int Axes>
  void add(const std::string& track, const FilterSettings& settings, TrackPoint<Axes> point,
           const LocalFrame<Axes>& anchor, const LocalFrame<Axes>& frame);

  AtomicFile& file() { return file_; }

 private:
  template <int Axes>
  void write(const std::string& track, const FilterSettings& settings, const TrackPoint<Axes>& point,
             const std::optional<Geodetic>& place);
  void cell(std::optional<double> value);

  AtomicFile file_;
  const RecordingReader& recording_;
  bool iso_times_;
  std::vector<std::string> models_;
  bool turns_ = false;
};

}  // namespace sigmax::apps
