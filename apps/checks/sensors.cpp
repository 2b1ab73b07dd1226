// Sensors against each other or against the truth: where they stand, their north, clock, range and how they are read.

#include "checks/checks.hpp"

namespace sigmax::apps::checks {
namespace {

/// Another way to read a radar's cells, and how to have them read so: angles are numbers times those that were read,
/// and more.
struct Rereading {
  std::string_view text;
  double azimuth = 1.0, more_azimuth = 0.0, range = 1.0;
  std::optional<AzimuthFrom> if_read = std::nullopt;  ///< so, else it is no other way
};

constexpr double right = 90.0 * degree;
constexpr Rereading as_read = {""};

constexpr Rereading rereadings[] = {
    {"azimuths run the other way (mirrored), clockwise from north: give --azimuth-from north", -1, right, 1,
     AzimuthFrom::east},
    {"azimuths run the other way (mirrored), counter-clockwise from east: name them azimuth_deg", -1, right, 1,
     AzimuthFrom::north},
    {"azimuths run the other way (mirrored), clockwise from ahead: give --azimuth-from ahead", -1},
    {"azimuths run the other way (mirrored), counter-clockwise from north: take them from 360°", -1, 2 * right},
    {"azimuths count from another axis: add 90°, as where east was taken for north", 1, -right},
    {"azimuths count from another axis: take 90° off, as where north was taken for east", 1, right},
    {"the unit of ranges is km: name them range_km", 1, 0, 1e3},
    {"the unit of ranges is feet: name them range_ft", 1, 0, units::foot}};

Vector position(const Record& row, const Rereading& read) {
  if (!row.is_radar()) return row.at;
  return row.from + to_cartesian({read.range * row.range, radians(read.azimuth * row.azimuth + read.more_azimuth),
                                  radians(row.elevation)});
}

/// A row of one sensor off what another one, or the truth, says at its time: where that is, and how fast.
struct Off {
  Vector by, other, velocity;
  double time;
};

/// The rows of `one` between two of `other`, both read so; against the truth if `other` is none.
std::vector<Off> offs_of(const Records& records, std::size_t one, std::optional<std::size_t> other,
                         const Rereading& one_read, const Rereading& other_read) {
  constexpr std::size_t most = 4000, about = 4;
  std::vector<Off> offs;
  for (const auto& [name, track] : records.tracks) {
    const Record* last = nullptr;        // of the other
    std::vector<const Record*> waiting;  // rows of one since
    const std::size_t begin = offs.size();
    const auto add = [&](const Record& row, const Vector& from, const Vector& to, double since, double T) {
      const Vector at = from + since / T * (to - from);
      if (T > 0.0 && offs.size() < most) offs.push_back({position(row, one_read) - at, at, Vector::Zero(), row.time});
    };
    for (const Record& row : track.rows) {
      if (std::isnan(row.at[0])) continue;
      if (!other && row.sensor == one && !std::isnan(row.truth[0])) {
        if (last) add(row, last->truth, row.truth, row.time - last->time, row.time - last->time);
        last = &row;
      }
      if (other && row.sensor == one && last) waiting.push_back(&row);
      if (!other || row.sensor != *other) continue;
      for (const Record* const each : waiting)
        add(*each, position(*last, other_read), position(row, other_read), each->time - last->time,
            row.time - last->time);
      waiting.clear();
      last = &row;
    }
    // From row to row the velocity of a slow target is mostly noise.
    for (std::size_t k = begin + about; k + about < offs.size(); ++k)
      if (const Off& from = offs[k - about], &to = offs[k + about]; to.time > from.time)
        offs[k].velocity = (to.other - from.other) / (to.time - from.time);
  }
  return offs;
}

Reading reading_of(const std::vector<Off>& offs, std::string text, double parameters, const auto& correction) {
  Reading reading{std::move(text), {}, parameters};
  for (const Off& off : offs) reading.off.push_back((off.by - correction(off)).squaredNorm());
  return reading;
}

std::vector<Reading> readings_of_sensors(const Records& records, std::size_t one, std::optional<std::size_t> other) {
  const auto offs = offs_of(records, one, other, as_read, as_read);
  const auto nothing = [](const Off&) -> Vector { return Vector::Zero(); };
  std::vector<Reading> readings = {reading_of(offs, "", 0, nothing)};
  const auto named = [&](std::size_t sensor) {
    return records.sensors[sensor].empty() ? "" : fmt::format("sensor '{}': ", records.sensors[sensor]);
  };
  const bool own = records.radars.contains(one), others = other && records.radars.contains(*other);
  for (const Rereading& reading : rereadings) {
    if (reading.if_read && reading.if_read != records.recording.azimuth_from()) continue;
    const auto add = [&](const Rereading& one_read, const Rereading& other_read, std::size_t whose) {
      readings.push_back(reading_of(offs_of(records, one, other, one_read, other_read),
                                    named(whose).append(reading.text), 0.5, nothing));
    };
    if (own) add(reading, as_read, one);
    if (others) add(as_read, reading, *other);
  }
  const auto median_over = [&](const auto& number) {
    std::vector<double> numbers;
    for (const Off& off : offs) numbers.push_back(number(off));
    return median_of(std::move(numbers));
  };
  Vector shift;
  for (Eigen::Index i = 0; i < 3; ++i) shift[i] = median_over([=](const Off& off) { return off.by[i]; });
  readings.push_back(
      reading_of(offs,
                 fmt::format("{}its place is ({:.3g}, {:.3g}, {:.3g}) m off {}; correct where it stands{}", named(one),
                             shift[0], shift[1], shift[2], other ? "'" + records.sensors[*other] + "'" : "the truth",
                             named(one).empty() ? "" : fmt::format(", by sensor.{}.at", records.sensors[one])),
                 static_cast<double>(records.axes), [=](const Off&) { return shift; }));
  // Off by a number times something of each row.
  const auto add_times = [&](double least, const auto& of, const auto& text) {
    const double times = median_over([&](const Off& off) { return off.by.dot(of(off)) / of(off).squaredNorm(); });
    if (std::abs(times) > least)
      readings.push_back(reading_of(offs, text(times), 1, [=](const Off& off) -> Vector { return times * of(off); }));
  };
  add_times(
      0.02, [](const Off& off) { return off.velocity; },
      [&](double times) {
        return fmt::format("{}its clock is {:.2g} s {}; correct its times", named(one), std::abs(times),
                           times > 0.0 ? "early" : "late");
      });
  for (const auto& [sensor, sign] : {std::pair(one, 1.0), std::pair(other.value_or(one), other ? -1.0 : 0.0)}) {
    if (sign == 0.0 || !records.radars.contains(sensor)) continue;
    const auto away = [from = records.radars.at(sensor), times = sign](const Off& off) -> Vector {
      return times * (off.other - from);
    };
    const std::string whose = named(sensor);
    add_times(
        0.3 * degree, [=](const Off& off) { return Vector(-away(off)[1], away(off)[0], 0.0); },
        [&](double times) {
          return fmt::format("{}its north is off: azimuths are turned by {:.2g}° {}; turn them back", whose,
                             std::abs(times) / degree, times > 0.0 ? "counter-clockwise" : "clockwise");
        });
    add_times(
        0.0, [=](const Off& off) -> Vector { return away(off).normalized(); },
        [&](double times) {
          return fmt::format("{}its ranges have a bias: they are {:.3g} m too {}{}; correct them", whose,
                             std::abs(times), times > 0.0 ? "long" : "short",
                             times > 0.0 && records.axes == 2 ? ", as slant ranges are, not along the ground" : "");
        });
  }
  return readings;
}

}  // namespace

void check_sensors(const Records& records, Findings& findings) {
  for (std::size_t one = 0; one < records.sensors.size(); ++one)
    for (std::size_t other = 0; other <= one; ++other) {  // itself stands for the truth
      const auto readings = readings_of_sensors(records, one, other == one ? std::nullopt : std::optional(other));
      const Reading* const found = better(readings);
      if (!found) continue;
      findings.push_back({"", records.tracks.begin()->second.rows.front().line, found->text});
      return;
    }
}

}  // namespace sigmax::apps::checks
