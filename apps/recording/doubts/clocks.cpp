#include "recording/doubts/clocks.hpp"

#include <chrono>
#include <numeric>

namespace sigmax::apps::doubts {

void Clocks::see(double time) {
  // Numbers as 101559 that are hours, minutes and seconds never end on 60 to 99.
  const double hundreds = std::floor(time / 100.0);
  ++times_;
  if (std::fmod(time, 100.0) < 60.0 && std::fmod(hundreds, 100.0) < 60.0) ++clocks_;
  if (std::fmod(time, 50.0) != 0.0) ++uneven_;
  if (time != std::floor(time)) ++fractions_;
  if (hundreds != hundreds_) ++minutes_;
  if (std::floor(hundreds / 100.0) != std::floor(std::exchange(hundreds_, hundreds) / 100.0)) ++hours_;
  latest_ = time;
}

void Clocks::see(double time, std::optional<double> before) {
  if (std::isnan(first_)) first_ = time;
  if (before && steps_.size() < many) steps_.push_back(time - *before);
}

void Clocks::see_way(double step, double way, double farther) {
  constexpr std::size_t most = 16;
  path_ += way;
  if (ways_.size() == most && !ways_.contains(step)) return;
  auto& [count, sum] = ways_[step];
  ++count;
  sum += farther;
}

void Clocks::see_slip(const Trail& trail, const Spoke& now) {
  const double dt = now.time - trail.last.time, leap = dt - trail.step;
  if (!trail.recent.reaches(3) || !(dt > 50.0 * trail.step)) return;
  const auto move = [&](std::size_t ago) -> Vector<3> { return trail.recent[ago] - trail.recent[ago + 1]; };
  const double usual = length(move(1));
  constexpr double about = 0.5;  // as even a way is that is seen with noise
  if (!(length(move(2) - move(1)) < about * usual && length(move(0) - move(1)) < about * usual)) return;
  // By a zone or a day, rather than for as long as a target waits whose ways are as long as each other.
  constexpr double quarter = 900.0, years = 1e7;
  const bool is_clock = leap > years || std::abs(std::remainder(leap, quarter)) < 0.5 * trail.step;
  if (slips_.insert(is_clock ? std::lround(leap) : -1L).second && slips_.size() == 1)
    slip_ = {now.line, dt, trail.step};
  ++slipped_;
}

/// Where the steps of a lone track become a thousand times what they were, or a thousandth; else nothing.
std::string Clocks::other_times() const {
  if (steps_.size() < 2 * few) return {};
  const auto longest = std::ranges::max_element(steps_);
  if (longest - steps_.begin() < std::ptrdiff_t{few} || steps_.end() - longest <= std::ptrdiff_t{few}) return {};
  const double before = median({steps_.begin(), longest}), then = median({longest + 1, steps_.end()});
  if (!(std::abs(std::log10(then / before) - 3.0) < 0.05)) return {};  // also of steps of 0 s
  const double last = std::accumulate(steps_.begin(), longest, first_);
  return fmt::format("{:.6g} s apart up to {:.6g} and {:.6g} s from {:.6g} on", before, last, then, last + *longest);
}

/// Whether a step is an hour longer, of a lone track once or twice, at night in those months in which it is done
/// somewhere.
bool Clocks::puts_clocks_forward(double step, bool alone) const {
  double time = first_;
  const auto times = std::ranges::count_if(steps_, [&](double own) {
    const double before = std::exchange(time, time + own);
    if (std::abs(own - step - 3600.0) > 0.1 * step) return false;
    const std::chrono::sys_seconds then{std::chrono::seconds(std::lround(before))};
    const auto day = std::chrono::floor<std::chrono::days>(then);
    const auto month = static_cast<unsigned>(std::chrono::year_month_day(day).month());
    const bool in_spring = month == 3 || month == 4 || (month >= 8 && month <= 10);
    return !alone || (in_spring && then - day < std::chrono::hours(5));
  });
  return times > 0 && (!alone || times <= 2);
}

/// What the reader found.
void Clocks::say_reading(Say& say, const RecordingReader& recording, double step) const {
  const auto& zone = recording.other_zone();
  say(zone.line > 0 && (zone.is_none || std::abs(zone.step) > 10.0 * step),
      "times have another zone from line {} on, {:.6g} s after the one before, and those without a zone were taken as "
      "UTC; see whether each has the zone that it was told in",
      zone.line, zone.step);
  say(recording.at_one_time() > std::max(recording.rows() / (recording.has_tracks() ? 4 : 1), few),
      "{} rows have the time of the row before, and were skipped: if times were rounded, as to whole seconds, write "
      "them in full{}",
      recording.at_one_time(),
      recording.has_tracks() ? "; if several targets have one name, give each its own"
                             : "; if rows are of several targets, name the column that tells them apart by --track-id");
  const std::string date = recording.times_of_day() ? recording.unread_date() : "";
  say(!date.empty(), "times are those of a day, beside a column {} that is not read: give --columns date={}",
      in_quotes(date), date);
  const auto& [left, left_by] = recording.left_behind();
  say(left >= few,
      "{} rows after line {} were skipped, since none is later: see whether the time of that row is wrong, and drop "
      "it; or, where a clock begins anew (at midnight, with the week, after summer time or a restart), add from there "
      "on what it went back",
      left, left_by);
}

/// Of a target that goes somewhere: the two steps that are most frequent, and whether one that is a second longer leads
/// no farther.
void Clocks::say_cut(Say& say, double moved) const {
  if (fractions_ > 0 || ways_.size() < 2 || 2.0 * moved < path_) return;
  std::vector<std::pair<double, std::pair<std::size_t, double>>> steps(ways_.begin(), ways_.end());
  std::ranges::partial_sort(steps, steps.begin() + 2, std::greater{}, [](const auto& one) { return one.second.first; });
  if (steps[0].first > steps[1].first) std::swap(steps[0], steps[1]);
  const auto& [shorter, ways] = steps[0];
  const auto& [longer, other_ways] = steps[1];
  const auto mean = [](const auto& some) { return some.second / static_cast<double>(some.first); };
  std::size_t all = 0;  // what tells its place after a way has many steps
  for (const auto& [step, some] : steps) all += some.first;
  const double as_far = 1.0 + 0.3 * (longer / shorter - 1.0);
  say(std::min(ways.first, other_ways.first) >= 2 * few && 10 * (ways.first + other_ways.first) > 9 * all &&
          longer == shorter + 1.0 && mean(other_ways) < as_far * mean(ways),
      "the target comes {:.3g} m in a step of {:.6g} s, and {:.3g} m in one of {:.6g} s: times seem to be cut to whole "
      "seconds; write them in full",
      mean(ways), shorter, mean(other_ways), longer);
}

/// Whether times are seconds from 1970 on, or since a start.
void Clocks::say_unit(Say& say, std::size_t tracks, double moved, double duration) const {
  const double step = this->step(), speed = moved / duration;
  // Of whole minutes none ends on 6000 to 9999.
  const bool are_minutes = hours_ > 2 && step < 2000.0;
  say(times_ >= 2 * few && clocks_ == times_ && (minutes_ > 2 || are_dates()) && (uneven_ > 0 || are_minutes),
      "no time ends on 60 to 99, as numbers of seconds would; if they are hours, minutes and seconds in a row, give "
      "--time-format {}",
      latest_ < 1e6 ? "%H%M%S" : "%Y%m%d%H%M%S");
  if (tracks == 1) {
    const std::string others = other_times();
    say(!others.empty(), "times are {}: write all in one unit", others);
  }
  // As an hour: what is slow, or stays where it is. Devices that tell milliseconds have even steps, and none tells them
  // of this century.
  const bool in_minutes = std::fmod(step, 300.0) == 0.0 && std::fmod(step, 1000.0) != 0.0;
  const auto uneven = std::ranges::count_if(steps_, [&](double own) { return std::abs(own - step) > 0.3 * step; });
  const bool stays = moved < 4.0 * static_cast<double>(tracks) * path_ / static_cast<double>(times_);
  const bool is_slow = in_minutes || stays || 5 * uneven > std::ssize(steps_) || (latest_ > 1e9 && latest_ < 1e10);
  for (const TimeColumn& unit : time_columns)
    // From a tenth of a second to twenty seconds, and from 0.5 m/s to 500 m/s.
    say(unit.unit_s < 1.0 && !is_slow && !is_far_off() && step * unit.unit_s >= (unit.unit_s < 1e-8 ? 1e-3 : 0.1) &&
            step * unit.unit_s <= 20.0 && speed / unit.unit_s >= 0.5 && speed / unit.unit_s < 500.0,
        "times that are {:.6g} s apart, and a speed of {:.2g} m/s: these look like {}; name the column {}, if they are",
        step, speed, unit.words, unit.name);
  say(speed > 1.2e4,  // nothing on the Earth or about it is as fast
      "a speed of {:.2g} m/s, where times are {:.2g} s apart: if times are not seconds, name the column time_min, "
      "time_h or time_days",
      speed, step);
}

void Clocks::say(Say& say, const RecordingReader& recording, std::size_t tracks, double moved, double duration) const {
  const double step = this->step();
  say_reading(say, recording, step);
  const bool are_forward = !recording.times_are_numbers() && !recording.zoned() && steps_.size() >= few &&
                           step <= 60.0 && puts_clocks_forward(step, tracks == 1);
  say(!are_forward && slips_.size() == 1 && !slips_.contains(-1),
      "time goes on by {:.6g} s on line {}, where steps are of {:.6g} s, and the target only as far as in one of "
      "these{}: see whether a clock was set, days were read as months, or the zone is another one from there on",
      slip_.dt, slip_.line, slip_.step, slipped_ > 1 ? fmt::format("; so it is {} times", slipped_) : "");
  if (steps_.size() < few) return;
  say_cut(say, moved);
  say(are_forward,
      "a step is an hour longer than the others, which are {:.6g} s: if times are local, and the clocks were put "
      "forward, write them with their zone",
      step);
  say(is_far_off() && recording.time_unit_s() <= 1.0,
      "times from 1970 on would be of the year {:.0f}: see whether they are in a smaller unit than that of their "
      "header, and name it time_ms, time_us or time_ns",
      1970.0 + latest_ / 31556952.0);
  if (recording.times_are_seconds()) say_unit(say, tracks, moved, duration);
}

}  // namespace sigmax::apps::doubts
