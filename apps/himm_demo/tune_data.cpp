#include "himm_demo/tune_data.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "himm_demo/fix_reading.hpp"
#include "himm_demo/simulated_radar.hpp"
#include "himm_demo/tracker.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t fewest_measurements = 10;  // of a track: three start the filter
constexpr std::size_t fewest_in_all = 40;

/// What is kept of a track while its file is read.
struct Open {
  std::size_t place;  // in the data
  std::optional<Geodetic> origin;
  RandomStream random;
  std::optional<double> altitude_m;  // the last one
};

template <int Axes>
class TuneReader {
 public:
  TuneReader(const TuneOptions& options, TuneData& data) : options_(options), data_(data) {}

  void read(const std::string& file) {
    RecordingOptions of_file = options_.recording;
    of_file.file = file;
    of_file.simulated = options_.radar.has_value();
    RecordingReader recording(of_file);
    refuse_other_kind(recording);
    data_.geodetic |= recording.geodetic();
    std::map<std::string, Open, std::less<>> open;
    std::optional<Geodetic> first;
    const bool one_frame = options_.radar || recording.has_truth();
    for (Fix fix; recording.next(fix);) {
      if (fix.place && !first) first = recording.origin().value_or(*fix.place);
      auto track = open.find(fix.track);
      if (track == open.end()) {
        track =
            open.try_emplace(fix.track, Open{data_.tracks.size(), {}, stream_of(options_.seed, fix.track), {}}).first;
        data_.tracks.push_back({recording.csv().file(), {}});
      }
      Open& its = track->second;
      auto& rows = data_.tracks[its.place].rows;
      if (fix.place) {
        if (!its.origin) its.origin = one_frame ? *first : recording.origin().value_or(*fix.place);
        localize(fix, its);
      }
      if (options_.radar && fix.position && fix.whole())
        see_by_radar(fix, *options_.radar, data_.radar_at, its.random, recording.csv().file());
      else if (options_.radar)
        fix.position.reset();
      data_.has_truth |= fix.truth.has_value();
      rows.push_back(std::move(fix));
    }
    for (const std::string& note : recording.notes()) data_.notes.push_back(fmt::format("{}: {}", file, note));
  }

 private:
  void refuse_other_kind(const RecordingReader& recording) const {
    const std::string& file = recording.csv().file();
    if (recording.axes() != Axes)
      throw InputError(
          message({.where = file,
                   .what = fmt::format("it has {} axes, {} has {}", recording.axes(), options_.files[0], Axes),
                   .remedy = "tune recordings of one, two and three axes apart"}));
    if (options_.objective != Objective::prequential && !options_.radar && !recording.has_truth())
      throw InputError(
          message({.where = file + ":1",
                   .what = "--truth, but there is no column true_x_m",
                   .remedy = "leave out --truth, name the columns with --columns, or take the recording as "
                             "the truth with --radar"}));
    if (!options_.radar) return;
    if (recording.polar())
      throw UsageError("--radar measures positions, but " + file + " holds a radar's measurements");
    if (recording.has_truth()) throw UsageError("--radar takes positions as the truth, but " + file + " has true_x_m");
    if (recording.axes() != 3) throw UsageError("--radar needs three axes, but " + file + " has fewer");
  }

  /// The place as a position; without a height it is at the target's last.
  static void localize(Fix& fix, Open& track) {
    Geodetic place = *fix.place;
    fix.place.reset();
    if (fix.missing[2] && !track.altitude_m) return;
    if (fix.missing[2]) place.altitude_m = *track.altitude_m;
    track.altitude_m = place.altitude_m;
    const LocalFrame<Axes> frame(*track.origin);
    const Vector<Axes> position = frame.to_local(place);
    fix.position = Vector<3>::Zero();
    fix.position->template head<Axes>() = position;
    if (!fix.moving()) return;
    Vector<Axes> v;  // east, north and up there
    for (int i = 0; i < Axes; ++i) v(i) = fix.velocity[static_cast<std::size_t>(i)].value_or(0.0);
    v = (frame.local_axes(position).transpose() * v).eval();
    for (int i = 0; i < Axes; ++i)
      if (auto& along = fix.velocity[static_cast<std::size_t>(i)]) along = v(i);
  }

  const TuneOptions& options_;
  TuneData& data_;
};

template <int Axes>
void read_all(const TuneOptions& options, TuneData& data) {
  TuneReader<Axes> reader(options, data);
  for (const auto& file : options.files) reader.read(file);
}

