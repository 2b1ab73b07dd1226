#include "records/recording.hpp"

#include <cmath>

#include "shell/text.hpp"
#include "table/timestamp.hpp"

namespace sigmax::apps {
namespace {

/// No measurement of this world, in m or degrees, but what a device writes where it has none.
constexpr double beyond_sense = 1e30;

/// Whether a header is that of names rather than numbers: track_id.
bool is_a_name(std::string_view header) {
  constexpr std::string_view endings[] = {"_id", "_name", "_no", "_number", "_type"};
  return std::ranges::any_of(endings, [&](std::string_view ending) { return header.ends_with(ending); });
}

/// So many covariances has a matrix of so many rows, as far as their diagonal.
constexpr std::size_t covariances(std::size_t rows) { return rows * (rows + 1) / 2; }

/// Of thousandths rather than times 0.001, which no double is.
double in_seconds(double number, double unit_s) {
  return unit_s < 1.0 ? number / std::round(1.0 / unit_s) : number * unit_s;
}

/// What a header without its unit probably is, by its name as others write it; or empty.
std::string_view known_as(std::string_view header) {
  constexpr std::string_view names =
      " time=time_s timestamp=time_s t=time_s lat=latitude_deg latitude=latitude_deg lon=longitude_deg "
      "lng=longitude_deg longitude=longitude_deg geoaltitude=altitude_m baroaltitude=altitude_m altitude=altitude_m "
      "alt=altitude_m sog=sog_kt cog=cog_deg velocity=speed_mps speed=speed_mps heading=track_deg "
      "vertrate=vertical_rate_mps x=x_m y=y_m z=z_m range=range_m azimuth=azimuth_deg elevation=elevation_deg ";
  constexpr std::string_view units[] = {"", "utc", "degrees", "knots", "(m)"};
  const std::string name = lower_case(header);
  const auto end = std::min(name.find_first_of("_ "), name.size());
  const std::string unit = name.substr(std::min(end + 1, name.size()));
  const std::string word = fmt::format(" {}=", name.substr(0, end));
  const auto at = names.find(word);
  if (at == names.npos || std::ranges::find(units, unit) == std::end(units)) return {};
  const std::string_view found = names.substr(at + word.size());
  return found.substr(0, found.find(' '));
}

/// The whole option that maps the headers of a file to the names that they probably stand for; or empty.
std::string columns_for(std::span<const std::string> headers) {
  std::map<std::string_view, std::string> found;
  for (const std::string& header : headers)
    if (const auto name = known_as(header); !name.empty() && name != header) found.try_emplace(name, csv_field(header));
  const auto mapped = each(found, [](const auto& one) { return fmt::format("{}={}", one.first, one.second); });
  const std::string words = fmt::format("{}", fmt::join(mapped, ","));
  if (words.empty()) return "";
  return "--columns " + (words.find_first_of(" ()[]\"") == words.npos ? words : "'" + words + "'");
}

/// Whether it is how accurate others of the row are.
bool is_accuracy(Role role) {
  return role == Role::covariance || role == Role::sigma_position || role == Role::sigma_all_axes ||
         role == Role::sigma_polar;
}

}  // namespace

bool says_unit(std::string_view header, std::string_view unit) {
  constexpr std::pair<std::string_view, std::string_view> others[] = {
      {"ft", "feet"}, {"m", "meters"}, {"kmh", "km/h"}, {"mps", "m/s"}, {"kt", "knots"}, {"deg", "degrees"}};
  const auto known = std::ranges::find(others, unit, [](const auto& one) { return one.first; });
  for (const std::string_view other : {unit, known == std::end(others) ? unit : known->second})
    if (header.ends_with(fmt::format("_{}", other)) || header.ends_with(fmt::format("({})", other)) ||
        header.ends_with(fmt::format("[{}]", other)))
      return true;
  return false;
}

RecordingReader::RecordingReader(const RecordingOptions& options) : options_(options) {
  options_.velocity &= !options.simulated;
  for (const auto& [name, header] : mapping_) csv_.column(header);  // each must be there
  find_columns();
  if (options.azimuth_from && !has(Role::polar, 1))
    throw UsageError("--azimuth-from is for radar input and bearings, but " + file() + " has no azimuth that counts");
  if (!options.track_id.empty()) track_ = csv_.column(options.track_id);
  for (const auto& select : options.select) {
    const auto equals = select.find('=');
    if (equals == std::string::npos || equals == 0) throw UsageError("--select: '{}' is not COLUMN=VALUE", select);
    select_.emplace_back(csv_.column(select.substr(0, equals)), trimmed(std::string_view{select}.substr(equals + 1)));
  }
  if (const auto doubt = doubt_of_format(options.time_format); !doubt.empty())
    throw UsageError("--time-format '{}': {}", options.time_format, doubt);
  if (!options.origin) return;
  if (!on_the_earth())
    throw UsageError("--origin is for geodetic input, or sensors with a latitude, but " + file() + " has none");
  const auto& [latitude, longitude, altitude] = *options.origin;
  origin_ = {latitude, longitude, altitude};
  if (!origin_->is_valid())
    throw UsageError("--origin: latitude {}°, longitude {}°, expected −90° to 90°, −360° to 360°", latitude, longitude);
}

std::optional<std::size_t> RecordingReader::find(std::string_view name) const {
  const auto mapped = mapping_.find(name);
  return mapped == mapping_.end() ? csv_.find(name) : csv_.column(mapped->second);
}

std::optional<RecordingReader::Column> RecordingReader::find(const Quantity& quantity) const {
  std::optional<Column> column, mapped;  // what --columns names goes before what the file does
  for_each_header(quantity, [&](const std::string& header, const Unit& unit) {
    const auto index = find(header);
    if (!index) return;
    const Column found{*index, &unit, not_available(header)};
    if (!column) column = found;
    if (!mapped && mapping_.contains(header)) mapped = found;
  });
  return mapped ? mapped : column;
}

/// The axes of which there are columns, up to the first of which there is none.
int RecordingReader::axes_of(Role role) const {
  int axes = 0;
  while (axes < 3 && has(role, static_cast<std::size_t>(axes))) ++axes;
  return axes;
}

/// Columns of a role that do not count.
void RecordingReader::drop(Role role, std::size_t from) {
  for (std::size_t i = from; i < size_of(role); ++i) column(role, i).reset();
}

void RecordingReader::find_columns() {
  std::ranges::transform(quantities, columns_.begin(), [&](const Quantity& quantity) { return find(quantity); });
  std::optional<std::size_t> time;
  for (const bool mapped : {true, false})
    for (const TimeColumn& unit : time_columns)
      if (!time && mapping_.contains(unit.name) == mapped && (time = find(unit.name))) time_unit_ = &unit;
  date_ = find("date");
  sensor_ = find("sensor");
  roll_ = find("roll_deg");
  if (!has(Role::polar, 1)) std::swap(column(Role::polar, 1), column(Role::polar, 3));
  from_zenith_ = !has(Role::polar, 2) && has(Role::polar, 4);
  if (from_zenith_) std::swap(column(Role::polar, 2), column(Role::polar, 4));
  drop(Role::polar, 3);
  const auto& azimuth = column(Role::polar, 1);
  if (azimuth && azimuth->unit->from_north) {
    if (options_.azimuth_from.value_or(AzimuthFrom::north) != AzimuthFrom::north)
      throw UsageError("--azimuth-from {} contradicts the column {}",
                       options_.azimuth_from == AzimuthFrom::east ? "east" : "ahead",
                       header_of(place_of(Role::polar) + 1));
    azimuth_from_ = AzimuthFrom::north;
  }
  const auto are_there = [&](Role role) { return has(role) && has(role, 1); };
  if (!are_there(Role::place)) drop(Role::place);
  if (!are_there(Role::polar)) {
    drop(Role::polar, 2);
    column(Role::polar).reset();
  }
  const bool along_one =
      has(Role::position) && !has(Role::position, 1) && !has(Role::position, 2) && !geodetic() && !polar();
  const bool cartesian = are_there(Role::position) || along_one;
  const bool places = options_.sensor_places || are_there(Role::sensor_place);
  if (along_one || (((geodetic() && !places) || options_.simulated) && !polar())) drop(Role::polar);
  const bool has_course = are_there(Role::course) && !has(Role::velocity) && !has(Role::velocity, 1);
  refuse_other_kinds(cartesian, time.has_value(), has_course || has(Role::velocity));
  time_ = *time;

  if (!cartesian) drop(Role::position);
  axes_ = std::max(polar() ? axes_of(Role::polar) : 0, axes_of(where()));
  if (axes_ == 0) axes_ = 2;
  if (!cartesian && !geodetic() && !has(Role::polar, 1))
    axes_ = has_course ? (has(Role::velocity, 2) ? 3 : 2) : axes_of(Role::velocity);
  const auto axes = static_cast<std::size_t>(axes_);
  if (!options_.simulated && (polar() || (!options_.velocity && located()))) doubted_ = columns_;
  if (!options_.velocity || axes_ == 1 || !has_course) drop(Role::course);
  drop(Role::velocity, options_.velocity ? axes : 0);
  if (!has(Role::range_rate)) std::swap(column(Role::range_rate), column(Role::range_rate, 1));
  drop(Role::range_rate, polar() && options_.range_rate ? 1 : 0);
  drop(Role::truth, axes_of(Role::truth) < axes_ ? 0 : axes);
  const std::size_t told = located() && !options_.simulated ? axes : 0;
  drop(Role::covariance, covariances(told));
  const bool has_variance = has(Role::covariance) || has(Role::covariance, 2) || has(Role::covariance, 5);
  drop(Role::sigma_position, has_variance ? 0 : told);
  if (told == 0 || has_variance) drop(Role::sigma_all_axes);
  if (!polar()) {
    drop(Role::sigma_polar, azimuth ? 2 : 0);
    column(Role::sigma_polar).reset();
  }
  for (const Role role : {Role::sensor_position, Role::sensor_place})
    drop(role, (polar() || bearings()) && !options_.simulated && are_there(role) ? axes : 0);
}

void RecordingReader::refuse_other_kinds(bool cartesian, bool time_known, bool has_velocity) const {
  const bool nowhere = !cartesian && !geodetic() && !polar() && !(bearings() && !without_unit());
  const bool moves = nowhere && has_velocity && !without_unit();
  const bool none = nowhere && !(moves && options_.velocity);
  if (!time_known && csv_.names().size() == 1) csv_.column("time_s");  // says what may be wrong with the separators
  const std::string columns = mapping_.empty() ? columns_for(csv_.names()) : "";
  const std::string map = columns.empty() ? "map other headers with --columns, as in --columns time_s=t,x_m=east"
                                          : "if the units are these, give " + columns;
  const bool headless =
      std::ranges::all_of(csv_.names(), [](const auto& name) { return parse_number(name).has_value(); });
  const struct {
    bool holds;
    std::string_view what;
    std::string remedy;
  } refusals[] = {
      {headless, "the first line holds numbers, and no names of columns",
       "put a line of names above it, as time_s,x_m,y_m (in this order, parted as the numbers are)"},
      {!time_known, "there is no column time_s", map},
      {none && moves && !options_.simulated, "there are velocities alone",
       "give --set sigma_velocity_mps=…, and they count"},
      {none, "its columns are of no kind", columns.empty() ? without_unit().value_or(map) : map},
      {geodetic() && (cartesian || (polar() && !seen_from_places())), "there are columns of several kinds",
       polar() ? "say on which latitude and longitude the sensors stand, or rename the columns that do not count"
               : "rename those that do not count"},
      {has(Role::sensor_position) && has(Role::sensor_place), "the place of a sensor is told in two ways",
       "rename the columns that do not count"},
      {located() && polar() && !sensor_, "there are positions and a radar's measurements, but no column sensor",
       "add one that names each row's sensor, or map its header with --columns"}};
  for (const auto& [holds, what, remedy] : refusals)
    if (holds)
      throw InputError({.where = file() + ":1",
                        .what = what,
                        .found = list_of(csv_.names()),
                        .expected = "time_s,x_m[,y_m[,z_m]], or time_s,latitude_deg,longitude_deg[,altitude_m] (or "
                                    "altitude_gnss_ft, altitude_ft), or time_s,range_m,azimuth_deg[,elevation_deg]",
                        .remedy = remedy});
}

/// The first column that may be a coordinate, but for its unit.
std::optional<std::string> RecordingReader::without_unit() const {
  for (const std::string& name : csv_.names())
    if (const Quantity* const like = is_mapped(name) ? nullptr : without_known_unit(name))
      if (like->role == Role::position || like->role == Role::place || like->role == Role::polar)
        return fmt::format("column {}: {}", in_quotes(name), advice(*like));
  return std::nullopt;
}

bool RecordingReader::next(Row& row) {
  const auto is_selected = [&](const auto& wanted) { return trimmed(row_[wanted.first]) == wanted.second; };
  do {
    if (!csv_.next(row_)) return false;
  } while (!std::ranges::all_of(select_, is_selected) || !take_time(row));
  row.roll_deg = roll_ ? number_in(*roll_) : std::nullopt;
  if (sensor_ && row.sensor.empty()) throw row_.error(*sensor_, "the name of the row's sensor", "fill the cell");
  take_numbers();
  row.truth = position(Role::truth);
  row.rates = rates();
  const double time = row.plot.time;
  row.sensor_at = position(Role::sensor_position);
  row.sensor_place = says(Role::sensor_place) ? std::optional(place(Role::sensor_place)) : std::nullopt;
  ++rows_;
  row.plot = measured();
  row.plot.time = time;
  return true;
}

std::optional<double> RecordingReader::time_of(const std::string& text, bool& of_day) const {
  of_day = options_.time_format.empty() && is_time_of_day(text);
  if (!options_.time_format.empty()) return parse_timestamp(text, options_.time_format, of_day);
  if (const auto number = parse_number(text)) return in_seconds(*number, time_unit_->unit_s);
  return parse_timestamp(text);
}

/// Takes the row's line, track, sensor and time; false if the row is to be skipped for its time.
bool RecordingReader::take_time(Row& row) {
  row.line = row_.line();
  row.track = track_ ? trimmed(row_[*track_]) : std::string_view{};
  row.sensor = sensor_ ? trimmed(row_[*sensor_]) : std::string_view{};
  if (track_ && row.track.empty())
    throw row_.error(*track_, "what tells its track from others",
                     rows_ == 0 ? "fill the cell, or drop the line, if it holds units" : "fill the cell");
  bool of_day = false;
  std::string cell(trimmed(row_[time_]));
  auto found = time_of(cell, of_day);
  if (date_ && (of_day || (!found && !options_.time_format.empty()))) {
    cell = fmt::format("{} {}", trimmed(row_[*date_]), cell);
    found = time_of(cell, of_day);
    if (!found || of_day)
      throw row_.error(*date_, "a date as 2016-01-12, since its row has a time of day",
                       "correct the cell, or drop the column if it is none; if all are written otherwise, say how "
                       "both are, as --time-format '%d/%m/%Y %H:%M:%S'");
    times_have_dates_ = true;
  }
  if (!found && !options_.time_format.empty())
    throw row_.error(time_, "a time as --time-format says, " + in_quotes(options_.time_format),
                     "correct the cell or drop the row");
  if (!found)
    throw row_.error(time_, "a number of seconds, or a date and time as 2016-01-12T13:02:11.218Z",
                     (rows_ == 0 ? "drop the line, if it holds units; " : "") +
                         std::string("correct the cell or drop the row; if all are written otherwise, say how, as "
                                     "--time-format '%d/%m/%Y %H:%M:%S'"));
  times_are_numbers_ = options_.time_format.empty() && parse_number(row_[time_]);
  const double time = of_day ? on_its_day(row, *found) : *found;
  row.plot.time = time;
  const bool refused = refused_time(row, time);
  Last& last = last_.find(row.track)->second;
  if (!refused) {
    last.of_day = of_day;
    if (of_day) latest_of_day_ = time;
    return true;
  }
  if (!options_.skip_bad_times)
    throw row_.error(
        time_, fmt::format("a time after that of the row before, {}", shortest(last.time)),
        sensor_ ? "sort the rows by time and drop repeated ones of one sensor, or give --on-bad-time skip"
        : time == last.time
            ? fmt::format(
                  "where several sensors measure at one time, name them in a column sensor{}; where times were "
                  "rounded, write them in full; else drop repeated rows, or give --on-bad-time skip",
                  track_ ? "" : ", and where several targets do, give the column that tells them apart by --track-id")
            : fmt::format("sort the rows by time{}, or give --on-bad-time skip",
                          track_ ? "" : "; or where there are several targets, tell them apart by --track-id COLUMN"));
  ++skipped_;
  return false;
}

/// The time of day with the days since the first. Where it falls by more than half a day within a track, that is the
/// next day. Where it would rise by more than half a day, it is of the day before: a late row of a track, or the first
/// row of one that begins.
double RecordingReader::on_its_day(const Row& row, double time_of_day) {
  const auto last = last_.find(row.track);
  const bool first = last == last_.end();
  if (first ? !latest_of_day_ : !last->second.of_day) return time_of_day;
  const double before = first ? *latest_of_day_ : last->second.time;
  const double midnight = midnight_before(before);
  const double time = first ? midnight + time_of_day : time_of_day_after(before, time_of_day);
  if (time >= day_s && time - before > day_s / 2.0) return time - day_s;
  if (time - midnight >= day_s) midnights_.add(row.line);
  return time;
}

/// Whether the time is not after that of the track's row before; several sensors may measure at one time.
bool RecordingReader::refused_time(const Row& row, double time) {
  const auto [found, first] = last_.try_emplace(row.track);
  Last& last = found->second;
  if (first || time > last.time) {
    last = {time, {row.sensor}};
    return false;
  }
  const bool spoke = std::ranges::find(last.sensors, row.sensor) != last.sensors.end();
  if (!(time == last.time) || spoke) return true;
  last.sensors.push_back(row.sensor);
  return false;
}

/// The number in a cell, which may stand for none.
std::optional<double> RecordingReader::number_in(std::size_t column) {
  const std::string_view cell = trimmed(row_[column]);
  const auto is_cell = [&](const std::string& word) {
    const auto number = parse_number(word);
    return cell == word || (number && number == parse_number(cell));
  };
  if (cell.empty() || std::ranges::none_of(options_.missing, is_cell)) {
    // A digit may follow a sign; 1 234, 1.234,5 and 33.88°S are no words for nothing.
    if (!cell.empty() && !parse_number(cell) && cell.find_first_of("0123456789") > 1)
      throw row_.error(column, "a finite number with a decimal point",
                       "leave the cell empty where there is none, or name such cells by --missing=" + typed(cell));
    return row_.optional_number(column);
  }
  ++missing_cells_[column];
  return std::nullopt;
}

/// What the row says of each quantity.
void RecordingReader::take_numbers() {
  for (std::size_t q = 0; q < quantities.size(); ++q)
    said_[q] = columns_[q] ? number_in(columns_[q]->index) : std::nullopt;
  // A longitude of 181° may be 179° west; it is none beside a latitude that is none, and so is an altitude.
  const auto says_none = [&](std::size_t q) { return said_[q] && said_[q] == columns_[q]->not_available; };
  const bool no_place = says_none(place_of(Role::place)) && says_none(place_of(Role::place) + 1);
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    const Role role = quantities[q].role;
    if (says_none(q) && (role != Role::place || no_place)) ++missing_cells_[columns_[q]->index];
    if (role == Role::place ? no_place : says_none(q)) said_[q].reset();
    if (said_[q] && std::abs(*said_[q]) >= beyond_sense) {
      ++missing_cells_[columns_[q]->index];
      std::fill_n(said_.begin() + place_of(role), size_of(role), std::nullopt);
    }
    if (said_[q]) *said_[q] *= columns_[q]->unit->value;
    if (said_[q] && from_zenith_ && q == place_of(Role::polar) + 2) said_[q] = 90.0 - *said_[q];
    if (said_[q] && is_accuracy(role) && role != Role::covariance && !(*said_[q] > 0.0))
      throw row_.error(columns_[q]->index, "a positive standard deviation", "leave the cell empty where it is unknown");
  }
  // A coordinate whose accuracy --missing names was not measured.
  for (std::size_t i = 0; i < 3; ++i)
    for (const std::size_t q :
         {place_of(Role::sigma_position) + i, place_of(Role::covariance) + covariances(i + 1) - 1})
      if (columns_[q] && !said_[q] && !trimmed(row_[columns_[q]->index]).empty()) said_[place_of(where()) + i].reset();
}

