#include "himm_demo/tune/tune.hpp"

#include <sigmax/hybrid/fit_target.hpp>

#include "checks/checks.hpp"
#include "shell/random.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t fewest_measurements = 10;  // of a track: three start the filter
constexpr std::size_t fewest_in_all = 40;
constexpr double metres_a_degree = 60.0 * units::nautical_mile;  // of latitude

/// The numbers of each sensor's columns, as they were written.
using Columns = std::map<std::string, std::map<MeasuredQuantity, std::vector<double>>, std::less<>>;

void refuse_other_kind(const TuneOptions& options, const TuneData& data, const RecordingReader& recording) {
  const std::string& file = recording.file();
  if (recording.axes() != data.axes)
    throw InputError({.where = file,
                      .what = fmt::format("it has {} axes, {} has {}", recording.axes(), options.files[0], data.axes),
                      .remedy = "tune recordings of one, two and three axes apart"});
  if (options.truth && !options.radar.sigma && !recording.has_truth())
    throw InputError(
        "{}:1: --truth, but there is no column true_x_m; leave out --truth, name the columns with --columns, or take "
        "the recording as the truth with --radar",
        file);
  refuse_radar(options.radar, recording);
}

/// Takes down a row's numbers; of a place in m along a meridian, and of a velocity along two axes or more also the
/// speed, since that may be what was rounded. It is filed behind the velocity.
void take_down(const Row& row, int axes, bool geodetic, Columns& columns) {
  const AnyDetection& detection = row.detection;
  auto& own = columns[row.sensor];
  double squares = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(detection.size); ++i) {
    const auto key = quantity_of(detection, i);
    const bool is_component = key.first == Sensor::components;
    own[key].push_back(detection.z[i] * (geodetic && is_component && key.second < 2 ? metres_a_degree : 1.0));
    if (is_component && key.second >= axes && key.second < axes + 2) squares += detection.z[i] * detection.z[i];
  }
  if (is_moving(detection, axes)) own[{detection.sensor, 2 * axes}].push_back(std::sqrt(squares));
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
  data.has_only_velocities |= recording.has_only_velocities();
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
    const bool is_place = recording.geodetic() && row.detection.sensor == Sensor::components;
    if (is_place) {
      its.last = {component_of(row.detection, 0).value_or(its.last.latitude_deg),
                  component_of(row.detection, 1).value_or(its.last.longitude_deg),
                  data.axes == 3 ? component_of(row.detection, 2).value_or(its.last.altitude_m) : 0.0};
      if (const auto start = place_of(row.detection, data.axes); start && !its.frame) {
        if (!first) first = start;
        its.frame.emplace(one_frame ? *first : recording.origin().value_or(*start), data.axes);
      }
      if (its.frame && its.last.is_valid()) its.at = its.frame->to_local(its.last);
    }
    if (is_place)
      row.detection =
          its.at ? in_frame(row.detection, *its.frame, *its.at, data.axes) : AnyDetection::missed(row.detection.time);
    if (options.radar.sigma)
      see_by_radar(row, position_of(row.detection, data.axes), data.axes, options.radar, its.random, recording.file());
    data.has_truth |= row.truth.has_value();
    auto& rows = data.tracks[its.place].rows;
    row.detection.tag = rows.size();
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

