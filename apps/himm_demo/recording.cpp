#include "himm_demo/recording.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "himm_demo/recording_headers.hpp"
#include "support/angle.hpp"
#include "support/input.hpp"
#include "support/output.hpp"
#include "support/timestamp.hpp"

namespace sigmax::apps {
namespace {

/// No measurement of this world, in m or degrees, but what a device writes where it has none.
constexpr double beyond_sense = 1e30;

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
    origin_ = Geodetic::checked((*options.origin)[0], (*options.origin)[1], (*options.origin)[2]);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("--origin: {}", error.what()));
  }
}

void RecordingReader::find_columns(const RecordingOptions& options) {
  const auto mapping = mapping_of(options.columns);
  const auto find = [&](std::string_view name) -> std::optional<std::size_t> {
    const auto mapped = mapping.find(name);
    return mapped == mapping.end() ? csv_.find(name) : csv_.column(mapped->second);
  };
  const auto find_quantity = [&](Headers candidates) -> std::optional<Column> {
    for (const auto& header : candidates)
      if (const auto index = find(header.name)) return Column{*index, header.unit, header.taken_for};
    return std::nullopt;
  };
  const auto time = find("time_s");
  const Columns cartesian = {find_quantity(headers::x), find_quantity(headers::y), find_quantity(headers::z)};
  const Columns geodetic = {find_quantity(headers::latitude), find_quantity(headers::longitude),
                            find_quantity(headers::altitude)};
  polar_ = {find_quantity(headers::range), find_quantity(headers::azimuth), find_quantity(headers::elevation)};
  for (const auto& header : headers::azimuth)
    if (header.from_north && find(header.name) == (polar_[1] ? std::optional(polar_[1]->index) : std::nullopt) &&
        find(header.name)) {
      if (options.azimuth_from_north == false)
        throw UsageError(fmt::format("--azimuth-from east contradicts the column {}", header.name));
      from_north_ = true;
    }
  const auto find_plain = [&](std::string_view name) -> std::optional<Column> {
    const auto index = find(name);
    return index ? std::optional(Column{*index, 1.0, "m"}) : std::nullopt;
  };
  truth_ = {find_plain("true_x_m"), find_plain("true_y_m"), find_plain("true_z_m")};
  sigma_position_ = {find_plain("sigma_x_m"), find_plain("sigma_y_m"), find_plain("sigma_z_m")};
  sigma_polar_ = {find_plain("sigma_range_m"), find_plain("sigma_azimuth_deg"), find_plain("sigma_elevation_deg")};
  if (options.velocity) {
    velocity_ = {find_quantity(headers::velocity_x), find_quantity(headers::velocity_y),
                 find_quantity(headers::velocity_z)};
    course_ = {find_quantity(headers::speed), find_quantity(headers::course)};
    if (!course_[0] || !course_[1] || velocity_[0] || velocity_[1]) course_ = {};
  }
  if (options.range_rate) range_rate_ = find_quantity(headers::range_rate);
  sensor_ = find("sensor");
  roll_ = find("roll_deg");

  const auto are_there = [](const Columns& columns) { return columns[0] && columns[1]; };
  geodetic_ = are_there(geodetic);
  if (!are_there(polar_)) polar_ = {};
  const bool along_one = cartesian[0] && !cartesian[1] && !cartesian[2] && !geodetic_ && !polar();
  const bool is_cartesian = are_there(cartesian) || along_one;
  refuse_other_kinds(is_cartesian, time.has_value());
  time_ = *time;
  position_ = geodetic_ ? geodetic : is_cartesian ? cartesian : Columns{};

  const auto axes_of = [](const Columns& columns) {
    return static_cast<int>(std::find(columns.begin(), columns.end(), std::nullopt) - columns.begin());
  };
  axes_ = axes_of(polar() ? polar_ : position_);
  if (polar() && is_cartesian && axes_of(position_) != axes_)
    throw InputError(message({.where = csv_.file() + ":1",
                              .found = fmt::format("{}", fmt::join(csv_.names(), ", ")),
                              .expected = "both z_m and elevation_deg, or none of them",
                              .remedy = "give all sensors of a file as many axes"}));
  if (axes_of(truth_) < axes_) truth_ = {};
  for (std::size_t axis = static_cast<std::size_t>(axes_); axis < truth_.size(); ++axis) truth_[axis].reset();
  for (std::size_t axis = static_cast<std::size_t>(axes_); axis < velocity_.size(); ++axis) velocity_[axis].reset();
  if (axes_ == 1) course_ = {};
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
                            .expected = "time_s,x_m[,y_m[,z_m]], or time_s,latitude_deg,longitude_deg[,altitude_m] "
                                        "(or altitude_gnss_ft, altitude_ft), or time_s,range_m,azimuth_deg"
                                        "[,elevation_deg]",
                            .remedy = remedy}));
}

