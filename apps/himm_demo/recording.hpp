#pragma once

#include <algorithm>
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

#include "himm_demo/recording_headers.hpp"
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
  bool velocity = false;                        ///< whether velocities count, or a speed and a course
  bool range_rate = false;                      ///< whether a radar's range rates count
  bool simulated = false;                       ///< whether a simulated radar measures: so no velocity counts
};

/// One row of a recording. A missed measurement has nothing of what is `measured`.
struct Fix {
  std::size_t line = 0;
  double time_s = 0.0;
  std::string track;                              ///< empty without a column that tells tracks apart
  std::string sensor;                             ///< empty without a column `sensor`
  std::optional<Vector<3>> position;              ///< measured: east, north, up in m; 0 along what is missing
  std::optional<Geodetic> place;                  ///< measured; the altitude is 0 on two axes
  std::array<bool, 3> missing{};                  ///< axes of the recording along which the position was not measured
  std::optional<Polar> seen;                      ///< measured by a radar; the elevation is 0 on two axes
  std::optional<double> range_rate;               ///< measured with that, in m/s
  std::optional<double> bearing;                  ///< measured alone, in rad counter-clockwise from east
  std::array<std::optional<double>, 3> velocity;  ///< measured: east, north, up in m/s
  /// What the row itself says of its accuracy: of x, y, z in m, or of range, azimuth, elevation in m and rad.
  std::array<std::optional<double>, 3> sigma;
  std::optional<Vector<3>> truth;
  std::optional<double> roll_deg;
  bool predicted = false;  ///< no row, but the time of --predict-to

  bool located() const { return position || place || seen; }
  bool partly() const { return missing[0] || missing[1] || missing[2]; }
  bool whole() const { return located() && !partly(); }

  /// So many axes of the position were measured, by whatever sensor.
  int measured_axes(int axes) const {
    return located() ? axes - static_cast<int>(std::count(missing.begin(), missing.end(), true)) : 0;
  }
  bool moving() const { return velocity[0] || velocity[1] || velocity[2]; }
  bool measured() const { return located() || bearing || moving(); }

  /// Forgets all but where the row stands: line, time and track.
  void forget() {
    Fix next;
    next.line = line;
    next.time_s = time_s;
    next.track = std::move(track);
    *this = std::move(next);
  }
};

/// Reads a headed CSV recording row by row: Cartesian, geodetic, a radar's or of bearings, or Cartesian rows mixed with
/// a radar's or with bearings, as its columns say.
class RecordingReader {
 public:
  /// Throws InputError for a file that is of no kind, UsageError for options that mean nothing for it.
  explicit RecordingReader(const RecordingOptions& options);

  /// The next row that counts; false at the end. The times of a track must increase. Throws InputError with file, line
  /// and column.
  bool next(Fix& fix);

  bool geodetic() const { return geodetic_; }
  bool polar() const { return polar_[0].has_value(); }
  /// Whether azimuths stand without a range.
  bool bearings() const { return azimuth_ && !polar(); }
  /// Whether there are positions.
  bool located() const { return position_[0].has_value(); }
  int axes() const { return axes_; }
  bool has_sensors() const { return sensor_.has_value(); }
  bool has_tracks() const { return track_.has_value(); }
  bool has_truth() const { return truth_[0].has_value(); }
  bool has_roll() const { return roll_.has_value(); }
  const CsvReader& csv() const { return csv_; }

  /// Where the frame of every track begins, if not at its own first row.
  const std::optional<Geodetic>& origin() const { return origin_; }

  /// What the columns were taken to be.
  std::string taken() const;

  /// Sentences on what was read so far: which columns of names that are known, or seem to be, do not count, and why; in
  /// how many rows a velocity does not, since they are a radar's or a bearing; where times of day passed midnight.
  std::vector<std::string> notes() const;

  /// Rows whose measurement is beyond all numbers of this world, and so counts as missed, and the line of the first.
  std::size_t senseless() const { return senseless_; }
  std::size_t first_senseless_line() const { return first_senseless_line_; }

  /// Whether there were times of day.
  bool times_of_day() const { return latest_of_day_.has_value(); }

  /// Rows dropped since their time was not after that of their track's row before.
  std::size_t skipped() const { return skipped_; }

 private:
  /// Where a quantity stands, and in which unit.
  struct Column {
    std::size_t index;
    const Quantity* quantity;
    const Unit* unit;
  };
  using Columns = std::array<std::optional<Column>, 3>;

  std::optional<std::size_t> find(std::string_view name) const;
  std::optional<Column> find(const Quantity& quantity) const;
  Columns find(const std::array<Quantity, 3>& quantities) const;
  void find_columns(const RecordingOptions& options);
  void refuse_other_kinds(bool cartesian, bool time_known) const;
  std::optional<std::string> without_unit() const;
  std::vector<std::optional<Column>> used() const;
  bool uses(std::size_t index) const;
  std::string why_unused(const Quantity& quantity) const;
  std::string unused() const;
  bool senseless(const Columns& columns) const;
  bool selected() const;
  bool take_time(Fix& fix);
  double on_its_day(const Fix& fix, double time_of_day);
  std::optional<std::array<double, 3>> numbers(const Columns& columns, std::array<bool, 3>* missing = nullptr) const;
  void take_sigmas(Fix& fix, const Columns& columns, double angle) const;
  bool take_bearing(Fix& fix);
  void take_velocity(Fix& fix) const;
  double azimuth_of(double degrees) const;
  Geodetic place(const std::array<double, 3>& cells) const;
  bool refused_time(const Fix& fix);
  Polar polar(const std::array<double, 3>& cells) const;

  CsvReader csv_;
  CsvRow row_;
  std::map<std::string, std::string, std::less<>> mapping_;  // of headers, as the options say
  std::size_t time_ = 0;
  Columns position_;  // Cartesian, or geodetic
  Columns polar_;
  std::optional<Column> azimuth_;  // also where there is no range
  Columns velocity_;
  std::array<std::optional<Column>, 2> course_;  // speed and course
  std::optional<Column> range_rate_;
  Columns truth_;
  Columns sigma_position_;
  Columns sigma_polar_;
  std::optional<std::size_t> sensor_, track_, roll_;
  std::vector<std::pair<std::size_t, std::string>> select_;
  bool geodetic_ = false;
  bool from_north_ = false;
  bool skip_bad_times_ = false;
  bool takes_velocity_ = false;
  bool simulated_ = false;
  bool takes_range_rate_ = false;
  int axes_ = 3;
  std::optional<Geodetic> origin_;
  /// The time of a track's last row, and the sensors that spoke then.
  struct Last {
    double time;
    std::vector<std::string> sensors;
    bool of_day = false;  ///< whether it was a time of day
  };
  std::map<std::string, Last, std::less<>> last_;  // by track
  std::size_t skipped_ = 0;
  std::size_t senseless_ = 0;
  std::size_t first_senseless_line_ = 0;
  std::size_t unused_velocities_ = 0;
  std::size_t bearings_ = 0;             // that count
  std::size_t unused_azimuths_ = 0;      // beside a position
  std::optional<double> latest_of_day_;  // the time of the last row with a time of day, since the first midnight
  std::size_t midnights_ = 0;            // that tracks passed
  std::size_t first_midnight_line_ = 0;
};

}  // namespace sigmax::apps
