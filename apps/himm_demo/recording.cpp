#include "himm_demo/recording.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "support/angle.hpp"
#include "support/input.hpp"
#include "support/output.hpp"
#include "support/timestamp.hpp"

namespace sigmax::apps {
namespace {

constexpr double foot = 0.3048;
constexpr std::array<std::string_view, 17> known = {
    "time_s",           "x_m",         "y_m",     "z_m",         "latitude_deg",  "longitude_deg", "altitude_m",
    "altitude_gnss_ft", "altitude_ft", "range_m", "azimuth_deg", "elevation_deg", "sensor",        "true_x_m",
    "true_y_m",         "true_z_m",    "roll_deg"};

using Mapping = std::map<std::string, std::string, std::less<>>;

Mapping mapping_of(const std::vector<std::string>& columns) {
  Mapping mapping;
  for (const auto& column : columns) {
    const auto equals = column.find('=');
    const std::string name = column.substr(0, equals);
    if (equals == std::string::npos || equals + 1 == column.size())
      throw UsageError(fmt::format("--columns: '{}' is not NAME=HEADER", column));
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw UsageError(fmt::format("--columns: '{}' is not one of {}", name, fmt::join(known, ", ")));
    if (!mapping.emplace(name, column.substr(equals + 1)).second)
      throw UsageError(fmt::format("--columns: '{}' is given twice", name));
  }
  return mapping;
}

CsvReader open(const std::string& file) {
  return file == "-" ? CsvReader{std::cin, "standard input"} : CsvReader{std::filesystem::path{file}};
}

}  // namespace

RecordingReader::RecordingReader(const RecordingOptions& options)
    : csv_(open(options.file)),
      from_north_(options.azimuth_from_north.value_or(false)),
      skip_bad_times_(options.skip_bad_times) {
  find_columns(options);
  if (options.azimuth_from_north && !polar())
    throw UsageError("--azimuth-from is for radar input, but " + csv_.file() + " has no azimuth_deg");
  if (!options.track_id.empty()) track_ = csv_.column(options.track_id);
  for (const auto& select : options.select) {
    const auto equals = select.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError(fmt::format("--select: '{}' is not COLUMN=VALUE", select));
    select_.emplace_back(csv_.column(select.substr(0, equals)), trimmed(std::string_view{select}.substr(equals + 1)));
  }
  if (!options.origin) return;
  if (!geodetic_) throw UsageError("--origin is for geodetic input, but " + csv_.file() + " is none");
  try {
    frame_.emplace(Geodetic::from_degrees((*options.origin)[0], (*options.origin)[1], (*options.origin)[2]));
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("--origin: {}", error.what()));
  }
}

void RecordingReader::find_columns(const RecordingOptions& options) {
  const Mapping mapping = mapping_of(options.columns);
  const auto find = [&](std::string_view name) -> std::optional<std::size_t> {
    const auto mapped = mapping.find(name);
    return mapped == mapping.end() ? csv_.find(name) : csv_.column(mapped->second);
  };
  const auto time = find("time_s");
  const Columns cartesian = {find("x_m"), find("y_m"), find("z_m")};
  Columns geodetic = {find("latitude_deg"), find("longitude_deg"), {}};
  for (const auto& [name, unit] : {std::pair{"altitude_m", 1.0}, {"altitude_gnss_ft", foot}, {"altitude_ft", foot}})
    if (!geodetic[2] && (geodetic[2] = find(name))) altitude_unit_ = unit;
  polar_ = {find("range_m"), find("azimuth_deg"), find("elevation_deg")};
  truth_ = {find("true_x_m"), find("true_y_m"), find("true_z_m")};
  sensor_ = find("sensor");
  roll_ = find("roll_deg");

  const auto are_there = [](const Columns& columns) { return columns[0] && columns[1]; };
  const bool is_cartesian = are_there(cartesian);
  geodetic_ = are_there(geodetic);
  if (!are_there(polar_)) polar_ = {};
  refuse_other_kinds(is_cartesian, time.has_value());
  time_ = *time;
  position_ = geodetic_ ? geodetic : is_cartesian ? cartesian : Columns{};

  const auto axes_of = [](const Columns& columns) { return columns[2] ? 3 : 2; };
  axes_ = axes_of(polar() ? polar_ : position_);
  if (polar() && is_cartesian && axes_of(position_) != axes_)
    throw InputError(message({.where = csv_.file() + ":1",
                              .found = fmt::format("{}", fmt::join(csv_.names(), ", ")),
                              .expected = "both z_m and elevation_deg, or none of them",
                              .remedy = "give all sensors of a file as many axes"}));
  if (!are_there(truth_) || axes_of(truth_) < axes_) truth_ = {};
  if (axes_ == 2) truth_[2].reset();
}

