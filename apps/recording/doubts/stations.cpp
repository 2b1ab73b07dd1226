#include "recording/doubts/stations.hpp"

#include "support/text.hpp"

namespace sigmax::apps::doubts {
namespace {

/// Whether two rays in the plane cross.
bool cross(const Position& a, double alpha, const Position& b, double beta) {
  const double x = b[0] - a[0], y = b[1] - a[1], turn = std::sin(beta - alpha);
  return (x * std::sin(beta) - y * std::cos(beta)) * turn > 0.0 &&
         (x * std::sin(alpha) - y * std::cos(alpha)) * turn > 0.0;
}

}  // namespace

void Stations::see(const AnyPlot& plot, const std::optional<Vector<3>>& reference, std::optional<Bearing>& before) {
  const bool is_bearing = plot.sensor == AnyPlot::Sensor::bearing;
  const double azimuth = plot.z[is_bearing ? 0 : 1], north = 90.0 * degree;
  const Position& from = plot.origin;
  see(Vector<3>(from.data()));
  if (reference) {
    const double true_one = std::atan2((*reference)[1] - from[1], (*reference)[0] - from[0]);
    as_read_ += std::cos(azimuth - true_one);
    other_way_ += std::cos(north - azimuth - true_one);
    radians_ += std::cos(azimuth / degree - true_one);
    ++azimuths_;
  }
  if (!is_bearing) return;
  if (before && from != before->from && std::abs(std::sin(azimuth - before->azimuth)) > 0.1) {
    ++pairs_;
    if (cross(before->from, before->azimuth, from, azimuth)) ++crossing_;
    if (cross(before->from, north - before->azimuth, from, north - azimuth)) ++crossing_other_;
  }
  const Eigen::Array3d here(from.data());
  const double step = before ? (here - Eigen::Array3d(before->from.data())).matrix().norm() : 0.0;
  ++places_.count;
  if (step > 0.0) ++places_.moves;
  places_.way += step;
  places_.least = places_.least.min(here);
  places_.greatest = places_.greatest.max(here);
  before = {from, azimuth};
}

bool Stations::from_one_that_moves() const {
  const auto& [count, moves, way, least, greatest] = places_;
  return 2 * moves > count && 10.0 * way < static_cast<double>(count) * (greatest - least).matrix().norm();
}

void Stations::see_path(const Vector<3>& at, const AnyPlot& plot, Path& path) {
  const Position& from = plot.origin;
  const bool moves = path.from && *path.from != from;
  path.from = from;
  path.at[0].keep({at[0], at[1], 0.0});
  path.at[1].keep({from[0] + at[1] - from[1], from[1] + at[0] - from[0], 0.0});
  path.times.keep(plot.time);
  constexpr std::size_t lag = 3, twice = 2 * lag;  // over which a turn shows beyond noise
  if (!moves || !path.times.reaches(twice)) return;
  ++bends_.count;
  for (std::size_t i = 0; i < bends_.sums.size(); ++i) {
    const auto& way = path.at[i];
    bends_.sums[i] +=
        length(off_the_way(path.times[lag], way[lag], path.times[twice], way[twice], path.times[0], way[0]));
  }
}

void Stations::see_error(const Spoke& last, const Spoke& now) {
  const double off = length(now.error);
  if (std::isnan(off + last.error[0])) return;
  ++errors_;
  off_ += off;
  if (off > 5.0 * length(now.error - last.error)) ++same_;
  const Vector<3> velocity = (now.at - now.error - last.at + last.error) / (now.time - last.time);
  for (Eigen::Index i = 0; i < 3; ++i) lag_.add(velocity[i], now.error[i]);
  error_ += now.error.array();
  square_ += now.error.array().square();
  next_ += now.error.array() * last.error.array();
}

void Stations::see_other(const std::string& sensor, const Spoke& last, const Spoke& now, const Vector<3>& bend,
                         const std::string& other, const Spoke& told) {
  constexpr std::size_t most_pairs = 100, enough = 1000;
  const std::pair pair(sensor, other);
  const auto known = apart_.find(pair);
  if (known == apart_.end() ? apart_.size() == most_pairs : known->second.size() == enough) return;
  apart_[pair].push_back({off_the_way(told.time, told.at, last.time, last.at, now.time, now.at),
                          (now.at - last.at) / (now.time - last.time), told.at, told.from_radar, dot(bend, bend)});
}

/// What accounts for most of it, in each quarter of the rows, since errors that last come and go: a shift, or so many
/// times something of the row. Empty if nothing does.
std::string Stations::why_apart(std::vector<Off> rows, int axes) {
  const auto median_of = [](std::span<const Off> some, const auto& number) {
    std::vector<double> all;
    for (const Off& row : some)
      if (const double one = number(row); std::isfinite(one)) all.push_back(one);
    return all.size() < few / 4 ? nan : median(all);
  };
  const auto of_all = [&](const auto& number) { return median_of(rows, number); };
  struct Cause {
    std::string words;
    std::function<Vector<3>(const Off&)> off;
  };
  std::vector<Cause> causes;
  const auto left_of = [&](std::span<const Off> some, const Cause& cause) {
    return median_of(some, [&](const Off& row) { return std::pow(length(row.by - cause.off(row)), 2); });
  };
  Vector<3> shift;
  for (Eigen::Index i = 0; i < 3; ++i) shift[i] = of_all([&](const Off& row) { return row.by[i]; });
  causes.push_back({fmt::format("{:.3g} m away, by ({})", length(shift), numbers_of(shift, axes)),
                    [shift](const Off&) { return shift; }});
  const auto consider = [&](std::string_view format, double unit, const std::function<Vector<3>(const Off&)>& of) {
    const double times = of_all([&](const Off& row) { return dot(row.by, of(row)) / dot(of(row), of(row)); });
    causes.push_back({fmt::format(fmt::runtime(format), std::abs(times) / unit, times > 0.0 ? "early" : "late"),
                      [of, times](const Off& row) -> Vector<3> { return times * of(row); }});
  };
  causes.push_back({"told with x for y", [](const Off& row) {
                      const double by = row.at[0] - row.at[1];
                      return Vector<3>(by, -by, 0.0);
                    }});
  const auto across = [](const Vector<3>& at) { return Vector<3>(-at[1], at[0], 0.0); };
  // From row to row the velocity of a slow target is mostly noise, and that of a quick one turns.
  constexpr std::size_t about = 8;
  for (std::size_t i = about; i + about < rows.size(); ++i) {
    rows[i].way = Vector<3>::Zero();
    for (std::size_t k = i - about; k <= i + about; ++k) rows[i].way += rows[k].velocity / (2.0 * about + 1.0);
  }
  consider("{:.2g} s too {} in its times", 1.0, [](const Off& row) { return row.velocity; });
  const Cause by_rows = causes.back();
  causes.pop_back();
  consider("{:.2g} s too {} in its times", 1.0, [](const Off& row) { return row.way; });
  if (left_of(rows, by_rows) < left_of(rows, causes.back())) causes.back() = by_rows;
  if (rows.front().from_radar) {
    const auto from = [](const Off& row) -> Vector<3> { return row.from_radar.value_or(Vector<3>::Zero()); };
    consider("turned by {:.2g}° about where it stands", degree, [=](const Off& row) { return across(from(row)); });
    consider("{:.3g} m off in its ranges", 1.0,
             [=](const Off& row) -> Vector<3> { return from(row) / length(from(row)); });
  } else {
    consider("turned by {:.2g}°", degree, [=](const Off& row) { return across(row.at); });
    consider("{:.2g} % off in scale", 0.01, [](const Off& row) { return row.at; });
  }
  const auto square = [](const Off& row) { return dot(row.by, row.by); };
  const double all = of_all(square), bend = of_all([](const Off&row) { return row.bend; });
  const auto left = each(causes, [&](const Cause& cause) { return left_of(rows, cause); });
  const auto best = std::ranges::min_element(left);
  if (!(*best < 0.5 * all) || !(all - *best > bend)) return {};
  const Cause& nearest = causes[static_cast<std::size_t>(best - left.begin())];
  for (std::size_t quarter = 0; quarter < 4; ++quarter) {
    const std::size_t from = quarter * rows.size() / 4, to = (quarter + 1) * rows.size() / 4;
    const std::span<const Off> some(rows.data() + from, to - from);
    if (!(left_of(some, nearest) < 0.5 * median_of(some, square))) return {};
  }
  std::string why;
  for (std::size_t i = 0; i < causes.size(); ++i)
    if (left[i] <= 3.0 * *best + 2e-3 * all) why += (why.empty() ? "" : ", or ") + causes[i].words;
  return why;
}

/// By how much the measurements are off the truth on the average, where that is half of their scatter or more and six
/// standard errors, of errors that last as these do; else nothing.
std::string Stations::shifted() const {
  const auto n = static_cast<double>(errors_);
  Eigen::Array3d mean = error_ / n, variances = square_ / n - mean * mean;
  std::vector<std::string> parts;
  double scatter = 0.0;
  bool is_shifted = false;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double variance = variances[i];
    if (!(variance > 0.0)) continue;
    const double lasting = std::clamp((next_[i] / n - mean[i] * mean[i]) / variance, 0.0, 0.99);
    const double independent = n * (1.0 - lasting) / (1.0 + lasting);
    is_shifted |= mean[i] * mean[i] > variance * std::max(0.25, 36.0 / independent);
    scatter += variance;
    parts.push_back(fmt::format("{:.3g}", mean[i]));
  }
  if (!is_shifted) return {};
  return fmt::format("{:.3g} m on the average, by ({}), where they scatter by {:.3g} m", length(mean.matrix()),
                     fmt::join(parts, ", "), std::sqrt(scatter));
}

