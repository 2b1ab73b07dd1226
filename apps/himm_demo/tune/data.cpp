#include "himm_demo/tune/tune.hpp"

#include <sigmax/estimation/dense.hpp>
#include <sigmax/hybrid/fit_target.hpp>

#include "checks/checks.hpp"
#include "shell/random.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t fewest_measurements = 10;  // of a track: three start the filter
constexpr std::size_t fewest_in_all = 40;
constexpr double stray_share = 0.01;                             // of all measurements
constexpr double metres_a_degree = 60.0 * units::nautical_mile;  // of latitude
constexpr double rows_apart = 60.0;                              // in s, in which what moves may turn more than once

/// The standard deviation of the rounding of numbers that come in whole steps; else 0, and infinite where they never
/// change.
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

void refuse_other_kind(const TuneOptions& options, const TuneData& data, const RecordingReader& recording) {
  const std::string& file = recording.file();
  if (recording.axes() != data.axes)
    throw InputError({.where = file,
                      .what = fmt::format("it has {} axes, {} has {}", recording.axes(), options.files[0], data.axes),
                      .remedy = "tune recordings of one, two and three axes apart"});
  if (options.objective != Objective::prequential && !options.radar.sigma && !recording.has_truth())
    throw InputError(
        "{}:1: --truth, but there is no column true_x_m; leave out --truth, name the columns with --columns, or take "
        "the recording as the truth with --radar",
        file);
  refuse_radar(options.radar, recording);
}

/// What a quantity of a plot is filed by; a position is components too.
QuantityKey quantity_of(const AnyPlot& plot, std::size_t i) {
  using enum AnyPlot::Sensor;
  if (plot.sensor == position) return {components, static_cast<int>(i)};
  return {plot.sensor, plot.sensor == components ? plot.places[i] : static_cast<int>(i)};
}

/// The numbers of each sensor's columns, as they were written.
using Columns = std::map<std::string, std::map<QuantityKey, std::vector<double>>, std::less<>>;

/// Takes down a row's numbers; of a place in m along a meridian, and of a velocity along two axes or more also the
/// speed, since that may be what was rounded. It is filed behind the velocity.
void take_down(const Row& row, int axes, bool geodetic, Columns& columns) {
  const AnyPlot& plot = row.plot;
  auto& own = columns[row.sensor];
  double squares = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(plot.size); ++i) {
    const auto key = quantity_of(plot, i);
    const bool is_component = plot.sensor == AnyPlot::Sensor::components;
    const bool is_angle = geodetic && is_component && key.second < 2;
    own[key].push_back(plot.z[i] * (is_angle ? metres_a_degree : 1.0));
    if (is_component && key.second >= axes && key.second < axes + 2) squares += plot.z[i] * plot.z[i];
  }
  if (is_moving(plot, axes)) own[{plot.sensor, 2 * axes}].push_back(std::sqrt(squares));
}

