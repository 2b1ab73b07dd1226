
#include "himm_demo/track/page.hpp"
#include "himm_demo/track/track.hpp"
#include "shell/progress.hpp"
#include "shell/random.hpp"
#include "table/timestamp.hpp"

namespace sigmax::apps {
namespace {

/// One target of a recording, followed by every filter.
struct Target {
  RandomStream random;
  std::vector<EarthTarget> filters;  // or in metres, where nothing is on the Earth
  std::deque<Row> rows{};            // whose tags are their numbers
  std::map<std::pair<std::size_t, std::string>, std::vector<double>> innovations{};  // the last of a filter and sensor
  TrackTally tally{};
  Geodetic last_place{};

  /// From where positions are counted, once a place on the Earth is known.
  const std::optional<LocalFrame>& anchor() const { return filters.front().anchor(); }
  const Row& row(std::size_t tag) const { return rows[tag + rows.size() - tally.rows]; }
};

/// All filters on all targets of one recording.
class TrackRun {
 public:
  TrackRun(const TrackOptions& options, RecordingReader& recording, const std::vector<FilterSettings>& filters,
           TrackSinks sinks)
      : options_(options), recording_(recording), filters_(filters), sinks_(std::move(sinks)) {
    outcome_.filters.resize(filters.size());
    for (std::size_t f = 0; f < filters.size(); ++f) {
      TargetChoice choice = choice_of(filters[f], axes_);
      if (crosses_) choice.rules.waiting = bearings_of_a_start;
      prototypes_.emplace_back(choice);
      for (auto& part : outcome_.filters[f].sums) part.weights.assign(filters[f].models.size(), 0.0);
      keeps_all_ |= filters[f].smooth;
    }
  }

  TrackOutcome run() {
    const auto total = recording_.csv().bytes_total();
    Progress progress(file(), total.value_or(1), options_.output.quiet || !total);
    for (Row row; recording_.next(row);) {
      take(row);
      progress.advance(recording_.csv().bytes_read() - progress.done());
    }
    progress.finish();
    if (options_.predict_to) predict();
    for (auto& [name, target] : targets_) end(name, target);
    if (outcome_.never_started.size() == targets_.size())
      outcome_.refuse_nothing(recording_, options_.recording, places_.several());
    outcome_.places = places_.notes();
    outcome_.some_unplaced = places_.some_unplaced();
    if (file_anchor_ && (fixed_ || recording_.origin() || !recording_.has_tracks())) outcome_.origin = file_anchor_;
    return std::move(outcome_);
  }

 private:
  const std::string& file() const { return recording_.file(); }

  /// A last step of each target that ended before the time asked for, without a measurement. A time of day is on the
  /// day of the target's last row, or the next.
  void predict() {
    for (auto& [name, target] : targets_) {
      const bool of_day = options_.predict_to_time_of_day && recording_.times_of_day();
      Row row{.line = target.rows.back().line, .track = name, .predicted = true};
      row.detection.time =
          of_day ? time_of_day_after(target.tally.last_time, *options_.predict_to) : *options_.predict_to;
      const double ahead = row.detection.time - target.tally.last_time;
      if (ahead <= 0.0) continue;
      ++outcome_.predicted;
      const auto restarts = [=](const FilterSettings& filter) {
        return filter.restart_after_s.value_or(infinity) <= ahead;
      };
      if (std::ranges::any_of(filters_, restarts)) ++outcome_.unpredicted;
      step(target, std::move(row));
    }
  }

  void take(Row& row) {
    outcome_.count(row, recording_, filters_);
    auto found = targets_.find(row.track);
    if (found == targets_.end()) {
      found = targets_.emplace(row.track, Target{stream_of(options_.seed, row.track), prototypes_}).first;
      found->second.tally.nis.resize(filters_.size());
    }
    Target& target = found->second;
    if (!options_.radar.sigma) places_.place(row);
    if (sinks_.rows) sinks_.rows(row, places_.frame() ? &*places_.frame() : nullptr);
    if (!target.anchor()) begin(target, row.detection);
    if (options_.radar.sigma) see_by_radar(row, where(row, target), axes_, options_.radar, target.random, file());
    if (sinks_.page || row.truth) measured(row, where(row, target), target);
    outcome_.judge_conversion(row, axes_, filters_);
    step(target, std::move(row));
  }

  /// Lets the target begin at its first place on the Earth. Where errors or a radar are about one point, the frame of
  /// all stays there.
  void begin(Target& target, const AnyDetection& detection) {
    std::optional<Geodetic> here = recording_.geodetic() ? place_of(detection, axes_) : std::nullopt;
    if (places_.frame()) here = places_.frame()->origin();
    if (!here) return;
    if (!file_anchor_) file_anchor_ = recording_.origin().value_or(*here);
    for (EarthTarget& filter : target.filters)
      filter.begin(fixed_ ? *file_anchor_ : recording_.origin().value_or(*here), *here, !fixed_);
  }

