#pragma once

#include <sigmax/hybrid/any_plot.hpp>

#include "recording/quantities.hpp"
#include "support/csv.hpp"
#include "support/geodesy.hpp"
#include "support/nines.hpp"

namespace sigmax::apps {

/// Where a recording is, what its columns mean, and which of its rows count.
struct RecordingOptions {
  std::string file;                             ///< "-" is the standard input
  std::vector<std::string> columns;             ///< NAME=HEADER
  std::optional<std::array<double, 3>> origin;  ///< latitude and longitude in degrees, altitude in m
  std::optional<bool> azimuth_from_north;       ///< clockwise from north rather than counter-clockwise from east
  std::string time_format;                      ///< by the directives of strptime, if times are written otherwise
  std::vector<std::string> missing;             ///< cells that stand for no number
  std::vector<std::string> select;              ///< COLUMN=VALUE, all of which must hold
  std::string track_id;                         ///< the column that tells tracks apart, or empty: all rows are one
  bool skip_bad_times = false;                  ///< rather than refuse them
  bool velocity = false;                        ///< whether velocities count, or a speed and a course
  bool range_rate = false;                      ///< whether a radar's range rates count
  bool sensor_places = false;                   ///< whether the settings say where on the Earth sensors stand
  bool simulated = false;                       ///< whether a simulated radar measures: so no velocity counts
};

/// One row of a recording.
struct Row {
  std::size_t line = 0;
  std::string track;     ///< empty without a column that tells tracks apart
  std::string sensor{};  ///< empty without a column `sensor`
  /// What was measured, and when: a position and a velocity as components, a radar's measurement or a bearing. In a
  /// geodetic recording the position is latitude and longitude in degrees and the altitude in m. A variance that the
  /// row does not tell is NaN.
  AnyPlot plot{};
  std::optional<Position> sensor_at{};     ///< where the sensor stands, if the row tells it, in m
  std::optional<Geodetic> sensor_place{};  ///< the same on the Earth
  std::optional<double> twice{};  ///< the number that is both its x and its y, or its latitude and its longitude
  std::optional<Position> truth{};
  Position rates = {nan, nan, nan};  ///< the velocity that it tells, in m/s, if that does not count
  std::optional<double> roll_deg{};
  bool predicted = false;  ///< no row, but the time of --predict-to

  bool measured() const { return plot.sensor != AnyPlot::Sensor::none; }
};

/// So many rows, and the line of the first.
struct Counted {
  std::size_t rows = 0, first_line = 0;

  void add(std::size_t line) {
    if (rows++ == 0) first_line = line;
  }
};

/// Columns of letters that say more of the number before them, as the S of a latitude, and of no other words.
class Marks {
 public:
  /// A cell, which counts if it is the first of the letters, or the word that begins with it.
  void see(std::size_t column, std::string_view cell, std::string_view letters, bool counts, std::size_t line);

  /// Those that count of the first such column.
  Counted found() const;

 private:
  std::map<std::size_t, std::pair<Counted, bool>> columns_;  // and whether all its cells are such letters
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
  bool polar() const { return has(Role::polar); }
  /// Whether azimuths stand without a range.
  bool bearings() const { return has(Role::polar, 1) && !polar(); }
  /// Whether there are velocities, and nothing that tells a position.
  bool moves_alone() const { return !located() && !has(Role::polar, 1); }
  /// Whether there are positions.
  bool located() const { return has(Role::position) || has(Role::place); }
  int axes() const { return axes_; }
  bool has_sensors() const { return sensor_.has_value(); }
  bool tells_accuracy() const {
    return has(Role::sigma_position) || has(Role::sigma_all_axes) || has(Role::covariance);
  }
  bool has_tracks() const { return track_.has_value(); }
  bool has_truth() const { return has(Role::truth); }
  bool has_roll() const { return roll_.has_value(); }
  /// How azimuths run, and whether range rates grow as the range falls.
  bool from_north() const { return from_north_; }
  bool counts_closing() const {
    return has(Role::range_rate) && columns_[place_of(Role::range_rate)]->unit->value < 0.0;
  }
  /// Whether times are numbers, and of seconds.
  bool times_are_numbers() const { return times_are_numbers_; }
  bool times_are_seconds() const { return times_are_numbers_ && time_unit_->unit_s == 1.0; }
  double time_unit_s() const { return time_unit_->unit_s; }
  const CsvReader& csv() const { return csv_; }
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

  /// Rows whose measurement is beyond all numbers of this world, and so counts as missed.
  const Counted& senseless() const { return senseless_; }

  /// Latitudes or longitudes beside which stands another hemisphere than that which they were taken for.
  Counted abroad(std::size_t i) const { return abroad_[i].found(); }

  /// Azimuths beside which an R says that they are relative to a heading.
  Counted relative() const { return relative_.found(); }

  /// Columns of one quantity that tell it otherwise, a sentence for each.
  std::vector<std::string> rivals() const;

  /// Numbers of nines that may stand for none, a sentence for each column.
  std::vector<std::string> nines() const;

