#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "himm_demo/filter_settings.hpp"
#include "himm_demo/recording.hpp"
#include "himm_demo/said.hpp"
#include "result/report.hpp"
#include "support/thinned.hpp"

namespace sigmax::apps {

/// Collects what the page of a recording shows, in memory that does not grow with its rows: some tracks, thinned.
class TrackPage {
 public:
  TrackPage(const std::vector<FilterSettings>& filters, const RecordingReader& recording, bool truth_known);

  /// What a row measured, as a position where the others are counted from, and where the target was.
  void measured(const Fix& fix, const std::optional<Vector<3>>& position, const std::optional<Geodetic>& anchor);

  /// What a filter said of the row, in the same coordinates.
  void estimated(const Fix& fix, const Said& said);

  /// That a filter's gate turned the row's measurement away, or that a filter started once more.
  void rejected(const Fix& fix, std::size_t filter);
  void restarted(const Fix& fix, std::size_t filter);

  /// The best history of a track's modes, once all rows were read.
  void explained(const std::string& track, std::size_t filter, const std::vector<ModeStay>& stays);

  /// Of the first track: the first axis' errors, or standard deviations, and the weights.
  std::vector<LineChart> charts_of_the_first() const;

  /// The tracks as views of a page, with the groups and the words that go with them.
  void add_to(Report& page) const;

 private:
  struct Mark {
    double time;
    std::size_t filter;
    Vector<3> position;
  };
  struct Track {
    Track(std::size_t filters, std::size_t columns, std::size_t most);
    double first_time = 0.0;
    std::optional<Geodetic> anchor;
    std::optional<Vector<3>> last_position;  // measured
    Thinned plots;                           // x, y, z and their errors
    std::vector<Thinned> estimates;
    std::vector<Mark> rejections;
    std::vector<Mark> restarts;
    std::vector<std::vector<ModeStay>> histories;  // of each filter
  };

  Track* track_of(const Fix& fix);
  const Track* find(const Fix& fix) const;
  std::size_t room() const;
  std::size_t columns() const { return 10 + models_.size(); }
  View view_of(const std::string& name, const Track& track) const;
  std::vector<Panel> charts(const Track& track) const;
  void mark(const Track& track, LineChart& chart) const;
  void add_histories(const Track& track, LineChart& weights) const;
  Plan plan(const std::string& name, const Track& track) const;

  const std::vector<FilterSettings>& filters_;
  const RecordingReader& recording_;
  bool truth_known_;
  std::vector<std::string> models_;
  std::map<std::string, Track> tracks_;
  std::size_t not_shown_ = 0;  // rows of tracks beyond
};

/// Parallels and meridians about a place that cross a part of its frame, at round degrees.
std::vector<GraticuleLine> graticule(const Geodetic& anchor, double west, double east, double south, double north);

}  // namespace sigmax::apps