/// Drops what is too short, and takes down what the rest holds.
void summarize(TuneData& data, const Columns& columns) {
  const std::size_t all = data.tracks.size();
  std::erase_if(data.tracks, [](const TuneTrack& track) {
    const auto measured = std::ranges::count_if(track.rows, [](const Row& row) { return row.measured(); });
    return static_cast<std::size_t>(measured) < fewest_measurements;
  });
  data.too_short = all - data.tracks.size();
  Tracks tracks;
  for (const TuneTrack& track : data.tracks) {
    tracks.push_back(each(track.rows, &Row::detection));
    for (const Row& row : track.rows) {
      if (!row.measured()) continue;
      const bool by_radar = row.detection.sensor == Sensor::polar || row.detection.sensor == Sensor::doppler;
      const bool is_bearing = row.detection.sensor == Sensor::bearing;
      bool unsaid = false;  // whether the filter must know how well
      for (int i = 0; i < (is_bearing ? 1 : axes_seen(row.detection, data.axes)); ++i)
        unsaid |= std::isnan(row.detection.variance(i));
      ++data.measurements;
      TuneSensor& sensor = data.sensors[row.sensor];
      sensor.velocity |= is_moving(row.detection, data.axes);
      sensor.range_rate |= row.detection.sensor == Sensor::doppler;
      (is_bearing ? sensor.bearing : by_radar ? sensor.radar : sensor.position) |= unsaid;
    }
  }
  data.scale = TrackScale(tracks);
  data.robust = RobustLoss(tracks, data.scale);
  for (auto& [name, sensor] : data.sensors) {
    const auto own = columns.find(name);
    if (own == columns.end()) continue;
    for (const auto& [key, numbers] : own->second) {
      const bool is_longitude = data.geodetic && key == MeasuredQuantity(Sensor::components, 1);
      const double latitude = is_longitude ? own->second.at({Sensor::components, 0}).front() / metres_a_degree : 0.0;
      sensor.rounding[key] = rounding_of(numbers) * std::cos(latitude * degree);
      if (std::isinf(sensor.rounding[key]))
        data.notes.push_back(
            fmt::format("{}: a column never changes, which no noise does; a sigma of such columns alone is left as it "
                        "is; leave out what nothing measured",
                        name.empty() ? "all rows" : "sensor " + name));
    }
  }
}

/// How far an estimate is from the truth, in m².
double squared_error(const TargetPoint& now, const Position& truth, int axes) {
  double sum = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(axes); ++i) sum += std::pow(now.mean[i] - truth[i], 2);
  return sum;
}

}  // namespace

TuneData read_tune_data(const TuneOptions& options, const FilterSettings& settings) {
  if (std::ranges::count(options.files, "-") > 0)
    throw UsageError("tune reads its files more than once: it takes no standard input");
  RecordingOptions first = options.recording;
  first.file = options.files.front();
  TuneData data{.axes = RecordingReader(first).axes()};
  Columns columns;
  for (const auto& file : options.files) read(file, options, settings, data, columns);
  summarize(data, columns);
  if (data.geodetic && !data.has_truth)
    data.notes.push_back(
        "sigma_position_m assumes white noise; without a truth, correlated errors (GNSS) are fitted as motion; if the "
        "device's accuracy is known, keep it by --keep sensors");
  if (data.measurements < fewest_in_all)
    throw InputError(
        "{}: there is too little to fit: found {} measurements of tracks with at least {}, expected at least {}; give "
        "a longer recording, or several",
        options.files.front(), data.measurements, fewest_measurements, fewest_in_all);
  return data;
}

double TuneSensor::rounding_of(Sensor kind, int from, int to) const {
  std::optional<double> greatest;
  for (const auto& [key, own] : rounding)
    if (key.first == kind && key.second >= from && key.second <= to)
      if (!greatest || std::isinf(*greatest) || (std::isfinite(own) && own > *greatest)) greatest = own;
  return greatest.value_or(0.0);
}

