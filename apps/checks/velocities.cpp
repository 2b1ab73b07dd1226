// Velocities against how positions grow: growth = A · velocity + c, with its lag. What A and c may be is a table.

#include "checks/checks.hpp"

namespace sigmax::apps::checks {
namespace {

using Complex = std::complex<double>;  // x + iy; along one line y is 0

struct Moment {
  double time;
  Complex at, velocity, way;  ///< the way since the first one by velocities
  std::size_t line;
};
using Path = std::vector<Moment>;

constexpr std::array lags = {-5.0, -4.0, -3.0, -2.0, -1.5, -1.0, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0};  // of steps

/// How much a path grows in a second over some rows, what its velocities say, and what they say at other lags.
struct Pair {
  Complex growth, reported;
  std::array<Complex, lags.size()> lagging;
};

/// What is compared, in words.
struct Words {
  std::string_view rates, positions, remedy_of_sign;
  bool along_one_line, count;
};

Complex way_at(const Path& path, double time) {
  const auto next = std::ranges::lower_bound(path, time, {}, &Moment::time) - path.begin();
  const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(next, 1, std::ssize(path) - 1));
  return path[k - 1].way +
         (time - path[k - 1].time) / (path[k].time - path[k - 1].time) * (path[k].way - path[k - 1].way);
}

/// Over so many rows, without gaps and without what hardly moves.
std::vector<Pair> pairs_of(const std::vector<Path>& paths, std::size_t rows, double step) {
  std::vector<Pair> pairs;
  const auto size_of = [](const Pair& pair) { return std::max(std::abs(pair.growth), std::abs(pair.reported)); };
  std::vector<double> sizes;
  for (const Path& path : paths)
    for (std::size_t k = rows; k < path.size(); k += std::max<std::size_t>(1, rows / 2)) {
      const Moment &from = path[k - rows], &to = path[k];
      const double T = to.time - from.time;
      if (T > 3.0 * step * static_cast<double>(rows)) continue;
      Pair pair{(to.at - from.at) / T, (to.way - from.way) / T, {}};
      for (std::size_t i = 0; i < lags.size(); ++i)
        pair.lagging[i] = (way_at(path, to.time + lags[i] * step) - way_at(path, from.time + lags[i] * step)) / T;
      pairs.push_back(pair);
      sizes.push_back(size_of(pair));
    }
  const double least = 0.2 * quantile_of(sizes, 0.9);
  std::erase_if(pairs, [&](const Pair& pair) { return size_of(pair) < least; });
  return pairs;
}

/// The usual number of pairs; of complex ones the usual parts.
template <class Number>
Complex fitted(const std::vector<Pair>& pairs, const Number& number) {
  std::vector<double> real, imaginary;
  for (const Pair& pair : pairs) {
    real.push_back(Complex(number(pair)).real());
    imaginary.push_back(Complex(number(pair)).imag());
  }
  return {median_of(std::move(real)), median_of(std::move(imaginary))};
}

/// What may be the unit of rates that are so many times too great.
std::string unit_of(double times) {
  const auto is = [&](double factor) { return std::abs(times / factor - 1.0) < 0.05; };
  for (const TimeColumn& time : time_columns)
    if (is(1.0 / time.unit_s)) return fmt::format("times in {} ({})", time.words, time.name);
  for (const Unit& unit : units::speeds)
    if (is(1.0 / unit.value)) return fmt::format("{} (_{})", unit.words, unit.suffix);
  return "those of another unit";
}

std::vector<Reading> readings_of_rates(const std::vector<Pair>& pairs, const Words& words, double step, double all) {
  std::vector<Reading> readings;
  const auto add = [&](double parameters, std::string text, const auto& read) {
    readings.push_back({std::move(text), {}, parameters});
    for (const Pair& pair : pairs) readings.back().off.push_back(std::norm(pair.growth - read(pair)));
  };
  constexpr Complex i(0.0, 1.0);
  add(0, "", [](const Pair& pair) { return pair.reported; });
  add(0, fmt::format("the {} have the other sign than {}: {}", words.rates, words.positions, words.remedy_of_sign),
      [](const Pair& pair) { return -pair.reported; });
  if (!words.along_one_line) {
    add(0,
        "velocities are exchanged: x for y, or a course that counts from east, or latitude for longitude; map the "
        "columns the other way round with --columns",
        [=](const Pair& pair) { return i * std::conj(pair.reported); });
    add(0, "the sign of velocities along x: they and x are to grow to the east; write both so",
        [](const Pair& pair) { return -std::conj(pair.reported); });
    add(0, "the sign of velocities along y: they and y are to grow to the north; write both so",
        [](const Pair& pair) { return std::conj(pair.reported); });
  }
  const Complex times = fitted(pairs, [](const Pair& pair) { return pair.growth / pair.reported; });
  if (times.real() > 0.0 && std::abs(std::log(times.real())) > 0.1)
    add(1,
        fmt::format("the scale of {}: they are {:.3g} times what {} say, as {} would be; name the unit in the header, "
                    "or map it with --columns",
                    words.rates, 1.0 / times.real(), words.positions, unit_of(1.0 / times.real())),
        [=](const Pair& pair) { return times.real() * pair.reported; });
  if (words.along_one_line) return readings;
  const double turn = std::arg(times);
  if (std::abs(turn) > 4.0 * degree)
    add(1,
        fmt::format("a rotation: velocities point {:.3g}° to the {} of where positions go; count courses clockwise "
                    "from true north, not from magnetic north or a heading",
                    std::abs(turn) / degree, turn > 0.0 ? "right" : "left"),
        [=](const Pair& pair) { return std::polar(1.0, turn) * pair.reported; });
  if (!words.count) return readings;  // nobody believes them, so what follows costs nothing
  const Complex wind = fitted(pairs, [](const Pair& pair) { return pair.growth - pair.reported; });
  if (std::norm(wind) > 0.0025 * all)
    add(2,
        fmt::format("a constant part: positions grow by ({:.2g}, {:.2g}) m/s more than velocities say, as where these "
                    "are through air (wind) or water; leave sigma_velocity_mps unset",
                    wind.real(), wind.imag()),
        [=](const Pair& pair) { return pair.reported + wind; });
  for (std::size_t k = 0; k < lags.size(); ++k)
    if (const double lag = lags[k] * step; std::abs(lag) >= 0.9)
      add(1,
          fmt::format("a lag: velocities are {:.2g} s {} than positions; shift them, or leave sigma_velocity_mps unset",
                      std::abs(lag), lag > 0.0 ? "later" : "earlier"),
          [=](const Pair& pair) { return pair.lagging[k]; });
  return readings;
}

void compare(const std::vector<Path>& paths, const Words& words, Findings& findings) {
  std::vector<double> steps;
  for (const Path& path : paths)
    for (std::size_t k = 1; k < path.size(); ++k) steps.push_back(path[k].time - path[k - 1].time);
  const double step = median_of(steps);
  // Over as many rows as make noise least, and turns no more.
  std::vector<Reading> readings;
  double least = infinity, all = nan, rough = nan;
  std::size_t over = 1;
  for (const std::size_t rows : {1U, 4U, 12U}) {
    const auto pairs = pairs_of(paths, rows, step);
    if (pairs.size() < 25) continue;
    const double size = fitted(pairs, [](const Pair& pair) { return std::norm(pair.growth); }).real();
    auto some = readings_of_rates(pairs, words, step, size);
    double left = infinity;
    for (const Reading& reading : some) left = std::min(left, median_of(reading.off) / size);
    if (left > 0.7 * least) continue;
    std::vector<double> changes;  // from pair to pair: little where growth is no noise
    for (std::size_t k = 2; k < pairs.size(); ++k)
      changes.push_back(std::norm(pairs[k].growth - pairs[k - 2].growth) / size);
    std::tie(rough, least, all, over) = std::tuple(median_of(std::move(changes)), left, size, rows);
    readings = std::move(some);
  }
  if (readings.empty()) return;
  const std::size_t line = paths.front().front().line;
  const Reading* const found = better(readings, std::max<std::size_t>(1, over / 2));
  if (found && quantile_of(found->off, 0.75) < 0.3 * all)
    findings.push_back({"", line, found->text});
  else if (words.count && !words.along_one_line && least > 0.25 && rough < 0.2 && readings.front().off.size() >= 50)
    findings.push_back({"", line,
                        "velocities have nothing to do with how positions grow: they are unrelated; leave "
                        "sigma_velocity_mps unset, or map the right columns with --columns"});
}

}  // namespace

