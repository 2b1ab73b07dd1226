#include "recording/doubts/repeats.hpp"

namespace sigmax::apps::doubts {

constexpr std::size_t many_ways = 100;

void Stays::see(double change, std::size_t& run) {
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

bool Stays::regular() const {
  std::size_t usual = 0, nearly = 0;
  for (const auto& [run, times] : after) {
    if (run == 0) continue;
    const auto next = after.find(run + 1);
    usual = std::max(usual, times);
    nearly = std::max(nearly, times + (next == after.end() ? 0 : next->second));
  }
  return changed >= few && 10 * (changes.size() > few ? nearly : usual) >= 9 * changed;
}

void Repeats::see(const Row& row, const Spoke& now, int axes) {
  if (!twice_) twice_ = row.twice;
  if (now.height == 0.0) ++zero_heights_.rows;
  if (is_twice(now)) ++twice_rows_;
  if (!row.truth) return;
  const bool is_zero = axes > 1 && (*row.truth)[0] == 0.0 && (*row.truth)[1] == 0.0;
  if (is_zero) ++zero_truths_.rows;
  zero_truths_.see(is_zero, length(now.error));
}

void Repeats::see_leap(Sensor& sensor, const Trail& trail, const Spoke& now, double jump) {
  constexpr std::size_t most_rows = 8;
  constexpr double farther = 20.0, most_mps2 = 30.0;
  if (jump == 0.0) return;  // it is held
  const double dt = now.time - trail.last.time, speed = jump / dt;
  if (auto& leap = sensor.leap) {
    const bool is_back = length(leap->from - now.at) < 0.5 * leap->way;
    const bool stays = ++leap->rows == most_rows;
    if (is_back || farther * jump > leap->way || farther * speed * leap->dt > leap->way) {
      leap.reset();
    } else if (stays) {
      if (leaps_++ == 0) leap_ = *leap;
      leap.reset();
    }
  } else if (sensor.moves.is_full() && speed > most_mps2 * dt &&
             std::ranges::all_of(sensor.moves, [&](const auto& move) {
               return jump > farther * move.first && speed > farther * move.second;
             })) {
    sensor.leap = {trail.last.at, jump, dt, now.line};
    return;  // that is no move of its own
  }
  sensor.moves.keep({jump, speed});
}

void Repeats::see(Sensor& sensor, const Trail& trail, const Spoke& now) {
  const Spoke& last = trail.last;
  const double jump = length(last.at - now.at);
  path_ += jump;
  // A place that is held may have a height that is not; the Earth's curve moves it along by a little then.
  const double rise = std::abs(now.height - last.height);
  const double along = std::hypot(now.at[0] - last.at[0], now.at[1] - last.at[1]);
  constexpr double earth = 6e6, most_tilt = 0.005, rounding = 1e-6;
  const double tilt = std::min(std::hypot(now.at[0], now.at[1]) / earth, most_tilt);
  const double way = std::isnan(rise) ? jump : along <= rounding + tilt * rise ? 0.0 : along;
  if (way == 0.0 && sensor.way > 0.0) {
    ++held_again_;
    if (ways_.size() < many_ways) ways_.insert(std::lround(1000.0 * std::log(sensor.way)));
  }
  sensor.way = way;
  if (way > 0.0) (sensor.runs[0] > 0 ? after_ : on_).add(way);
  const auto& recent = trail.recent;
  if (recent.reaches(3) && trail.even > 2 && sensor.curves.size() < many) {
    const Vector<3> off = now.at - 4.0 * recent[0] + 6.0 * recent[1] - 4.0 * recent[2] + recent[3];
    sensor.curves.emplace_back(length(off), length(now.at - recent[3]));
  }
  Vector<3> change = now.velocity - last.velocity;
  if (std::isnan(now.velocity[2])) change[2] = 0.0;
  const std::array changes = {way, rise, length(change), length(now.at - now.error - last.at + last.error)};
  for (std::size_t i = 0; i < changes.size(); ++i) stays_[i].see(changes[i], sensor.runs[i]);
  if (!std::isnan(now.height + last.height)) zero_heights_.see((now.height == 0.0) != (last.height == 0.0), rise);
  if (std::ranges::any_of(trail.recent, [&](const Vector<3>& at) {
        const double off = length(at - now.at);
        return off > 0.0 && off < 0.2 * jump;
      }))
    ++returns_;
  see_leap(sensor, trail, now, jump);
  if (is_twice(now) != is_twice(last)) to_twice_ += jump;
}

void Repeats::see_other(double way, bool same) {
  if (way == 0.0) return;
  ++others_;
  if (!same) return;
  ++echoes_;
  if (echoed_.size() <= few) echoed_.insert(static_cast<float>(way));
}

void Repeats::see_bend(Sensor& sensor, const Trail& trail, const Spoke& now, double bend) {
  if (trail.before->second == trail.last.at || bent_ == many) return;
  sensor.bends.emplace_back(bend, length(trail.before->second - now.at));
  ++bent_;
}

bool Repeats::comes_back() const {
  const std::size_t jumps = stays_[0].same + stays_[0].changed;
  return 3 * returns_ > 2 * jumps && jumps >= 2 * few;
}

void Repeats::say_interpolated(Say& say, const std::vector<const Sensor*>& sensors, double rounding) const {
  const auto count = [&](Sensor::Offs Sensor::*which, double least) {  // those that are off by next to nothing, and all
    std::pair<std::size_t, std::size_t> result;
    for (const Sensor* sensor : sensors) {
      auto offs = sensor->*which;
      result.second += offs.size();
      if (offs.size() < 2 * few) continue;
      std::ranges::sort(offs);
      const double usual = offs[offs.size() * 19 / 20].first;
      std::set<float> different;  // few, where all is rounded
      for (const auto& [off, way] : offs)
        if (different.size() <= few) different.insert(static_cast<float>(off));
      if (different.size() > few && usual > least)
        result.first += static_cast<std::size_t>(std::ranges::count_if(
            offs, [&](const auto& each) { return each.first < std::min(0.02 * usual, 5e-4 * each.second); }));
    }
    return result;
  };
  const double step = std::sqrt(12.0) * rounding;  // else a lone one of the numbers
  const auto [straight, bent] = count(&Sensor::bends, 10.0 * step);
  const auto [cubic, curved] = count(&Sensor::curves, 50.0 * step);
  const bool on_lines = 5 * straight > 2 * bent;
  say(on_lines || 4 * cubic > curved,
      "{} of {} positions are on the {}, to within a fiftieth of what others are off it, as if they were interpolated: "
      "they count as new measurements, and the filters take their estimates for better than they are; leave the "
      "measured rows alone",
      on_lines ? straight : cubic, on_lines ? bent : curved,
      on_lines ? "line between those before and after" : "cubic through the four before");
}

/// Positions that are held while the target moves.
void Repeats::say_held(Say& say, std::size_t tracks, double moved) const {
  const Stays& positions = stays_[0];
  const std::size_t jumps = positions.same + positions.changed;
  // What stays where it is repeats itself, too; but its way is much longer than the distance that it comes.
  // So does what is rounded, by steps that are few; a held position goes any way, and is held again, or as long.
  const bool goes_any_way = ways_.size() > few && 2 * ways_.size() > std::min(held_again_, many_ways);
  const bool held_again = 4 * held_again_ > 3 * positions.changed && goes_any_way;
  const bool on_its_way = moved > 0.5 * path_ && (goes_any_way || positions.regular());
  // Where some rows repeat the one before, at random, the next step is of several rows; after a rest it is a short one.
  const bool catches_up =
      tracks == 1 && on_.count() >= few && after_.count() >= few && after_.mean() > 1.5 * on_.mean() && goes_any_way;
  say(positions.same >= few &&
          ((4 * positions.same > jumps && (on_its_way || held_again)) || (10 * positions.same > jumps && catches_up)),
      "{} of {} positions repeat the one before to the last digit, although the target moves: values that are held "
      "count as new measurements, and the filters take their estimates for better than they are; leave one row of each",
      positions.same, jumps);
}

void Repeats::say(Say& say, const RecordingReader& recording, std::size_t tracks, double moved) const {
  say(recording.nines().empty() && twice_rows_ > 1 && 2.0 * to_twice_ > path_,
      "{} positions have {} for both coordinates, and most of the way is to there and back: if that stands for no "
      "position, empty those cells or name them by --missing",
      twice_rows_, twice_.value_or(0.0));
  constexpr std::size_t most_leaps = 5;
  if (leap_)
    say(leaps_ <= most_leaps,
        "positions leap by {:.3g} m in {:.3g} s on line {}, 20 times as far as in the rows about it, and stay there{}: "
        "see whether a place, a unit, a zone or an axis changed, or the target (--track-id)",
        leap_->way, leap_->dt, leap_->line, leaps_ > 1 ? fmt::format("; {} such in all", leaps_) : "");
  const auto& [positions, heights, speeds, truths] = stays_;
  const std::pair<const Stays&, std::string_view> slower[] = {{heights, "heights"}, {speeds, "velocities"}};
  for (const auto& [stays, what] : slower)
    say(stays.regular() && stays.changes.size() > few && !positions.regular(),
        "the {} change {} times in {} rows, after as many rows each time, and stay the same to the last digit between: "
        "values that are held count as new measurements, and the filters take their estimates for better than they "
        "are; empty the cells that repeat one",
        what, stays.changed, stays.same + stays.changed + 1);
  constexpr double low_m = 20.0;  // a lift, or an animal that dives
  say(zero_heights_.stands_out() && zero_heights_.least > low_m,
      "the height is 0 in {} rows, and goes much farther to or from there than between any others: if that stands for "
      "no height, empty those cells or name them by --missing",
      zero_heights_.rows);
  say(no_truth(),
      "the truth is (0, 0) in {} rows, where it is much farther from what was measured than in all others: if that "
      "stands for no truth, empty those cells or name them by --missing",
      zero_truths_.rows);
  say(comes_back(),
      "{} of {} positions are near one a few rows before, and five times as far from the last: if rows of several "
      "targets are mixed, name the column that tells them apart by --track-id, and if those of several sensors, one "
      "that is called sensor",
      returns_, positions.same + positions.changed);
  // A target that stands repeats a few times, for long.
  const auto at_once = truths.after.find(0);
  const bool is_held = at_once == truths.after.end() || 10 * at_once->second < 9 * truths.changed;
  say(truths.same >= few && truths.changes.size() > few && 3 * truths.same > truths.changed && is_held &&
          20 * positions.same < truths.same,
      "{} of {} truths repeat the one before to the last digit, although what is measured moves: empty those cells, as "
      "errors are counted from where the target was",
      truths.same, truths.same + truths.changed);
  say_held(say, tracks, moved);
  say(5 * echoes_ > 2 * others_ && echoed_.size() > few,
      "{} of {} positions that follow one of another sensor equal it to the last digit: what comes twice counts as two "
      "measurements, and the filters take their estimates for better than they are; leave one row of each",
      echoes_, others_);
}

}  // namespace sigmax::apps::doubts