void RecordingReader::refuse_other_kinds(bool cartesian, bool time_known) const {
  std::string what;
  std::string remedy = "map other headers with --columns, as in --columns time_s=t,x_m=east";
  if (!time_known) {
    if (csv_.names().size() == 1) csv_.column("time_s");  // says what may be wrong with the separators
    what = "there is no column time_s";
  } else if (!cartesian && !geodetic_ && !polar()) {
    what = "its columns are of no kind";
  } else if (geodetic_ && (cartesian || polar())) {
    what = "there are columns of several kinds";
    remedy = "rename those that do not count";
  } else if (cartesian && polar() && !sensor_) {
    what = "there are positions and a radar's measurements, but no column sensor";
    remedy = "add one that names each row's sensor, or map its header with --columns";
  } else {
    return;
  }
  throw InputError(message({.where = csv_.file() + ":1",
                            .what = what,
                            .found = fmt::format("{}", fmt::join(csv_.names(), ", ")),
                            .expected = "time_s,x_m,y_m[,z_m], or time_s,latitude_deg,longitude_deg[,altitude_m] "
                                        "(or altitude_gnss_ft, altitude_ft), or time_s,range_m,azimuth_deg"
                                        "[,elevation_deg]",
                            .remedy = remedy}));
}

bool RecordingReader::next(Fix& fix) {
  do {
    if (!csv_.next(row_)) return false;
  } while (!selected() || !take_time(fix));
  fix.roll_deg = roll_ ? row_.optional_number(*roll_) : std::nullopt;
  fix.sensor = sensor_ ? trimmed(row_[*sensor_]) : std::string_view{};
  if (sensor_ && fix.sensor.empty()) throw row_.error(*sensor_, "the name of the row's sensor", "fill the cell");

  const auto position = numbers(position_);
  const auto seen = numbers(polar_);
  if (position && seen)
    throw row_.error(*polar_[0], "an empty cell, since the row has a position", "give each sensor a row of its own");
  fix.position.reset();
  if (position) fix.position = geodetic_ ? local(*position) : Vector<3>(position->data());
  fix.seen.reset();
  if (seen) fix.seen = polar(*seen);
  const auto truth = numbers(truth_);
  fix.truth.reset();
  if (truth) fix.truth = Vector<3>(truth->data());
  return true;
}

bool RecordingReader::selected() const {
  return std::all_of(select_.begin(), select_.end(),
                     [&](const auto& wanted) { return trimmed(row_[wanted.first]) == wanted.second; });
}

/// Takes the row's line, track and time; false if the row is to be skipped for its time.
bool RecordingReader::take_time(Fix& fix) {
  fix.line = row_.line();
  fix.track = track_ ? trimmed(row_[*track_]) : std::string_view{};
  if (track_ && fix.track.empty()) throw row_.error(*track_, "what tells its track from others", "fill the cell");
  const auto time = parse_timestamp(row_[time_]);
  if (!time)
    throw row_.error(time_, "a number of seconds, or a date and time as 2016-01-12T13:02:11.218Z",
                     "correct the cell or drop the row");
  fix.time_s = *time;
  const auto [last, first] = last_times_.emplace(fix.track, fix.time_s);
  if (first) return true;
  if (!(fix.time_s > last->second)) {
    if (!skip_bad_times_)
      throw row_.error(time_, fmt::format("a time after that of the row before, {}", shortest(last->second)),
                       "sort the rows by time and drop repeated ones, or give --on-bad-time skip");
    ++skipped_;
    return false;
  }
  last->second = fix.time_s;
  return true;
}

/// The numbers in the columns that there are, 0 in those that there are not; nothing if all cells are empty.
std::optional<std::array<double, 3>> RecordingReader::numbers(const Columns& columns) const {
  std::array<double, 3> result = {0.0, 0.0, 0.0};
  std::size_t filled = 0;
  std::optional<std::size_t> empty;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!columns[i]) continue;
    if (const auto cell = row_.optional_number(*columns[i])) {
      result[i] = *cell;
      ++filled;
    } else if (!empty) {
      empty = columns[i];
    }
  }
  if (filled == 0) return std::nullopt;
  if (empty)
    throw row_.error(*empty, "a number, since the row's other coordinates are there",
                     "fill the cell or empty them all");
  return result;
}

Vector<3> RecordingReader::local(const std::array<double, 3>& cells) {
  Geodetic point;
  try {
    point = Geodetic::from_degrees(cells[0], cells[1], altitude_unit_ * cells[2]);
  } catch (const std::invalid_argument& error) {
    throw row_.error(*position_[std::abs(cells[0]) > 90.0 ? 0 : 1], error.what(), "correct the cell or drop the row");
  }
  if (!frame_) frame_.emplace(point);
  const EastNorthUp position = frame_->to_local(point);
  return {position.east, position.north, axes_ == 3 ? position.up : 0.0};
}

Polar RecordingReader::polar(const std::array<double, 3>& cells) const {
  const auto [range, azimuth, elevation] = cells;
  if (!(range > 0.0))
    throw row_.error(*polar_[0], "a range above 0 m", "correct the cell, or empty those of a missed measurement");
  if (!(std::abs(azimuth) <= 360.0)) throw row_.error(*polar_[1], "degrees from −360 to 360", "correct the cell");
  if (!(std::abs(elevation) <= 90.0)) throw row_.error(*polar_[2], "degrees from −90 to 90", "correct the cell");
  return {range, (from_north_ ? 90.0 - azimuth : azimuth) * degree, elevation * degree};
}

}  // namespace sigmax::apps
