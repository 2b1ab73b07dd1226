#include "recording/doubts/doubts.hpp"

#include "recording/doubts/clocks.hpp"
#include "recording/doubts/rates.hpp"
#include "recording/doubts/stations.hpp"
#include "recording/plots.hpp"
#include "support/text.hpp"

namespace sigmax::apps {

using namespace doubts;

namespace {

/// A velocity along the axes of a frame rather than those of a place; how fast it climbs is that of its height.
Vector<3> moved(const std::array<Position, 3>& axes, const Vector<3>& velocity) {
  Vector<3> sum = Vector<3>::Zero();
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (const double own = velocity[static_cast<Eigen::Index>(i)]; !std::isnan(own))
      sum += own * Vector<3>(axes[i].data());
  sum[2] = velocity[2];
  return sum;
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
  // As a float holds them, whose steps grow with the number.
  const auto step_at = [](double number) { return number == 0.0 ? 0.0 : std::exp2(std::ilogb(number) - 23); };
  const auto held = std::ranges::count_if(numbers, [&](double number) {
    return std::abs(number - static_cast<double>(static_cast<float>(number))) <= 0.15 * step_at(number);
  });
  const double float_step = step_at(numbers[numbers.size() / 2]);
  const double by_float = 20 * held >= 19 * std::ssize(numbers) && least > 0.5 * float_step ? float_step : 0.0;
  for (double digits = 1.0; digits < 1e7; digits *= 10.0)  // as they are written
    if (std::ranges::all_of(numbers, [&](double number) {
          const double all = number * digits;
          return std::abs(all - std::round(all)) < 1e-9 + 1e-15 * std::abs(all);
        }))
      return std::max(by_float, 1.0 / digits) / std::sqrt(12.0);
  return by_float / std::sqrt(12.0);
}

struct Doubts::Parts {
  struct Sensor {
    explicit Sensor(const Spoke& first) : trail{first}, rates(first) {}
    Trail trail;
    Rates::Sensor rates;
    Repeats::Sensor repeats{};
  };
  struct Track {
    double first_time = 0.0, time = 0.0;  // of those with a position
    std::optional<Vector<3>> first{}, last{};
    std::optional<Vector<3>> located{};             // by a sensor of positions
    std::optional<Stations::Bearing> bearing{};     // the last one
    std::map<std::string, Stations::Path> paths{};  // that each radar saw
    std::map<std::string, Sensor> sensors{};
    std::string latest{};  // of them
  };
  /// A row after the first of its sensor.
  void see_next(const Track& track, const std::string& name, Sensor& sensor, Spoke& now);
  void see_bends(const Trail& trail, const Spoke& now);
  void say_reading(Say& say, const RecordingReader& recording) const;