void read(const std::string& file, const TuneOptions& options, const FilterSettings& settings, TuneData& data,
          Columns& columns) {
  struct Open {  // what is kept of a track while its file is read
    std::size_t place;
    RandomStream random;
    std::optional<LocalFrame> frame{};
    Geodetic last{nan, nan, nan};  // place, of what rows told
    std::optional<Position> at{};  // the same in the frame, once it is known
  };
  RecordingOptions of_file = options.recording;
  of_file.file = file;
  of_file.simulated = options.radar.sigma.has_value();
  RecordingReader recording(of_file);
  refuse_other_kind(options, data, recording);
  data.geodetic |= recording.geodetic();
  data.crosses |= recording.bearings() && !recording.located();
  data.moves_alone |= recording.moves_alone();
  SensorPlaces places(settings, recording, options.radar.place());
  const bool one_frame = options.radar.sigma || recording.has_truth() || recording.seen_from_places();
  std::optional<Geodetic> first = recording.origin();
  std::map<std::string, Open, std::less<>> open;
  RecordingChecks checks(recording);
  for (Row row; recording.next(row);) {
    const auto [found, is_new] =
        open.try_emplace(row.track, Open{data.tracks.size(), stream_of(options.seed, row.track)});
    if (is_new) data.tracks.push_back({recording.file(), {}});
    Open& its = found->second;
    if (!options.radar.sigma) {
      take_down(row, data.axes, recording.geodetic(), columns);
      places.place(row);
    }
    if (!first && places.frame()) first = places.frame()->origin();
    checks.see(row, places.frame() ? &*places.frame() : nullptr);
    const bool is_place = recording.geodetic() && row.plot.sensor == AnyPlot::Sensor::components;
    if (is_place) {
      its.last = {component_of(row.plot, 0).value_or(its.last.latitude_deg),
                  component_of(row.plot, 1).value_or(its.last.longitude_deg),
                  data.axes == 3 ? component_of(row.plot, 2).value_or(its.last.altitude_m) : 0.0};
      if (const auto start = place_of(row.plot, data.axes); start && !its.frame) {
        if (!first) first = start;
        its.frame.emplace(one_frame ? *first : recording.origin().value_or(*start), data.axes);
      }
      if (its.frame && its.last.is_valid()) its.at = its.frame->to_local(its.last);
    }
    if (is_place)
      row.plot = its.at ? in_frame(row.plot, *its.frame, *its.at, data.axes) : AnyPlot::missed(row.plot.time);
    if (options.radar.sigma)
      see_by_radar(row, position_of(row.plot, data.axes), data.axes, options.radar, its.random, recording.file());
    data.has_truth |= row.truth.has_value();
    auto& rows = data.tracks[its.place].rows;
    row.plot.tag = rows.size();
    rows.push_back(std::move(row));
  }
  if (recording.skipped() > 0)
    data.notes.push_back(fmt::format("{}: Rows skipped, since their time is not after that of the row before: {}",
                                     recording.file(), recording.skipped()));
  for (const auto& notes : {recording.notes(), places.notes()})
    for (const std::string& note : notes) data.notes.push_back(fmt::format("{}: {}", file, note));
  if (const auto assumed = checks.assumed()) data.notes.push_back(*assumed);
  for (const std::string& finding : checks.findings()) data.notes.push_back(finding);
}

/// The positions of one sensor of a track, and how far each is off the line between the two beside it, along x and y.
struct Bends {
  std::vector<AnyPlot> last{};
  std::array<std::vector<double>, 2> off{};

  void see(const AnyPlot& plot) {
    last.push_back(plot);
    if (last.size() < 3) return;
    const double share = (last[1].time - last[0].time) / (plot.time - last[0].time);
    for (std::size_t i = 0; i < 2; ++i)
      off[i].push_back(std::abs(last[1].z[i] - last[0].z[i] - share * (plot.z[i] - last[0].z[i])));
    last.erase(last.begin());
  }

  /// Whether one scatters twice as much.
  bool apart() {
    constexpr std::size_t enough = 30;
    if (off[0].size() < enough) return false;
    const double x = quantile(off[0], 0.5), y = quantile(off[1], 0.5);
    return x > 0.0 && y > 0.0 && std::max(x, y) > 2.0 * std::min(x, y);
  }
};

