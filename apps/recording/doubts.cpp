#include "recording/doubts.hpp"

#include <algorithm>
#include <cmath>

#include "recording/plots.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t few = 10, many = 10000;

double distance(const Position& a, const Position& b) {
  double square = 0.0;
  for (std::size_t i = 0; i < 3; ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(square);
}

}  // namespace

void Doubts::Agreement::add(double told_now, double growth) {
  product += told_now * growth;
  told += told_now * told_now;
  grew += growth * growth;
  ++count;
}

void Doubts::see_azimuth(double azimuth, const Position& from_radar) {
  const double true_one = std::atan2(from_radar[1], from_radar[0]);
  as_read_ += std::cos(azimuth - true_one);
  other_way_ += std::cos(90.0 * degree - azimuth - true_one);
  radians_ += std::cos(azimuth / degree - true_one);
  ++azimuths_;
}

void Doubts::see_rates(const Spoke& before, const Spoke& now) {
  const double dt = now.time - before.time;
  if (!(dt > 0.0)) return;
  const double jump = distance(before.position, now.position);
  path_ += jump;
  ++jumps_;
  if (jump == 0.0) ++held_;
  const double range_rate = (before.range_rate + now.range_rate) / 2.0;
  if (!std::isnan(range_rate)) range_rates_.add(range_rate, (now.range - before.range) / dt);
  Position grew{}, told{};
  for (std::size_t i = 0; i < 3; ++i) {
    grew[i] = (now.position[i] - before.position[i]) / dt;
    told[i] = (before.velocity[i] + now.velocity[i]) / 2.0;
  }
  if (!std::isnan(told[2])) climbs_.add(told[2], grew[2]);
  if (std::isnan(told[0] + told[1])) return;
  for (std::size_t i = 0; i < 2; ++i) {
    velocities_.add(told[i], grew[i]);
    swapped_velocities_.add(told[1 - i], grew[i]);
  }
}

void Doubts::see(const Row& row, const std::optional<Position>& position, int axes) {
  const AnyPlot& plot = row.plot;
  const bool is_bearing = plot.sensor == AnyPlot::Sensor::bearing, has_rate = plot.sensor == AnyPlot::Sensor::doppler;
  const bool is_radar = has_rate || plot.sensor == AnyPlot::Sensor::polar;
  Track& track = tracks_[row.track];
  const auto& reference = row.truth ? row.truth : track.located;
  if ((is_bearing || is_radar) && reference)
    see_azimuth(plot.z[is_bearing ? 0 : 1], {(*reference)[0] - plot.origin[0], (*reference)[1] - plot.origin[1], 0.0});
  if (!position || axes_seen(plot, axes) < axes) return;
  Position velocity{nan, nan, nan};
  for (int i = 0; i < axes && axes > 1; ++i)
    velocity[static_cast<std::size_t>(i)] = component_of(plot, axes + i).value_or(nan);
  const Spoke now{plot.time, *position, velocity, is_radar ? plot.z[0] : 0.0,
                  has_rate ? plot.z[static_cast<std::size_t>(plot.size) - 1] : nan};
  const auto [before, first] = track.spoke.try_emplace(row.sensor, now);
  if (!first) see_rates(std::exchange(before->second, now), now);
  if (!is_radar) track.located = position;
  if (!track.first) {
    track.first = position;
    track.first_time = plot.time;
  } else if (steps_.size() < many) {
    steps_.push_back(plot.time - track.time);
  }
  track.last = position;
  track.time = plot.time;
}

double Doubts::median_step() const {
  std::vector<double> steps = steps_;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

std::vector<std::string> Doubts::sentences(const RecordingReader& recording) const {
  std::vector<std::string> sentences;
  const auto say = [&](bool holds, std::string_view format, const auto&... words) {
    if (holds) sentences.push_back(recording.file() + ": " + fmt::format(fmt::runtime(format), words...));
  };
  say(range_rates_.count >= few && range_rates_.correlation() < -0.5,
      "the range rates have the other sign than the growth of the ranges (correlation {:.2f}); where a radar counts "
      "closing as positive, its column is closing_rate_mps, else range_rate_mps: name it {}",
      range_rates_.correlation(), recording.counts_closing() ? "range_rate_mps" : "closing_rate_mps");
  const bool swapped = swapped_velocities_.correlation() > 0.9 && velocities_.correlation() < 0.5;
  say(velocities_.count >= few && swapped,
      "the velocities do not fit how the positions grow, but would if the first were the second: vx is along x, or "
      "east, vy along y, or north, and a course is clockwise from north");
  say(climbs_.count >= few && climbs_.correlation() < -0.7,
      "the vertical velocities have the other sign than the growth of the heights (correlation {:.2f}): vz and a "
      "vertical rate are upwards",
      climbs_.correlation());
  const double growth = velocities_.growth_per_told();
  say(velocities_.count >= few && velocities_.correlation() > 0.9 && !(growth > 0.7 && growth < 1.4),
      "the velocities are {:.2g} times what the positions say: see whether their unit, or that of the positions or "
      "times, is that of their header",
      1.0 / growth);
  const auto n = static_cast<double>(azimuths_);
  // 1 − cos of an error is half of its square: so it is three times as great, and above 2.5°.
  const auto fits = [&](double sum) { return azimuths_ >= few && n - as_read_ > std::max(9.0 * (n - sum), 1e-3 * n); };
  const char* const reference = recording.has_truth() ? "truth" : "positions";
  say(fits(other_way_), "the azimuths do not fit the {}, but would if they ran {}: {}", reference,
      recording.from_north() ? "counter-clockwise from east" : "clockwise from north",
      recording.from_north() ? "name the column azimuth_deg, without --azimuth-from" : "give --azimuth-from north");
  say(fits(radians_) && !recording.from_north(),
      "the azimuths do not fit the {}, but would if they were radians: name the column azimuth_rad", reference);
  double moved = 0.0, duration = 0.0;
  for (const auto& [name, track] : tracks_) {
    if (!track.first) continue;
    duration += track.time - track.first_time;
    moved += distance(*track.first, *track.last);
  }
  // What stays where it is repeats itself, too; but its way is much longer than the distance that it comes.
  say(held_ >= few && 4 * held_ > jumps_ && moved > 0.5 * path_,
      "{} of {} positions repeat the one before to the last digit, although the target moves: values that are held "
      "count "
      "as new measurements, and the filters take their estimates for better than they are; leave one row of each",
      held_, jumps_);
  if (steps_.size() < few || !recording.times_are_seconds()) return sentences;
  const double step = median_step(), speed = moved / duration;
  const bool in_minutes = std::fmod(step, 300.0) == 0.0 && std::fmod(step, 1000.0) != 0.0;  // as an hour: what is slow
  for (const TimeColumn& unit : time_columns)
    // From a tenth of a second to twenty seconds, and from 0.5 m/s to 500 m/s.
    say(unit.unit_s < 1.0 && !in_minutes && step * unit.unit_s >= 0.1 && step * unit.unit_s <= 20.0 &&
            speed / unit.unit_s >= 0.5 && speed / unit.unit_s < 500.0,
        "times that are {:.6g} s apart, and a speed of {:.2g} m/s: these look like {}; name the column {}, if they are",
        step, speed, unit.unit_s == 1e-3 ? "milliseconds" : "microseconds", unit.name);
  say(speed > 1.2e4,  // nothing on the Earth or about it is as fast
      "a speed of {:.2g} m/s, where times are {:.2g} s apart: if times are not seconds, name the column "
      "time_min, time_h or time_days",
      speed, step);
  return sentences;
}

}  // namespace sigmax::apps
