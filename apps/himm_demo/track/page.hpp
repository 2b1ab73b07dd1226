#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "himm_demo/filters/settings.hpp"
#include "recording/recording.hpp"
#include "result/report.hpp"
#include "support/thinned.hpp"

namespace sigmax::apps {

/// Collects what the page of a recording shows, in memory that does not grow with its rows: some tracks, thinned.
class TrackPage {
 public:
  TrackPage(const std::vector<FilterSettings>& filters, const RecordingReader& recording, bool truth_known);

  /// What a row measured, as a position where the others are counted from, and where that begins if the recording is
  /// geodetic.
  void measured(const Row& row, const std::optional<Position>& position, const std::optional<Geodetic>& anchor);

  /// What a filter said of the row, of which it took so many quantities, in the same coordinates.
  void estimated(const Row& row, std::size_t filter, const TargetPoint& point, int quantities);

  /// That a filter's gate turned the row's measurement away, or that a filter started once more.
  void rejected(const Row& row, std::size_t filter) { mark(row, filter, true); }
  void restarted(const Row& row, std::size_t filter) { mark(row, filter, false); }

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
    Position position;
  };
  struct Track {
    double first_time;
    Thinned plots;  // x, y, z, their errors, and the truth
    std::vector<Thinned> estimates;
    std::vector<std::vector<ModeStay>> histories;  // of each filter
    std::optional<Geodetic> anchor{};
    std::optional<Position> last_position{};  // measured
    std::vector<Mark> rejections{};
    std::vector<Mark> restarts{};
  };

  Track* track_of(const Row& row);
  void mark(const Row& row, std::size_t filter, bool rejection);
  std::vector<Panel> charts(const Track& track) const;
  void add_restarts(const Track& track, LineChart& chart) const;
  void add_histories(const Track& track, LineChart& weights) const;
  Plan plan(const std::string& name, const Track& track) const;

  const std::vector<FilterSettings>& filters_;
  const RecordingReader& recording_;
  bool truth_known_;
  std::vector<std::string> models_;
  std::map<std::string, Track> tracks_;
  std::size_t not_shown_ = 0;  // rows of tracks beyond
};

}  // namespace sigmax::apps