/// Drops what is too short, and takes down what the rest holds.
void summarize(TuneData& data, const Columns& columns) {
  const std::size_t all = data.tracks.size();
  std::erase_if(data.tracks, [](const TuneTrack& track) {
    const auto measured = std::ranges::count_if(track.rows, [](const Row& row) { return row.measured(); });
    return static_cast<std::size_t>(measured) < fewest_measurements;
  });
  data.too_short = all - data.tracks.size();
  std::vector<double> steps;
  std::map<std::string, std::map<QuantityKey, std::vector<double>>> changes;
  std::map<std::string, Bends> bends;
  for (const TuneTrack& track : data.tracks) {
    for (auto& [sensor, its] : bends) its.last.clear();
    std::optional<double> last;
    std::map<QuantityKey, double> numbers;
    for (const Row& row : track.rows) {
      if (!row.measured()) continue;
      if (last && row.plot.time > *last) steps.push_back(row.plot.time - *last);
      last = row.plot.time;
      const int seen = axes_seen(row.plot, data.axes);
      const bool by_radar = row.plot.sensor == AnyPlot::Sensor::polar || row.plot.sensor == AnyPlot::Sensor::doppler;
      const bool is_bearing = row.plot.sensor == AnyPlot::Sensor::bearing;
      bool unsaid = false;  // whether the filter must know how well
      TuneSensor& sensor = data.sensors[row.sensor];
      for (int i = 0; i < (is_bearing ? 1 : seen); ++i)
        (std::isnan(row.plot.variance(i)) ? unsaid : sensor.stated) = true;
      ++data.measurements;
      ++sensor.rows;
      sensor.velocity |= is_moving(row.plot, data.axes);
      sensor.range_rate |= row.plot.sensor == AnyPlot::Sensor::doppler;
      (is_bearing ? sensor.bearing : by_radar ? sensor.radar : sensor.position) |= unsaid;
      if (!is_bearing && !by_radar && data.axes > 1 && seen == data.axes) bends[row.sensor].see(row.plot);
      for (std::size_t i = 0; i < static_cast<std::size_t>(row.plot.size); ++i) {
        const auto key = quantity_of(row.plot, i);
        const auto [before, is_first] = numbers.try_emplace(key, row.plot.z[i]);
        if (const double change = std::abs(row.plot.z[i] - before->second); change > 0.0)
          changes[row.sensor][key].push_back(change);
        before->second = row.plot.z[i];
      }
    }
  }
  // East and north are no axes of a sensor: what scatters otherwise along them is the way of a target.
  for (auto& [name, its] : bends) data.sensors[name].apart = !data.geodetic && its.apart();
  for (auto& [name, sensor] : data.sensors)
    if (const auto own = columns.find(name); own != columns.end())
      for (const auto& [key, numbers] : own->second) {
        const bool is_longitude = data.geodetic && key == QuantityKey{AnyPlot::Sensor::components, 1};
        const double latitude =
            is_longitude ? own->second.at({AnyPlot::Sensor::components, 0}).front() / metres_a_degree : 0.0;
        sensor.rounding[key] = rounding_of(numbers) * std::cos(latitude * degree);
        if (std::isinf(sensor.rounding[key]))
          data.notes.push_back(
              fmt::format("{}: a column never changes, which no noise does: what is fitted may be too small, and a "
                          "sigma of such columns alone is left as it is; leave out what nothing measured",
                          name.empty() ? "all rows" : "sensor " + name));
      }
  for (auto& [name, its] : changes)
    for (auto& [key, own] : its) data.sensors[name].stray_width[key] = 6.0 * quantile(own, 0.9);
  if (steps.empty()) return;
  data.step_s = quantile(steps, 0.5);
  data.long_step_s = quantile(steps, 0.9);
  data.longest_step_s = *std::ranges::max_element(steps);
  if (data.longest_step_s > 200.0 * data.step_s)
    data.notes.push_back(
        fmt::format("a step of {:.4g} s is among those of {:.4g} s: if a target may do anything meanwhile, let filters "
                    "start anew by --set restart_after_s=…, and where it is another target, tell both apart",
                    data.longest_step_s, data.step_s));
  data.uneven_steps = data.long_step_s >= 2.0 * quantile(steps, 0.1);
}

/// Of the true position, by the estimate's leading components; an axis that there is not counts for nothing.
double truth_loss(const TargetPoint& now, const Position& truth, int axes, Objective objective) {
  std::array<double, 3> error{};
  std::array<double, 9> covariance = {1, 0, 0, 0, 1, 0, 0, 0, 1}, root{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(axes); ++i) {
    error[i] = now.mean[i] - truth[i];
    for (std::size_t k = 0; k <= i; ++k) covariance[i + 3 * k] = now.covariance[i + k * now.mean.size()];
  }
  const auto squared = [&] { return error[0] * error[0] + error[1] * error[1] + error[2] * error[2]; };
  if (objective == Objective::rmse) return squared();
  if (!detail::cholesky_factor(covariance.data(), 3, root.data()))
    throw std::domain_error("the covariance of an estimate is not positive definite");
  detail::lower_solve(root.data(), 3, error.data());
  const double log_root = std::log(root[0]) + std::log(root[4]) + std::log(root[8]);
  return 0.5 * squared() + log_root + 0.5 * axes * std::log(2.0 * std::numbers::pi);
}