bool RecordingReader::next(Fix& fix) {
  do {
    if (!csv_.next(row_)) return false;
  } while (!selected() || !take_time(fix));
  fix.forget();
  fix.roll_deg = roll_ ? row_.optional_number(*roll_) : std::nullopt;
  fix.sensor = sensor_ ? trimmed(row_[*sensor_]) : std::string_view{};
  if (sensor_ && fix.sensor.empty()) throw row_.error(*sensor_, "the name of the row's sensor", "fill the cell");
  if (const auto truth = numbers(truth_)) fix.truth = Vector<3>(truth->data());
  if (senseless(position_) || senseless(polar_)) {
    if (senseless_++ == 0) first_senseless_line_ = fix.line;
    return true;
  }
  const auto position = numbers(position_, &fix.missing);
  if (!position) take_bearing(fix);
  const auto seen = fix.bearing ? std::nullopt : numbers(polar_);
  if (position && seen)
    throw row_.error(polar_[0]->index, "an empty cell, since the row has a position",
                     "give each sensor a row of its own");
  if (position && geodetic_) fix.place = place(*position);
  if (position && !geodetic_) fix.position = Vector<3>(position->data());
  if (seen) fix.seen = polar(*seen);
  if (position) take_sigmas(fix, sigma_position_, 1.0);
  if (seen || fix.bearing) take_sigmas(fix, sigma_polar_, degree);
  if (seen && range_rate_)
    if (const auto cell = row_.optional_number(range_rate_->index)) fix.range_rate = *cell * range_rate_->unit;
  if (!seen && !fix.bearing) take_velocity(fix);
  return true;
}

/// The azimuth alone, where a radar's row has no range and no elevation.
void RecordingReader::take_bearing(Fix& fix) const {
  if (!polar() || row_.optional_number(polar_[0]->index) || (polar_[2] && row_.optional_number(polar_[2]->index)))
    return;
  if (const auto azimuth = row_.optional_number(polar_[1]->index)) fix.bearing = azimuth_of(*azimuth * polar_[1]->unit);
}

/// The components of the velocity that the row has, or those that its speed and course make.
void RecordingReader::take_velocity(Fix& fix) const {
  for (std::size_t i = 0; i < velocity_.size(); ++i)
    if (const auto& column = velocity_[i])
      if (const auto cell = row_.optional_number(column->index); cell && std::abs(*cell) < beyond_sense)
        fix.velocity[i] = *cell * column->unit;
  if (!course_[0]) return;
  const auto speed = row_.optional_number(course_[0]->index);
  const auto course = row_.optional_number(course_[1]->index);
  if (!speed || !course || !(std::abs(*speed) < beyond_sense)) return;
  if (!(std::abs(*course) <= 360.0))
    throw row_.error(course_[1]->index, "degrees from −360 to 360", "correct the cell");
  fix.velocity[0] = *speed * course_[0]->unit * std::sin(*course * degree);
  fix.velocity[1] = *speed * course_[0]->unit * std::cos(*course * degree);
}

/// In rad counter-clockwise from east.
double RecordingReader::azimuth_of(double degrees) const {
  if (!(std::abs(degrees) <= 360.0)) throw row_.error(polar_[1]->index, "degrees from −360 to 360", "correct the cell");
  return (from_north_ ? 90.0 - degrees : degrees) * degree;
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
  if (!refused_time(fix)) return true;
  if (!skip_bad_times_)
    throw row_.error(
        time_, fmt::format("a time after that of the row before, {}", shortest(last_.find(fix.track)->second.time)),
        sensor_ ? "sort the rows by time and drop repeated ones of one sensor, or give --on-bad-time skip"
                : "sort the rows by time and drop repeated ones, or give --on-bad-time skip");
  ++skipped_;
  return false;
}