std::optional<double> RecordingReader::written(std::size_t quantity) const {
  const Column& column = *(columns_[quantity] ? columns_ : doubted_)[quantity];
  const auto number = parse_number(row_[column.index]);
  const auto is_it = [&](const auto& word) { return parse_number(word) == number; };
  return number == column.not_available || std::ranges::any_of(options_.missing, is_it) ? std::nullopt : number;
}

/// What columns tell of the velocity that do not count.
Position RecordingReader::rates() const {
  const auto told = [&](Role role, std::size_t i) {
    const auto& column = doubted_[place_of(role) + i];
    const auto number = column ? written(place_of(role) + i) : std::nullopt;
    return !number || number == column->not_available || std::abs(*number) >= beyond_sense
               ? nan
               : *number * column->unit->value;
  };
  Position rates = {told(Role::velocity, 0), told(Role::velocity, 1), told(Role::velocity, 2)};
  const double speed = told(Role::course, 0), course = told(Role::course, 1) * degree;
  if (std::isnan(rates[0]) && axes_ > 1 && speed >= 0.0) {
    rates[0] = speed * std::sin(course);
    rates[1] = speed * std::cos(course);
  }
  return rates;
}

/// Whether it has a number.
bool RecordingReader::says(Role role) const {
  const auto first = said_.begin() + place_of(role);
  return std::any_of(first, first + size_of(role), [](const auto& number) { return number.has_value(); });
}