void Stations::say_azimuths(Say& say, const RecordingReader& recording) const {
  const auto n = static_cast<double>(azimuths_);
  // 1 − cos of an error is half of its square: so it is three times as great, and above 2.5°.
  const auto fits = [&](double sum) { return azimuths_ >= few && n - as_read_ > std::max(9.0 * (n - sum), 1e-3 * n); };
  const char* const reference = recording.has_truth() ? "truth" : "positions";
  say(fits(other_way_), "the azimuths do not fit the {}, but would if they ran {}: {}", reference,
      other_way_of_azimuths(recording), remedy_of_azimuths(recording));
  say(fits(radians_) && !recording.from_north(),
      "the azimuths do not fit the {}, but would if they were radians: name the column azimuth_rad", reference);
  const auto& [as_read, mirrored] = bends_.sums;
  say(bends_.count >= 2 * few && mirrored < 0.3 * as_read && !fits(other_way_),
      "the ways of targets bend {:.2g} times as much as if azimuths ran {}: {}; or the sensor's x is its y",
      as_read / mirrored, other_way_of_azimuths(recording), remedy_of_azimuths(recording));
  const bool diverge = pairs_ >= few && pairs_ > 3 * crossing_;
  const bool would_cross = 9 * pairs_ < 10 * crossing_other_;
  say(diverge, "of {} pairs of bearings {} cross ahead of both their stations; {}", pairs_, crossing_,
      would_cross && !recording.from_north()
          ? "all but a few would, if they ran clockwise from north: give --azimuth-from north"
          : "see whether the stations stand where it is said, and how azimuths run");
}

