#include "himm_demo/recording.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sigmax::apps {
namespace {

constexpr double foot = 0.3048;
constexpr std::array<std::string_view, 10> known = {"time_s",       "x_m",           "y_m",        "z_m",
                                                    "latitude_deg", "longitude_deg", "altitude_m", "altitude_gnss_ft",
                                                    "altitude_ft",  "roll_deg"};

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

}  // namespace

RecordingReader::RecordingReader(const std::string& file, const std::vector<std::string>& columns,
                                 std::optional<std::array<double, 3>> origin)
    : csv_(file) {
  const Mapping mapping = mapping_of(columns);
  const auto find = [&](std::string_view name) -> std::optional<std::size_t> {
    const auto mapped = mapping.find(name);
    return mapped == mapping.end() ? csv_.find(name) : csv_.column(mapped->second);
  };
  const auto time = find("time_s");
  x_ = find("x_m");
  y_ = find("y_m");
  z_ = find("z_m");
  latitude_ = find("latitude_deg");
  longitude_ = find("longitude_deg");
  roll_ = find("roll_deg");
  for (const auto& [name, unit] : {std::pair{"altitude_m", 1.0}, {"altitude_gnss_ft", foot}, {"altitude_ft", foot}})
    if (!altitude_ && (altitude_ = find(name))) altitude_unit_ = unit;

  const bool cartesian = x_ && y_;
  const bool geodetic = latitude_ && longitude_ && altitude_;
  if (!time || cartesian == geodetic) {
    std::string what = !time       ? "there is no column time_s"
                       : cartesian ? "there are columns of both kinds"
                                   : "its columns are of neither kind";
    throw InputError(message({.where = csv_.file() + ":1",
                              .what = what,
                              .found = fmt::format("{}", fmt::join(csv_.names(), ", ")),
                              .expected = "time_s,x_m,y_m[,z_m] or time_s,latitude_deg,longitude_deg,altitude_m (or "
                                          "altitude_gnss_ft, altitude_ft)",
                              .remedy = "map other headers with --columns, as in --columns time_s=t,x_m=east"}));
  }
  time_ = *time;
  if (cartesian) {
    latitude_.reset();
    longitude_.reset();
    altitude_.reset();
    if (origin) throw UsageError("--origin is for geodetic input, but " + csv_.file() + " is Cartesian");
  }
  if (origin) {
    try {
      frame_.emplace(Geodetic::from_degrees((*origin)[0], (*origin)[1], (*origin)[2]));
    } catch (const std::invalid_argument& error) {
      throw UsageError(fmt::format("--origin: {}", error.what()));
    }
  }
}

bool RecordingReader::next(Fix& fix) {
  if (!csv_.next(row_)) return false;
  fix.line = row_.line();
  fix.time_s = row_.number(time_);
  if (last_time_ && !(fix.time_s > *last_time_))
    throw row_.error(time_, fmt::format("a time after that of the row before, {}", *last_time_),
                     "sort the rows by time and drop repeated ones");
  last_time_ = fix.time_s;
  fix.roll_deg = roll_ ? row_.optional_number(*roll_) : std::nullopt;
  fix.position.reset();

  std::array<std::optional<double>, 3> cells;
  const std::array<std::optional<std::size_t>, 3> columns =
      geodetic() ? std::array{latitude_, longitude_, altitude_} : std::array{x_, y_, z_};
  std::size_t filled = 0;
  std::size_t wanted = 0;
  std::size_t empty = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!columns[i]) continue;
    ++wanted;
    cells[i] = row_.optional_number(*columns[i]);
    if (cells[i])
      ++filled;
    else
      empty = *columns[i];
  }
  if (filled == 0) return true;  // a missed measurement
  if (filled != wanted)
    throw row_.error(empty, "a number, since the row's other coordinates are there", "fill the cell or empty them all");
  if (!geodetic()) {
    fix.position = Vector<3>(*cells[0], *cells[1], cells[2].value_or(0.0));
    return true;
  }
  Geodetic point;
  try {
    point = Geodetic::from_degrees(*cells[0], *cells[1], altitude_unit_ * *cells[2]);
  } catch (const std::invalid_argument& error) {
    throw row_.error(std::abs(*cells[0]) > 90.0 ? *latitude_ : *longitude_, error.what());
  }
  if (!frame_) frame_.emplace(point);
  const EastNorthUp local = frame_->to_local(point);
  fix.position = Vector<3>(local.east, local.north, local.up);
  return true;
}

}  // namespace sigmax::apps
