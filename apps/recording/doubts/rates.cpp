#include "recording/doubts/rates.hpp"

namespace sigmax::apps::doubts {
namespace {

bool by_radar(const RecordingReader& recording) { return recording.polar() && !recording.located(); }

}  // namespace

/// Whether what is told is too small, or too great, whichever of the two is noisy, and beyond this share.
bool Rates::Compared::other_size(double bent) const {
  const double margin = 0.03 + bent + 5.0 * std::sqrt(std::max(error_square(), 0.0));
  return fits() && (growth_per_told() > 1.0 + margin || grew / product < 1.0 / (1.0 + margin));
}

/// Whether the rate has the other sign, by four standard errors of a correlation that is none.
bool Rates::Compared::other_sign() const {
  const double square = correlation() * correlation();
  return count >= few && correlation() < -0.5 && square * static_cast<double>(count - 2) > 16.0 * (1.0 - square);
}

void Rates::see(Sensor& sensor, const Trail& trail, Spoke& now) {
  const Spoke& last = trail.last;
  const double dt = now.time - last.time;
  if (trail.recent.reaches(3) && trail.even > 1) {
    const auto at = [&](std::size_t ago) { return trail.recent[ago].head<2>(); };
    const Eigen::Vector2d off = (at(0) - at(2)) / (2.0 * dt) - last.rate.head<2>().matrix();
    if (!std::isnan(off.sum())) {
      ++computed_.count;
      computed_.off += off.squaredNorm();
      // A third difference has twenty times the variance of a position, and this velocity one of 1/(2 dt²).
      computed_.rough += (at(0) - 3.0 * at(1) + 3.0 * at(2) - at(3)).squaredNorm() / (40.0 * dt * dt);
    }
  }
  // A velocity that is told less often holds, but not for long.
  sensor.silent = std::isnan(now.rate[x]) ? sensor.silent + 1 : 0;
  now.rate = now.rate.isNaN().select(last.rate, now.rate);
  now.velocity = now.velocity.array().isNaN().select(last.velocity, now.velocity);
  if (const double change = (now.rate - last.rate).head<2>().square().sum(); !std::isnan(change)) changes_ += change;
  if (sensor.silent == few) {
    now.rate.setConstant(nan);
    sensor.since.fill(Since(now));
  }
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    Since& since = sensor.since[k];
    since.told += dt * (last.rate + now.rate) / 2.0;
    since.held |= sensor.silent > 0 || dt > 3.0 * trail.step;
    if (++since.rows < lengths[k]) continue;
    const double T = now.time - since.time;
    const Grown grew = (now.grown - since.grown) / T, told = since.told / T;
    const auto add = [&](std::size_t rate, double told_now, double growth) { pairs_[k][rate].add(told_now, growth); };
    for (const Rate rate : {x, y, z, range}) add(rate, told[rate], grew[rate]);
    for (const Rate rate : {x, y}) {
      add(velocities, told[rate], grew[rate]);
      if (!since.held && !std::isnan(told[rate]))
        late_[k].add(now.rate[rate] - since.rate[rate], (grew[rate] - told[rate]) * T);
    }
    since = Since(now);
    if (std::isnan(told[x] + told[y])) continue;
    add(exchanged, told[y], grew[x]);
    add(exchanged, told[x], grew[y]);
    add(to_the_left, -told[y], grew[x]);
    add(to_the_left, told[x], grew[y]);
    if (k == 1) {
      off_.sum += Vector<3>(told[x] - grew[x], told[y] - grew[y], 0.0);
      ++off_.squares.count;
      off_.speeds += std::pow(told.head<2>().matrix().norm() - grew.head<2>().matrix().norm(), 2);
      off_.squares.grew += (told - grew).head<2>().square().sum();
      off_.squares.told += told.head<2>().square().sum();
    }
  }
}

/// Whether velocities are about as great as positions grow, in which noise is little: what it makes of rates falls with
/// the rows that they are taken over; what moves does not.
bool Rates::same_size() const {
  const Agreement &by_one = pairs_[0][velocities], &by_ten = pairs_[1][velocities];
  const auto square = [](const Agreement& rates) { return rates.grew / static_cast<double>(rates.count); };
  const double size = by_one.grew / by_one.told;
  return by_ten.count >= few && square(by_one) < 2.0 * square(by_ten) && size > 0.25 && size < 4.0;
}

