#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/estimation/gaussian.hpp>
#include <sigmax/estimation/radar.hpp>

#include "support/csv.hpp"
#include "support/geodesy.hpp"

namespace sigmax::apps {

/// Where a recording is, what its columns mean, and which of its rows count.
struct RecordingOptions {
  std::string file;                             ///< "-" is the standard input
  std::vector<std::string> columns;             ///< NAME=HEADER
  std::optional<std::array<double, 3>> origin;  ///< latitude and longitude in degrees, altitude in m
  std::optional<bool> azimuth_from_north;       ///< clockwise from north rather than counter-clockwise from east
  std::vector<std::string> select;              ///< COLUMN=VALUE, all of which must hold
  std::string track_id;                         ///< the column that tells tracks apart, or empty: all rows are one
  bool skip_bad_times = false;                  ///< rather than refuse them
};

/// One row of a recording in local coordinates. A missed measurement has neither `position` nor `seen`.
struct Fix {
  std::size_t line = 0;
  double time_s = 0.0;
  std::string track;                  ///< empty without a column that tells tracks apart
  std::string sensor;                 ///< empty without a column `sensor`
  std::optional<Vector<3>> position;  ///< measured: east, north, up in m; z is 0 on two axes
  std::optional<Polar> seen;          ///< measured by a radar; the elevation is 0 on two axes
  std::optional<Vector<3>> truth;
  std::optional<double> roll_deg;

  bool measured() const { return position || seen; }
};

/// Reads a headed CSV recording row by row: Cartesian, geodetic or a radar's, or Cartesian and radar's rows mixed, as
/// its columns say.
class RecordingReader {
 public:
  /// Throws InputError for a file that is of no kind, UsageError for options that mean nothing for it.
  explicit RecordingReader(const RecordingOptions& options);

  /// The next row that counts; false at the end. The times of a track must increase. Throws InputError with file, line
  /// and column.
  bool next(Fix& fix);

  bool geodetic() const { return geodetic_; }
  bool polar() const { return polar_[0].has_value(); }
  int axes() const { return axes_; }
  bool has_sensors() const { return sensor_.has_value(); }
  bool has_tracks() const { return track_.has_value(); }
  bool has_truth() const { return truth_[0].has_value(); }
  bool has_roll() const { return roll_.has_value(); }
  const CsvReader& csv() const { return csv_; }

  /// The frame of a geodetic recording, known after its first row.
  const LocalFrame& frame() const { return *frame_; }

  /// Rows dropped since their time was not after that of their track's row before.
  std::size_t skipped() const { return skipped_; }

 private:
  using Columns = std::array<std::optional<std::size_t>, 3>;

  void find_columns(const RecordingOptions& options);
  void refuse_other_kinds(bool cartesian, bool time_known) const;
  bool selected() const;
  bool take_time(Fix& fix);
  std::optional<std::array<double, 3>> numbers(const Columns& columns) const;
  Vector<3> local(const std::array<double, 3>& point);
  Polar polar(const std::array<double, 3>& cells) const;

  CsvReader csv_;
  CsvRow row_;
  std::size_t time_ = 0;
  Columns position_;  // Cartesian, or geodetic
  Columns polar_;
  Columns truth_;
  std::optional<std::size_t> sensor_, track_, roll_;
  std::vector<std::pair<std::size_t, std::string>> select_;
  bool geodetic_ = false;
  bool from_north_ = false;
  bool skip_bad_times_ = false;
  int axes_ = 3;
  double altitude_unit_ = 1.0;  ///< in m
  std::optional<LocalFrame> frame_;
  std::map<std::string, double, std::less<>> last_times_;  // by track
  std::size_t skipped_ = 0;
};

}  // namespace sigmax::apps