InputError RecordingReader::error(Role role, std::size_t i, std::string_view expected, std::string_view remedy) const {
  return row_.error(columns_[place_of(role) + i]->index, expected, remedy);
}

void RecordingReader::require_whole(Role role, std::size_t size) const {
  for (std::size_t i = 0; i < size; ++i)
    if (has(role, i) && !said(role, i))
      throw error(role, i, "a number, since the row's other coordinates are there", "fill the cell or empty them all");
}

/// The position that it says, if it does.
std::optional<Position> RecordingReader::position(Role role) const {
  if (!says(role)) return std::nullopt;
  require_whole(role, 3);
  return Position{*said(role), said(role, 1).value_or(0.0), said(role, 2).value_or(0.0)};
}

/// The place on the Earth that it says, perhaps without an altitude.
Geodetic RecordingReader::place(Role role) const {
  require_whole(role, 2);
  const Geodetic place{*said(role), *said(role, 1), said(role, 2).value_or(0.0)};
  if (place.is_valid()) return place;
  const double latitude = std::abs(place.latitude_deg), longitude = std::abs(place.longitude_deg);
  const bool is_latitude = latitude > 90.0;
  throw error(role, is_latitude ? 0 : 1, is_latitude ? "degrees from −90 to 90" : "degrees from −360 to 360",
              is_latitude && role == Role::place && latitude <= 360.0 && longitude <= 90.0
                  ? fmt::format("correct the cell, or, where latitude and longitude are exchanged, give --columns "
                                "latitude_{0}={1},longitude_{2}={3}",
                                columns_[place_of(role)]->unit->suffix, typed(header_of(place_of(role) + 1)),
                                columns_[place_of(role) + 1]->unit->suffix, typed(header_of(place_of(role))))
              : std::max(latitude, longitude) < 1000.0
                  ? "correct the cell or drop the row"
                  : "if all are so, they are no degrees, but degrees and minutes in a row, as 5359.4, minutes, degrees "
                    "× 10⁷ or semicircles × 2³¹: write degrees");
}