void Stations::say_truth(Say& say, double step) const {
  if (errors_ < few) return;
  const double lag = lag_.growth_per_told();
  if (lag_.tells_a_delay(0.5, step))
    return say(true,
               "the measurements are off the truth as if it told where the target {} {:.2g} s {} (that leaves {:.0f} % "
               "of the squares of their distances): see whether rows or clocks are shifted",
               lag > 0.0 ? "was" : "will be", std::abs(lag), lag > 0.0 ? "before" : "later",
               100.0 * (1.0 - lag_.correlation() * lag_.correlation()));
  if (2 * same_ > errors_)
    return say(true,
               "the measurements are off the truth by {:.3g} m on the average, and in {} of {} rows by much the same "
               "as in the row before, which is no noise: see whether both have the same axes, units and times, and "
               "whether the truth is empty where there is none",
               off_ / static_cast<double>(errors_), same_, errors_);
  const std::string shift = errors_ >= 2 * few ? shifted() : "";
  say(!shift.empty(),
      "the measurements are off the truth by {}: see whether both count from the same place and have the same datum",
      shift);
}

void Stations::say_sensors(Say& say, const RecordingReader& recording) const {
  constexpr double far_away = 4e5;
  if (recording.seen_from_places() && recording.axes() == 2 && farthest_ > far_away)
    return say(true,
               "sensors or targets are {:.3g} km from where the map begins, on which lines of sight from elsewhere are "
               "straight: it is {:.2g} km off there",
               farthest_ / 1e3, off_the_map() / 1e3);
  std::set<std::string> doubted;  // so that none is named twice
  for (const auto& [sensors, rows] : apart_) {
    const auto& [one, other] = sensors;
    const std::string why = rows.size() < few || doubted.contains(one) ? "" : why_apart(rows, recording.axes());
    if (why.empty()) continue;
    doubted.insert(other);
    say(true,
        "beside sensor '{}', sensor '{}' is {} in most of {} rows, which is more than either scatters: see where both "
        "count from (sensor.{}.at), their datum and north, and their clocks",
        one, other, why, rows.size(), other);
  }
}

void Stations::say(Say& say, const RecordingReader& recording, double step, bool no_truth) const {
  say_azimuths(say, recording);
  if (!no_truth) say_truth(say, step);
  say_sensors(say, recording);
}

}  // namespace sigmax::apps::doubts