/// How well all other rows, before and after, predict a plot of components, by what smoothing knows of its state with
/// it. With e = z − Hx and C = R − HPHᵀ the plot is R C⁻¹ e off what they say, of covariance R C⁻¹ R, so that its
/// squared distance is eᵀ C⁻¹ e. Nothing where the covariances do not allow it.
std::optional<double> log_score_by_others(const AnyPlot& plot, const TargetPoint& smoothed) {
  const auto size = static_cast<std::size_t>(plot.size), n = smoothed.mean.size();
  std::array<double, 6> error{};
  std::array<double, 36> rest{}, root{}, own_root{};
  for (std::size_t i = 0; i < size; ++i) {
    const auto at = static_cast<std::size_t>(quantity_of(plot, i).second);
    error[i] = plot.z[i] - smoothed.mean[at];
    for (std::size_t k = 0; k < size; ++k)
      rest[i + size * k] = plot.covariance[i + size * k] -
                           smoothed.covariance[at + n * static_cast<std::size_t>(quantity_of(plot, k).second)];
  }
  if (!detail::cholesky_factor(rest.data(), plot.size, root.data()) ||
      !detail::cholesky_factor(plot.covariance.data(), plot.size, own_root.data()))
    return std::nullopt;
  detail::lower_solve(root.data(), plot.size, error.data());
  double score = -0.5 * plot.size * std::log(2.0 * std::numbers::pi);
  for (std::size_t i = 0; i < size; ++i)
    score += std::log(root[i * (size + 1)]) - 2.0 * std::log(own_root[i * (size + 1)]) - 0.5 * error[i] * error[i];
  return score;
}

}  // namespace

bool TuneOptions::fits(std::string_view what) const { return std::ranges::find(fixed, what) == fixed.end(); }

TuneData read_tune_data(const TuneOptions& options, const FilterSettings& settings) {
  if (std::ranges::count(options.files, "-") > 0)
    throw UsageError("tune reads its files more than once: it takes no standard input");
  RecordingOptions first = options.recording;
  first.file = options.files.front();
  TuneData data{.axes = RecordingReader(first).axes()};
  Columns columns;
  for (const auto& file : options.files) read(file, options, settings, data, columns);
  summarize(data, columns);
  if (data.geodetic && !data.has_truth && !options.radar.sigma)
    data.notes.push_back(
        "errors that last from row to row, as those of a GNSS, cannot be told from the target's way without a truth: "
        "sigma_position_m is how far rows scatter beside their neighbours, and what is stated of estimates leaves out "
        "what lasts: where the device's accuracy is known, keep it by --keep sensors");
  const auto has_position = [](const auto& sensor) { return sensor.second.position; };
  if (data.step_s >= rows_apart && !data.has_truth && std::ranges::any_of(data.sensors, has_position))
    data.notes.push_back(
        fmt::format("of rows {:.6g} s apart sigma_position_m may hold the turns between them, too: where the device's "
                    "accuracy is known, keep it by --keep sensors, and try a model whose velocity does not last "
                    "(--models cwna,ou_velocity)",
                    data.step_s));
  const bool by_steps = options.models.empty() && std::ranges::any_of(settings.motions, [](const MotionChoice& motion) {
                          return motion.name == "dwna" || motion.name == "dwpa";
                        });
  if (by_steps && !data.uneven_steps && data.longest_step_s >= 10.0 * data.step_s)
    data.notes.push_back(
        fmt::format("dwna and dwpa are models of one step, {:.4g} s as a rule: after one of {:.4g} s they state too "
                    "great sigmas, which cwna and cwpa do not (--models cwna,cwpa,cwna+cwpa)",
                    data.step_s, data.longest_step_s));
  const double change = data.stray_width({AnyPlot::Sensor::components, 0}) / 6.0;
  const double sigma = settings.accuracy.position_m.front();
  if (change > 0.0 && change < 1.7e-5 * sigma)
    data.notes.push_back(fmt::format(
        "positions change by {:.2g} m from row to row, and sigma_position_m begins at {:.2g} m: from so far away "
        "little may be found; begin nearer, with --set sigma_position_m={:.1g} and a sigma_w as small",
        change, sigma, change));
  if (data.measurements < fewest_in_all)
    throw InputError(
        "{}: there is too little to fit: found {} measurements of tracks with at least {}, expected at least {}; give "
        "a longer recording, or several",
        options.files.front(), data.measurements, fewest_measurements, fewest_in_all);
  return data;
}

