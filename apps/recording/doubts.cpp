#include "recording/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "recording/plots.hpp"
#include "support/text.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t few = 10, many = 10000, many_ways = 100, most_leaps = 5;

// Over so many rows the two kinds of rates are compared.
constexpr std::array<std::size_t, 3> lengths = {1, 10, 100};

double dot(const Position& a, const Position& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double distance(const auto& a, const auto& b) {
  double square = 0.0;
  for (std::size_t i = 0; i < 3; ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(square);
}

/// The upper one of two.
double median(std::vector<double> some) {
  const auto middle = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
  std::ranges::nth_element(some, middle);
  return *middle;
}

/// Whether two rays in the plane cross.
bool cross(const Position& a, double alpha, const Position& b, double beta) {
  const double x = b[0] - a[0], y = b[1] - a[1], turn = std::sin(beta - alpha);
  return (x * std::sin(beta) - y * std::cos(beta)) * turn > 0.0 &&
         (x * std::sin(alpha) - y * std::cos(alpha)) * turn > 0.0;
}

}  // namespace

void Doubts::Agreement::add(double told_now, double growth) {
  if (std::isnan(told_now)) return;
  product += told_now * growth;
  told += told_now * told_now;
  grew += growth * growth;
  ++count;
}

void Doubts::Stays::see(double change, std::size_t& run) {
  if (std::isnan(change)) return;
  if (change == 0.0) {
    ++run;
    ++same;
    return;
  }
  ++changed;
  ++after[std::exchange(run, 0)];
  if (changes.size() <= few) changes.insert(static_cast<float>(change));
}

bool Doubts::Stays::regular() const {
  std::size_t usual = 0, nearly = 0;
  for (const auto& [run, times] : after) {
    if (run == 0) continue;
    const auto next = after.find(run + 1);
    usual = std::max(usual, times);
    nearly = std::max(nearly, times + (next == after.end() ? 0 : next->second));
  }
  return changed >= few && 10 * (changes.size() > few ? nearly : usual) >= 9 * changed;
}

/// Numbers as 101559 that are hours, minutes and seconds never end on 60 to 99.
void Doubts::see_time(double time) {
  const double hundreds = std::floor(time / 100.0);
  ++times_;
  if (std::fmod(time, 100.0) < 60.0 && std::fmod(hundreds, 100.0) < 60.0) ++clocks_;
  if (std::fmod(time, 50.0) != 0.0) ++uneven_;
  if (hundreds != hundreds_) ++minutes_;
  hundreds_ = hundreds;
  latest_ = time;
}

void Doubts::see_azimuth(double azimuth, const Position& from_radar) {
  const double true_one = std::atan2(from_radar[1], from_radar[0]);
  as_read_ += std::cos(azimuth - true_one);
  other_way_ += std::cos(90.0 * degree - azimuth - true_one);
  radians_ += std::cos(azimuth / degree - true_one);
  ++azimuths_;
}

void Doubts::see_bearing(const Bearing& now, std::optional<Bearing>& before) {
  const double north = 90.0 * degree;
  if (before && now.from != before->from && std::abs(std::sin(now.azimuth - before->azimuth)) > 0.1) {
    ++pairs_;
    if (cross(before->from, before->azimuth, now.from, now.azimuth)) ++crossing_;
    if (cross(before->from, north - before->azimuth, now.from, north - now.azimuth)) ++crossing_other_;
  }
  before = now;
}

void Doubts::see_error(const Spoke& last, const Spoke& now) {
  const double off = distance(now.error, Position{});
  if (std::isnan(off + last.error[0])) return;
  ++errors_;
  off_ += off;
  if (off > 5.0 * distance(now.error, last.error)) ++same_;
  for (std::size_t i = 0; i < 3; ++i) {
    lag_.add((now.at[i] - now.error[i] - last.at[i] + last.error[i]) / (now.time - last.time), now.error[i]);
    error_[i] += now.error[i];
    square_[i] += now.error[i] * now.error[i];
    next_[i] += now.error[i] * last.error[i];
  }
}

void Doubts::see_return(Sensor& before, const Spoke& now, double jump) {
  constexpr std::size_t reach = 8;
  const auto is_nearer = [&](const Position& at) {
    const double off = distance(at, now.at);
    return off > 0.0 && off < 0.2 * jump;
  };
  if (std::ranges::any_of(before.recent, is_nearer)) ++returns_;
  if (before.recent.size() == reach) before.recent.erase(before.recent.begin());
  before.recent.push_back({now.at[0], now.at[1], now.at[2]});
}

void Doubts::see_leap(Sensor& before, const Spoke& now, double jump) {
  constexpr std::size_t reach = 8;
  constexpr double farther = 20.0, most_mps2 = 30.0;
  if (jump == 0.0) return;  // it is held
  const double dt = now.time - before.last.time, speed = jump / dt;
  if (auto& leap = before.leap) {
    const bool is_back = distance(leap->from, now.at) < 0.5 * leap->way;
    if (is_back || farther * jump > leap->way || farther * speed * leap->dt > leap->way) {
      leap.reset();
    } else if (++leap->rows == reach) {
      ++leaps_;
      if (!leap_) leap_ = leap;
      leap.reset();
    }
  } else if (before.moves.size() == reach && speed > most_mps2 * dt &&
             std::ranges::all_of(before.moves, [&](const auto& move) {
               return jump > farther * move.first && speed > farther * move.second;
             })) {
    before.leap = {{before.last.at[0], before.last.at[1], before.last.at[2]}, jump, dt, now.line};
    return;  // that is no move of its own
  }
  if (before.moves.size() == reach) before.moves.erase(before.moves.begin());
  before.moves.emplace_back(jump, speed);
}

void Doubts::see_rates(Sensor& before, Spoke now) {
  const Spoke& last = before.last;
  const double dt = now.time - last.time;
  if (!(dt > 0.0)) return;
  const double jump = distance(last.at, now.at);
  path_ += jump;
  // A place that is held may have a height that is not; the Earth's curve moves it along by a little then.
  const double rise = std::abs(now.height - last.height);
  const double along = std::hypot(now.at[0] - last.at[0], now.at[1] - last.at[1]);
  constexpr double earth = 6e6, most_tilt = 0.005, rounding = 1e-6;
  const double tilt = std::min(std::hypot(now.at[0], now.at[1]) / earth, most_tilt);
  const double way = std::isnan(rise) ? jump : along <= rounding + tilt * rise ? 0.0 : along;
  if (way == 0.0 && before.way > 0.0) {
    ++held_again_;
    if (ways_.size() < many_ways) ways_.insert(std::lround(1000.0 * std::log(before.way)));
  }
  before.way = way;
  stays_[0].see(way, before.runs[0]);
  stays_[1].see(rise, before.runs[1]);
  Position change{};
  for (std::size_t i = 0; i < 3; ++i) change[i] = i == 2 && std::isnan(now.rate[i]) ? 0.0 : now.rate[i] - last.rate[i];
  stays_[2].see(std::sqrt(dot(change, change)), before.runs[2]);
  if (!std::isnan(now.height + last.height)) zero_heights_.see((now.height == 0.0) != (last.height == 0.0), rise);
  see_return(before, now, jump);
  see_leap(before, now, jump);
  if (now.twice != last.twice) to_twice_ += jump;
  see_error(last, now);
  for (std::size_t i = 0; i < now.rate.size(); ++i)
    if (std::isnan(now.rate[i])) now.rate[i] = last.rate[i];
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    Since& since = before.since[k];
    for (std::size_t i = 0; i < now.rate.size(); ++i) since.told[i] += dt * (last.rate[i] + now.rate[i]) / 2.0;
    if (++since.rows < lengths[k]) continue;
    const double T = now.time - since.time;
    std::array<double, 4> grew = now.grown();
    for (std::size_t i = 0; i < grew.size(); ++i) {
      grew[i] = (grew[i] - since.at[i]) / T;
      since.told[i] /= T;
      rates_[k].each[i].add(since.told[i], grew[i]);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      rates_[k].velocities.add(since.told[i], grew[i]);
      rates_[k].exchanged.add(since.told[1 - i], grew[i]);
      rates_[k].to_the_left.add(i == 0 ? -since.told[1] : since.told[0], grew[i]);
    }
    since = {now.time, now.grown()};
  }
  before.last = now;
}

