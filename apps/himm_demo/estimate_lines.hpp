#pragma once

#include <optional>
#include <string>
#include <vector>

#include "himm_demo/filter_settings.hpp"
#include "himm_demo/recording.hpp"
#include "himm_demo/tracker.hpp"

namespace sigmax::apps {

/// Tells a point in `frame` from `anchor`: its position about that, and all else along east, north and up at the point.
/// Returns where it is.
template <int Axes>
Geodetic tell_from(const LocalFrame<Axes>& anchor, const LocalFrame<Axes>& frame, TrackPoint<Axes>& point);

/// The lines of estimates.csv: a header, and one for each filter and step.
class EstimateLines {
 public:
  EstimateLines(const std::vector<FilterSettings>& filters, const RecordingReader& recording, bool iso_times);

  std::string header() const;

  /// `place` is where a geodetic target is.
  template <int Axes>
  std::string line(const std::string& track, const FilterSettings& settings, const TrackPoint<Axes>& point,
                   const std::optional<Geodetic>& place) const;

 private:
  bool has_tracks_;
  bool geodetic_;
  bool iso_times_;
  std::vector<std::string> models_;
  bool turns_ = false;
};

}  // namespace sigmax::apps
