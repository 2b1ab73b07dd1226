#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shell/text.hpp"

namespace sigmax::apps {

/// How a header says the unit of its numbers: `range_nmi`.
struct Unit {
  std::string_view suffix;
  double value;  ///< in m, m/s or degrees; numbers are multiplied with it
  std::string_view words;
  bool from_north = false;  ///< of an azimuth: clockwise from north
};

namespace units {

inline constexpr double foot = 0.3048;
inline constexpr double nautical_mile = 1852.0;
inline constexpr double mile = 1609.344;
inline constexpr double hour = 3600.0;

inline constexpr Unit lengths[] = {
    {"m", 1.0, "m"},       {"km", 1e3, "km"},  {"ft", foot, "ft"}, {"nmi", nautical_mile, "nautical miles"},
    {"mi", mile, "miles"}, {"cm", 1e-2, "cm"}, {"mm", 1e-3, "mm"}, {"yd", 3.0 * foot, "yards"}};
inline constexpr Unit areas[] = {{"m2", 1.0, "m²"}, {"", 1.0, "m²"}};
inline constexpr Unit speeds[] = {
    {"mps", 1.0, "m/s"},         {"kmh", 1e3 / hour, "km/h"}, {"kt", nautical_mile / hour, "kt"},
    {"mph", mile / hour, "mph"}, {"fps", foot, "ft/s"},       {"fpm", foot / 60.0, "ft/min"},
    {"cmps", 1e-2, "cm/s"},      {"mmps", 1e-3, "mm/s"}};
inline constexpr auto closing_speeds = [] {  // of ranges that fall
  auto all = std::to_array(speeds);
  for (Unit& unit : all) unit.value = -unit.value;
  return all;
}();
inline constexpr Unit angles[] = {{"deg", 1.0, "°"}, {"rad", 1.0 / degree, "rad"}};
inline constexpr Unit azimuths[] = {{"deg", 1.0, "°"},
                                    {"rad", 1.0 / degree, "rad"},
                                    {"deg_north", 1.0, "°", true},
                                    {"rad_north", 1.0 / degree, "rad", true}};
inline constexpr Unit bearings[] = {{"deg", 1.0, "°", true}, {"rad", 1.0 / degree, "rad", true}};

}  // namespace units

/// Where a number of a row goes: those of a role make one position, one measurement, one truth.
enum class Role {
  position,
  place,
  polar,
  velocity,
  course,
  range_rate,
  truth,
  sigma_position,
  sigma_all_axes,
  covariance,
  sigma_polar,
  sensor_position,
  sensor_place
};

/// What a row may say: its headers are a stem and a unit. The unit that comes first wins, then the stem: altitude_m
/// before altitude_gnss_ft, that before altitude_ft.
struct Quantity {
  Role role;
  std::array<std::string_view, 3> stems;  ///< those after the first may be empty
  std::span<const Unit> units;
  std::string_view note = {};  ///< what the unit alone does not say
};

/// All of them: those of a role in the order of the axes, or of range, azimuth and elevation; covariances row by row,
/// as far as their diagonal; the range rate, the azimuth and the elevation, and what stands for them.
inline constexpr std::array<Quantity, 40> quantities = {
    {{Role::position, {"x"}, units::lengths},
     {Role::position, {"y"}, units::lengths},
     {Role::position, {"z"}, units::lengths},
     {Role::place, {"latitude"}, units::angles, " north"},
     {Role::place, {"longitude"}, units::angles, " east"},
     {Role::place, {"altitude_gnss", "altitude"}, units::lengths, " above the ellipsoid"},
     {Role::polar, {"range"}, units::lengths},
     {Role::polar, {"azimuth"}, units::azimuths},
     {Role::polar, {"elevation"}, units::angles, " above the horizon"},
     {Role::polar, {"bearing"}, units::bearings},
     {Role::polar, {"zenith"}, units::angles, " from the zenith"},
     {Role::velocity, {"vx"}, units::speeds},
     {Role::velocity, {"vy"}, units::speeds},
     {Role::velocity, {"vz", "vertical_rate"}, units::speeds, " upwards"},
     {Role::course, {"groundspeed", "speed", "sog"}, units::speeds},
     {Role::course, {"track", "course", "cog"}, units::angles, " clockwise from north"},
     {Role::range_rate, {"range_rate"}, units::speeds},
     {Role::range_rate, {"closing_rate"}, units::closing_speeds},
     {Role::truth, {"true_x"}, units::lengths},
     {Role::truth, {"true_y"}, units::lengths},
     {Role::truth, {"true_z"}, units::lengths},
     {Role::sigma_position, {"sigma_x", "std_x"}, units::lengths},
     {Role::sigma_position, {"sigma_y", "std_y"}, units::lengths},
     {Role::sigma_position, {"sigma_z", "std_z"}, units::lengths},
     {Role::sigma_all_axes, {"sigma_position"}, units::lengths},
     {Role::covariance, {"cov_xx", "var_x"}, units::areas},
     {Role::covariance, {"cov_xy"}, units::areas},
     {Role::covariance, {"cov_yy", "var_y"}, units::areas},
     {Role::covariance, {"cov_xz"}, units::areas},
     {Role::covariance, {"cov_yz"}, units::areas},
     {Role::covariance, {"cov_zz", "var_z"}, units::areas},
     {Role::sigma_polar, {"sigma_range"}, units::lengths},
     {Role::sigma_polar, {"sigma_azimuth", "sigma_bearing"}, units::angles},
     {Role::sigma_polar, {"sigma_elevation"}, units::angles},
     {Role::sensor_position, {"sensor_x"}, units::lengths},
     {Role::sensor_position, {"sensor_y"}, units::lengths},
     {Role::sensor_position, {"sensor_z"}, units::lengths},
     {Role::sensor_place, {"sensor_latitude"}, units::angles, " north"},
     {Role::sensor_place, {"sensor_longitude"}, units::angles, " east"},
     {Role::sensor_place, {"sensor_altitude"}, units::lengths, " above the ellipsoid"}}};

/// Headers of times, and the unit of their numbers, in s; one that --columns names counts, else the first that there
/// is.
struct TimeColumn {
  std::string_view name;
  double unit_s;
  std::string_view words;
};
inline constexpr TimeColumn time_columns[] = {
    {"time_s", 1.0, "s"},          {"time_ms", 1e-3, "ms"},     {"time_us", 1e-6, "µs"},       {"time_ns", 1e-9, "ns"},
    {"time_min", 60.0, "minutes"}, {"time_h", 3600.0, "hours"}, {"time_days", 86400.0, "days"}};

/// Where a role begins among them, and how many it has.
constexpr std::size_t place_of(Role role) {
  return static_cast<std::size_t>(std::ranges::find(quantities, role, &Quantity::role) - quantities.begin());
}
constexpr std::size_t size_of(Role role) {
  return static_cast<std::size_t>(std::ranges::count(quantities, role, &Quantity::role));
}

/// Whether it is how accurate others of the row are.
constexpr bool is_accuracy(Role role) {
  return role == Role::covariance || role == Role::sigma_position || role == Role::sigma_all_axes ||
         role == Role::sigma_polar;
}

/// So many covariances has a matrix of so many rows, as far as their diagonal.
constexpr std::size_t covariances(std::size_t rows) { return rows * (rows + 1) / 2; }

/// Whether a header names a unit at its end: altitude_ft, Altitude (ft), X [ft].
bool names_unit(std::string_view header, std::string_view unit);

/// Calls `use(header, unit)` for each header of a quantity, in order.
template <class Use>
void for_each_header(const Quantity& quantity, const Use& use) {
  for (const Unit& unit : quantity.units)
    for (const std::string_view stem : quantity.stems)
      if (!stem.empty()) use(std::string(stem).append(unit.suffix.empty() ? "" : "_").append(unit.suffix), unit);
}

/// What a column of this name holds where there is no number: AIS has such numbers (ITU-R M.1371). They are of that
/// name alone; a `course_deg` of 360 is one.
std::optional<double> not_available(std::string_view header);

/// The quantity that a header seems to name without a unit that is read, as `range_furlong` or `x`; or null.
const Quantity* without_known_unit(std::string_view header);

/// "track_deg or course_deg": its names, in the first of its units.
std::string names_of(const Quantity& quantity);

/// "name its unit: _m, _km or _ft"
std::string advice(const Quantity& quantity);

/// What `--columns` maps: from the names above, and those that have no unit to choose, to the headers of a file. Throws
/// UsageError for what it does not know.
std::map<std::string, std::string, std::less<>> mapping_of(const std::vector<std::string>& columns);

}  // namespace sigmax::apps