/// What another sensor told between this one's last row and now, beside the way between these two.
void Doubts::see_other(const std::string& sensor, const Spoke& now, Track& track) {
  const auto own = track.spoke.find(sensor);
  if (own == track.spoke.end()) return;
  const Spoke& last = own->second.last;
  const double T = now.time - last.time;
  const auto off_the_way = [](double t, const auto& at, double from, const auto& a, double to, const auto& b) {
    Position off{};
    for (std::size_t i = 0; i < 3; ++i) off[i] = at[i] - a[i] - (b[i] - a[i]) * (t - from) / (to - from);
    return off;
  };
  if (const auto& before = own->second.before; before && T > 0.0 && T <= 2.0 * (last.time - before->first)) {
    const auto bend = off_the_way(last.time, last.at, before->first, before->second, now.time, now.at);
    if (distance(before->second, last.at) > 0.0 && bent_ < many) {
      bends_[&own->second].emplace_back(std::sqrt(dot(bend, bend)), distance(before->second, now.at));
      ++bent_;
    }
    if (const auto other = track.spoke.find(track.latest); other != own && other->second.last.time >= last.time) {
      Position velocity{};
      for (std::size_t i = 0; i < 3; ++i) velocity[i] = (now.at[i] - last.at[i]) / T;
      const Spoke& told = other->second.last;
      constexpr std::size_t most_pairs = 100, enough = 1000;
      const std::pair pair(sensor, other->first);
      if (const auto known = apart_.find(pair);
          known == apart_.end() ? apart_.size() < most_pairs : known->second.size() < enough)
        apart_[pair].push_back({off_the_way(told.time, told.at, last.time, last.at, now.time, now.at),
                                velocity,
                                {told.at[0], told.at[1], told.at[2]},
                                told.from_radar,
                                dot(bend, bend)});
    }
  }
  own->second.before = {last.time, {last.at[0], last.at[1], last.at[2]}};
}

