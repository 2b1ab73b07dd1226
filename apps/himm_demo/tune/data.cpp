#include "himm_demo/tune/tune.hpp"

#include <sigmax/estimation/dense.hpp>

#include "support/random.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t fewest_measurements = 10;  // of a track: three start the filter
constexpr std::size_t fewest_in_all = 40;

void refuse_other_kind(const TuneOptions& options, const TuneData& data, const RecordingReader& recording) {
  const std::string& file = recording.file();
  if (recording.axes() != data.axes)
    throw InputError(
        message({.where = file,
                 .what = fmt::format("it has {} axes, {} has {}", recording.axes(), options.files[0], data.axes),
                 .remedy = "tune recordings of one, two and three axes apart"}));
  if (options.objective != Objective::prequential && !options.radar.sigma && !recording.has_truth())
    throw InputError(
        "{}:1: --truth, but there is no column true_x_m; leave out --truth, name the columns with --columns, or take "
        "the recording as the truth with --radar",
        file);
  refuse_radar(options.radar, recording);
}

void read(const std::string& file, const TuneOptions& options, TuneData& data) {
  struct Open {  // what is kept of a track while its file is read
    std::size_t place;
    RandomStream random;
    std::optional<LocalFrame> frame{};
    std::optional<double> altitude_m{};  // the last one
  };
  RecordingOptions of_file = options.recording;
  of_file.file = file;
  of_file.simulated = options.radar.sigma.has_value();
  RecordingReader recording(of_file);
  refuse_other_kind(options, data, recording);
  data.geodetic |= recording.geodetic();
  data.moves_alone |= recording.moves_alone();
  const bool one_frame = options.radar.sigma || recording.has_truth();
  std::optional<Geodetic> first = recording.origin();
  std::map<std::string, Open, std::less<>> open;
  Doubts doubts;
  for (Row row; recording.next(row);) {
    const auto [found, is_new] =
        open.try_emplace(row.track, Open{data.tracks.size(), stream_of(options.seed, row.track)});
    if (is_new) data.tracks.push_back({recording.file(), {}});
    Open& its = found->second;
    if (recording.geodetic() && axes_seen(row.plot, data.axes) > 0) {
      const Geodetic here = place_of(row.plot, data.axes, its.altitude_m.value_or(nan));
      if (!first) first = place_of(row.plot, data.axes, 0.0);
      if (!its.frame)
        its.frame.emplace(one_frame ? *first : recording.origin().value_or(place_of(row.plot, data.axes, 0.0)),
                          data.axes);
      if (std::isnan(here.altitude_m)) {  // nobody knows the height yet
        row.plot = AnyPlot::missed(row.plot.time);
      } else {
        its.altitude_m = here.altitude_m;
        row.plot = in_frame(row.plot, *its.frame, its.frame->to_local(here), data.axes);
      }
    }
    if (options.radar.sigma) {
      if (axes_seen(row.plot, data.axes) == data.axes)
        see_by_radar(row, *position_of(row.plot, data.axes, {}), *options.radar.sigma, data.radar_at, its.random,
                     recording.file());
      else
        row.plot = AnyPlot::missed(row.plot.time);
    }
    doubts.see(row, position_of(row.plot, data.axes, data.radar_at), data.radar_at, data.axes);
    data.has_truth |= row.truth.has_value();
    auto& rows = data.tracks[its.place].rows;
    row.plot.tag = rows.size();
    rows.push_back(std::move(row));
  }
  for (const std::string& note : recording.notes()) data.notes.push_back(fmt::format("{}: {}", file, note));
  for (const std::string& doubt : doubts.sentences(recording)) data.notes.push_back(doubt);
}

/// A box about points.
struct Extent {
  std::array<double, 3> least, greatest;

  Extent() {
    least.fill(std::numeric_limits<double>::infinity());
    greatest.fill(-least[0]);
  }
  void add(const AnyPlot& plot) {
    for (std::size_t i = 0; i < 3; ++i) {
      least[i] = std::min(least[i], plot.z[i]);
      greatest[i] = std::max(greatest[i], plot.z[i]);
    }
  }
  double volume(int axes) const {
    double product = 1.0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(axes); ++i) product *= std::max(greatest[i] - least[i], 1e-6);
    return product;
  }
};