  /// Where a row's measurement was, about where positions are counted from.
  std::optional<Position> where(const Row& row, Target& target) const {
    if (!recording_.geodetic() || row.detection.sensor != Sensor::components) return position_of(row.detection, axes_);
    if (!target.anchor() || axes_seen(row.detection, axes_) == 0) return std::nullopt;
    target.last_place = place_of(row.detection, axes_).value_or(target.last_place);
    target.last_place.altitude_m = axes_ == 3 ? component_of(row.detection, 2).value_or(0.0) : 0.0;
    return target.anchor()->to_local(target.last_place);
  }

  /// What a row measured, perhaps by a simulated radar.
  void measured(const Row& row, const std::optional<Position>& position, const Target& target) {
    if (row.truth && axes_seen(row.detection, axes_) == axes_)
      add_by_part(outcome_.raw, row.roll_deg, [&](Sums& sums) {
        for (std::size_t axis = 0; axis < 3; ++axis) sums.error[axis].add((*position)[axis] - (*row.truth)[axis]);
      });
    if (!sinks_.page) return;
    sinks_.page->measured(row, position, target.anchor() ? std::optional(target.anchor()->origin()) : std::nullopt);
  }

  void step(Target& target, Row row) {
    TrackTally& tally = target.tally;
    // Of another sensor: nothing starts from two rows of one time.
    const bool again = row.detection.time == tally.last_time;
    if (tally.rows == 0) tally.first_time = row.detection.time;
    tally.last_time = row.detection.time;
    row.detection.tag = tally.rows++;
    if (row.measured()) ++tally.measurements;
    target.rows.push_back(std::move(row));
    if (!keeps_all_ && target.rows.size() > 2) target.rows.pop_front();  // a start may wait for the row after it
    follow(target, target.rows.back(), again);
  }

  /// Leads a row through every filter.
  void follow(Target& target, const Row& row, bool again) {
    double nis = infinity, likely = -infinity, metres = infinity;  // of the filter that expects the row most
    std::size_t refusing = 0;
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      AnyTarget& filter = target.filters[f];
      const std::size_t rejected = filter.rejected(), starts = filter.starts();
      if (again && !filter.running() && !(crosses_ && filters_[f].start != StartRule::given)) continue;
      const TargetPoint last = follow(target, f, row);
      if (last.nis && last.tag == row.detection.tag && !last.is_start) nis = std::min(nis, *last.nis);
      if (filter.rejected() > rejected) {
        ++refusing;
        likely = std::max(likely, last.log_evidence.value_or(infinity));
        metres = std::min(metres, distance(target, f, row, last));
        if (sinks_.page) sinks_.page->rejected(row, f);
      }
      if (sinks_.page && starts > 0 && filter.starts() > starts) sinks_.page->restarted(row, f);
    }
    if (nis > outlier_nis && nis < infinity) ++outcome_.outliers;
    if (refusing < filters_.size()) return;
    Refused& refused = outcome_.refused_by_all;
    refused.add(row.line);
    if (likely < refused.log_evidence)
      refused.log_evidence = likely, refused.worst_line = row.line, refused.metres = metres;
  }

  /// Leads a row through a filter. Returns the last of what that tells.
  TargetPoint follow(Target& target, std::size_t f, const Row& row) {
    EarthTarget& filter = target.filters[f];
    TargetPoint last;
    const auto visit = [&](const TargetPoint& point) {
      if (!filters_[f].smooth && !point.is_start) tell(target, f, point);
      last = point;
    };
    try {
      if (row.predicted)
        filter.predict(row.detection.time, row.detection.tag, visit);
      else
        filter.follow_in_frame(detection_for(filter, filters_[f], row), visit);
    } catch (const std::logic_error& error) {
      refuse_failure(f, row, error);
    }
    return last;
  }

  /// What a row measures, in the frame of the filter and with the covariances that it believes. It starts from whole
  /// positions, or bearings, or as given.
  AnyDetection detection_for(const EarthTarget& filter, const FilterSettings& settings, const Row& row) const {
    AnyDetection detection = row.detection;
    if (recording_.geodetic() && detection.sensor == Sensor::components)
      detection =
          filter.anchor() ? filter.in_frame(detection) : AnyDetection{.time = detection.time, .tag = detection.tag};
    const bool starts_anywhere = (settings.start == StartRule::given && !recording_.geodetic()) || crosses_;
    if (!filter.running() && !starts_anywhere && axes_seen(detection, axes_) < axes_)
      return {.time = detection.time, .tag = detection.tag};
    return with_sensor_noise(settings, row.sensor, detection, axes_);
  }