void check_velocities(const Records& records, Findings& findings) {
  constexpr std::size_t most_rows = 20'000;
  const bool one = records.axes == 1, counts = records.recording.velocity_counts();
  const auto check = [&](const Words& words, const auto& at, const auto& velocity) {
    std::vector<Path> paths;
    for_each_path(records, [&](const std::string&, const std::vector<const Record*>& rows) {
      Path path;
      for (const Record* const row : rows) {
        const Complex here = at(*row), now = velocity(*row);
        if (std::isnan(std::abs(here) + std::abs(now)) || path.size() == most_rows) continue;
        const double dt = path.empty() ? 1.0 : row->time - path.back().time;
        const Complex way = path.empty() ? 0.0 : path.back().way + dt / 2.0 * (now + path.back().velocity);
        if (dt > 0.0) path.push_back({row->time, here, now, way, row->line});
      }
      if (!path.empty()) paths.push_back(std::move(path));
    });
    if (!paths.empty()) compare(paths, words, findings);
  };
  check(
      {"velocities", "positions", one ? "vx is below 0 where x falls" : "they point backwards; add 180° to a course",
       one, counts},
      [](const Record& row) { return Complex(row.at[0], row.at[1]); },
      [=](const Record& row) { return Complex(row.velocity[0], one ? 0.0 : row.velocity[1]); });
  check(
      {"vertical velocities", "heights", "count them upwards", true, counts},
      [](const Record& row) { return row.height; }, [](const Record& row) { return row.climb; });
  check(
      {"range rates", "ranges", "where closing is positive, name the column closing_rate_mps", true, true},
      [](const Record& row) { return row.range; }, [](const Record& row) { return row.range_rate; });
}

}  // namespace sigmax::apps::checks