  /// Where the zone of dates and times changes first, how far they go on there, and whether it is none before or then.
  struct OtherZone {
    std::size_t line = 0;
    double step = 0.0;
    bool is_none = false;
  };
  const OtherZone& other_zone() const { return other_zone_; }

  /// Whether the last date and time had a zone.
  bool zoned() const { return zone_ && !zone_->empty(); }

  /// A column that seems to tell the date, and is not read; or nothing.
  const std::string& unread_date() const { return unread_date_; }

  /// Whether there were times of day.
  bool times_of_day() const { return latest_of_day_.has_value(); }

  /// Rows dropped since their time was not after that of their track's row before.
  std::size_t skipped() const { return skipped_; }

  /// Rows that were taken.
  std::size_t rows() const { return rows_; }

  /// Of those dropped, those at the time of that row.
  std::size_t at_one_time() const { return at_one_time_; }

  /// The most of those before a row, and its line.
  const Counted& left_behind() const { return left_behind_; }

 private:
  /// Where a quantity stands, in which unit, and the number that stands for none.
  struct Column {
    std::size_t index;
    const Unit* unit;
    std::optional<double> not_available;
  };
  /// Another column of a quantity than that which counts, how far both are apart, and how great, in sum.
  struct Rival {
    std::size_t quantity;
    Column column;
    bool is_angle, is_mirrored;
    std::size_t rows = 0;
    double apart = 0.0, size = 0.0;

    void see(const std::optional<double>& said, std::optional<double> other);
  };
  /// The time of a track's last row, and the sensors that spoke then.
  struct Last {
    double time;
    std::vector<std::string> sensors;
    std::size_t line;
    bool of_day = false;   ///< whether it was a time of day
    std::size_t left = 0;  ///< earlier rows dropped since
  };

  std::optional<Column>& column(Role role, std::size_t i = 0) { return columns_[place_of(role) + i]; }
  bool has(Role role, std::size_t i = 0) const { return columns_[place_of(role) + i].has_value(); }
  /// What its positions stand in.
  Role where() const { return geodetic() ? Role::place : Role::position; }
  const std::string& header_of(std::size_t quantity) const { return csv_.names()[columns_[quantity]->index]; }
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
  std::string find_unread_date() const;
  bool may_mark(std::size_t column, std::initializer_list<std::string_view> words) const;

  bool take_time(Row& row);
  double on_its_day(const Row& row, double time_of_day);
  bool refused_time(const Row& row, double time);
  std::optional<double> number_in(std::size_t column);
  void take_numbers();
  Position rates() const;
  const std::optional<double>& said(Role role, std::size_t i = 0) const { return said_[place_of(role) + i]; }
  bool says(Role role, double least = 0.0) const;
  void require_whole(Role role, std::size_t size) const;
  Geodetic place(Role role) const;
  std::optional<Position> position(Role role) const;
  InputError error(Role role, std::size_t i, std::string_view expected, std::string_view remedy) const;
  std::optional<AnyPlot> measured();
  AnyPlot radar_plot() const;
  AnyPlot components() const;
  std::vector<double> covariance(const std::vector<int>& places, std::vector<double> variances) const;

  RecordingOptions options_;
  CsvReader csv_ = open_csv(options_.file);
  CsvRow row_;
  std::map<std::string, std::string, std::less<>> mapping_ = mapping_of(options_.columns);  // of headers
  std::array<std::optional<Column>, quantities.size()> columns_;
  std::array<std::optional<Column>, quantities.size()> doubted_;  // velocities that do not count
  std::array<std::optional<double>, quantities.size()> said_;     // of the row, in m, m/s and degrees
  std::size_t time_ = 0;
  const TimeColumn* time_unit_ = time_columns;
  bool times_are_numbers_ = false, times_have_dates_ = false;
  std::optional<std::size_t> date_, sensor_, track_, roll_;
  std::vector<std::pair<std::size_t, std::string>> select_;
  bool from_north_ = options_.azimuth_from_north.value_or(false), from_zenith_ = false;
  int axes_ = 3;
  std::optional<Geodetic> origin_;
  std::map<std::string, Last, std::less<>> last_;  // by track
  std::size_t rows_ = 0, skipped_ = 0, at_one_time_ = 0;
  Counted senseless_, left_behind_;
  std::array<Marks, 2> abroad_;
  Marks relative_;
  std::vector<Rival> rivals_;
  std::string unread_date_;
  std::map<std::size_t, std::size_t> missing_cells_;  // by column
  std::array<Nines, quantities.size()> nines_;
  std::optional<std::string> zone_;  // of the last date and time, which was
  double zoned_ = 0.0;
  OtherZone other_zone_;
  Counted midnights_;  // that tracks passed
  std::size_t unused_velocities_ = 0;
  std::size_t negative_speeds_ = 0;      // beside a negative course
  std::size_t bearings_ = 0;             // that count
  std::size_t unused_azimuths_ = 0;      // beside a position
  std::optional<double> latest_of_day_;  // the time of the last row with a time of day, since the first midnight
};

}  // namespace sigmax::apps
