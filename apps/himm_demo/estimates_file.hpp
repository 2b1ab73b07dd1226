#pragma once

#include <optional>
#include <string>
#include <vector>

#include "himm_demo/filter_settings.hpp"
#include "himm_demo/recording.hpp"
#include "himm_demo/tracker.hpp"
#include "support/output.hpp"

namespace sigmax::apps {

/// Tells a point in `frame` from `anchor`: its position about that, and all else along east, north and up at the point.
/// Returns where it is.
template <int Axes>
Geodetic tell_from(const LocalFrame<Axes>& anchor, const LocalFrame<Axes>& frame, TrackPoint<Axes>& point);

/// Writes estimates.csv: a row for each filter and step.
class EstimatesFile {
 public:
  EstimatesFile(AtomicFile& file, const std::vector<FilterSettings>& filters, const RecordingReader& recording,
                bool iso_times);

  /// `place` is where a geodetic target is.
  template <int Axes>
  void add(const std::string& track, const FilterSettings& settings, const TrackPoint<Axes>& point,
           const std::optional<Geodetic>& place);

 private:
  void cell(std::optional<double> value);

  AtomicFile& file_;
  const RecordingReader& recording_;
  bool iso_times_;
  std::vector<std::string> models_;
  bool turns_ = false;
};

}  // namespace sigmax::apps