/// What the row measured.
AnyPlot RecordingReader::measured() {
  const bool is_located = says(where()), is_moving = says(Role::velocity) || says(Role::course);
  const bool is_seen = says(Role::polar) && (polar() || !is_located);
  if (is_located && is_seen)
    throw error(Role::polar, 0, "an empty cell, since the row has a position", "give each sensor a row of its own");
  if (!is_seen) return components();
  if (is_moving) ++unused_velocities_;
  return radar_plot();
}

AnyPlot RecordingReader::radar_plot() const {
  const bool is_bearing = !said(Role::polar, 0) && !said(Role::polar, 2);
  if (!is_bearing) require_whole(Role::polar, 2);  // in space it may have no elevation
  if (!is_bearing && !(*said(Role::polar) > 0.0))
    throw error(Role::polar, 0, "a range above 0 m", "correct the cell, or empty those of a missed measurement");
  if (!(std::abs(said(Role::polar, 2).value_or(0.0)) <= 90.0))
    throw error(Role::polar, 2, from_zenith_ ? "degrees from 0 to 180" : "degrees from −90 to 90",
                "correct the cell; if all are gon or mils, write degrees");
  const double azimuth = *said(Role::polar, 1);
  if (!(std::abs(azimuth) <= 360.0))
    throw error(Role::polar, 1, "degrees from −360 to 360", "correct the cell; if all are gon or mils, write degrees");
  const double from_east = (azimuth_from_ == AzimuthFrom::north   ? 90.0 - azimuth
                            : azimuth_from_ == AzimuthFrom::ahead ? -azimuth
                                                                  : azimuth) *
                           degree;
  const double sigma_azimuth = said(Role::sigma_polar, 1).value_or(nan) * degree;
  if (is_bearing) return AnyPlot::bearing(0.0, from_east, sigma_azimuth * sigma_azimuth);
  const double sigma_range = said(Role::sigma_polar).value_or(nan);
  std::vector<double> z = {*said(Role::polar), from_east};
  std::vector<double> variances = {sigma_range * sigma_range, sigma_azimuth * sigma_azimuth};
  if (said(Role::polar, 2)) {
    const double sigma_elevation = said(Role::sigma_polar, 2).value_or(nan) * degree;
    z.push_back(*said(Role::polar, 2) * degree);
    variances.push_back(sigma_elevation * sigma_elevation);
  }
  if (!said(Role::range_rate) || z.size() < static_cast<std::size_t>(axes_)) return AnyPlot::polar(0.0, z, variances);
  z.push_back(*said(Role::range_rate));
  variances.push_back(nan);
  return AnyPlot::doppler(0.0, z, variances);
}