bool Rates::say_exchanged(Say& say, const RecordingReader& recording) const {
  const bool holds = std::ranges::any_of(
      pairs_, [](const Pairs& pairs) { return pairs[exchanged].fits() && pairs[velocities].correlation() < 0.5; });
  if (by_radar(recording))
    say(holds,
        "the velocities do not fit how the positions grow, but would if azimuths ran {}: {}; or if vx were vy, as vx "
        "is along x, or east, and a course clockwise from north",
        other_way_of_azimuths(recording), remedy_of_azimuths(recording));
  else
    say(holds,
        "the velocities do not fit how the positions grow, but would if the first were the second: vx is along x, or "
        "east, vy along y, or north, a latitude is along y, and a course is clockwise from north");
  return holds;
}

bool Rates::say_signs(Say& say, const RecordingReader& recording, bool is_exchanged) const {
  const bool radar = by_radar(recording);
  const std::string range_remedy = fmt::format(
      "where a radar counts closing as positive, its column is closing_rate_mps, else range_rate_mps: name it {}",
      recording.counts_closing() ? "range_rate_mps" : "closing_rate_mps");
  struct Kind {
    std::string_view name, others, remedy;
  };
  const std::array<Kind, 4> kinds = {
      {{"velocities along x", "x",
        radar                   ? "see where azimuths count from, and whether vx is along x, or east"
        : recording.axes() == 1 ? "vx is along x, and so below 0 where x falls"
                                : "vx is along x, or east, and longitudes west are negative"},
       {"velocities along y", "y",
        radar ? "see where azimuths count from, and whether vy is along y, or north"
              : "vy is along y, or north, and latitudes south are negative"},
       {"vertical velocities", "the heights", "vz and a vertical rate are upwards"},
       {"range rates", "the ranges", range_remedy}}};
  const auto opposed = [&](std::size_t i) -> const Compared* {
    const double most = i < z && same_size() ? -0.8 : 0.0;
    const bool is_small = i < z && pairs_[0][i].told < 1e-3 * pairs_[0][velocities].told;
    const auto found = std::ranges::find_if(
        pairs_, [&](const Pairs& pairs) { return pairs[i].other_sign() && pairs[i].correlation() < most; });
    return found == pairs_.end() || is_small ? nullptr : &(*found)[i];
  };
  const bool both = !is_exchanged && opposed(x) && opposed(y);
  say(both,
      "the velocities point to where the target came from: where a direction is that from which something comes, as "
      "of wind, add 180°; else vx is along x, or east, vy along y, or north{}",
      radar ? ", and see where azimuths count from" : "");
  bool any = both;
  for (std::size_t i = is_exchanged || both ? z : x; i < kinds.size(); ++i) {
    const Compared* const found = opposed(i);
    say(found, "the {} have the other sign than the growth of {} (correlation {:.2f}); {}", kinds[i].name,
        kinds[i].others, found ? found->correlation() : 0.0, kinds[i].remedy);
    any |= found != nullptr;
  }
  return any;
}

bool Rates::say_scale(Say& say, Rate rate, std::string_view name, std::string_view others) const {
  // Where a velocity turns within a step, the mean of two is less than what comes between, by a twelfth of the square.
  const double bent = rate == velocities ? changes_ / pairs_[0][velocities].told / 6.0 : 0.0;
  const auto wrong = std::ranges::find_if(pairs_, [&](const Pairs& pairs) { return pairs[rate].other_size(bent); });
  if (wrong == pairs_.end()) return false;
  const double times = 1.0 / (*wrong)[rate].growth_per_told();
  say(true,
      "the {} are {:.{}g} times what the {} say: see whether their unit, or that of the {} or times, is that of their "
      "header",
      name, times, times > 0.8 && times < 1.25 ? 3 : 2, others, others);
  return true;
}

bool Rates::say_turn(Say& say, const RecordingReader& recording, double turned) const {
  for (const Pairs& pairs : pairs_) {
    const double angle = std::atan2(pairs[to_the_left].product, pairs[velocities].product);
    Compared along = pairs[velocities];  // as far as they are
    along.product = std::hypot(along.product, pairs[to_the_left].product);
    const double margin = 2.5 * degree + 5.0 * std::sqrt(std::max(along.error_square(), 0.0)) + turned;
    if (!along.fits() || std::abs(angle) < margin) continue;
    say(true,
        "the velocities point {:.2g}° to the {} of where the positions go: see whether a course is from true north, "
        "and whether it is one, and no heading{}",
        std::abs(angle) / degree, angle > 0.0 ? "right" : "left",
        by_radar(recording) ? ", and where azimuths count from and which way they run" : "");
    return true;
  }
  return false;
}