  /// How far a measurement is from where a filter expects it, in m; 0 where it tells no position.
  double distance(const Target& target, std::size_t f, const Row& row, const TargetPoint& expected) const {
    if (expected.mean.empty()) return 0.0;
    const EarthTarget& filter = target.filters[f];
    const bool on_earth = recording_.geodetic() && row.detection.sensor == Sensor::components;
    const auto at = position_of(on_earth ? filter.in_frame(row.detection) : row.detection, axes_);
    double squares = 0.0;
    for (std::size_t i = 0; at && i < static_cast<std::size_t>(axes_); ++i)
      squares += ((*at)[i] - expected.mean[i]) * ((*at)[i] - expected.mean[i]);
    return std::sqrt(squares);
  }

  /// Takes down what a filter says of a row.
  void tell(Target& target, std::size_t f, TargetPoint point) {
    ++target.tally.estimates;
    const Row& row = target.row(point.tag);
    const FilterSettings& filter = filters_[f];
    const std::vector<double>& innovation = point.normalized_innovation;
    std::size_t size = innovation.size();
    if (innovation.empty() && point.nis)  // smoothed
      size = static_cast<std::size_t>(with_sensor_noise(filter, row.sensor, row.detection, axes_).size);
    if (!row.predicted) {
      FilterOutcome& own = outcome_.filters[f];
      if (point.nis) {
        target.tally.nis[f].sum += *point.nis;
        target.tally.nis[f].quantities += size;
        own.add_innovation(row.sensor, point, size, target.innovations[{f, row.sensor}]);
      }
      own.add(row, point, size, axes_);
    }
    if (!estimates_ && !sinks_.page) return;
    EarthPoint known{std::move(point), {}};
    if (target.anchor()) known = target.filters[f].on_earth(std::move(known), row.predicted);
    if (f == 0) target.tally.goes_to(known.mean, axes_);
    estimates_.write(row.track, filter, known);
    if (sinks_.page) sinks_.page->estimated(row, f, known, static_cast<int>(size));
  }

  /// The end of a target whose rows have all been read: the steps as smoothing sees them, and when the modes changed.
  void end(const std::string& name, Target& target) {
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      try {
        if (filters_[f].smooth)
          target.filters[f].smoothed([&](const TargetPoint& point) {
            if (!point.is_start) tell(target, f, point);
          });
        if (filters_[f].explain) outcome_.filters[f].histories[name] = target.filters[f].explained();
      } catch (const std::logic_error& error) {
        refuse_failure(f, target.rows.back(), error);
      }
    }
    bool started = target.tally.estimates > 0;  // what only starts tells nothing
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      const std::size_t rejected = target.filters[f].rejected(), starts = target.filters[f].starts();
      outcome_.filters[f].rejected += target.tally.nis[f].rejected = rejected;
      outcome_.filters[f].restarts += starts > 0 ? starts - 1 : 0;
      started &= starts > 0;
    }
    if (!started) outcome_.never_started.push_back(name);
    outcome_.each.emplace(name, std::move(target.tally));
    target.rows.clear();
  }

  [[noreturn]] void refuse_failure(std::size_t f, const Row& row, const std::exception& error) const {
    throw InputError(
        "{}:{}: filter '{}' at time {} s: {}; look for an outlier here, and at the start and the settings of the "
        "filter",
        file(), row.line, filters_[f].name, shortest(row.detection.time), error.what());
  }

  const TrackOptions& options_;
  RecordingReader& recording_;
  int axes_ = recording_.axes();
  const std::vector<FilterSettings>& filters_;
  TrackSinks sinks_;
  EstimatesFile estimates_{sinks_.files, filters_, recording_};
  TrackOutcome outcome_;
  std::vector<EarthTarget> prototypes_;  // each filter before its first row
  bool keeps_all_ = false;               // rows, if a filter is to be smoothed; else two
  std::map<std::string, Target, std::less<>> targets_;
  std::optional<Geodetic> file_anchor_;
  bool fixed_ =
      options_.radar.sigma || recording_.has_truth() || recording_.seen_from_places();  // all is about one point
  SensorPlaces places_{filters_.front(), recording_, options_.radar.place()};
  bool crosses_ = recording_.bearings() && !recording_.located();  // bearings alone, from which a track may start
};

}  // namespace

TrackOutcome run_track(const TrackOptions& options, RecordingReader& recording,
                       const std::vector<FilterSettings>& filters, TrackSinks sinks) {
  return TrackRun(options, recording, filters, std::move(sinks)).run();
}

}  // namespace sigmax::apps