/// The position, as far as the row has it, and the velocity; or that nothing was measured.
AnyPlot RecordingReader::components() const {
  // A place has a latitude and a longitude; another position may lack any coordinate.
  if (geodetic() && (said(Role::place) || said(Role::place, 1))) place(Role::place);
  std::vector<int> places;
  std::vector<double> z, variances;
  const auto add = [&](std::size_t place, double number, double sigma) {
    places.push_back(static_cast<int>(place));
    z.push_back(number);
    variances.push_back(sigma * sigma);
  };
  const double sigma = said(Role::sigma_all_axes).value_or(nan);
  for (std::size_t i = 0; i < 3; ++i)
    if (said(where(), i)) add(i, *said(where(), i), said(Role::sigma_position, i).value_or(sigma));
  const auto axes = static_cast<std::size_t>(axes_);
  if (const auto speed = said(Role::course), course = said(Role::course, 1); speed && course) {
    if (!(std::abs(*course) <= 360.0)) throw error(Role::course, 1, "degrees from −360 to 360", "correct the cell");
    add(axes, *speed * std::sin(*course * degree), nan);
    add(axes + 1, *speed * std::cos(*course * degree), nan);
  }
  for (std::size_t i = 0; i < 3; ++i)
    if (said(Role::velocity, i)) add(axes + i, *said(Role::velocity, i), nan);
  return z.empty() ? AnyPlot{} : AnyPlot::components(0.0, places, z, covariance(places, variances));
}