  Rates rates{};
  Stations stations{};
  Repeats repeats{};
  Clocks clocks{};
  std::map<std::string, Track> tracks{};
  std::set<std::string> sensors{};
  static constexpr std::size_t enough_numbers = 1000;
  std::array<std::vector<double>, 2> numbers{};  // along x and y, as rows tell them, the first of them
  struct {
    std::vector<double> sizes{};          // the first thousands along an axis
    std::array<double, 4> products = {};  // of each with itself and those before
  } second{};                             // differences of positions
  RunningMean variances{};                // that rows tell of positions, along an axis
  std::size_t located = 0;                // rows that might
};

Doubts::Doubts() : parts_(std::make_shared<Parts>()) {}

void Doubts::see(const Row& row, const std::optional<Position>& position, const LocalFrame* frame, int axes) {
  const AnyPlot& plot = row.plot;
  const bool has_rate = plot.sensor == AnyPlot::Sensor::doppler;
  const bool is_radar = has_rate || plot.sensor == AnyPlot::Sensor::polar;
  parts_->clocks.see(plot.time);
  Parts::Track& track = parts_->tracks[row.track];
  const auto truth = row.truth ? std::optional(Vector<3>(row.truth->data())) : std::nullopt;
  if (is_radar || plot.sensor == AnyPlot::Sensor::bearing)
    parts_->stations.see(plot, truth ? truth : track.located, track.bearing);
  if (!position || axes_seen(plot, axes) < axes) return;
  const Vector<3> at(position->data());
  parts_->stations.see(at);
  if (is_radar) parts_->stations.see_path(at, plot, track.paths[row.sensor]);
  for (int i = 0; i < 2; ++i)
    if (auto& some = parts_->numbers[static_cast<std::size_t>(i)]; some.size() < Parts::enough_numbers)
      if (const auto number = component_of(plot, i)) some.push_back(*number);
  if (!is_radar) ++parts_->located;
  if (const double variance = plot.variance(0); !is_radar && variance > 0.0) parts_->variances.add(variance);
  const double height = axes == 3 ? component_of(plot, 2).value_or(nan) : nan;
  Vector<3> velocity = Vector<3>::Constant(nan);
  for (int i = 0; i < axes; ++i)
    velocity[i] = component_of(plot, axes + i).value_or(row.rates[static_cast<std::size_t>(i)]);
  const Vector<3> here = frame && !std::isnan(velocity[0]) ? moved(frame->local_axes(*position), velocity) : velocity;
  Spoke now{plot.time,
            at,
            {at[0], at[1], std::isnan(height) ? at[2] : height, is_radar ? plot.z[0] : 0.0},
            {here[0], here[1], here[2], has_rate ? plot.z[static_cast<std::size_t>(plot.size) - 1] : nan},
            velocity,
            truth ? Vector<3>(at - *truth) : Vector<3>::Constant(nan),
            is_radar ? std::optional(Vector<3>(at - Vector<3>(plot.origin.data()))) : std::nullopt,
            height,
            row.twice,
            row.line};
  parts_->repeats.see(row, now, axes);
  const auto [own, first] = track.sensors.try_emplace(row.sensor, now);
  if (!first && track.latest != row.sensor)
    parts_->repeats.see_other(length(now.at - own->second.trail.last.at), track.last == now.at);
  if (first)
    parts_->sensors.insert(row.sensor);
  else
    parts_->see_next(track, row.sensor, own->second, now);
  track.latest = row.sensor;
  if (!is_radar) track.located = at;
  parts_->clocks.see(plot.time, track.first ? std::optional(track.time) : std::nullopt);
  if (!track.first) {
    track.first = at;
    track.first_time = plot.time;
  }
  track.last = at;
  track.time = plot.time;
}

void Doubts::Parts::see_next(const Track& track, const std::string& name, Sensor& sensor, Spoke& now) {
  Trail& trail = sensor.trail;
  const Spoke& last = trail.last;
  const double dt = now.time - last.time;
  if (!(dt > 0.0)) return;
  if (const auto& before = trail.before; before && dt <= 2.0 * (last.time - before->first)) {
    const Vector<3> bend = off_the_way(last.time, last.at, before->first, before->second, now.time, now.at);
    repeats.see_bend(sensor.repeats, trail, now, length(bend));
    if (const auto& [other, told] = *track.sensors.find(track.latest);
        other != name && told.trail.last.time >= last.time)
      stations.see_other(name, last, now, bend, other, told.trail.last);
  }
  repeats.see(sensor.repeats, trail, now);
  trail.recent.keep(now.at);
  trail.even = std::abs(dt - trail.step) < 0.01 * dt ? trail.even + 1 : 0;
  see_bends(trail, now);
  clocks.see_slip(trail, now);
  const Vector<3> first = track.first.value_or(last.at);
  clocks.see_way(dt, length(now.at - last.at), length(now.at - first) - length(last.at - first));
  stations.see_error(last, now);
  rates.see(sensor.rates, trail, now);
  trail.before = {last.time, last.at};
  trail.step = dt;
  trail.last = now;
}

void Doubts::Parts::see_bends(const Trail& trail, const Spoke& now) {
  const auto& recent = trail.recent;
  if (!recent.reaches(3) || trail.even < 2) return;
  const auto bend = [&](std::size_t ago) -> Eigen::Vector2d {
    return (recent[ago] - 2.0 * recent[ago + 1] + recent[ago + 2]).head<2>();
  };
  for (std::size_t lag = 0; lag < second.products.size() && recent.reaches(lag + 2) && lag < trail.even; ++lag)
    second.products[lag] += bend(0).dot(bend(lag));
  for (const double own : {bend(0)[0], bend(0)[1]})
    if ((own != 0.0 || now.at[1] != 0.0) && second.sizes.size() < many) second.sizes.push_back(std::abs(own));
}

std::optional<double> Doubts::scatter() const {
  const auto& products = parts_->second.products;
  const auto correlation = [&](std::size_t lag) { return products[lag] / products[0]; };
  constexpr double median_of_bends = 1.652;  // 0.6745 √6 of the noise, which outliers do not move
  // Of noise alone they are −2/3, 1/6 and 0.
  const bool is_noise = correlation(1) < -0.58 && correlation(2) < 0.4 && std::abs(correlation(3)) < 0.2 &&
                        parts_->sensors.size() == 1 && !parts_->repeats.comes_back();
  if (parts_->second.sizes.size() < 200 || !is_noise) return {};
  return median(parts_->second.sizes) / median_of_bends;
}

std::optional<double> Doubts::told_sigma() const {
  if (parts_->variances.count() < 200 || 10 * parts_->variances.count() < 9 * parts_->located) return {};
  return std::sqrt(parts_->variances.mean());
}

double Doubts::apart(double sigma_position, double sigma_velocity) const {
  return parts_->rates.apart(parts_->clocks.step(), sigma_position, sigma_velocity);
}

double Doubts::off_the_map(const RecordingReader& recording) const {
  return recording.seen_from_places() && recording.axes() == 2 ? parts_->stations.off_the_map() : 0.0;
}

bool Doubts::from_one_that_moves() const { return parts_->stations.from_one_that_moves(); }

double Doubts::rounding(const RecordingReader& recording) const {
  double greatest = 0.0;
  for (std::size_t i = 0; i < 2 && recording.located(); ++i)
    if (const double own = rounding_of(parts_->numbers[i]);
        std::isfinite(own) && std::set(parts_->numbers[i].begin(), parts_->numbers[i].end()).size() >= 2 * few)
      greatest = std::max(greatest, own);
  return greatest * (recording.geodetic() ? metres_a_degree : 1.0);
}

/// What the reader found in cells and headers.
void Doubts::Parts::say_reading(Say& say, const RecordingReader& recording) const {
  const auto names = each(tracks, [](const auto& named) -> std::string_view { return named.first; });
  const std::pair<std::string_view, std::string> twins[] = {{"tracks", alike(names)},
                                                            {"sensors", alike({sensors.begin(), sensors.end()})}};
  for (const auto& [what, two] : twins)
    say(!two.empty(),
        "{} {} differ in case, blanks, Unicode forms or the writing of a number only, and count as two; write them "
        "alike, if they are "
        "the same",
        what, two);
  const auto swallowed = recording.csv().swallowed();
  say(swallowed.is_doubtful(), swallowed_words, swallowed.line, swallowed.rows);
  for (const std::string& sentence : recording.rivals()) say(true, "{}", sentence);
  for (const std::string& sentence : recording.nines()) say(true, "{}", sentence);
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
}

std::vector<std::string> Doubts::sentences(const RecordingReader& recording) const {
  Say say(recording.file());
  const double step = parts_->clocks.step();
  constexpr double earth = 6.4e6;  // north far from a radar is not north at it
  const double north_elsewhere =
      recording.polar() && !recording.located() ? 2.0 * parts_->stations.farthest() / earth : 0.0;
  parts_->rates.say(say, recording, parts_->repeats.velocities(), step, north_elsewhere);
  parts_->stations.say(say, recording, step, parts_->repeats.no_truth());
  parts_->say_reading(say, recording);
  double moved = 0.0, duration = 0.0;
  std::vector<const Repeats::Sensor*> sensors;
  for (const auto& [name, track] : parts_->tracks) {
    if (!track.first) continue;
    duration += track.time - track.first_time;
    moved += length(*track.first - *track.last);
    for (const auto& [sensor, own] : track.sensors) sensors.push_back(&own.repeats);
  }
  parts_->repeats.say_interpolated(say, sensors, rounding(recording));
  parts_->repeats.say(say, recording, parts_->tracks.size(), moved);
  parts_->clocks.say(say, recording, parts_->tracks.size(), moved, duration);
  return std::move(say.sentences);
}

}  // namespace sigmax::apps
