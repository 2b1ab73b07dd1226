#include "recording/doubts.hpp"

#include <chrono>

#include "recording/plots.hpp"
#include "support/text.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t many = 10000, many_ways = 100, most_leaps = 5;

// Over so many rows the two kinds of rates are compared.
constexpr std::array<std::size_t, 3> lengths = {1, 10, 100};

double dot(const Vector<3>& a, const Vector<3>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double length(const Vector<3>& a) { return std::sqrt(dot(a, a)); }

/// How far a place is off the way between two others, by the times of all three.
Vector<3> off_the_way(double time, const Vector<3>& at, double from, const Vector<3>& a, double to,
                      const Vector<3>& b) {
  return at - a - (b - a) * (time - from) / (to - from);
}

/// "12.5, -3": as many numbers as there are axes.
std::string numbers_of(const Vector<3>& a, int axes) {
  return fmt::format("{:.3g}", fmt::join(a.data(), a.data() + axes, ", "));
}

/// Whether so many are known as are kept of the last ones.
template <class One>
bool are_enough(const std::vector<One>& some) {
  return some.size() == 8;
}
template <class One>
void keep(const One& one, std::vector<One>& some) {
  if (are_enough(some)) some.erase(some.begin());
  some.push_back(one);
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

double rounding_of(std::vector<double> numbers) {
  std::ranges::sort(numbers);
  std::vector<double> apart;  // those that differ by more than the reading of decimals does
  for (std::size_t k = 1; k < numbers.size(); ++k)
    if (const double step = numbers[k] - numbers[k - 1]; step > 1e-10 * std::abs(numbers[k])) apart.push_back(step);
  if (apart.empty()) return std::numeric_limits<double>::infinity();
  const double least = *std::ranges::min_element(apart);
  const auto whole = std::ranges::count_if(
      apart, [&](double step) { return std::abs(step / least - std::round(step / least)) < 0.05; });
  // Where hardly a number comes twice, and all are one step apart, it is the way of what moves evenly.
  const auto single = std::ranges::count_if(apart, [&](double step) { return step < 1.5 * least; });
  const bool is_even = 5 * single > 4 * std::ssize(numbers) && 2 * apart.size() > numbers.size();
  if (10 * whole >= 9 * std::ssize(apart) && !is_even) return least / std::sqrt(12.0);
  for (double digits = 1.0; digits < 1e7; digits *= 10.0)  // as they are written
    if (std::ranges::all_of(numbers, [&](double number) {
          const double all = number * digits;
          return std::abs(all - std::round(all)) < 1e-9 + 1e-15 * std::abs(all);
        }))
      return 1.0 / (digits * std::sqrt(12.0));
  return 0.0;
}

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

void Doubts::see_bearing(const Bearing& now, std::optional<Bearing>& before) {
  const double north = 90.0 * degree;
  if (before && now.from != before->from && std::abs(std::sin(now.azimuth - before->azimuth)) > 0.1) {
    ++pairs_;
    if (cross(before->from, before->azimuth, now.from, now.azimuth)) ++crossing_;
    if (cross(before->from, north - before->azimuth, now.from, north - now.azimuth)) ++crossing_other_;
  }
  before = now;
}

void Doubts::see_leap(Sensor& before, const Spoke& now, double jump) {
  constexpr std::size_t most_rows = 8;
  constexpr double farther = 20.0, most_mps2 = 30.0;
  if (jump == 0.0) return;  // it is held
  const double dt = now.time - before.last.time, speed = jump / dt;
  if (auto& leap = before.leap) {
    const bool is_back = length(leap->from - now.at) < 0.5 * leap->way;
    const bool stays = ++leap->rows == most_rows;
    if (is_back || farther * jump > leap->way || farther * speed * leap->dt > leap->way) {
      leap.reset();
    } else if (stays) {
      if (leaps_++ == 0) leap_ = *leap;
      leap.reset();
    }
  } else if (are_enough(before.moves) && speed > most_mps2 * dt &&
             std::ranges::all_of(before.moves, [&](const auto& move) {
               return jump > farther * move.first && speed > farther * move.second;
             })) {
    before.leap = {before.last.at, jump, dt, now.line};
    return;  // that is no move of its own
  }
  keep({jump, speed}, before.moves);
}

void Doubts::see_rates(Sensor& before, Spoke now) {
  const Spoke& last = before.last;
  const double dt = now.time - last.time;
  if (!(dt > 0.0)) return;
  const double jump = length(last.at - now.at);
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
  if (way > 0.0) {
    auto& steps = steps_on_[before.runs[0] > 0 ? 1 : 0];
    ++steps.count;
    steps.sum += way;
  }
  Vector<3> change = (now.rate - last.rate).head<3>();
  if (std::isnan(now.rate[z])) change[z] = 0.0;
  const std::array changes = {way, rise, length(change), length(now.at - now.error - last.at + last.error)};
  for (std::size_t i = 0; i < changes.size(); ++i) stays_[i].see(changes[i], before.runs[i]);
  if (!std::isnan(now.height + last.height)) zero_heights_.see((now.height == 0.0) != (last.height == 0.0), rise);
  const auto is_much_nearer = [&](const Vector<3>& at) {
    const double off = length(at - now.at);
    return off > 0.0 && off < 0.2 * jump;
  };
  if (std::ranges::any_of(before.recent, is_much_nearer)) ++returns_;
  keep(now.at, before.recent);
  see_leap(before, now, jump);
  const std::span recent = before.recent;
  before.even = std::abs(dt - before.step) < 0.01 * dt ? before.even + 1 : 0;
  if (recent.size() > 3 && before.even > 1) {
    const auto at = [&](std::size_t ago) { return recent[recent.size() - 1 - ago].head<2>(); };
    const auto bend = [&](std::size_t ago) -> Eigen::Vector2d { return at(ago) - 2.0 * at(ago + 1) + at(ago + 2); };
    for (std::size_t lag = 0; lag < second_.products.size() && lag + 2 < recent.size() && lag < before.even; ++lag)
      second_.products[lag] += bend(0).dot(bend(lag));
    for (const double own : {bend(0)[0], bend(0)[1]})
      if ((own != 0.0 || now.at[1] != 0.0) && second_.sizes.size() < many) second_.sizes.push_back(std::abs(own));
    const Eigen::Vector2d off = (at(0) - at(2)) / (2.0 * dt) - last.rate.head<2>().matrix();
    if (!std::isnan(off.sum())) {
      ++computed_.count;
      computed_.off += off.squaredNorm();
      // A third difference has twenty times the variance of a position, and this velocity one of 1/(2 dt²).
      computed_.rough += (at(0) - 3.0 * at(1) + 3.0 * at(2) - at(3)).squaredNorm() / (40.0 * dt * dt);
    }
  }
  // A target that goes on evenly, while the clock leaps.
  if (recent.size() > 3 && dt > 50.0 * before.step) {
    const auto move = [&](std::size_t ago) -> Vector<3> {
      return recent[recent.size() - 1 - ago] - recent[recent.size() - 2 - ago];
    };
    const double usual = length(move(1)), leap = dt - before.step;
    // By a zone or a day, rather than for as long as a target waits whose ways are as long as each other.
    constexpr double quarter = 900.0, years = 1e7;
    const bool is_clock = leap > years || std::abs(std::remainder(leap, quarter)) < 0.5 * before.step;
    if (length(move(2) - move(1)) < 0.2 * usual && length(move(0) - move(1)) < 0.2 * usual) {
      if (slips_.insert(is_clock ? std::lround(leap) : -1L).second && slips_.size() == 1)
        slip_ = {now.line, dt, before.step};
      ++slipped_;
    }
  }
  if (now.twice != last.twice) to_twice_ += jump;
  if (const double off = length(now.error); !std::isnan(off + last.error[0])) {
    ++errors_;
    off_ += off;
    if (off > 5.0 * length(now.error - last.error)) ++same_;
    const Vector<3> velocity = (now.at - now.error - last.at + last.error) / dt;
    for (Eigen::Index i = 0; i < 3; ++i) lag_.add(velocity[i], now.error[i]);
    error_ += now.error.array();
    square_ += now.error.array().square();
    next_ += now.error.array() * last.error.array();
  }
  // A velocity that is told less often holds, but not for long.
  before.silent = std::isnan(now.rate[x]) ? before.silent + 1 : 0;
  const double longest = 3.0 * std::exchange(before.step, dt);
  now.rate = now.rate.isNaN().select(last.rate, now.rate);
  if (before.silent == few) {
    now.rate.setConstant(nan);
    before.since.fill({now.time, now.grown, now.rate});
  }
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    Since& since = before.since[k];
    since.told += dt * (last.rate + now.rate) / 2.0;
    since.held |= before.silent > 0 || dt > longest;
    if (++since.rows < lengths[k]) continue;
    const double T = now.time - since.time;
    const Grown grew = (now.grown - since.grown) / T, told = since.told / T;
    const auto add = [&](std::size_t rate, double told_now, double growth) { rates_[k][rate].add(told_now, growth); };
    for (const Rate rate : {x, y, z, range}) add(rate, told[rate], grew[rate]);
    for (const Rate rate : {x, y}) add(velocities, told[rate], grew[rate]);
    if (k == 1 && !std::isnan(told[x] + told[y])) {
      const Vector<3> off(told[x] - grew[x], told[y] - grew[y], 0.0);
      offsets_ += off;
      ++offset_.count;
      offset_.grew += dot(off, off);
      offset_.told += told[x] * told[x] + told[y] * told[y];
    }
    for (const Rate rate : {x, y})
      if (!since.held && !std::isnan(told[rate]))
        late_[k].add(now.rate[rate] - since.rate[rate], (grew[rate] - told[rate]) * T);
    add(exchanged, told[y], grew[x]);
    add(exchanged, told[x], grew[y]);
    add(to_the_left, -told[y], grew[x]);
    add(to_the_left, told[x], grew[y]);
    since = {now.time, now.grown, now.rate};
  }
  before.last = now;
}

/// What another sensor told between this one's last row and now, beside the way between these two.
void Doubts::see_other(const std::string& sensor, const Spoke& now, Track& track) {
  const auto own = track.spoke.find(sensor);
  if (own == track.spoke.end()) return;
  const Spoke& last = own->second.last;
  const double T = now.time - last.time;
  if (const auto& before = own->second.before; before && T > 0.0 && T <= 2.0 * (last.time - before->first)) {
    const Vector<3> bend = off_the_way(last.time, last.at, before->first, before->second, now.time, now.at);
    if (before->second != last.at && bent_ < many) {
      bends_[&own->second].emplace_back(length(bend), length(before->second - now.at));
      ++bent_;
    }
    if (const auto other = track.spoke.find(track.latest); other != own && other->second.last.time >= last.time) {
      const Spoke& told = other->second.last;
      constexpr std::size_t most_pairs = 100, enough = 1000;
      const std::pair pair(sensor, other->first);
      if (const auto known = apart_.find(pair);
          known == apart_.end() ? apart_.size() < most_pairs : known->second.size() < enough)
        apart_[pair].push_back({off_the_way(told.time, told.at, last.time, last.at, now.time, now.at),
                                (now.at - last.at) / T, told.at, told.from_radar, dot(bend, bend)});
    }
  }
  own->second.before = {last.time, last.at};
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
  consider("{:.2g} s too {} in its times", 1.0, [](const Off& row) { return row.velocity; });
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

void Doubts::see(const Row& row, const std::optional<Position>& position, int axes) {
  const AnyPlot& plot = row.plot;
  const bool is_bearing = plot.sensor == AnyPlot::Sensor::bearing, has_rate = plot.sensor == AnyPlot::Sensor::doppler;
  const bool is_radar = has_rate || plot.sensor == AnyPlot::Sensor::polar;
  const Vector<3> origin(plot.origin.data());
  // Numbers as 101559 that are hours, minutes and seconds never end on 60 to 99.
  const double hundreds = std::floor(plot.time / 100.0);
  ++times_;
  if (std::fmod(plot.time, 100.0) < 60.0 && std::fmod(hundreds, 100.0) < 60.0) ++clocks_;
  if (std::fmod(plot.time, 50.0) != 0.0) ++uneven_;
  if (hundreds != hundreds_) ++minutes_;
  if (std::floor(hundreds / 100.0) != std::floor(std::exchange(hundreds_, hundreds) / 100.0)) ++hours_;
  latest_ = plot.time;
  Track& track = tracks_[row.track];
  const auto truth = row.truth ? std::optional(Vector<3>(row.truth->data())) : std::nullopt;
  if (const auto& reference = truth ? truth : track.located; reference && (is_bearing || is_radar)) {
    const double azimuth = plot.z[is_bearing ? 0 : 1];
    const double true_one = std::atan2((*reference)[1] - origin[1], (*reference)[0] - origin[0]);
    as_read_ += std::cos(azimuth - true_one);
    other_way_ += std::cos(90.0 * degree - azimuth - true_one);
    radians_ += std::cos(azimuth / degree - true_one);
    ++azimuths_;
  }
  farthest_ = std::max(farthest_, std::hypot(origin[0], origin[1]));
  if (is_bearing) see_bearing({plot.origin, plot.z[0]}, track.bearing);
  if (!position || axes_seen(plot, axes) < axes) return;
  const Vector<3> at(position->data());
  farthest_ = std::max(farthest_, std::hypot(at[0], at[1]));
  constexpr std::size_t enough_numbers = 1000;
  for (std::size_t i = 0; i < 2; ++i)
    if (const auto number = component_of(plot, static_cast<int>(i)); number && numbers_[i].size() < enough_numbers)
      numbers_[i].push_back(*number);
  if (!twice_) twice_ = row.twice;
  if (const double variance = plot.variance(0); !is_radar && variance > 0.0) {
    ++variances_.count;
    variances_.sum += variance;
  }
  const double height = axes == 3 ? component_of(plot, 2).value_or(nan) : nan;
  const auto rate = [&](int i) {
    return i < axes ? component_of(plot, axes + i).value_or(row.rates[static_cast<std::size_t>(i)]) : nan;
  };
  const Spoke now{plot.time,
                  at,
                  {at[0], at[1], std::isnan(height) ? at[2] : height, is_radar ? plot.z[0] : 0.0},
                  {rate(0), rate(1), rate(2), has_rate ? plot.z[static_cast<std::size_t>(plot.size) - 1] : nan},
                  truth ? Vector<3>(at - *truth) : Vector<3>::Constant(nan),
                  is_radar ? std::optional(Vector<3>(at - origin)) : std::nullopt,
                  row.twice && row.twice == twice_,
                  height,
                  row.line};
  if (height == 0.0) ++zero_heights_.rows;
  if (truth) {
    const bool is_zero = axes > 1 && (*truth)[0] == 0.0 && (*truth)[1] == 0.0;
    if (is_zero) ++zero_truths_.rows;
    zero_truths_.see(is_zero, length(now.error));
  }
  if (now.twice) ++twice_rows_;
  if (track.latest != row.sensor || sensors_.empty()) sensors_.insert(row.sensor);
  see_other(row.sensor, now, track);
  track.latest = row.sensor;
  const Since since{now.time, now.grown, now.rate};
  const auto [before, first] = track.spoke.try_emplace(row.sensor, Sensor{now, {since, since, since}});
  if (!first) see_rates(before->second, now);
  if (!is_radar) track.located = at;
  if (!track.first) {
    track.first = at;
    track.first_time = plot.time;
  } else if (steps_.size() < many) {
    steps_.push_back(plot.time - track.time);
  }
  track.last = at;
  track.time = plot.time;
}

/// By how much the measurements are off the truth on the average, where that is half of their scatter or more and six
/// standard errors, of errors that last as these do; else nothing.
std::string Doubts::shifted() const {
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

/// Where the steps of a lone track become a thousand times what they were, or a thousandth; else nothing.
std::string Doubts::other_times() const {
  if (tracks_.size() != 1 || steps_.size() < 2 * few) return {};
  double time = tracks_.begin()->second.first_time;
  const auto longest = std::ranges::max_element(steps_);
  for (auto step = steps_.begin(); step != longest; ++step) time += *step;
  if (longest - steps_.begin() < std::ptrdiff_t{few} || steps_.end() - longest <= std::ptrdiff_t{few}) return {};
  const double before = median({steps_.begin(), longest}), then = median({longest + 1, steps_.end()});
  if (!(std::abs(std::log10(then / before) - 3.0) < 0.05)) return {};  // also of steps of 0 s
  return fmt::format("{:.6g} s apart up to {:.6g} and {:.6g} s from {:.6g} on", before, time, then, time + *longest);
}

/// Whether a step is an hour longer, of a lone track at night in those months in which it is done somewhere.
bool Doubts::puts_clocks_forward(double step) const {
  double time = tracks_.begin()->second.first_time;
  return std::ranges::any_of(steps_, [&](double own) {
    const double before = std::exchange(time, time + own);
    if (std::abs(own - step - 3600.0) > 0.1 * step) return false;
    const std::chrono::sys_seconds then{std::chrono::seconds(std::lround(before))};
    const auto day = std::chrono::floor<std::chrono::days>(then);
    const auto month = static_cast<unsigned>(std::chrono::year_month_day(day).month());
    const bool in_spring = month == 3 || month == 4 || (month >= 8 && month <= 10);
    return tracks_.size() > 1 || (in_spring && then - day < std::chrono::hours(5));
  });
}

bool Doubts::comes_back() const {
  const std::size_t jumps = stays_[0].same + stays_[0].changed;
  return 3 * returns_ > 2 * jumps && jumps >= 2 * few;
}

std::optional<double> Doubts::scatter() const {
  const auto& products = second_.products;
  const auto correlation = [&](std::size_t lag) { return products[lag] / products[0]; };
  constexpr double median_of_bends = 1.652;  // 0.6745 √6 of the noise, which outliers do not move
  // Of noise alone they are −2/3, 1/6 and 0.
  const bool is_noise = correlation(1) < -0.58 && correlation(2) < 0.4 && std::abs(correlation(3)) < 0.2 &&
                        sensors_.size() == 1 && !comes_back();
  if (second_.sizes.size() < 200 || !is_noise) return {};
  return median(second_.sizes) / median_of_bends;
}

std::optional<double> Doubts::told_sigma() const {
  if (variances_.count < 200) return {};
  return std::sqrt(variances_.sum / static_cast<double>(variances_.count));
}

double Doubts::rounding(const RecordingReader& recording) const {
  double greatest = 0.0;
  for (std::size_t i = 0; i < 2 && recording.located(); ++i)
    if (const double own = rounding_of(numbers_[i]);
        std::isfinite(own) && std::set(numbers_[i].begin(), numbers_[i].end()).size() >= 2 * few)
      greatest = std::max(greatest, own);
  return greatest * (recording.geodetic() ? metres_a_degree : 1.0);
}

std::vector<std::string> Doubts::sentences(const RecordingReader& recording) const {
  std::vector<std::string> sentences;
  const auto say = [&](bool holds, std::string_view format, const auto&... words) {
    if (holds) sentences.push_back(recording.file() + ": " + fmt::format(fmt::runtime(format), words...));
  };
  const bool by_radar = recording.polar() && !recording.located();
  const std::string range_remedy = fmt::format(
      "where a radar counts closing as positive, its column is closing_rate_mps, else range_rate_mps: name it {}",
      recording.counts_closing() ? "range_rate_mps" : "closing_rate_mps");
  const std::array<std::array<std::string_view, 3>, 4> kinds = {
      {{"velocities along x", "x",
        by_radar                ? "see where azimuths count from, and whether vx is along x, or east"
        : recording.axes() == 1 ? "vx is along x, and so below 0 where x falls"
                                : "vx is along x, or east, and longitudes west are negative"},
       {"velocities along y", "y",
        by_radar ? "see where azimuths count from, and whether vy is along y, or north"
                 : "vy is along y, or north, and latitudes south are negative"},
       {"vertical velocities", "the heights", "vz and a vertical rate are upwards"},
       {"range rates", "the ranges", range_remedy}}};
  const char* const way_of_azimuths = recording.from_north() ? "counter-clockwise from east" : "clockwise from north";
  const char* const remedy_of_azimuths =
      recording.from_north() ? "name the column azimuth_deg, without --azimuth-from" : "give --azimuth-from north";
  const bool swapped = std::ranges::any_of(
      rates_, [](const Rates& rates) { return rates[exchanged].fits() && rates[velocities].correlation() < 0.5; });
  say(swapped && by_radar,
      "the velocities do not fit how the positions grow, but would if azimuths ran {}: {}; or if vx were vy, as vx is "
      "along x, or east, and a course clockwise from north",
      way_of_azimuths, remedy_of_azimuths);
  say(swapped && !by_radar,
      "the velocities do not fit how the positions grow, but would if the first were the second: vx is along x, or "
      "east, vy along y, or north, a latitude is along y, and a course is clockwise from north");
  // What noise makes of rates falls with the rows that they are taken over; what moves does not.
  const Agreement &by_one = rates_[0][velocities], &by_ten = rates_[1][velocities];
  const auto square = [](const Agreement& rates) { return rates.grew / static_cast<double>(rates.count); };
  const double size = by_one.grew / by_one.told;
  const bool same_size = by_ten.count >= few && square(by_one) < 2.0 * square(by_ten) && size > 0.25 && size < 4.0;
  bool is_clear = swapped;  // how the velocities are told
  for (std::size_t i = swapped ? z : x; i < kinds.size(); ++i) {
    const double most = i < z && same_size ? -0.8 : 0.0;
    const auto found = std::ranges::find_if(
        rates_, [&](const Rates& rates) { return rates[i].other_sign() && rates[i].correlation() < most; });
    is_clear |= found != rates_.end();
    say(found != rates_.end(), "the {} have the other sign than the growth of {} (correlation {:.2f}); {}", kinds[i][0],
        kinds[i][1], found == rates_.end() ? 0.0 : (*found)[i].correlation(), kinds[i][2]);
  }
  const auto say_scale = [&](Rate rate, std::string_view name, std::string_view others) {
    const auto wrong = std::ranges::find_if(
        rates_, [&](const Rates& rates) { return rates[rate].fits() && rates[rate].other_size(); });
    say(wrong != rates_.end(),
        "the {} are {:.2g} times what the {} say: see whether their unit, or that of the {} or times, is that of their "
        "header",
        name, wrong == rates_.end() ? 0.0 : 1.0 / (*wrong)[rate].growth_per_told(), others, others);
    return wrong != rates_.end();
  };
  is_clear |= say_scale(velocities, "velocities", "positions");
  constexpr double earth_radius = 6.4e6;  // of whose north one is another's, far away
  const double north_elsewhere = recording.on_the_earth() || by_radar ? 2.0 * farthest_ / earth_radius : 0.0;
  for (const Rates& rates : rates_) {
    const double angle = std::atan2(rates[to_the_left].product, rates[velocities].product);
    Agreement turned = rates[velocities];  // as far as they are
    turned.product = std::hypot(turned.product, rates[to_the_left].product);
    const double margin = 2.5 * degree + 5.0 * std::sqrt(std::max(turned.error_square(), 0.0)) + north_elsewhere;
    if (is_clear || !turned.fits() || std::abs(angle) < margin) continue;
    say(true,
        "the velocities point {:.2g}° to the {} of where the positions go: see whether a course is from true north, "
        "and whether it is one, and no heading{}",
        std::abs(angle) / degree, angle > 0.0 ? "right" : "left",
        by_radar ? ", and where azimuths count from and which way they run" : "");
    is_clear = true;
  }
  const auto rows_of_offset = static_cast<double>(offset_.count);
  const Vector<3> off = offsets_ / rows_of_offset;
  const double square_off = dot(off, off) * rows_of_offset;
  const bool is_off = offset_.count >= few && 2.0 * square_off > offset_.grew &&
                      square_off > std::max(0.003, north_elsewhere * north_elsewhere) * offset_.told;
  const bool elsewhere = same_size && by_ten.correlation() < 0.7;
  const Stays& told = stays_[2];
  const bool frozen = told.same > 9 * told.changed;
  say(!is_clear && (is_off || elsewhere) && frozen,
      "{} of {} velocities repeat the one before to the last digit, and the positions do not go so: nothing measured "
      "them; leave their cells empty",
      told.same, told.same + told.changed);
  is_clear |= frozen;
  say(!is_clear && is_off,
      "the velocities are ({}) m/s off how the positions grow, on the average and much the same all the time: see "
      "whether they are relative to something that moves, as water, air or the vehicle of the sensor",
      numbers_of(off, 2));
  say(!is_clear && !is_off && elsewhere,
      "the velocities are about as great as the positions tell, but point elsewhere (correlation {:.2f}): see whether "
      "they are along x and y, and not ahead and to a side, and whether a course is in the unit of its header",
      by_ten.correlation());
  // Measured ones are off these ways by the noise of positions, or by what turns within a step.
  const bool is_computed = computed_.count >= 2 * few && computed_.off < 0.05 * computed_.rough;
  say(!is_clear && is_computed,
      "the velocities are the ways from the rows before to those after by their time, as computed from these "
      "positions, and tell nothing new: do not let them count, by no sigma_velocity_mps");
  is_clear |= is_computed;
  const double step = steps_.empty() ? nan : median(steps_);
  const auto found_late = std::ranges::find_if(late_, [&](const Agreement& some) {
    return some.count >= 2 * few && some.correlation() * some.correlation() > 0.25 && some.error_square() < 0.04 &&
           std::abs(some.growth_per_told()) > 0.3 * step && std::abs(some.growth_per_told()) < 20.0 * step;
  });
  const bool is_late = found_late != late_.end();
  const double late = is_late ? found_late->growth_per_told() : nan;
  say(!is_clear && !is_off && !elsewhere && is_late,
      "the velocities are those of {:.2g} s {} the positions beside them{}: write each beside the time that it is of, "
      "or do not let them count, by no sigma_velocity_mps",
      std::abs(late), late > 0.0 ? "before" : "after",
      late > 0.0 && late < 0.7 * step ? ", as where each is the way since the row before by the step" : "");
  say_scale(z, "vertical velocities", "heights");
  say_scale(range, "range rates", "ranges");
  const auto n = static_cast<double>(azimuths_);
  // 1 − cos of an error is half of its square: so it is three times as great, and above 2.5°.
  const auto fits = [&](double sum) { return azimuths_ >= few && n - as_read_ > std::max(9.0 * (n - sum), 1e-3 * n); };
  const char* const reference = recording.has_truth() ? "truth" : "positions";
  say(fits(other_way_), "the azimuths do not fit the {}, but would if they ran {}: {}", reference, way_of_azimuths,
      remedy_of_azimuths);
  say(fits(radians_) && !recording.from_north(),
      "the azimuths do not fit the {}, but would if they were radians: name the column azimuth_rad", reference);
  const bool diverge = pairs_ >= few && pairs_ > 3 * crossing_;
  const bool would_cross = 9 * pairs_ < 10 * crossing_other_;
  say(diverge, "of {} pairs of bearings {} cross ahead of both their stations; {}", pairs_, crossing_,
      would_cross && !recording.from_north()
          ? "all but a few would, if they ran clockwise from north: give --azimuth-from north"
          : "see whether the stations stand where it is said, and how azimuths run");
  const double lag = lag_.growth_per_told();
  const bool lags = errors_ >= few && lag_.correlation() * lag_.correlation() > 0.5 && std::abs(lag) > 0.3 * step &&
                    std::abs(lag) < 20.0 * step;
  const bool no_truth = zero_truths_.stands_out();
  say(no_truth,
      "the truth is (0, 0) in {} rows, where it is much farther from what was measured than in all others: if that "
      "stands for no truth, empty those cells or name them by --missing",
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
  constexpr double earth = 6.371e6, far_away = 4e5;
  const bool is_far = recording.seen_from_places() && recording.axes() == 2 && farthest_ > far_away;
  say(is_far,
      "sensors or targets are {:.3g} km from where the map begins, on which lines of sight from elsewhere are "
      "straight: it is {:.2g} km off there",
      farthest_ / 1e3, std::pow(farthest_, 3) / (6e3 * earth * earth));
  std::set<std::string> doubted;  // so that none is named twice
  for (const auto& [sensors, rows] : apart_) {
    const auto& [one, other] = sensors;
    const std::string why = rows.size() < few || doubted.contains(one) ? "" : why_apart(rows, recording.axes());
    if (why.empty() || is_far) continue;
    doubted.insert(other);
    say(true,
        "beside sensor '{}', sensor '{}' is {} in most of {} rows, which is more than either scatters: see where both "
        "count from (sensor.{}.at), their datum and north, and their clocks",
        one, other, why, rows.size(), other);
  }
  std::size_t straight = 0;
  const double least_bend = 10.0 * std::sqrt(12.0) * rounding(recording);  // else a lone step of the numbers
  for (const auto& [sensor, all] : bends_) {
    auto bends = all;
    std::ranges::sort(bends);
    const double usual = bends[bends.size() * 19 / 20].first;
    std::set<float> different;  // few, where all is rounded
    for (const auto& [bend, way] : bends)
      if (different.size() <= few) different.insert(static_cast<float>(bend));
    const auto is_straight = [&](const auto& each) { return each.first < std::min(0.02 * usual, 5e-4 * each.second); };
    if (bends.size() >= 2 * few && different.size() > few && usual > least_bend)
      straight += static_cast<std::size_t>(std::ranges::count_if(bends, is_straight));
  }
  say(5 * straight > 2 * bent_,
      "{} of {} positions are on the line between those before and after, to within a fiftieth of what others are off "
      "it, as if they were interpolated: they count as new measurements, and the filters take their estimates for "
      "better than they are; leave the measured rows alone",
      straight, bent_);
  const auto names = each(tracks_, [](const auto& named) -> std::string_view { return named.first; });
  const std::pair<std::string_view, std::string> twins[] = {{"tracks", alike(names)},
                                                            {"sensors", alike({sensors_.begin(), sensors_.end()})}};
  for (const auto& [what, two] : twins)
    say(!two.empty(),
        "{} {} differ in case, blanks or the writing of a number only, and count as two; write them alike, if they are "
        "the same",
        what, two);
  const auto swallowed = recording.csv().swallowed();
  say(swallowed.is_doubtful(), swallowed_words, swallowed.line, swallowed.rows);
  for (const std::string& sentence : recording.rivals()) say(true, "{}", sentence);
  const auto nines = recording.nines();
  for (const std::string& sentence : nines) say(true, "{}", sentence);
  say(nines.empty() && twice_rows_ > 1 && 2.0 * to_twice_ > path_,
      "{} positions have {} for both coordinates, and most of the way is to there and back: if that stands for no "
      "position, empty those cells or name them by --missing",
      twice_rows_, twice_.value_or(0.0));
  for (const std::size_t i : {0U, 1U})
    if (const auto [abroad, first_abroad] = recording.abroad(i); abroad > 0)
      say(true, "{} positive {}, first on line {}, and were taken as {}: give them a minus sign", abroad,
          i == 0 ? "latitudes stand beside an S" : "longitudes stand beside a W", first_abroad,
          i == 0 ? "north" : "east");
  const bool along_the_ground = recording.polar() && recording.axes() == 2;
  const auto& headers = recording.csv().names();
  const auto tells_height = [](std::string_view name) {
    const std::string lower = lower_case(name);
    if (lower.starts_with("sensor_")) return false;
    constexpr std::array words = {"slant",        "altitude",     "height",    "depth",
                                  "flight_level", "flight level", "elevation", "depression"};
    return lower == "z" || lower.starts_with("z_") ||
           std::ranges::any_of(words, [&](std::string_view word) { return lower.find(word) != lower.npos; });
  };
  const auto height = std::ranges::find_if(headers, tells_height);
  say(along_the_ground && !recording.located() && height != headers.end(),
      "ranges are taken along the ground, beside a column {}: a slant range is longer; write range·cos(elevation), or "
      "give an elevation_deg",
      in_quotes(height == headers.end() ? "" : *height));
  const auto [relative, first_relative] = recording.relative();
  say(relative > 0,
      "an R stands beside {} azimuths, first on line {}, as beside those that are relative to a heading, and they were "
      "taken from {}: add the heading",
      relative, first_relative, recording.from_north() ? "north" : "east");
  const auto& zone = recording.other_zone();
  say(zone.line > 0 && (zone.is_none || std::abs(zone.step) > 10.0 * step),
      "times have another zone from line {} on, {:.6g} s after the one before, and those without a zone were taken as "
      "UTC; see whether each has the zone that it was told in",
      zone.line, zone.step);
  const bool are_forward = !recording.times_are_numbers() && !recording.zoned() && steps_.size() >= few &&
                           step <= 60.0 && puts_clocks_forward(step);
  say(!are_forward && slips_.size() == 1 && !slips_.contains(-1),
      "time goes on by {:.6g} s on line {}, where steps are of {:.6g} s, and the target only as far as in one of "
      "these{}: see whether a clock was set, days were read as months, or the zone is another one from there on",
      slip_.dt, slip_.line, slip_.step, slipped_ > 1 ? fmt::format("; so it is {} times", slipped_) : "");
  say(recording.at_one_time() > std::max(recording.rows(), few),
      "{} rows have the time of the row before, and were skipped: if times were rounded, as to whole seconds, write "
      "them in full{}",
      recording.at_one_time(),
      recording.has_tracks() ? ""
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
  const Leap leap = leap_.value_or(Leap{});
  say(leap_ && leaps_ <= most_leaps,
      "positions leap by {:.3g} m in {:.3g} s on line {}, 20 times as far as in the rows about it, and stay there{}: "
      "see whether a place, a unit, a zone or an axis changed, or the target (--track-id)",
      leap.way, leap.dt, leap.line, leaps_ > 1 ? fmt::format("; {} such in all", leaps_) : "");
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
  const std::size_t jumps = positions.same + positions.changed;
  say(comes_back(),
      "{} of {} positions are near one a few rows before, and five times as far from the last: if rows of several "
      "targets are mixed, name the column that tells them apart by --track-id, and if those of several sensors, one "
      "that is called sensor",
      returns_, jumps);
  // A target that stands repeats a few times, for long.
  const auto at_once = truths.after.find(0);
  const bool is_held = at_once == truths.after.end() || 10 * at_once->second < 9 * truths.changed;
  say(truths.same >= few && truths.changes.size() > few && 3 * truths.same > truths.changed && is_held &&
          20 * positions.same < truths.same,
      "{} of {} truths repeat the one before to the last digit, although what is measured moves: empty those cells, as "
      "errors are counted from where the target was",
      truths.same, truths.same + truths.changed);
  double moved = 0.0, duration = 0.0;
  for (const auto& [name, track] : tracks_) {
    if (!track.first) continue;
    duration += track.time - track.first_time;
    moved += length(*track.first - *track.last);
  }
  // What stays where it is repeats itself, too; but its way is much longer than the distance that it comes.
  // So does what is rounded, by steps that are few; a held position goes any way, and is held again, or as long.
  const bool goes_any_way = ways_.size() > few && 2 * ways_.size() > std::min(held_again_, many_ways);
  const bool held_again = 4 * held_again_ > 3 * positions.changed && goes_any_way;
  const bool on_its_way = moved > 0.5 * path_ && (goes_any_way || positions.regular());
  // Where some rows repeat the one before, at random, the next step is of several rows; after a rest it is a short one.
  const auto& [on, after] = steps_on_;
  const bool catches_up =
      tracks_.size() == 1 && on.count >= few && after.count >= few && after.mean() > 1.5 * on.mean() && goes_any_way;
  say(positions.same >= few &&
          ((4 * positions.same > jumps && (on_its_way || held_again)) || (10 * positions.same > jumps && catches_up)),
      "{} of {} positions repeat the one before to the last digit, although the target moves: values that are held "
      "count as new measurements, and the filters take their estimates for better than they are; leave one row of each",
      positions.same, jumps);
  if (steps_.size() < few) return sentences;
  const double speed = moved / duration;
  say(are_forward,
      "a step is an hour longer than the others, which are {:.6g} s: if times are local, and the clocks were put "
      "forward, write them with their zone",
      step);
  const bool of_a_date = latest_ >= 1.9e13 && latest_ < 2.1e13;
  const bool is_far_off = !of_a_date && latest_ > 1e11;
  say(is_far_off,
      "times from 1970 on would be of the year {:.0f}: see whether they are in a smaller unit than that of their "
      "header, and name it time_ms, time_us or time_ns",
      1970.0 + latest_ / 31556952.0);
  if (!recording.times_are_seconds()) return sentences;
  // Of whole minutes none ends on 6000 to 9999.
  const bool are_minutes = hours_ > 2 && step < 2000.0;
  say(times_ >= 2 * few && clocks_ == times_ && (minutes_ > 2 || of_a_date) && (uneven_ > 0 || are_minutes),
      "no time ends on 60 to 99, as numbers of seconds would; if they are hours, minutes and seconds in a row, give "
      "--time-format {}",
      latest_ < 1e6 ? "%H%M%S" : "%Y%m%d%H%M%S");
  const std::string others = other_times();
  say(!others.empty(), "times are {}: write all in one unit", others);
  const bool in_minutes = std::fmod(step, 300.0) == 0.0 && std::fmod(step, 1000.0) != 0.0;  // as an hour: what is slow
  for (const TimeColumn& unit : time_columns)
    // From a tenth of a second to twenty seconds, and from 0.5 m/s to 500 m/s.
    say(unit.unit_s < 1.0 && !in_minutes && !is_far_off && step * unit.unit_s >= (unit.unit_s < 1e-8 ? 1e-3 : 0.1) &&
            step * unit.unit_s <= 20.0 && speed / unit.unit_s >= 0.5 && speed / unit.unit_s < 500.0,
        "times that are {:.6g} s apart, and a speed of {:.2g} m/s: these look like {}; name the column {}, if they are",
        step, speed, unit.words, unit.name);
  say(speed > 1.2e4,  // nothing on the Earth or about it is as fast
      "a speed of {:.2g} m/s, where times are {:.2g} s apart: if times are not seconds, name the column time_min, "
      "time_h or time_days",
      speed, step);
  return sentences;
}

}  // namespace sigmax::apps