/// The covariance of components at these places of the state, row by row, by their variances where the row tells none.
std::vector<double> RecordingReader::covariance(const std::vector<int>& places, std::vector<double> variances) const {
  const std::size_t n = places.size();
  const auto number = [&](std::size_t i, std::size_t j) {  // of those that the row may tell, j up to i
    return covariances(static_cast<std::size_t>(places[i])) + static_cast<std::size_t>(places[j]);
  };
  const auto own = [&](std::size_t i, std::size_t j) {
    return places[i] < axes_ ? said(Role::covariance, number(i, j)) : std::nullopt;
  };
  std::vector<double> matrix(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    matrix[i * (n + 1)] = variances[i] = own(i, i).value_or(variances[i]);
    for (std::size_t j = 0; j < i; ++j) {
      if (own(i, j) && std::isnan(variances[i] + variances[j]))
        throw error(Role::covariance, number(i, j), "an empty cell, since the row does not tell both variances",
                    "fill theirs");
      matrix[i * n + j] = matrix[j * n + i] = own(i, j).value_or(0.0);
    }
  }
  std::vector<double> left = matrix;  // by elimination
  for (std::size_t k = 0; k < n; ++k) {
    const double pivot = left[k * (n + 1)];
    if (std::isnan(pivot)) continue;  // the settings' variance, of an error that depends on no other
    if (pivot <= 0.0) {
      std::size_t at = number(k, k);
      while (!has(Role::covariance, at)) --at;
      throw error(Role::covariance, at, "a positive definite covariance with those beside it",
                  "correct it, or leave the row's covariances empty");
    }
    for (std::size_t i = k + 1; i < n; ++i)
      for (std::size_t j = k + 1; j < n; ++j) left[i * n + j] -= left[i * n + k] * left[k * n + j] / pivot;
  }
  return matrix;
}

