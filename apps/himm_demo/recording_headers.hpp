#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "support/angle.hpp"

namespace sigmax::apps {

/// A header that names a quantity with its unit.
struct Header {
  std::string_view name;
  double unit;  ///< in m, m/s or degrees; numbers are multiplied with it
  std::string_view taken_for;
  bool from_north = false;  ///< of an azimuth: clockwise from north
};
using Headers = std::span<const Header>;

/// The headers of what a row may say, those that come first winning.
namespace headers {

inline constexpr double foot = 0.3048;
inline constexpr double knot = 1852.0 / 3600.0;

inline constexpr Header x[] = {{"x_m", 1.0, "m"}, {"x_km", 1e3, "km"}};
inline constexpr Header y[] = {{"y_m", 1.0, "m"}, {"y_km", 1e3, "km"}};
inline constexpr Header z[] = {{"z_m", 1.0, "m"}, {"z_km", 1e3, "km"}, {"z_ft", foot, "ft"}};
inline constexpr Header latitude[] = {{"latitude_deg", 1.0, "° north"}};
inline constexpr Header longitude[] = {{"longitude_deg", 1.0, "° east"}};
inline constexpr Header altitude[] = {{"altitude_m", 1.0, "m above the ellipsoid"},
                                      {"altitude_gnss_ft", foot, "ft above the ellipsoid"},
                                      {"altitude_ft", foot, "ft above the ellipsoid"}};
inline constexpr Header range[] = {
    {"range_m", 1.0, "m"}, {"range_km", 1e3, "km"}, {"range_nmi", 1852.0, "nautical miles"}, {"range_ft", foot, "ft"}};
inline constexpr Header azimuth[] = {{"azimuth_deg", 1.0, "°"},
                                     {"azimuth_rad", 1.0 / degree, "rad"},
                                     {"azimuth_deg_north", 1.0, "°", true},
                                     {"azimuth_rad_north", 1.0 / degree, "rad", true}};
inline constexpr Header elevation[] = {{"elevation_deg", 1.0, "° above the horizon"},
                                       {"elevation_rad", 1.0 / degree, "rad above the horizon"}};
inline constexpr Header range_rate[] = {{"range_rate_mps", 1.0, "m/s"}, {"range_rate_kt", knot, "kt"}};
inline constexpr Header velocity_x[] = {{"vx_mps", 1.0, "m/s"}};
inline constexpr Header velocity_y[] = {{"vy_mps", 1.0, "m/s"}};
inline constexpr Header velocity_z[] = {{"vz_mps", 1.0, "m/s"},
                                        {"vertical_rate_mps", 1.0, "m/s upwards"},
                                        {"vertical_rate_fpm", foot / 60.0, "ft/min upwards"}};
inline constexpr Header speed[] = {{"groundspeed_mps", 1.0, "m/s"},
                                   {"groundspeed_kt", knot, "kt"},
                                   {"speed_mps", 1.0, "m/s"},
                                   {"speed_kt", knot, "kt"}};
inline constexpr Header course[] = {{"track_deg", 1.0, "° clockwise from north"},
                                    {"course_deg", 1.0, "° clockwise from north"}};

}  // namespace headers

/// What `--columns` maps: from the names above, and those that have no unit to choose, to the headers of a file. Throws
/// UsageError for what it does not know.
std::map<std::string, std::string, std::less<>> mapping_of(const std::vector<std::string>& columns);

}  // namespace sigmax::apps
