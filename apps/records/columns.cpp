// What the columns of a recording are: which count, what they were taken for, and why others do not count.

#include "records/recording.hpp"
#include "table/timestamp.hpp"

namespace sigmax::apps {
namespace {

/// Whether a header is that of names rather than numbers: track_id.
bool is_a_name(std::string_view header) {
  constexpr std::string_view endings[] = {"_id", "_name", "_no", "_number", "_type"};
  return std::ranges::any_of(endings, [&](std::string_view ending) { return header.ends_with(ending); });
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

}  // namespace

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
  if (const auto warning = time_format_warning(options.time_format); !warning.empty())
    throw UsageError("--time-format '{}': {}", options.time_format, warning);
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
  const std::size_t usable = located() && !options_.simulated ? axes : 0;
  drop(Role::covariance, covariances(usable));
  const bool has_variance = has(Role::covariance) || has(Role::covariance, 2) || has(Role::covariance, 5);
  drop(Role::sigma_position, has_variance ? 0 : usable);
  if (usable == 0 || has_variance) drop(Role::sigma_all_axes);
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
      {has(Role::sensor_position) && has(Role::sensor_place), "the place of a sensor is given in two ways",
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
        if (other.words != columns_[q]->unit->words && names_unit(header_of(q), other.suffix) &&
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

}  // namespace sigmax::apps