double quantile(std::vector<double>& numbers, double share) {
  const auto place = numbers.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(numbers.size() - 1));
  std::nth_element(numbers.begin(), place, numbers.end());
  return *place;
}

double TuneSensor::rounding_of(AnyPlot::Sensor kind, int from, int to) const {
  std::optional<double> greatest;
  for (const auto& [key, own] : rounding)
    if (key.first == kind && key.second >= from && key.second <= to)
      if (!greatest || std::isinf(*greatest) || (std::isfinite(own) && own > *greatest)) greatest = own;
  return greatest.value_or(0.0);
}

bool TuneSensor::sees(int from, int to) const {
  const auto first = stray_width.lower_bound({AnyPlot::Sensor::components, from});
  return first != stray_width.end() && first->first <= QuantityKey{AnyPlot::Sensor::components, to};
}

double TuneData::stray_width(const QuantityKey& quantity) const {
  double width = 0.0;
  for (const auto& [name, sensor] : sensors)
    if (const auto own = sensor.stray_width.find(quantity); own != sensor.stray_width.end())
      width = std::max(width, own->second);
  return width;
}

double TuneData::log_stray(const std::string& sensor, const AnyPlot& plot) const {
  const auto& widths = sensors.find(sensor)->second.stray_width;
  double sum = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(plot.size); ++i) {
    // A quantity that never changes has no width, and no row is off.
    if (const auto found = widths.find(quantity_of(plot, i)); found != widths.end()) sum -= std::log(found->second);
  }
  return sum;
}

double TuneData::share_of_strays(const RowLosses& losses) const {
  double strays = 0.0, all = 0.0;
  for (std::size_t t = 0; t < tracks.size(); ++t)
    for (std::size_t k = 0; k < losses[t].size(); ++k) {
      if (std::isnan(losses[t][k])) continue;
      ++all;
      const double width = log_stray(tracks[t].rows[k].sensor, tracks[t].rows[k].plot);  // 0 where nothing changes
      const double of_a_stray = -std::log(stray_share) - width;
      if (width != 0.0 && losses[t][k] > of_a_stray - std::log(2.0)) ++strays;
    }
  return strays / all;
}

RowFolds TuneData::folds(std::size_t count) const {
  return folds_of(each(tracks, [](const TuneTrack& track) { return track.rows.size(); }), count);
}

std::vector<AnyPlot> TuneData::plots(const TuneTrack& track, const FilterSettings& settings) const {
  return each(track.rows, [&](const Row& row) { return believed(settings, row.sensor, row.plot, axes); });
}

TargetChoice judged_choice(const TuneData& data, const FilterSettings& settings) {
  TargetChoice choice = choice_of(settings, data.axes);
  choice.rules.record = false;
  if (data.crosses) choice.rules.waiting = bearings_of_a_start;
  return choice;
}

