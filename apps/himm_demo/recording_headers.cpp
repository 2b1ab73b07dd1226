#include "himm_demo/recording_headers.hpp"

#include <algorithm>
#include <initializer_list>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "support/error.hpp"

namespace sigmax::apps {
namespace {

constexpr std::string_view others[] = {"time_s",    "sensor",        "true_x_m",          "true_y_m",
                                       "true_z_m",  "roll_deg",      "sigma_x_m",         "sigma_y_m",
                                       "sigma_z_m", "sigma_range_m", "sigma_azimuth_deg", "sigma_elevation_deg"};

std::vector<std::string_view> known_headers() {
  std::vector<std::string_view> names(std::begin(others), std::end(others));
  for (const Headers headers : std::initializer_list<Headers>{
           headers::x, headers::y, headers::z, headers::latitude, headers::longitude, headers::altitude, headers::range,
           headers::azimuth, headers::elevation, headers::range_rate, headers::velocity_x, headers::velocity_y,
           headers::velocity_z, headers::speed, headers::course})
    for (const auto& header : headers) names.push_back(header.name);
  return names;
}

}  // namespace

std::map<std::string, std::string, std::less<>> mapping_of(const std::vector<std::string>& columns) {
  std::map<std::string, std::string, std::less<>> mapping;
  const auto known = known_headers();
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

}  // namespace sigmax::apps