double median(std::vector<double>& numbers) {
  const auto middle = numbers.begin() + std::ssize(numbers) / 2;
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

RowFolds TuneData::folds(std::size_t count) const {
  return folds_of(each(tracks, [](const TuneTrack& track) { return track.rows.size(); }), count);
}

RowLosses losses(const TuneData& data, const FilterSettings& settings, bool by_truth, const Look& look,
                 std::size_t withhold) {
  TargetChoice choice = choice_of(settings, data.axes);
  if (data.crosses) choice.rules.waiting = bearings_of_a_start;
  const bool starts_anywhere = data.crosses || (settings.start == StartRule::given && !data.geodetic);  // as `track`
  RowLosses result;
  for (std::size_t t = 0; t < data.tracks.size(); ++t) {
    const auto& rows = data.tracks[t].rows;
    auto detections =
        each(rows, [&](const Row& row) { return with_sensor_noise(settings, row.sensor, row.detection, data.axes); });
    for (std::size_t k = withhold; k < detections.size(); k += 4) {
      detections[k] = AnyDetection::missed(detections[k].time);
      detections[k].tag = k;
    }
    std::vector<double> lost(rows.size(), nan);
    bool started = false;
    const auto visit = [&](const TargetPoint& now) {
      if (now.is_start && !std::exchange(started, true)) return;
      const Row& row = rows[now.tag];
      if (by_truth && row.truth) lost[now.tag] = squared_error(now, *row.truth, data.axes);
      if (look && !now.is_start) look(t, now);
    };
    const auto scores = log_scores(choice, detections, visit, [&](const AnyDetection& detection) {
      return starts_anywhere || axes_seen(rows[detection.tag].detection, data.axes) == data.axes;
    });
    result.push_back(!by_truth ? data.robust(t, scores) : std::move(lost));
  }
  return result;
}

double objective_of(const TuneData& data, const RowLosses& losses, bool by_truth, const RowCounts& counts) {
  if (!by_truth) return data.robust.objective(losses, counts, data.most_strays);
  return 0.5 * std::log(mean_loss(losses, counts));
}

Diagnosis diagnose(const TuneData& data, const FilterSettings& settings, bool by_truth) {
  Diagnosis diagnosis;
  std::map<std::string, InnovationTally, std::less<>> sensors;
  for (const auto& model : settings.models) diagnosis.modes.push_back({model});
  std::map<std::string, std::vector<double>, std::less<>> last;  // by sensor, of the track at hand
  std::size_t track = 0, rows = 0, judged = 0;
  double squares = 0.0;
  const auto look = [&](std::size_t t, const TargetPoint& now) {
    if (t != track) last.clear();
    track = t;
    const Row& row = data.tracks[t].rows[now.tag];
    if (row.truth) {
      squares += squared_error(now, *row.truth, data.axes);
      ++judged;
    }
    if (!now.nis) return;
    sensors[row.sensor].add(now.normalized_innovation, last[row.sensor]);
    diagnosis.modes[now.most_likely_mode].innovations.add(now.normalized_innovation);
    last[row.sensor] = now.normalized_innovation;
    for (std::size_t j = 0; j < now.weights.size(); ++j) diagnosis.modes[j].weight += now.weights[j];
    ++rows;
  };
  RowLosses lost;
  try {
    lost = losses(data, settings, by_truth, look);
  } catch (const std::exception& error) {
    const TuneTrack& its = data.tracks[track];
    throw InputError("{}:{}: filter '{}' on the track that begins here: {}; begin with settings that track takes",
                     its.file, its.rows.front().line, settings.name, error.what());
  }
  if (std::isnan(mean_loss(lost)))
    throw InputError(
        "{}: filter '{}' makes no estimate to judge: its start needs whole positions, or fewer rows at one time. Drop "
        "columns that are always empty, or give a start, --set start=given, or the places of bearings, --set "
        "sensor.NAME.at=[E,N]",
        data.tracks.front().file, settings.name);
  for (auto& mode : diagnosis.modes) mode.weight /= static_cast<double>(std::max<std::size_t>(rows, 1));
  for (auto& [name, tally] : sensors) diagnosis.sensors.push_back({name.empty() ? "all rows" : name, tally});
  if (judged > 0) diagnosis.rmse_m = std::sqrt(squares / static_cast<double>(judged));
  return diagnosis;
}

std::string_view verdict_of(const InnovationTally& sensor) {
  if (sensor.count() < 10) return "too few rows to say";
  const double nis = sensor.mean_square(), apart = sensor.autocorrelation();
  const bool high = nis > sensor.band().upper, low = nis < sensor.band().lower;
  const bool lags = apart > sensor.autocorrelation_band(), overshoots = apart < -sensor.autocorrelation_band();
  if (high) return lags ? "models too stiff" : "optimistic sensor";
  if (low) return overshoots ? "models too loose" : "pessimistic sensor";
  return lags ? "gain too low" : overshoots ? "gain too high" : "as it should be";
}

}  // namespace sigmax::apps