/// What accounts for most of it, in each quarter of the rows, since errors that last come and go: a shift, or so many
/// times something of the row. Empty if nothing does.
std::string Doubts::why_apart(const std::vector<Off>& rows, int axes) {
  const auto median_of = [](std::span<const Off> some, const auto& number) {
    std::vector<double> all;
    for (const Off& row : some)
      if (const double one = number(row); std::isfinite(one)) all.push_back(one);
    return all.size() < few / 4 ? nan : median(all);
  };
  const auto of_all = [&](const auto& number) { return median_of(rows, number); };
  struct Cause {
    std::string words;
    std::function<Position(const Off&)> off;
  };
  std::vector<Cause> causes;
  const auto left_of = [&](std::span<const Off> some, const Cause& cause) {
    return median_of(some, [&](const Off& row) { return std::pow(distance(row.by, cause.off(row)), 2); });
  };
  Position shift;
  for (std::size_t i = 0; i < 3; ++i) shift[i] = of_all([&](const Off& row) { return row.by[i]; });
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < static_cast<std::size_t>(axes); ++i) parts.push_back(fmt::format("{:.3g}", shift[i]));
  causes.push_back({fmt::format("{:.3g} m away, by ({})", std::sqrt(dot(shift, shift)), fmt::join(parts, ", ")),
                    [shift](const Off&) { return shift; }});
  const auto consider = [&](std::string_view format, double unit, const std::function<Position(const Off&)>& of) {
    const double times = of_all([&](const Off& row) {
      const Position direction = of(row);
      return dot(row.by, direction) / dot(direction, direction);
    });
    causes.push_back({fmt::format(fmt::runtime(format), std::abs(times) / unit, times > 0.0 ? "early" : "late"),
                      [of, times](const Off& row) {
                        Position expected = of(row);
                        for (double& along : expected) along *= times;
                        return expected;
                      }});
  };
  const auto across = [](const Position& at) { return Position{-at[1], at[0], 0.0}; };
  consider("{:.2g} s too {} in its times", 1.0, [](const Off& row) { return row.velocity; });
  if (rows.front().from_radar) {
    const auto from = [](const Off& row) { return row.from_radar.value_or(Position{}); };
    consider("turned by {:.2g}° about where it stands", degree, [&](const Off& row) { return across(from(row)); });
    consider("{:.3g} m off in its ranges", 1.0, [&](const Off& row) {
      Position at = from(row);
      const double range = std::sqrt(dot(at, at));
      for (double& along : at) along /= range;
      return at;
    });
  } else {
    consider("turned by {:.2g}°", degree, [&](const Off& row) { return across(row.at); });
    consider("{:.2g} % off in scale", 0.01, [](const Off& row) { return row.at; });
  }
  const auto square = [](const Off& row) { return dot(row.by, row.by); };
  const double all = of_all(square), bend = of_all([](const Off&row) { return row.bend; });
  std::vector<double> left;
  for (const Cause& cause : causes) left.push_back(left_of(rows, cause));
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