/// Drops what is too short, and takes down what the rest holds.
void summarize(TuneData& data) {
  const std::size_t all = data.tracks.size();
  std::erase_if(data.tracks, [](const TuneTrack& track) {
    const auto measured = std::ranges::count_if(track.rows, [](const Row& row) { return row.measured(); });
    return static_cast<std::size_t>(measured) < fewest_measurements;
  });
  data.too_short = all - data.tracks.size();
  Extent all_positions, all_polars;
  for (const TuneTrack& track : data.tracks)
    for (const Row& row : track.rows) {
      if (!row.measured()) continue;
      const int seen = axes_seen(row.plot, data.axes);
      const bool by_radar = row.plot.sensor == AnyPlot::Sensor::polar || row.plot.sensor == AnyPlot::Sensor::doppler;
      const bool is_bearing = row.plot.sensor == AnyPlot::Sensor::bearing;
      bool unsaid = false;  // whether the filter must know how well
      for (int i = 0; i < (is_bearing ? 1 : seen); ++i) unsaid |= std::isnan(row.plot.variance(i));
      ++data.measurements;
      TuneSensor& sensor = data.sensors[row.sensor];
      ++sensor.rows;
      sensor.velocity |= is_moving(row.plot, data.axes);
      sensor.range_rate |= row.plot.sensor == AnyPlot::Sensor::doppler;
      (is_bearing ? sensor.bearing : by_radar ? sensor.radar : sensor.position) |= unsaid;
      if (seen == data.axes) (by_radar ? all_polars : all_positions).add(row.plot);
    }
  data.volume = all_positions.volume(data.axes);
  data.radar_volume = all_polars.volume(data.axes);
}

double measurement_loss(double log_score, const FilterSettings& settings, double volume) {
  if (settings.gate_probability >= 1.0) return -log_score;
  const double target = std::log(settings.gate_probability) + log_score;
  const double stray = std::log1p(-settings.gate_probability) - std::log(volume);
  const double greater = std::max(target, stray);
  return -(greater + std::log1p(std::exp(std::min(target, stray) - greater)));
}

/// In which a stray measurement of a row's kind lies anywhere.
double volume_for(const Row& row, const TuneData& data) {
  if (row.plot.sensor == AnyPlot::Sensor::bearing) return 2.0 * std::numbers::pi;
  return row.plot.sensor == AnyPlot::Sensor::components ? data.volume : data.radar_volume;
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

}  // namespace

bool TuneOptions::fits(std::string_view what) const { return std::ranges::find(fixed, what) == fixed.end(); }

TuneData read_tune_data(const TuneOptions& options) {
  if (std::ranges::count(options.files, "-") > 0)
    throw UsageError("tune reads its files more than once: it takes no standard input");
  RecordingOptions first = options.recording;
  first.file = options.files.front();
  TuneData data{.axes = RecordingReader(first).axes(), .radar_at = options.radar.place()};
  for (const auto& file : options.files) read(file, options, data);
  summarize(data);
  if (data.measurements < fewest_in_all)
    throw InputError(
        "{}: there is too little to fit: found {} measurements of tracks with at least {}, expected at least {}; give "
        "a longer recording, or several",
        options.files.front(), data.measurements, fewest_measurements, fewest_in_all);
  return data;
}

RowFolds TuneData::folds(std::size_t count) const {
  std::vector<std::size_t> rows;
  for (const TuneTrack& track : tracks) rows.push_back(track.rows.size());
  return folds_of(rows, count);
}

std::vector<AnyPlot> TuneData::plots(const TuneTrack& track, const FilterSettings& settings) const {
  std::vector<AnyPlot> plots;
  for (const Row& row : track.rows) plots.push_back(believed(settings, row.sensor, row.plot, axes, radar_at));
  return plots;
}

TargetChoice judged_choice(const TuneData& data, const FilterSettings& settings) {
  TargetChoice choice = choice_of(settings, data.axes);
  choice.rules.rejections = 0;
  choice.rules.record = false;
  return choice;
}

RowLosses losses(const TuneData& data, const FilterSettings& settings, Objective objective, const Look& look) {
  const TargetChoice choice = judged_choice(data, settings);
  const bool starts_anywhere = settings.start == StartRule::given && !data.geodetic;  // as `track` does
  RowLosses result;
  for (std::size_t t = 0; t < data.tracks.size(); ++t) {
    const auto& rows = data.tracks[t].rows;
    auto& lost = result.emplace_back(rows.size(), nan);
    AnyTarget target(choice);
    const auto visit = [&](const TargetPoint& now) {
      if (now.is_start) return;
      const Row& row = rows[now.tag];
      if (objective == Objective::prequential && now.log_score)
        lost[now.tag] = measurement_loss(*now.log_score, settings, volume_for(row, data));
      if (objective != Objective::prequential && row.truth)
        lost[now.tag] = truth_loss(now, *row.truth, data.axes, objective);
      if (look) look(t, now);
    };
    for (const AnyPlot& plot : data.plots(data.tracks[t], settings))
      if (target.running() || starts_anywhere || axes_seen(rows[plot.tag].plot, data.axes) == data.axes)
        target.follow({&plot, 1}, visit);
  }
  return result;
}

double objective_of(const RowLosses& losses, Objective objective, const RowCounts& counts) {
  const double mean = mean_loss(losses, counts);
  return objective == Objective::rmse ? 0.5 * std::log(mean) : mean;
}

double figure_of(double value, Objective objective) { return objective == Objective::rmse ? std::exp(value) : value; }

}  // namespace sigmax::apps