/// A box about points.
struct Extent {
  Vector<3> least = Vector<3>::Constant(std::numeric_limits<double>::infinity());
  Vector<3> greatest = -least;

  void add(const Vector<3>& point) {
    least = least.cwiseMin(point);
    greatest = greatest.cwiseMax(point);
  }
  double volume(int axes) const {
    double product = 1.0;
    for (int axis = 0; axis < axes; ++axis) product *= std::max(greatest(axis) - least(axis), 1e-6);
    return product;
  }
};

/// Drops what is too short, and takes down what the rest holds.
void summarize(TuneData& data) {
  const auto measured = [](const TuneTrack& track) {
    return static_cast<std::size_t>(
        std::count_if(track.rows.begin(), track.rows.end(), [](const Fix& fix) { return fix.measured(); }));
  };
  const std::size_t all = data.tracks.size();
  std::erase_if(data.tracks, [&](const TuneTrack& track) { return measured(track) < fewest_measurements; });
  data.too_short = all - data.tracks.size();
  Extent all_positions, all_polars;
  for (const TuneTrack& track : data.tracks)
    for (const Fix& fix : track.rows) {
      if (!fix.measured()) continue;
      ++data.measurements;
      TuneSensor& sensor = data.sensors[fix.sensor];
      ++sensor.rows;
      sensor.velocity |= fix.moving();
      sensor.range_rate |= fix.range_rate.has_value();
      sensor.bearing |= fix.bearing && !fix.sigma[1];
      if (!fix.located()) continue;
      if (fix.seen)
        all_polars.add({fix.seen->range, fix.seen->azimuth, fix.seen->elevation});
      else if (fix.whole())
        all_positions.add(*fix.position);
      const bool unsaid = std::any_of(fix.sigma.begin(), fix.sigma.begin() + data.axes,
                                      [](const auto& sigma) { return !sigma.has_value(); });
      (fix.seen ? sensor.radar : sensor.position) |= unsaid;
    }
  data.volume = all_positions.volume(data.axes);
  data.radar_volume = all_polars.volume(data.axes);
}

}  // namespace

TuneData read_tune_data(const TuneOptions& options) {
  TuneData data;
  if (options.radar_at) data.radar_at = Vector<3>(options.radar_at->data());
  RecordingOptions first = options.recording;
  first.file = options.files.front();
  if (std::count(options.files.begin(), options.files.end(), "-") > 0)
    throw UsageError("tune reads its files more than once: it takes no standard input");
  data.axes = RecordingReader(first).axes();
  if (data.axes == 1)
    read_all<1>(options, data);
  else if (data.axes == 2)
    read_all<2>(options, data);
  else
    read_all<3>(options, data);
  summarize(data);
  if (data.measurements < fewest_in_all)
    throw InputError(message(
        {.where = options.files.front(),
         .what = "there is too little to fit",
         .found = fmt::format("{} measurements of tracks with at least {}", data.measurements, fewest_measurements),
         .expected = fmt::format("at least {}", fewest_in_all),
         .remedy = "give a longer recording, or several"}));
  return data;
}

std::vector<std::vector<std::size_t>> TuneData::folds(std::size_t count) const {
  const bool by_track = tracks.size() >= 2 * count;
  std::vector<std::vector<std::size_t>> result;
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    const std::size_t rows = tracks[t].rows.size();
    auto& of_track = result.emplace_back(rows);
    for (std::size_t k = 0; k < rows; ++k) of_track[k] = by_track ? t % count : k * count / rows;
  }
  return result;
}

namespace {

template <int Axes>
std::vector<AnyPlot> plots_of(const TuneData& data, const TuneTrack& track, const FilterSettings& settings) {
  std::vector<AnyPlot> plots;
  plots.reserve(track.rows.size());
  for (std::size_t k = 0; k < track.rows.size(); ++k)
    plots.push_back(plot_of<Axes>(track.rows[k].time_s, reading_of<Axes>(track.rows[k], settings, data.radar_at), k));
  return plots;
}

}  // namespace

std::vector<AnyPlot> TuneData::plots(const TuneTrack& track, const FilterSettings& settings) const {
  if (axes == 1) return plots_of<1>(*this, track, settings);
  return axes == 2 ? plots_of<2>(*this, track, settings) : plots_of<3>(*this, track, settings);
}

}  // namespace sigmax::apps