std::string RecordingReader::taken() const {
  std::vector<std::string> parts = {times_have_dates_
                                        ? fmt::format("{} and {}", csv_.names()[*date_], csv_.names()[time_])
                                        : fmt::format("{} in {}", csv_.names()[time_], time_unit_->words)};
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    if (!columns_[q]) continue;
    const Quantity& quantity = quantities[from_zenith_ && q == place_of(Role::polar) + 2 ? q + 2 : q];
    std::string part = fmt::format("{} in {}{}", header_of(q), columns_[q]->unit->words, quantity.note);
    for (const auto units : {std::span<const Unit>(units::lengths), std::span<const Unit>(units::speeds),
                             std::span<const Unit>(units::angles)})
      for (const Unit& other : units)
        if (other.words != columns_[q]->unit->words && says_unit(header_of(q), other.suffix) &&
            quantity.role != Role::covariance)
          part += fmt::format(", as --columns says, and not in {}", other.words);
    if (q == place_of(Role::polar) + 1)
      part += fmt::format(" {}{}",
                          azimuth_from_ == AzimuthFrom::north   ? "clockwise from north"
                          : azimuth_from_ == AzimuthFrom::ahead ? "clockwise from ahead (x)"
                                                                : "counter-clockwise from east",
                          located() && bearings() ? " in rows without a position" : "");
    if (q == place_of(Role::polar) && axes_ == 2) part += " along the ground";
    if (is_accuracy(quantity.role)) part += " for the row's accuracy";
    parts.push_back(std::move(part));
  }
  return list_of(parts);
}

