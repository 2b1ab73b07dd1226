#pragma once

#include <deque>

#include "himm_demo/filters/settings.hpp"
#include "records/recording.hpp"
#include "report/result.hpp"
#include "report/thinned.hpp"

namespace sigmax::apps {

struct TrackOutcome;

/// Collects what the page of a recording shows, in memory that does not grow with its rows: some tracks, thinned.
class TrackPage {
 public:
  TrackPage(const std::vector<FilterSettings>& filters, const RecordingReader& recording, bool truth_known)
      : filters_(filters), recording_(recording), truth_known_(truth_known) {}

  /// What a row measured, as a position where the others are counted from, and where that begins if the recording is
  /// geodetic.
  void measured(const Row& row, const std::optional<Position>& position, const std::optional<Geodetic>& anchor);

  /// What a filter said of the row, of which it took so many quantities, in the same coordinates.
  void estimated(const Row& row, std::size_t filter, const TargetPoint& point, int quantities);

  /// That a filter's gate turned the row's measurement away, or that a filter started once more.
  void rejected(const Row& row, std::size_t filter) { mark(row, filter, true); }
  void restarted(const Row& row, std::size_t filter) { mark(row, filter, false); }

  /// The tracks as views of a page, the one with the most rows first, with the groups and the words that go with them;
  /// and where there are several, a map of all.
  void add_to(Report& page, const TrackOutcome& outcome) const;

  /// All rows were read, and the best histories of the tracks' modes are known.
  void finish(const TrackOutcome& outcome);

 private:
  static constexpr std::size_t most_marks = 300;  // of each kind and track
  static constexpr std::size_t recent_rows = 20;  // whose mean NIS is drawn

  /// Columns of a measurement: its position, its error, where the target was, and its speed, course and climb.
  static constexpr std::size_t row_at = 0, row_error_at = 3, truth_at = 6, truth_moves_at = 9, row_columns = 12;

  /// Columns of an estimate; the weights of the models follow. Speed, course and climb have their σ beside them.
  static constexpr std::size_t position_at = 0, error_at = 3, sigma_at = 6, moves_at = 9, nis_at = 15,
                               quantities_at = 16, outlier_at = 17, sensor_at = 18, innovation_at = 19, innovations = 4,
                               weights_at = innovation_at + innovations;

  struct Mark {
    double time;
    std::size_t filter;
    Position position;
  };
  /// The latest NIS of a filter, each with the number of its quantities.
  using Recent = std::deque<std::pair<double, double>>;
  struct Track {
    double first_time;  // where its charts begin to count
    Thinned rows;       // what was measured, and then what each filter says of it
    std::map<std::pair<double, std::size_t>, std::vector<double>> open{};  // the last of them, by time and line
    std::size_t estimates = 0;                                             // of the first filter
    std::vector<std::vector<ModeStay>> histories{};                        // of each filter, at the end
    std::vector<Recent> recent;                                            // of each filter
    std::optional<Geodetic> anchor{};
    std::optional<Position> last_position{};  // measured
    std::optional<std::pair<double, Position>> last_truth{};
    std::vector<Mark> rejections{}, restarts{};
  };
  using Named = std::pair<const std::string, Track>;

  static double longest_step(const std::vector<double>& times);
  Track* track_of(const Row& row);
  void mark(const Row& row, std::size_t filter, bool rejection);
  std::vector<const Named*> longest_first() const;
  std::vector<double>& numbers(Track& track, double time, std::size_t line);
  void close(Track& track, std::size_t left_open);
  std::size_t most_rows() const;
  std::size_t column(std::size_t filter, std::size_t i) const;
  std::vector<double> heights(const Track& track, std::size_t from) const;
  void judge(const Row& row, const TargetPoint& point, int measured, Recent& recent, double* numbers);
  LineChart chart(const Track& track, std::string title, std::string y_label) const;
  std::vector<Panel> charts(const Track& track) const;
  void add_errors(const Track& track, std::vector<Panel>& panels) const;
  LineChart modes(const Track& track, std::size_t filter) const;
  void add_trust(const Track& track, std::vector<Panel>& panels) const;
  void add_history(const Track& track, std::size_t filter, LineChart& modes) const;
  PlanTrace traced(PlanTrace made, const Track& track, std::size_t from, std::size_t every = 1) const;
  MapChart plan(const std::string& name, const Track& track) const;
  MapChart map_of_all() const;

  const std::vector<FilterSettings>& filters_;
  const RecordingReader& recording_;
  bool truth_known_;
  std::vector<std::string> models_ = model_names(filters_);
  bool smooths_ = std::ranges::any_of(filters_, &FilterSettings::smooth);  // so that estimates come at the end
  std::vector<std::string> sensors_;                                       // as they appear
  std::map<Position, std::set<std::string>> stations_;  // who stands where and measures ranges or angles
  std::map<std::string, Track> tracks_;
  std::optional<double> clock_{};  // the first time, in seconds since 1970, if times have dates
  std::size_t kept_ = 0;           // rows of all tracks
  std::size_t not_shown_ = 0;      // rows of tracks beyond
};

}  // namespace sigmax::apps
