#include "himm_demo/recording.hpp"

#include <algorithm>
#include <cmath>

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

constexpr std::string_view name_endings[] = {"_id", "_name", "_no", "_number", "_type"};

/// Whether a header is that of names rather than numbers: track_id.
bool is_a_name(std::string_view header) {
  return std::any_of(std::begin(name_endings), std::end(name_endings),
                     [&](std::string_view ending) { return header.ends_with(ending); });
}

}  // namespace

RecordingReader::RecordingReader(const RecordingOptions& options)
    : csv_(open_csv(options.file)),
      mapping_(mapping_of(options.columns)),
      from_north_(options.azimuth_from_north.value_or(false)),
      skip_bad_times_(options.skip_bad_times),
      takes_velocity_(options.velocity && !options.simulated),
      simulated_(options.simulated),
      takes_range_rate_(options.range_rate) {
  for (const auto& [name, header] : mapping_) csv_.column(header);  // each must be there
  find_columns(options);
  if (options.azimuth_from_north && !azimuth_)
    throw UsageError("--azimuth-from is for radar input and bearings, but " + csv_.file() +
                     " has no azimuth that counts");
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

std::optional<std::size_t> RecordingReader::find(std::string_view name) const {
  const auto mapped = mapping_.find(name);
  return mapped == mapping_.end() ? csv_.find(name) : csv_.column(mapped->second);
}

std::optional<RecordingReader::Column> RecordingReader::find(const Quantity& quantity) const {
  std::optional<Column> column, mapped;  // what --columns names goes before what the file does
  for_each_header(quantity, [&](const std::string& header, const Unit& unit) {
    const auto index = find(header);
    if (index && !column) column = {*index, &quantity, &unit};
    if (index && !mapped && mapping_.contains(header)) mapped = {*index, &quantity, &unit};
  });
  return mapped ? mapped : column;
}

RecordingReader::Columns RecordingReader::find(const std::array<Quantity, 3>& quantities) const {
  return {find(quantities[0]), find(quantities[1]), find(quantities[2])};
}

void RecordingReader::find_columns(const RecordingOptions& options) {
  const auto time = find("time_s");
  const Columns cartesian = find(headers::position);
  const Columns geodetic = find(headers::place);
  polar_ = find(headers::polar);
  azimuth_ = polar_[1];
  if (azimuth_ && azimuth_->unit->from_north) {
    if (options.azimuth_from_north == false)
      throw UsageError(fmt::format("--azimuth-from east contradicts the column azimuth_{}", azimuth_->unit->suffix));
    from_north_ = true;
  }
  truth_ = find(headers::truth);
  sigma_position_ = find(headers::sigma_position);
  sigma_polar_ = find(headers::sigma_polar);
  if (takes_velocity_) {
    velocity_ = find(headers::velocity);
    course_ = {find(headers::course[0]), find(headers::course[1])};
    if (!course_[0] || !course_[1] || velocity_[0] || velocity_[1]) course_ = {};
  }
  sensor_ = find("sensor");
  roll_ = find("roll_deg");

  const auto are_there = [](const Columns& columns) { return columns[0] && columns[1]; };
  geodetic_ = are_there(geodetic);
  if (!are_there(polar_)) polar_ = {};
  const bool along_one = cartesian[0] && !cartesian[1] && !cartesian[2] && !geodetic_ && !polar();
  const bool is_cartesian = are_there(cartesian) || along_one;
  if (along_one || ((geodetic_ || simulated_) && !polar())) azimuth_.reset();
  refuse_other_kinds(is_cartesian, time.has_value());
  time_ = *time;
  position_ = geodetic_ ? geodetic : is_cartesian ? cartesian : Columns{};
  if (polar() && takes_range_rate_) range_rate_ = find(headers::range_rate[0]);
  if (!position_[0]) sigma_position_ = {};
  if (!polar()) sigma_polar_ = {std::nullopt, azimuth_ ? sigma_polar_[1] : std::nullopt, std::nullopt};

  const auto axes_of = [](const Columns& columns) {
    return static_cast<int>(std::find(columns.begin(), columns.end(), std::nullopt) - columns.begin());
  };
  axes_ = polar() ? axes_of(polar_) : position_[0] ? axes_of(position_) : 2;
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
  const bool bearings_alone = azimuth_ && !cartesian && !geodetic_ && !polar();
  if (!time_known) {
    if (csv_.names().size() == 1) csv_.column("time_s");  // says what may be wrong with the separators
    what = "there is no column time_s";
  } else if (!cartesian && !geodetic_ && !polar() && (!bearings_alone || without_unit())) {
    what = "its columns are of no kind";
    remedy = without_unit().value_or(remedy);
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

/// The first column that may be a coordinate, but for its unit.
std::optional<std::string> RecordingReader::without_unit() const {
  for (const std::string& name : csv_.names())
    for (const auto& quantities : {headers::position, headers::place, headers::polar})
      for (const Quantity& quantity : quantities)
        if (const Quantity* const like = without_known_unit(name); like && like->stems == quantity.stems)
          return fmt::format("column {}: {}", in_quotes(name), advice(*like));
  return std::nullopt;
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
  if (!position && !take_bearing(fix)) {
    if (senseless_++ == 0) first_senseless_line_ = fix.line;
    return true;
  }
  const auto seen = fix.bearing ? std::nullopt : numbers(polar_);
  if (position && seen)
    throw row_.error(polar_[0]->index, "an empty cell, since the row has a position",
                     "give each sensor a row of its own");
  if (position && geodetic_) fix.place = place(*position);
  if (position && !geodetic_) fix.position = Vector<3>(position->data());
  if (seen) fix.seen = polar(*seen);
  if (position && bearings() && !row_.blank(azimuth_->index)) ++unused_azimuths_;
  if (position) take_sigmas(fix, sigma_position_, 1.0);
  if (seen || fix.bearing) take_sigmas(fix, sigma_polar_, degree);
  if (seen && range_rate_)
    if (const auto cell = row_.optional_number(range_rate_->index)) fix.range_rate = *cell * range_rate_->unit->value;
  const auto blank = [&](const auto& column) { return !column || row_.blank(column->index); };
  if (!seen && !fix.bearing)
    take_velocity(fix);
  else if (!std::all_of(velocity_.begin(), velocity_.end(), blank) ||
           !std::all_of(course_.begin(), course_.end(), blank))
    ++unused_velocities_;
  return true;
}

/// The azimuth alone, where the row has no range and no elevation; false if it is a number that stands for none.
bool RecordingReader::take_bearing(Fix& fix) {
  const auto filled = [&](const auto& column) { return column && row_.optional_number(column->index); };
  if (!azimuth_ || filled(polar_[0]) || filled(polar_[2])) return true;
  const auto azimuth = row_.optional_number(azimuth_->index);
  if (!azimuth) return true;
  if (std::abs(*azimuth) >= beyond_sense) return false;
  fix.bearing = azimuth_of(*azimuth * azimuth_->unit->value);
  ++bearings_;
  return true;
}

/// The components of the velocity that the row has, or those that its speed and course make.
void RecordingReader::take_velocity(Fix& fix) const {
  for (std::size_t i = 0; i < velocity_.size(); ++i)
    if (const auto& column = velocity_[i])
      if (const auto cell = row_.optional_number(column->index); cell && std::abs(*cell) < beyond_sense)
        fix.velocity[i] = *cell * column->unit->value;
  if (!course_[0]) return;
  const auto speed = row_.optional_number(course_[0]->index);
  const auto course = row_.optional_number(course_[1]->index);
  if (!speed || !course || !(std::abs(*speed) < beyond_sense)) return;
  if (!(std::abs(*course) <= 360.0))
    throw row_.error(course_[1]->index, "degrees from −360 to 360", "correct the cell");
  fix.velocity[0] = *speed * course_[0]->unit->value * std::sin(*course * degree);
  fix.velocity[1] = *speed * course_[0]->unit->value * std::cos(*course * degree);
}

/// In rad counter-clockwise from east.
double RecordingReader::azimuth_of(double degrees) const {
  if (!(std::abs(degrees) <= 360.0)) throw row_.error(azimuth_->index, "degrees from −360 to 360", "correct the cell");
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
  const bool of_day = is_time_of_day(row_[time_]);
  fix.time_s = of_day ? on_its_day(fix, *time) : *time;
  if (!refused_time(fix)) {
    last_.find(fix.track)->second.of_day = of_day;
    if (of_day) latest_of_day_ = fix.time_s;
    return true;
  }
  if (!skip_bad_times_)
    throw row_.error(
        time_, fmt::format("a time after that of the row before, {}", shortest(last_.find(fix.track)->second.time)),
        sensor_ ? "sort the rows by time and drop repeated ones of one sensor, or give --on-bad-time skip"
                : "sort the rows by time and drop repeated ones, or give --on-bad-time skip");
  ++skipped_;
  return false;
}

/// The time of day with the days since the first. Where it falls by more than half a day within a track, that is the
/// next day. Where it would rise by more than half a day, it is of the day before: a late row of a track, or the first
/// row of one that begins.
double RecordingReader::on_its_day(const Fix& fix, double time_of_day) {
  const auto last = last_.find(fix.track);
  const bool first = last == last_.end();
  if (first ? !latest_of_day_ : !last->second.of_day) return time_of_day;
  const double before = first ? *latest_of_day_ : last->second.time;
  const double midnight = midnight_before(before);
  const double time = first ? midnight + time_of_day : time_of_day_after(before, time_of_day);
  if (time >= day_s && time - before > day_s / 2.0) return time - day_s;
  if (time - midnight >= day_s && midnights_++ == 0) first_midnight_line_ = fix.line;
  return time;
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
    fix.sigma[i] = *sigma * columns[i]->unit->value * (i == 0 ? 1.0 : angle);
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
    result[i] = *cell * columns[i]->unit->value;
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
  const auto add = [&](const std::optional<Column>& column, std::string_view more = {}) {
    if (column)
      parts.push_back(
          fmt::format("{} in {}{}{}", csv_.names()[column->index], column->unit->words, column->quantity->note, more));
  };
  for (const auto& column : position_) add(column);
  add(polar_[0]);
  add(azimuth_, fmt::format(" {}{}", from_north_ ? "clockwise from north" : "counter-clockwise from east",
                            position_[0] && bearings() ? " in rows without a position" : ""));
  add(polar_[2]);
  for (const auto& column : velocity_) add(column);
  for (const auto& column : {course_[0], course_[1], range_rate_}) add(column);
  for (const auto& column : truth_) add(column);
  for (const auto& columns : {sigma_position_, sigma_polar_})
    for (const auto& column : columns) add(column, " for the row's accuracy");
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// The columns of quantities that count.
std::vector<std::optional<RecordingReader::Column>> RecordingReader::used() const {
  std::vector<std::optional<Column>> columns = {azimuth_, course_[0], course_[1], range_rate_};
  for (const auto& three : {position_, polar_, velocity_, truth_, sigma_position_, sigma_polar_})
    columns.insert(columns.end(), three.begin(), three.end());
  return columns;
}

/// Whether a column counts in any way.
bool RecordingReader::uses(std::size_t index) const {
  const auto columns = used();
  return index == time_ || index == sensor_ || index == track_ || index == roll_ ||
         std::any_of(select_.begin(), select_.end(), [&](const auto& wanted) { return wanted.first == index; }) ||
         std::any_of(columns.begin(), columns.end(),
                     [&](const auto& column) { return column && column->index == index; });
}

std::string RecordingReader::why_unused(const Quantity& quantity) const {
  const auto is_of = [&](const auto& quantities) {
    return std::any_of(quantities.begin(), quantities.end(), [&](const auto& one) { return &one == &quantity; });
  };
  for (const auto& column : used())
    if (column && column->quantity == &quantity) return csv_.names()[column->index] + " says it";
  if (!takes_velocity_ && (is_of(headers::velocity) || is_of(headers::course)))
    return simulated_ ? "--radar measures no velocity" : "give --set sigma_velocity_mps=…";
  if (simulated_ && is_of(headers::polar)) return "--radar measures positions";
  if (!takes_range_rate_ && polar() && is_of(headers::range_rate)) return "give --set sigma_range_rate_mps=…";
  return "does not go with the others";
}

std::string RecordingReader::unused() const {
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
  const auto add = [&](std::size_t index, const std::string& reason) {
    const auto same =
        std::find_if(reasons.begin(), reasons.end(), [&](const auto& other) { return other.first == reason; });
    auto& names =
        same == reasons.end() ? reasons.emplace_back(reason, std::vector<std::string>{}).second : same->second;
    names.push_back(csv_.names()[index]);
  };
  for (const auto& quantities : headers::all)
    for (const Quantity& quantity : quantities) {
      bool named = false;
      for_each_header(quantity, [&](const std::string& header, const Unit&) {
        const auto index = find(header);
        named |= index.has_value();
        if (index && !uses(*index)) add(*index, why_unused(quantity));
      });
      for (std::size_t index = 0; index < csv_.names().size() && !named; ++index)
        if (!uses(index) && !is_a_name(csv_.names()[index]) && without_known_unit(csv_.names()[index]) == &quantity)
          add(index, advice(quantity));
    }
  std::vector<std::string> parts;
  for (const auto& [reason, names] : reasons) parts.push_back(fmt::format("{} ({})", fmt::join(names, ", "), reason));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<std::string> RecordingReader::notes() const {
  std::vector<std::string> sentences;
  if (const std::string columns = unused(); !columns.empty()) sentences.push_back("Not used: " + columns);
  if (unused_velocities_ > 0)
    sentences.push_back(
        fmt::format("Velocities do not count in rows of a radar or with a bearing: {} rows", unused_velocities_));
  if (bearings_ > 0 && unused_azimuths_ > 0)
    sentences.push_back(fmt::format("Azimuths do not count in rows with a position: {} rows", unused_azimuths_));
  if (midnights_ > 0)
    sentences.push_back(
        fmt::format("Times of day pass midnight {}, first on line {}; there the time falls by more than 12 h, and days "
                    "are counted from the first",
                    midnights_ == 1 ? "once" : fmt::format("{} times", midnights_), first_midnight_line_));
  return sentences;
}

}  // namespace sigmax::apps