/// Names of the first quantity that those of a role cannot do without, and that has no column; or empty.
std::string RecordingReader::other_half(Role role) const {
  const bool pair = role == Role::position || role == Role::place || role == Role::course ||
                    role == Role::sensor_position || role == Role::sensor_place || (role == Role::polar && !geodetic());
  const std::size_t needed = role == Role::truth ? static_cast<std::size_t>(axes_) : pair ? 2 : 0;
  for (std::size_t i = 0; i < needed; ++i)
    if (const Quantity& quantity = quantities[place_of(role) + i]; !find(quantity)) return names_of(quantity);
  return {};
}

std::string RecordingReader::why_unused(std::size_t q) const {
  if (columns_[q]) return header_of(q) + " says it";
  const Role role = quantities[q].role;
  const bool velocity = !options_.velocity && (role == Role::velocity || role == Role::course);
  const std::string other = other_half(role), needs = "needs " + other;
  const std::pair<bool, std::string_view> reasons[] = {
      {velocity && options_.simulated, "--radar measures no velocity"},
      {options_.simulated && role == Role::polar, "--radar measures positions"},
      {options_.simulated && is_accuracy(role), "--radar has its own"},
      {role == Role::course && axes_ == 1, "along one axis it is vx_mps, and vx_kmh, if it has a sign"},
      {!other.empty(), needs},
      {velocity && !located() && has(Role::polar, 1), "velocities do not count in rows of a radar or with a bearing"},
      {velocity, "give --set sigma_velocity_mps=…"},
      {!options_.range_rate && polar() && role == Role::range_rate, "give --set sigma_range_rate_mps=…"},
      {true, "does not go with the others"}};
  return std::string(std::ranges::find_if(reasons, [](const auto& reason) { return reason.first; })->second);
}

/// The columns that do not count in any way, and why not: those with the name of a quantity, or nearly, before others.
std::string RecordingReader::unused() const {
  const auto names = csv_.names();
  std::vector<bool> done(names.size());
  for (const auto& index : {std::optional(time_), sensor_, track_, roll_, times_have_dates_ ? date_ : std::nullopt})
    if (index) done[*index] = true;
  for (const auto& wanted : select_) done[wanted.first] = true;
  for (const auto& column : columns_)
    if (column) done[column->index] = true;
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
  const auto add = [&](std::size_t index, std::string_view reason) {
    if (done[index]) return;
    done[index] = true;
    auto same = std::ranges::find_if(reasons, [&](const auto& other) { return other.first == reason; });
    if (same == reasons.end()) same = reasons.insert(same, {std::string(reason), {}});
    same->second.push_back(names[index].empty() ? fmt::format("column {}", index + 1) : names[index]);
  };
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    bool named = false;
    for_each_header(quantities[q], [&](const std::string& header, const Unit&) {
      const auto index = find(header);
      named |= index.has_value();
      if (index) add(*index, why_unused(q));
    });
    for (std::size_t index = 0; index < names.size() && !named; ++index)
      if (!is_a_name(names[index]) && without_known_unit(names[index]) == &quantities[q])
        add(index, advice(quantities[q]));
  }
  for (std::size_t index = 0; index < names.size(); ++index) add(index, {});
  return list_of(reasons, [](const auto& one) {
    return fmt::format("{}{}", fmt::join(one.second, ", "), one.first.empty() ? "" : " (" + one.first + ")");
  });
}

std::vector<std::string> RecordingReader::notes() const {
  const std::string columns = unused();
  const std::string times = midnights_.rows == 1 ? "once" : fmt::format("{} times", midnights_.rows);
  const std::string missing =
      list_of(missing_cells_, [&](const auto& of) { return fmt::format("{} {}", csv_.names()[of.first], of.second); });
  const std::pair<bool, std::string> notes[] = {
      {!columns.empty(), "Not used: " + columns},
      {!missing.empty(), "Cells that say that there is no number: " + missing},
      {unused_velocities_ > 0,
       fmt::format("Velocities do not count in rows of a radar or with a bearing: {} rows", unused_velocities_)},
      {midnights_.rows > 0, fmt::format("Times of day pass midnight {}, first on line {}; there the time falls by more "
                                        "than 12 h, and days are counted from the first",
                                        times, midnights_.first_line)}};
  std::vector<std::string> sentences;
  for (const auto& [holds, sentence] : notes)
    if (holds) sentences.push_back(sentence);
  return sentences;
}

}  // namespace sigmax::apps