/// Whether the time is not after that of the track's row before; several sensors may measure at one time.
bool RecordingReader::refused_time(const Fix& fix) {
  const std::string sensor{sensor_ ? trimmed(row_[*sensor_]) : std::string_view{}};
  const auto [found, first] = last_.try_emplace(fix.track, Last{fix.time_s, {sensor}});
  if (first) return false;
  Last& last = found->second;
  if (fix.time_s > last.time) {
    last = {fix.time_s, {sensor}};
    return false;
  }
  const bool spoke = std::find(last.sensors.begin(), last.sensors.end(), sensor) != last.sensors.end();
  if (!(fix.time_s == last.time) || spoke) return true;
  last.sensors.push_back(sensor);
  return false;
}

/// Whether a cell has a number that stands for none.
bool RecordingReader::senseless(const Columns& columns) const {
  return std::any_of(columns.begin(), columns.end(), [&](const auto& column) {
    const auto cell = column ? row_.optional_number(column->index) : std::nullopt;
    return cell && std::abs(*cell) >= beyond_sense;
  });
}

void RecordingReader::take_sigmas(Fix& fix, const Columns& columns, double angle) const {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!columns[i]) continue;
    const auto sigma = row_.optional_number(columns[i]->index);
    if (!sigma) continue;
    if (!(*sigma > 0.0))
      throw row_.error(columns[i]->index, "a positive standard deviation", "leave the cell empty where it is unknown");
    fix.sigma[i] = *sigma * (i == 0 ? 1.0 : angle);
  }
}

/// The numbers in the columns that there are, 0 in those that there are not; nothing if all cells are empty. If some
/// are, and may be, those are `missing`: any of a Cartesian position, and the altitude of a place.
std::optional<std::array<double, 3>> RecordingReader::numbers(const Columns& columns,
                                                              std::array<bool, 3>* missing) const {
  std::array<double, 3> result = {0.0, 0.0, 0.0};
  std::array<bool, 3> empty{};
  std::size_t filled = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!columns[i]) continue;
    const auto cell = row_.optional_number(columns[i]->index);
    empty[i] = !cell;
    if (!cell) continue;
    result[i] = *cell * columns[i]->unit;
    ++filled;
  }
  if (filled == 0) return std::nullopt;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (empty[i] && (!missing || (geodetic_ && i < 2)))
      throw row_.error(columns[i]->index, "a number, since the row's other coordinates are there",
                       "fill the cell or empty them all");
  if (missing) *missing = empty;
  return result;
}

Geodetic RecordingReader::place(const std::array<double, 3>& cells) const {
  try {
    return Geodetic::checked(cells[0], cells[1], axes_ == 3 ? cells[2] : 0.0);
  } catch (const std::invalid_argument& error) {
    throw row_.error(position_[std::abs(cells[0]) > 90.0 ? 0 : 1]->index, error.what(),
                     "correct the cell or drop the row");
  }
}

Polar RecordingReader::polar(const std::array<double, 3>& cells) const {
  const auto [range, azimuth, elevation] = cells;
  if (!(range > 0.0))
    throw row_.error(polar_[0]->index, "a range above 0 m", "correct the cell, or empty those of a missed measurement");
  if (!(std::abs(elevation) <= 90.0)) throw row_.error(polar_[2]->index, "degrees from −90 to 90", "correct the cell");
  return {range, azimuth_of(azimuth), elevation * degree};
}

std::string RecordingReader::taken() const {
  std::vector<std::string> parts = {fmt::format("{} in s", csv_.names()[time_])};
  const auto add = [&](const Columns& columns, std::string_view azimuth) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i])
        parts.push_back(
            fmt::format("{} in {}{}", csv_.names()[columns[i]->index], columns[i]->taken_for, i == 1 ? azimuth : ""));
  };
  add(position_, "");
  add(polar_, from_north_ ? " clockwise from north" : " counter-clockwise from east");
  add(velocity_, "");
  for (const auto& column : {course_[0], course_[1], range_rate_}) add({column}, "");
  add(truth_, "");
  for (const auto& columns : {position_[0] ? sigma_position_ : Columns{}, polar_[0] ? sigma_polar_ : Columns{}})
    for (const auto& column : columns)
      if (column) parts.push_back(fmt::format("{} for the row's accuracy", csv_.names()[column->index]));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace sigmax::apps