/// What else velocities may be of.
void Rates::say_source(Say& say, const Stays& told, double step, double turned) const {
  const bool is_off = off_.squares.count >= few && 2.0 * square_off() > off_.squares.grew &&
                      square_off() > std::max(0.003, turned * turned) * off_.squares.told;
  const Agreement& by_ten = pairs_[1][velocities];
  const bool same_speed = square_off() > 0.25 * off_.squares.told && off_.speeds < 0.05 * off_.squares.grew;
  const bool elsewhere = (same_size() && by_ten.correlation() < 0.7) || (is_off && same_speed);
  if (told.same > 9 * told.changed)
    return say(is_off || elsewhere,
               "{} of {} velocities repeat the one before to the last digit, and the positions do not go so: nothing "
               "measured them; leave their cells empty",
               told.same, told.same + told.changed);
  if (is_off && !same_speed)
    return say(true,
               "the velocities are ({}) m/s off how the positions grow, on the average and much the same all the time: "
               "see whether they are relative to something that moves, as water, air or the vehicle of the sensor",
               numbers_of(off_.sum / static_cast<double>(off_.squares.count), 2));
  if (elsewhere)
    return say(true,
               "the velocities are about as great as the positions tell, but point elsewhere (correlation {:.2f}): see "
               "whether they are along x and y, and not ahead and to a side, and whether a course is in the unit of "
               "its header",
               by_ten.correlation());
  // Measured ones are off these ways by the noise of positions, or by what turns within a step.
  if (computed_.count >= 2 * few && computed_.off < 0.05 * computed_.rough)
    return say(true,
               "the velocities are the ways from the rows before to those after by their time, as computed from these "
               "positions, and tell nothing new: do not let them count, by no sigma_velocity_mps");
  const auto late = std::ranges::find_if(late_, [&](const Agreement& some) {
    return some.count >= 2 * few && some.error_square() < 0.04 && some.tells_a_delay(0.25, step);
  });
  if (late == late_.end()) return;
  const double delay = late->growth_per_told();
  say(true,
      "the velocities are those of {:.2g} s {} the positions beside them{}: write each beside the time that it is of, "
      "or do not let them count, by no sigma_velocity_mps",
      std::abs(delay), delay > 0.0 ? "before" : "after",
      delay > 0.0 && delay < 0.7 * step ? ", as where each is the way since the row before by the step" : "");
}

double Rates::apart(double step, double sigma_position, double sigma_velocity) const {
  const double noise = std::pow(sigma_velocity, 2);
  if (changes_ < 4.0 * noise * static_cast<double>(pairs_[0][velocities].count)) return 0.0;
  double most = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {  // farther on a small error of all velocities is as great
    const Agreement& both = pairs_[k][velocities];
    if (both.count < few) continue;
    const double rows = static_cast<double>(lengths[k]), way = std::pow(step * rows, 2);
    const double off = way * (both.told - 2.0 * both.product + both.grew) / static_cast<double>(both.count);
    most = std::max(most, off / (2.0 * std::pow(sigma_position, 2) + noise * way / rows));
  }
  return std::sqrt(most);
}

void Rates::say(Say& say, const RecordingReader& recording, const Stays& told, double step, double turned) const {
  bool is_clear = say_exchanged(say, recording);
  is_clear |= say_signs(say, recording, is_clear);
  const Pairs& by_ten = pairs_[1];
  const double along = std::hypot(by_ten[velocities].product, by_ten[to_the_left].product);
  const double left_by_turn = by_ten[velocities].grew - along * along / by_ten[velocities].told;
  const bool is_off = off_.squares.count >= few && 2.0 * (off_.squares.grew - square_off()) < left_by_turn;
  is_clear |= !is_off && say_scale(say, velocities, "velocities", "positions");
  is_clear = is_clear || (!is_off && say_turn(say, recording, turned));
  if (!is_clear) say_source(say, told, step, turned);
  say_scale(say, z, "vertical velocities", "heights");
  say_scale(say, range, "range rates", "ranges");
}

}  // namespace sigmax::apps::doubts