RowLosses losses(const TuneData& data, const FilterSettings& settings, Objective objective, const Look& look,
                 std::vector<RowPlace>* set_aside) {
  const TargetChoice choice = judged_choice(data, settings);
  const bool starts_anywhere = settings.start == StartRule::given && !data.geodetic;  // as `track` does
  const bool prequential = objective == Objective::prequential;
  RowLosses result;
  for (std::size_t t = 0; t < data.tracks.size(); ++t) {
    const auto& rows = data.tracks[t].rows;
    auto& lost = result.emplace_back(rows.size(), nan);
    const std::vector<AnyPlot> plots = data.plots(data.tracks[t], settings);
    AnyTarget target(choice);
    const auto loss = [&](const AnyPlot& plot, double log_score) {
      return -robust_log_score(log_score, stray_share, data.log_stray(rows[plot.tag].sensor, plot));
    };
    const auto visit = [&](const TargetPoint& now) {
      if (prequential && !now.is_start && now.log_score) lost[now.tag] = loss(plots[now.tag], *now.log_score);
      if (now.is_start && target.starts() == 1) return;
      const Row& row = rows[now.tag];
      if (!prequential && row.truth) lost[now.tag] = truth_loss(now, *row.truth, data.axes, objective);
      if (look && !now.is_start) look(t, now);
    };
    for (const AnyPlot& plot : plots) {
      const bool starts = starts_anywhere || data.crosses || axes_seen(rows[plot.tag].plot, data.axes) == data.axes;
      if (!target.running() && !starts) continue;
      if (prequential && target.starts() > 0 && plot.sensor != AnyPlot::Sensor::none)
        lost[plot.tag] = loss(plot, -infinity);  // unless it is a step
      const std::size_t rejected = target.rejected();
      target.follow({&plot, 1}, visit);
      if (set_aside && target.rejected() > rejected) set_aside->push_back({t, plot.tag});
    }
  }
  return result;
}

std::vector<RowPlace> leave_out_strays(TuneData& data, const FilterSettings& settings) {
  constexpr std::size_t reach = 2;      // so far a stray row spoils what others say of its neighbours most
  constexpr double weaker = 10.0;       // and farther off makes good ones doubtful, but so many times less
  constexpr std::size_t passes = 6;     // since a stray row hides weaker ones
  constexpr std::size_t too_many = 10;  // where one row in so many seems stray, it is the settings that are wrong
  auto whole = data.tracks;
  TargetChoice choice = judged_choice(data, settings);
  choice.rules.gate_probability = 1.0;
  choice.rules.rejections = 0;
  choice.rules.record = true;
  std::vector<RowPlace> strays;
  std::size_t found = 1;
  for (std::size_t pass = 0; pass < passes && found > 0; ++pass) {
    const std::size_t before = strays.size();
    for (std::size_t t = 0; t < data.tracks.size(); ++t) {
      auto& rows = data.tracks[t].rows;
      const std::vector<AnyPlot> plots = data.plots(data.tracks[t], settings);
      std::vector<double> odds(rows.size() + 2 * reach, 0.0);  // logarithms, behind and before rows that there are not
      AnyTarget target(choice);
      try {
        for (const AnyPlot& plot : plots) target.take(plot);
        target.smoothed([&](const TargetPoint& now) {
          const AnyPlot& plot = plots[now.tag];
          if (!now.nis || quantity_of(plot, 0).first != AnyPlot::Sensor::components) return;
          if (const auto own = log_score_by_others(plot, now))
            odds[now.tag + reach] =
                std::log(stray_share) + data.log_stray(rows[now.tag].sensor, plot) - std::log1p(-stray_share) - *own;
        });
      } catch (const std::exception&) {  // what cannot be smoothed is not judged by it
        continue;
      }
      const double least = std::max(0.0, *std::ranges::max_element(odds) / weaker);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const double* const about = &odds[k];
        if (!(about[reach] > least) || about[reach] < *std::max_element(about, about + 2 * reach + 1)) continue;
        rows[k].plot = AnyPlot::missed(rows[k].plot.time);
        rows[k].plot.tag = k;
        strays.push_back({t, k});
      }
    }
    found = strays.size() - before;
  }
  if (too_many * strays.size() > data.measurements) {
    data.tracks = std::move(whole);
    return {};
  }
  std::ranges::sort(strays, {}, [](const RowPlace& place) { return std::pair(place.track, place.row); });
  return strays;
}

double objective_of(const RowLosses& losses, Objective objective, const RowCounts& counts) {
  const double mean = mean_loss(losses, counts);
  return objective == Objective::rmse ? 0.5 * std::log(mean) : mean;
}

double figure_of(double value, Objective objective) { return objective == Objective::rmse ? std::exp(value) : value; }

}  // namespace sigmax::apps
