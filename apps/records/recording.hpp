#pragma once

#include <sigmax/earth/earth_detection.hpp>
#include <sigmax/estimation/radar.hpp>

#include "shell/command_line.hpp"
#include "table/csv.hpp"
#include "table/quantities.hpp"

namespace sigmax::apps {

using Sensor = AnyDetection::Sensor;

/// From where azimuths count: counter-clockwise from east (x), clockwise from north (y) or clockwise from ahead (x).
enum class AzimuthFrom { east, north, ahead };

/// Where a recording is, what its columns mean, and which of its rows count.
struct RecordingOptions {
  std::string file;                             ///< "-" is the standard input
  std::vector<std::string> columns;             ///< NAME=HEADER
  std::optional<std::array<double, 3>> origin;  ///< latitude and longitude in degrees, altitude in m
  std::optional<AzimuthFrom> azimuth_from;      ///< else as the header says, or from east
  std::string time_format;                      ///< by the directives of strptime, if times are written otherwise
  std::vector<std::string> missing;             ///< cells that stand for no number
  std::vector<std::string> select;              ///< COLUMN=VALUE, all of which must hold
  std::string track_id;                         ///< the column that tells tracks apart, or empty: all rows are one
  bool skip_bad_times = false;                  ///< rather than refuse them
  bool velocity = false;                        ///< whether velocities count, or a speed and a course
  bool range_rate = false;                      ///< whether a radar's range rates count
  bool sensor_places = false;                   ///< whether the settings say where on the Earth sensors stand
  bool mixed = false;      ///< whether rows of several targets are mixed: times may repeat, and tracks may be empty
  bool simulated = false;  ///< whether a simulated radar measures: so no velocity counts
};

/// One row of a recording.
struct Row {
  std::size_t line = 0;
  std::string track{};   ///< empty without a column that tells tracks apart
  std::string sensor{};  ///< empty without a column `sensor`
  /// What was measured, and when: a position and a velocity as components, a radar's measurement or a bearing. In a
  /// geodetic recording the position is latitude and longitude in degrees and the altitude in m. A variance that the
  /// row does not tell is NaN.
  AnyDetection detection{};
  std::optional<Position> sensor_at{};     ///< where the sensor stands, if the row tells it, in m
  std::optional<Geodetic> sensor_place{};  ///< the same on the Earth
  std::optional<Position> truth{};
  Position rates = {nan, nan, nan};  ///< the velocity that it tells, in m/s, if that does not count
  std::optional<double> roll_deg{};
  bool predicted = false;  ///< no row, but the time of --predict-to

  bool measured() const { return detection.sensor != Sensor::none; }
};

/// So many rows, and the line of the first.
struct Counted {
  std::size_t rows = 0, first_line = 0;