void Doubts::see(const Row& row, const std::optional<Position>& position, int axes) {
  const AnyPlot& plot = row.plot;
  const bool is_bearing = plot.sensor == AnyPlot::Sensor::bearing, has_rate = plot.sensor == AnyPlot::Sensor::doppler;
  const bool is_radar = has_rate || plot.sensor == AnyPlot::Sensor::polar;
  see_time(plot.time);
  Track& track = tracks_[row.track];
  const auto& reference = row.truth ? row.truth : track.located;
  if ((is_bearing || is_radar) && reference)
    see_azimuth(plot.z[is_bearing ? 0 : 1], {(*reference)[0] - plot.origin[0], (*reference)[1] - plot.origin[1], 0.0});
  if (is_bearing) see_bearing({plot.origin, plot.z[0]}, track.bearing);
  if (!position || axes_seen(plot, axes) < axes) return;
  const Position& at = *position;
  farthest_ = std::max(farthest_, std::hypot(at[0], at[1]));
  if (!twice_) twice_ = row.twice;
  Spoke now{plot.time,
            {at[0], at[1], at[2], is_radar ? plot.z[0] : 0.0},
            {nan, nan, nan, has_rate ? plot.z[static_cast<std::size_t>(plot.size) - 1] : nan},
            {nan, nan, nan},
            {},
            row.twice && row.twice == twice_,
            axes == 3 ? component_of(plot, 2).value_or(nan) : nan,
            row.line};
  if (now.height == 0.0) ++zero_heights_.rows;
  if (is_radar) now.from_radar = {at[0] - plot.origin[0], at[1] - plot.origin[1], at[2] - plot.origin[2]};
  for (std::size_t i = 0; i < static_cast<std::size_t>(axes); ++i)
    now.rate[i] = component_of(plot, axes + static_cast<int>(i)).value_or(nan);
  for (std::size_t i = 0; i < 3 && row.truth; ++i) now.error[i] = at[i] - (*row.truth)[i];
  if (row.truth) {
    const bool is_zero = axes > 1 && (*row.truth)[0] == 0.0 && (*row.truth)[1] == 0.0;
    if (is_zero) ++zero_truths_.rows;
    zero_truths_.see(is_zero, distance(at, *row.truth));
  }
  if (now.twice) ++twice_rows_;
  if (track.latest != row.sensor || sensors_.empty()) sensors_.insert(row.sensor);
  see_other(row.sensor, now, track);
  track.latest = row.sensor;
  const Since since{now.time, now.grown()};
  const auto [before, first] = track.spoke.try_emplace(row.sensor, Sensor{now, {since, since, since}});
  if (!first) see_rates(before->second, now);
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

/// By how much the measurements are off the truth on the average, where that is half of their scatter or more and six
/// standard errors, of errors that last as these do; else nothing.
std::string Doubts::shifted() const {
  const auto n = static_cast<double>(errors_);
  Position mean{};
  std::vector<std::string> parts;
  double scatter = 0.0;
  bool is_shifted = false;
  for (std::size_t i = 0; i < 3; ++i) {
    mean[i] = error_[i] / n;
    const double variance = square_[i] / n - mean[i] * mean[i];
    if (!(variance > 0.0)) continue;
    const double lasting = std::clamp((next_[i] / n - mean[i] * mean[i]) / variance, 0.0, 0.99);
    const double independent = n * (1.0 - lasting) / (1.0 + lasting);
    is_shifted |= mean[i] * mean[i] > variance * std::max(0.25, 36.0 / independent);
    scatter += variance;
    parts.push_back(fmt::format("{:.3g}", mean[i]));
  }
  if (!is_shifted) return {};
  return fmt::format("{:.3g} m on the average, by ({}), where they scatter by {:.3g} m", std::sqrt(dot(mean, mean)),
                     fmt::join(parts, ", "), std::sqrt(scatter));
}

/// Where the steps of a lone track become a thousand times what they were, or a thousandth; else nothing.
std::string Doubts::other_times() const {
  if (tracks_.size() != 1 || steps_.size() < 2 * few) return {};
  double time = tracks_.begin()->second.first_time;
  const auto longest = std::ranges::max_element(steps_);
  for (auto step = steps_.begin(); step != longest; ++step) time += *step;
  if (longest - steps_.begin() < std::ptrdiff_t{few} || steps_.end() - longest <= std::ptrdiff_t{few}) return {};
  const double before = median({steps_.begin(), longest}), then = median({longest + 1, steps_.end()});
  if (std::abs(std::log10(then / before) - 3.0) > 0.05) return {};
  return fmt::format("{:.6g} s apart up to {:.6g} and {:.6g} s from {:.6g} on", before, time, then, time + *longest);
}

std::vector<std::string> Doubts::sentences(const RecordingReader& recording) const {
  std::vector<std::string> sentences;
  const auto say = [&](bool holds, std::string_view format, const auto&... words) {
    if (holds) sentences.push_back(recording.file() + ": " + fmt::format(fmt::runtime(format), words...));
  };
  const std::string range_remedy = fmt::format(
      "where a radar counts closing as positive, its column is closing_rate_mps, else range_rate_mps: name "
      "it {}",
      recording.counts_closing() ? "range_rate_mps" : "closing_rate_mps");
  const std::array<std::array<std::string_view, 3>, 4> kinds = {
      {{"velocities along x", "x",
        recording.axes() == 1 ? "vx is along x, and so below 0 where x falls"
                              : "vx is along x, or east, and longitudes west are negative"},
       {"velocities along y", "y", "vy is along y, or north, and latitudes south are negative"},
       {"vertical velocities", "the heights", "vz and a vertical rate are upwards"},
       {"range rates", "the ranges", range_remedy}}};
  const auto fit = [](const Agreement& rates) { return rates.count >= few && rates.correlation() > 0.9; };
  const bool exchanged = std::ranges::any_of(
      rates_, [&](const Rates& rates) { return fit(rates.exchanged) && rates.velocities.correlation() < 0.5; });
  say(exchanged,
      "the velocities do not fit how the positions grow, but would if the first were the second: vx is along x, or "
      "east, vy along y, or north, a latitude is along y, and a course is clockwise from north");
  for (std::size_t i = exchanged ? 2 : 0; i < kinds.size(); ++i) {
    const auto found = std::ranges::find_if(rates_, [&](const Rates& rates) { return rates.each[i].other_sign(); });
    say(found != rates_.end(), "the {} have the other sign than the growth of {} (correlation {:.2f}); {}", kinds[i][0],
        kinds[i][1], found == rates_.end() ? 0.0 : found->each[i].correlation(), kinds[i][2]);
  }
  const auto say_scale = [&](std::string_view name, std::string_view others, const auto& agreement) {
    for (const Rates& rates : rates_) {
      if (!fit(agreement(rates)) || !agreement(rates).other_size()) continue;
      return say(true,
                 "the {} are {:.2g} times what the {} say: see whether their unit, or that of the {} or times, is that "
                 "of their header",
                 name, 1.0 / agreement(rates).growth_per_told(), others, others);
    }
  };
  say_scale("velocities", "positions", [](const Rates& rates) { return rates.velocities; });
  for (const Rates& rates : rates_) {
    constexpr double earth = 6.4e6;  // of whose north one is another's, far away
    const double angle = std::atan2(rates.to_the_left.product, rates.velocities.product);
    const double margin = 2.5 * degree + 5.0 * std::sqrt(std::max(rates.velocities.error_square(), 0.0)) +
                          (recording.on_the_earth() ? 2.0 * farthest_ / earth : 0.0);
    if (!fit(rates.velocities) || std::abs(angle) < margin) continue;
    say(true,
        "the velocities point {:.2g}° to the {} of where the positions go: see whether a course is from true north, "
        "and "
        "whether it is one, and no heading",
        std::abs(angle) / degree, angle > 0.0 ? "right" : "left");
    break;
  }
  say_scale("vertical velocities", "heights", [](const Rates& rates) { return rates.each[2]; });
  say_scale("range rates", "ranges", [](const Rates& rates) { return rates.each[3]; });
  const auto n = static_cast<double>(azimuths_);
  // 1 − cos of an error is half of its square: so it is three times as great, and above 2.5°.
  const auto fits = [&](double sum) { return azimuths_ >= few && n - as_read_ > std::max(9.0 * (n - sum), 1e-3 * n); };
  const char* const reference = recording.has_truth() ? "truth" : "positions";
  say(fits(other_way_), "the azimuths do not fit the {}, but would if they ran {}: {}", reference,
      recording.from_north() ? "counter-clockwise from east" : "clockwise from north",
      recording.from_north() ? "name the column azimuth_deg, without --azimuth-from" : "give --azimuth-from north");
  say(fits(radians_) && !recording.from_north(),
      "the azimuths do not fit the {}, but would if they were radians: name the column azimuth_rad", reference);
  const bool diverge = pairs_ >= few && pairs_ > 3 * crossing_;
  const bool would_cross = 9 * pairs_ < 10 * crossing_other_;
  say(diverge, "of {} pairs of bearings {} cross ahead of both their stations; {}", pairs_, crossing_,
      would_cross && !recording.from_north()
          ? "all but a few would, if they ran clockwise from north: give --azimuth-from north"
          : "see whether the stations stand where it is said, and how azimuths run");
  const double step = steps_.empty() ? nan : median(steps_);
  const double lag = lag_.growth_per_told();
  const bool lags = errors_ >= few && lag_.correlation() * lag_.correlation() > 0.5 && std::abs(lag) > 0.3 * step &&
                    std::abs(lag) < 20.0 * step;
  const bool no_truth = zero_truths_.stands_out();
  say(no_truth,
      "the truth is (0, 0) in {} rows, where it is much farther from what was measured than in all others: if that "
      "stands "
      "for no truth, empty those cells or name them by --missing",
      zero_truths_.rows);
  say(lags && !no_truth,
      "the measurements are off the truth as if it told where the target {} {:.2g} s {} (that leaves {:.0f} % of the "
      "squares of their distances): see whether rows or clocks are shifted",
      lag > 0.0 ? "was" : "will be", std::abs(lag), lag > 0.0 ? "before" : "later",
      100.0 * (1.0 - lag_.correlation() * lag_.correlation()));
  const bool same = errors_ >= few && 2 * same_ > errors_;
  const std::string shift = errors_ >= 2 * few && !same && !lags && !no_truth ? shifted() : "";
  say(!shift.empty(),
      "the measurements are off the truth by {}: see whether both count from the same place and have the same datum",
      shift);
  say(!lags && !no_truth && same,
      "the measurements are off the truth by {:.3g} m on the average, and in {} of {} rows by much the same as in the "
      "row before, which is no noise: see whether both have the same axes, units and times, and whether the truth is "
      "empty where there is none",
      off_ / static_cast<double>(errors_), same_, errors_);
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
  std::size_t straight = 0;
  for (const auto& [sensor, all] : bends_) {
    auto bends = all;
    std::ranges::sort(bends);
    const double usual = bends[bends.size() * 19 / 20].first;
    std::set<float> different;  // few, where all is rounded
    for (const auto& [bend, way] : bends)
      if (different.size() <= few) different.insert(static_cast<float>(bend));
    const auto is_straight = [&](const auto& each) { return each.first < std::min(0.02 * usual, 5e-4 * each.second); };
    if (bends.size() >= 2 * few && different.size() > few)
      straight += static_cast<std::size_t>(std::ranges::count_if(bends, is_straight));
  }
  say(5 * straight > 2 * bent_,
      "{} of {} positions are on the line between those before and after, to within a fiftieth of what others are off "
      "it, as if they were interpolated: they count as new measurements, and the filters take their estimates for "
      "better than they are; leave the measured rows alone",
      straight, bent_);
  std::vector<std::string_view> names;
  for (const auto& [name, track] : tracks_) names.push_back(name);
  const std::pair<std::string_view, std::string> twins[] = {{"tracks", alike(names)},
                                                            {"sensors", alike({sensors_.begin(), sensors_.end()})}};
  for (const auto& [what, two] : twins)
    say(!two.empty(),
        "{} {} differ in case, blanks or the writing of a number only, and count as two; write them alike, if they "
        "are the same",
        what, two);
  const auto nines = recording.nines();
  for (const std::string& sentence : nines) say(true, "{}", sentence);
  say(nines.empty() && twice_rows_ > 1 && 2.0 * to_twice_ > path_,
      "{} positions have {} for both coordinates, and most of the way is to there and back: if that stands for no "
      "position, empty those cells or name them by --missing",
      twice_rows_, twice_.value_or(0.0));
  const auto& [abroad, first_abroad] = recording.abroad();
  say(abroad > 0,
      "{} positive latitudes or longitudes stand beside an S or a W, first on line {}, and were taken as north and "
      "east: "
      "give those of the south and the west a minus sign",
      abroad, first_abroad);
  const auto& zone = recording.other_zone();
  say(zone.line > 0 && (zone.is_none || std::abs(zone.step) > 10.0 * step),
      "times have another zone from line {} on, {:.6g} s after the one before, and those without a zone were taken as "
      "UTC; see whether each has the zone that it was told in",
      zone.line, zone.step);
  say(recording.at_one_time() > std::max(steps_.size(), few),
      "{} rows have the time of the row before, and were skipped: if times were rounded, as to whole seconds, write "
      "them "
      "in full",
      recording.at_one_time());
  const auto& [left, left_by] = recording.left_behind();
  say(left >= few,
      "{} rows after line {} were skipped, since none is later: see whether the time of that row is wrong, and drop "
      "it; "
      "or, where a clock begins anew (at midnight, with the week, after summer time or a restart), add from there on "
      "what it went back",
      left, left_by);
  say(leap_ && leaps_ <= most_leaps,
      "positions leap by {:.3g} m in {:.3g} s on line {}, 20 times as far as in the rows about it, and stay there{}: "
      "see "
      "whether a place, a unit, a zone or an axis changed, or the target (--track-id)",
      leap_ ? leap_->way : 0.0, leap_ ? leap_->dt : 0.0, leap_ ? leap_->line : 0,
      leaps_ > 1 ? fmt::format("; {} such in all", leaps_) : "");
  const auto& [positions, heights, velocities] = stays_;
  const std::pair<const Stays&, std::string_view> slower[] = {{heights, "heights"}, {velocities, "velocities"}};
  for (const auto& [stays, what] : slower)
    say(stays.regular() && stays.changes.size() > few && !positions.regular(),
        "the {} change {} times in {} rows, after as many rows each time, and stay the same to the last digit between: "
        "values that are held count as new measurements, and the filters take their estimates for better than they "
        "are; empty the cells that repeat one",
        what, stays.changed, stays.same + stays.changed + 1);
  constexpr double low_m = 20.0;  // a lift, or an animal that dives
  say(zero_heights_.stands_out() && zero_heights_.least > low_m,
      "the height is 0 in {} rows, and goes much farther to or from there than between any others: if that stands for "
      "no "
      "height, empty those cells or name them by --missing",
      zero_heights_.rows);
  const std::size_t jumps = positions.same + positions.changed;
  say(3 * returns_ > 2 * jumps && jumps >= 2 * few,
      "{} of {} positions are near one a few rows before, and five times as far from the last: if rows of several "
      "targets are mixed, name the column that tells them apart by --track-id, and if those of several sensors, one "
      "that is called sensor",
      returns_, jumps);
  double moved = 0.0, duration = 0.0;
  for (const auto& [name, track] : tracks_) {
    if (!track.first) continue;
    duration += track.time - track.first_time;
    moved += distance(*track.first, *track.last);
  }
  // What stays where it is repeats itself, too; but its way is much longer than the distance that it comes.
  // So does what is rounded, by steps that are few; a held position goes any way, and is held again, or as long.
  const bool goes_any_way = ways_.size() > few && 2 * ways_.size() > std::min(held_again_, many_ways);
  const bool held_again = 4 * held_again_ > 3 * positions.changed && goes_any_way;
  const bool on_its_way = moved > 0.5 * path_ && (goes_any_way || positions.regular());
  say(positions.same >= few && 4 * positions.same > jumps && (on_its_way || held_again),
      "{} of {} positions repeat the one before to the last digit, although the target moves: values that are held "
      "count as new measurements, and the filters take their estimates for better than they are; leave one row of each",
      positions.same, jumps);
  if (steps_.size() < few) return sentences;
  const double speed = moved / duration;
  const auto by_an_hour = [&](double other) { return std::abs(other - step - 3600.0) < 0.1 * step; };
  say(!recording.times_are_numbers() && step <= 60.0 && std::ranges::any_of(steps_, by_an_hour),
      "a step is an hour longer than the others, which are {:.6g} s: if times are local, and the clocks were put "
      "forward, write them with their zone",
      step);
  if (!recording.times_are_seconds()) return sentences;
  const bool of_a_date = latest_ >= 1.9e13 && latest_ < 2.1e13;
  say(times_ >= 2 * few && clocks_ == times_ && (minutes_ > 2 || of_a_date) && uneven_ > 0,
      "no time ends on 60 to 99, as numbers of seconds would; if they are hours, minutes and seconds in a row, give "
      "--time-format {}",
      latest_ < 1e6 ? "%H%M%S" : "%Y%m%d%H%M%S");
  const std::string others = other_times();
  say(!others.empty(), "times are {}: write all in one unit", others);
  const bool in_minutes = std::fmod(step, 300.0) == 0.0 && std::fmod(step, 1000.0) != 0.0;  // as an hour: what is slow
  for (const TimeColumn& unit : time_columns)
    // From a tenth of a second to twenty seconds, and from 0.5 m/s to 500 m/s.
    say(unit.unit_s < 1.0 && !in_minutes && step * unit.unit_s >= 0.1 && step * unit.unit_s <= 20.0 &&
            speed / unit.unit_s >= 0.5 && speed / unit.unit_s < 500.0,
        "times that are {:.6g} s apart, and a speed of {:.2g} m/s: these look like {}; name the column {}, if they are",
        step, speed, unit.words, unit.name);
  say(speed > 1.2e4,  // nothing on the Earth or about it is as fast
      "a speed of {:.2g} m/s, where times are {:.2g} s apart: if times are not seconds, name the column "
      "time_min, time_h or time_days",
      speed, step);
  return sentences;
}

}  // namespace sigmax::apps