  void add(std::size_t line) {
    if (rows++ == 0) first_line = line;
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
  bool next(Row& row);

  bool geodetic() const { return has(Role::place); }
  /// Whether radars or stations of bearings see from places on the Earth: then all is about one point.
  bool seen_from_places() const {
    return (polar() || bearings()) && !options_.simulated && (options_.sensor_places || has(Role::sensor_place));
  }
  /// Whether estimates have a latitude and a longitude.
  bool on_the_earth() const { return geodetic() || seen_from_places(); }
  bool simulated() const { return options_.simulated; }
  bool polar() const { return has(Role::polar); }
  /// Whether azimuths stand without a range.
  bool bearings() const { return has(Role::polar, 1) && !polar(); }
  /// Whether there are velocities, and nothing that tells a position.
  bool has_only_velocities() const { return !located() && !has(Role::polar, 1); }
  bool velocity_counts() const { return options_.velocity; }
  /// Whether there are positions.
  bool located() const { return has(Role::position) || has(Role::place); }
  int axes() const { return axes_; }
  bool has_sensors() const { return sensor_.has_value(); }
  bool has_accuracy() const { return has(Role::sigma_position) || has(Role::sigma_all_axes) || has(Role::covariance); }
  bool has_tracks() const { return track_.has_value(); }
  bool has_truth() const { return has(Role::truth); }
  bool has_roll() const { return roll_.has_value(); }
  /// How azimuths run, and whether range rates grow as the range falls.
  AzimuthFrom azimuth_from() const { return azimuth_from_; }
  /// Whether an option or a header says so.
  bool azimuth_from_is_given() const {
    return options_.azimuth_from || columns_[place_of(Role::polar) + 1]->unit->from_north;
  }
  /// Whether times are numbers, and of seconds.
  bool times_are_numbers() const { return times_are_numbers_; }
  bool times_are_seconds() const { return times_are_numbers_ && time_unit_->unit_s == 1.0; }
  const CsvReader& csv() const { return csv_; }
  const std::string& time_header() const { return csv_.names()[time_]; }
  /// Whether a quantity has a column, counting or not, that column's header, and its number in the last row, as
  /// written.
  bool holds(std::size_t quantity) const { return held(quantity).has_value(); }
  const std::string& header_of(std::size_t quantity) const { return csv_.names()[held(quantity)->index]; }
  std::optional<double> written(std::size_t quantity) const;
  const std::string& file() const { return csv_.file(); }

  /// A time written as those of the recording, in s, and whether it is a time of day; nothing if it is none.
  std::optional<double> time_of(const std::string& text, bool& of_day) const;

  /// Where the frame of every track begins, if not at its own first row.
  const std::optional<Geodetic>& origin() const { return origin_; }

  /// What the columns were taken to be.
  std::string taken() const;

  /// Sentences on what was read so far: which columns do not count, and why, where there is a reason; how many cells
  /// say that there is no number; in how many rows a velocity does not count, since they are a radar's or a bearing;
  /// where times of day passed midnight.
  std::vector<std::string> notes() const;

  /// Whether there were times of day.
  bool times_of_day() const { return latest_of_day_.has_value(); }

  /// Rows dropped since their time was not after that of their track's row before.
  std::size_t skipped() const { return skipped_; }

 private:
  /// Where a quantity stands, in which unit, and the number that stands for none.
  struct Column {
    std::size_t index;
    const Unit* unit;
    std::optional<double> not_available;
  };
  /// The time of a track's last row, and the sensors that spoke then.
  struct Last {
    double time;
    std::vector<std::string> sensors;
    bool of_day = false;  ///< whether it was a time of day
  };

  const std::optional<Column>& held(std::size_t q) const { return columns_[q] ? columns_[q] : doubted_[q]; }
  std::optional<Column>& column(Role role, std::size_t i = 0) { return columns_[place_of(role) + i]; }
  bool has(Role role, std::size_t i = 0) const { return columns_[place_of(role) + i].has_value(); }
  /// What its positions stand in.
  Role where() const { return geodetic() ? Role::place : Role::position; }
  /// Whether --columns names this header.
  bool is_mapped(std::string_view header) const {
    return std::ranges::any_of(mapping_, [&](const auto& mapped) { return mapped.second == header; });
  }
  int axes_of(Role role) const;
  void drop(Role role, std::size_t from = 0);
  std::optional<std::size_t> find(std::string_view name) const;
  std::optional<Column> find(const Quantity& quantity) const;
  void find_columns();
  void refuse_other_kinds(bool cartesian, bool time_known, bool has_velocity) const;
  std::optional<std::string> without_unit() const;
  std::string other_half(Role role) const;
  std::string why_unused(std::size_t quantity) const;
  std::string unused() const;

  /// By what its times must increase: its track, unless all are mixed.
  std::string timed(const Row& row) const { return options_.mixed ? "" : row.track; }
  bool take_time(Row& row);
  double on_its_day(const Row& row, double time_of_day);
  bool refused_time(const Row& row, double time);
  std::optional<double> number_in(std::size_t column);
  void take_numbers();
  Position rates() const;
  const std::optional<double>& value(Role role, std::size_t i = 0) const { return values_[place_of(role) + i]; }
  bool has_value(Role role) const;
  void require_whole(Role role, std::size_t size) const;
  Geodetic place(Role role) const;
  std::optional<Position> position(Role role) const;
  InputError error(Role role, std::size_t i, std::string_view expected, std::string_view remedy) const;
  AnyDetection measured();
  AnyDetection radar_detection() const;
  AnyDetection components() const;
  std::vector<double> covariance(const std::vector<int>& places, std::vector<double> variances) const;

  RecordingOptions options_;
  CsvReader csv_ = open_csv(options_.file);
  CsvRow row_;
  std::map<std::string, std::string, std::less<>> mapping_ = mapping_of(options_.columns);  // of headers
  std::array<std::optional<Column>, quantities.size()> columns_;
  std::array<std::optional<Column>, quantities.size()> doubted_;  // velocities that do not count
  std::array<std::optional<double>, quantities.size()> values_;   // of the row, in m, m/s and degrees
  std::size_t time_ = 0;
  const TimeColumn* time_unit_ = time_columns;
  bool times_are_numbers_ = false, times_have_dates_ = false;
  std::optional<std::size_t> date_, sensor_, track_, roll_;
  std::vector<std::pair<std::size_t, std::string>> select_;
  bool from_zenith_ = false;
  AzimuthFrom azimuth_from_ = options_.azimuth_from.value_or(AzimuthFrom::east);
  int axes_ = 3;
  std::optional<Geodetic> origin_;
  std::map<std::string, Last, std::less<>> last_;  // by track
  std::size_t rows_ = 0, skipped_ = 0;
  std::map<std::size_t, std::size_t> missing_cells_;  // by column
  Counted midnights_;                                 // that tracks passed
  std::size_t unused_velocities_ = 0;
  std::optional<double> latest_of_day_;  // the time of the last row with a time of day, since the first midnight
};

class RandomStream;

/// The position that a detection tells, a radar's or of components; 0 along what those do not have, nothing if there is
/// none.
std::optional<Position> position_of(const AnyDetection& detection, int axes);

/// What a radar with these standard deviations measures.
Polar measured(Polar exact, const Polar& sigma, RandomStream& random);

/// A stream of random numbers for each track, whichever others a file holds.
RandomStream stream_of(std::uint64_t seed, std::string_view track);

/// A radar that is simulated, if it is, and where a radar stands.
struct RadarOptions {
  std::optional<std::array<double, 3>> sigma;  ///< standard deviations in m, degrees and degrees
  std::optional<Position> at;                  ///< in m; else at the origin

  Position place() const { return at.value_or(Position{}); }
};

/// Takes a position for the truth and sees it by a simulated radar, or misses what lacks an axis. Throws InputError
/// with file and line where it comes out behind the radar.
void see_by_radar(Row& row, const std::optional<Position>& position, int axes, const RadarOptions& radar,
                  RandomStream& random, const std::string& file);

/// The options that say what a recording's columns mean, and which of its rows count; and --radar and --radar-at. All
/// outlive the app. The option for the column of tracks may have another name and meaning.
void add_recording(Subcommand app, RecordingOptions& recording, RadarOptions& radar,
                   const std::string& tracks = "--track-id",
                   const std::string& meaning = "The column that identifies tracks: a filter each");

/// Throws UsageError where a radar cannot measure what a recording holds.
void refuse_radar(const RadarOptions& radar, const RecordingReader& recording);

}  // namespace sigmax::apps
