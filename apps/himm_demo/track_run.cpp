#include "himm_demo/track_run.hpp"

#include <algorithm>
#include <deque>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sigmax/estimation/chi_square.hpp>

#include "himm_demo/estimates_file.hpp"
#include "himm_demo/fix_reading.hpp"
#include "himm_demo/simulated_radar.hpp"
#include "himm_demo/track_page.hpp"
#include "himm_demo/tracker.hpp"
#include "support/output.hpp"
#include "support/progress.hpp"
#include "support/random.hpp"

namespace sigmax::apps {
namespace {

void add_error(Sums& sums, const Vector<3>& error) {
  for (std::size_t axis = 0; axis < 3; ++axis) sums.error[axis].add(error(static_cast<Eigen::Index>(axis)));
}

/// The frame in which a filter follows a target from a start on.
template <int Axes>
struct Segment {
  std::size_t first_tag;
  std::size_t starts;
  LocalFrame<Axes> frame;
};

/// One target of a recording, followed by every filter.
template <int Axes>
struct Target {
  Target(const std::vector<FilterSettings>& filters, const RandomStream& random_stream)
      : trackers(filters.begin(), filters.end()),
        segments(filters.size()),
        random(random_stream),
        keeps_all(std::any_of(filters.begin(), filters.end(), [](const auto& filter) { return filter.smooth; })) {}

  bool all_started() const {
    return std::all_of(trackers.begin(), trackers.end(), [](const auto& tracker) { return tracker.starts() > 0; });
  }

  /// The frame of a row's estimate; there is one if the recording is geodetic.
  const LocalFrame<Axes>& frame(std::size_t filter, std::size_t tag) const {
    const auto& all = segments[filter];
    const auto after =
        std::find_if(all.begin() + 1, all.end(), [&](const auto& segment) { return segment.first_tag > tag; });
    return std::prev(after)->frame;
  }

  std::vector<Tracker<Axes>> trackers;
  std::optional<LocalFrame<Axes>> anchor;                    // where positions are counted from in the output
  std::vector<std::vector<Segment<Axes>>> segments;          // of each filter
  double before = std::numeric_limits<double>::quiet_NaN();  // the time of the row before
  RandomStream random;
  bool keeps_all;        // rows, if a filter is to be smoothed; else two: a start may wait for the row after it
  std::deque<Fix> rows;  // whose tags are their numbers
  std::size_t taken = 0;

  const Fix& row(std::size_t tag) const { return rows[tag + rows.size() - taken]; }
};

/// All filters on all targets of one recording.
template <int Axes>
class TrackRun {
 public:
  TrackRun(const TrackOptions& options, RecordingReader& recording, const std::vector<FilterSettings>& filters,
           TrackSinks sinks)
      : options_(options), recording_(recording), filters_(filters), sinks_(sinks) {
    outcome_.filters.resize(filters.size());
    for (std::size_t f = 0; f < filters.size(); ++f)
      for (auto& part : outcome_.filters[f].sums) part.weights.assign(filters[f].models.size(), 0.0);
    if (options.radar_at) radar_at_ = Vector<3>(options.radar_at->data());
  }

  TrackOutcome run() {
    const auto total = recording_.csv().bytes_total();
    Progress progress(file(), total.value_or(1), options_.output.quiet || !total);
    std::uint64_t done = 0;
    for (Fix fix; recording_.next(fix);) {
      take(fix);
      progress.advance(recording_.csv().bytes_read() - done);
      done = recording_.csv().bytes_read();
    }
    progress.finish();
    if (options_.predict_to) predict();
    for (auto& [name, target] : targets_) smooth(target);
    outcome_.tracks = targets_.size();
    if (file_anchor_ && (fixed_ || recording_.origin() || !recording_.has_tracks()))
      outcome_.origin = file_anchor_->origin();
    for (const auto& [name, target] : targets_) count(name, target);
    if (outcome_.never_started.size() == targets_.size()) refuse_nothing();
    return std::move(outcome_);
  }

 private:
  const std::string& file() const { return recording_.csv().file(); }

  /// A last step of each target that ended before the time asked for, without a measurement.
  void predict() {
    for (auto& [name, target] : targets_) {
      Fix fix;
      fix.line = target.rows.back().line;
      fix.track = name;
      fix.time_s = *options_.predict_to;
      if (fix.time_s <= target.before) continue;
      step(target, fix);
      ++outcome_.predicted;
    }
  }

  void count(const std::string& name, const Target<Axes>& target) {
    if (!target.all_started()) outcome_.never_started.push_back(name);
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      const Tracker<Axes>& tracker = target.trackers[f];
      outcome_.filters[f].rejected += tracker.rejected();
      outcome_.filters[f].restarts += tracker.starts() > 0 ? tracker.starts() - 1 : 0;
      if (filters_[f].explain) outcome_.filters[f].histories[name] = tracker.explained();
    }
  }

  void take(Fix fix) {
    ++outcome_.rows;
    if (fix.measured()) ++outcome_.measurements;
    if (recording_.has_sensors()) ++outcome_.sensors[fix.sensor];
    auto target = targets_.find(fix.track);
    if (target == targets_.end())
      target = targets_.try_emplace(fix.track, filters_, stream_of(options_.seed, fix.track)).first;
    if (fix.place) place(target->second, fix);
    if (options_.radar && fix.position && !fix.no_height)
      see_by_radar(fix, *options_.radar, radar_at_, target->second.random, file());
    else if (options_.radar)
      fix.position.reset();
    if (fix.seen) outcome_.validity.add(fix, *fix.seen, filters_);
    if (fix.truth && fix.located() && !fix.no_height)
      add_by_part(outcome_.raw, fix.roll_deg, [&](Sums& sums) {
        add_error(sums, (fix.seen ? radar_at_ + to_cartesian(*fix.seen) : *fix.position) - *fix.truth);
      });
    if (sinks_.page) show(target->second, fix);
    step(target->second, fix);
  }

  /// Gives the target its frames at its first place. Where errors or a radar are about one point, that is the frame of
  /// all for good, and the place a position in it.
  void place(Target<Axes>& target, Fix& fix) {
    if (!target.anchor) {
      Geodetic here = *fix.place;
      if (!file_anchor_) file_anchor_.emplace(recording_.origin().value_or(here));
      target.anchor.emplace(fixed_ ? file_anchor_->origin() : recording_.origin().value_or(here));
      const bool near = far_away(target.anchor->to_local(here)) == false;
      for (std::size_t f = 0; f < filters_.size(); ++f) {
        const bool stays = fixed_ || near || filters_[f].start == StartRule::given;
        target.segments[f] = {{0, 0, stays ? *target.anchor : LocalFrame<Axes>(here)}};
      }
    }
    if (!fixed_) return;
    fix.position = Vector<3>::Zero();
    fix.position->template head<Axes>() = target.anchor->to_local(*fix.place);
    fix.place.reset();
  }

  /// So far from the origin of a frame its axes are no longer east and north.
  static bool far_away(const Vector<Axes>& position) { return position.template head<2>().norm() > 50e3; }

  /// Moves the frame of a filter along with a target that has gone far.
  void follow(Target<Axes>& target, std::size_t f) {
    Tracker<Axes>& tracker = target.trackers[f];
    if (!target.anchor || fixed_ || !tracker.running()) return;
    auto& segments = target.segments[f];
    if (segments.back().starts == 0) segments.back().starts = tracker.starts();
    if (tracker.starts() > segments.back().starts) {
      segments.push_back({target.taken - 1, tracker.starts(), segments.back().frame});
      if (!tracker.settings().smooth) segments.erase(segments.begin());
    }
    const Vector<Axes> position = tracker.now().estimate.mean.template head<Axes>();
    if (!far_away(position)) return;
    LocalFrame<Axes>& frame = segments.back().frame;
    const SquareMatrix<Axes> turn = frame.local_axes(position);
    if (tracker.transform(turn, -turn * position)) frame = LocalFrame<Axes>(frame.to_geodetic(position));
  }

  void step(Target<Axes>& target, const Fix& fix) {
    const bool again = fix.time_s == target.before;  // of another sensor: nothing starts from two rows of one time
    target.before = fix.time_s;
    target.rows.push_back(fix);
    ++target.taken;
    if (!target.keeps_all && target.rows.size() > 2) target.rows.pop_front();
    std::optional<double> least;  // of the filters' NIS
    std::size_t refusing = 0;     // filters whose gate turns the measurement away
    for (std::size_t f = 0; f < target.trackers.size(); ++f) {
      auto& tracker = target.trackers[f];
      if (again && !tracker.running()) continue;
      const std::size_t rejected = tracker.rejected(), starts = tracker.starts();
      try {
        tracker.take(fix.time_s, reading(fix, target, f), target.taken - 1, [&](std::size_t tag) {
          if (tracker.settings().smooth) return;
          const TrackPoint<Axes> now = tracker.now();
          record(target, tag, f, now);
          if (tag + 1 == target.taken && now.nis && (!least || *now.nis < *least)) least = now.nis;
        });
        follow(target, f);
      } catch (const InputError&) {
        throw;  // of the output
      } catch (const std::exception& error) {
        refuse_failure(f, fix, error);
      }
      if (tracker.rejected() > rejected) ++refusing;
      if (sinks_.page && tracker.rejected() > rejected) sinks_.page->rejected(fix, f);
      if (sinks_.page && starts > 0 && tracker.starts() > starts) sinks_.page->restarted(fix, f);
    }
    if (refusing == filters_.size() && outcome_.refused_by_all++ == 0) outcome_.first_refused_line = fix.line;
    if (least) outcome_.outliers.add(fix.line, *least);
  }

  /// The steps of a target whose rows have all been read, as smoothing sees them.
  void smooth(Target<Axes>& target) {
    for (std::size_t f = 0; f < target.trackers.size(); ++f) {
      std::vector<TrackPoint<Axes>> points;
      try {
        points = target.trackers[f].finish();
      } catch (const std::exception& error) {
        refuse_failure(f, target.rows.back(), error);
      }
      for (const auto& point : points)
        if (!point.is_start) record(target, point.tag, f, point);
    }
    target.rows.clear();
  }

  /// What a row measures, in the frame of the filter and with the covariances that it believes.
  std::optional<Reading<Axes>> reading(const Fix& fix, const Target<Axes>& target, std::size_t f) const {
    const Tracker<Axes>& tracker = target.trackers[f];
    if (!tracker.running() && (fix.no_height || !fix.located())) return std::nullopt;
    if (!target.anchor) return reading_of<Axes>(fix, filters_[f], radar_at_);
    return reading_of<Axes>(localized(fix, target.segments[f].back().frame, tracker), filters_[f], radar_at_);
  }

  /// The row with its place as a position in a frame, and its velocity, which is along the place's own east, north and
  /// up, along the axes of the frame.
  static Fix localized(Fix fix, const LocalFrame<Axes>& frame, const Tracker<Axes>& tracker) {
    const auto known = [&] { return Vector<Axes>(tracker.now().estimate.mean.template head<Axes>()); };
    if (fix.place) {
      if (fix.no_height) fix.place->altitude_m = frame.to_geodetic(known()).altitude_m;  // it is at the target's
      fix.position = Vector<3>::Zero();
      fix.position->template head<Axes>() = frame.to_local(*fix.place);
      fix.place.reset();
    }
    if (!fix.moving()) return fix;
    Vector<Axes> v;
    for (Eigen::Index i = 0; i < Axes; ++i) v(i) = fix.velocity[static_cast<std::size_t>(i)].value_or(0.0);
    const Vector<Axes> at = fix.position ? Vector<Axes>(fix.position->template head<Axes>()) : known();
    v = (frame.local_axes(at).transpose() * v).eval();
    for (Eigen::Index i = 0; i < Axes; ++i)
      if (auto& component = fix.velocity[static_cast<std::size_t>(i)]) component = v(i);
    return fix;
  }

  template <class Add>
  static void add_by_part(SumsByPart& sums, std::optional<double> roll, const Add& add) {
    for (std::size_t p = 0; p < parts.size(); ++p)
      if (parts[p].holds(roll)) add(sums[p]);
  }

  /// Takes down what filter f says of a row.
  void record(const Target<Axes>& target, std::size_t tag, std::size_t f, const TrackPoint<Axes>& point) {
    const Fix& fix = target.row(tag);
    if (sinks_.estimates || sinks_.page) tell(target, tag, f, point);
    if (options_.predict_to && !fix.measured() && fix.time_s == *options_.predict_to) return;
    const auto& estimate = point.estimate;
    const int quantities = measured_quantities(fix, filters_[f].accuracy_of(fix.sensor), Axes);
    add_by_part(outcome_.filters[f].sums, fix.roll_deg, [&](Sums& sums) {
      ++sums.count;
      for (Eigen::Index axis = 0; axis < Axes; ++axis)
        sums.sigma[static_cast<std::size_t>(axis)].add_square(estimate.covariance(axis, axis));
      if (fix.truth) {
        Vector<3> error = Vector<3>::Zero();
        error.template head<Axes>() = estimate.mean.template head<Axes>() - fix.truth->template head<Axes>();
        add_error(sums, error);
      }
      for (std::size_t j = 0; j < sums.weights.size(); ++j) sums.weights[j] += point.weights[j];
      if (point.nis) sums.nis.add(*point.nis, usual_nis_[static_cast<std::size_t>(quantities) - 1]);
    });
  }

  void tell(const Target<Axes>& target, std::size_t tag, std::size_t f, TrackPoint<Axes> point) {
    const Fix& fix = target.row(tag);
    std::optional<Geodetic> place;
    if (target.anchor) place = tell_from(*target.anchor, target.frame(f, tag), point);
    if (sinks_.estimates) sinks_.estimates->add(fix.track, filters_[f], point, place);
    if (sinks_.page) sinks_.page->estimated(fix, f, point);
  }

  /// Shows a row on the page.
  void show(const Target<Axes>& target, const Fix& fix) {
    std::optional<Vector<3>> position = fix.position;
    if (fix.seen) position = radar_at_ + to_cartesian(*fix.seen);
    if (fix.place) {
      position = Vector<3>::Zero();
      position->template head<Axes>() = target.anchor->to_local(*fix.place);
    }
    std::optional<Geodetic> anchor;
    if (target.anchor) anchor = target.anchor->origin();
    sinks_.page->measured(fix, position, anchor);
  }

  [[noreturn]] void refuse_failure(std::size_t f, const Fix& fix, const std::exception& error) const {
    throw InputError(message(
        {.where = fmt::format("{}:{}", file(), fix.line),
         .what = fmt::format("filter '{}' at time {} s: {}", filters_[f].name, shortest(fix.time_s), error.what()),
         .remedy = "look for an outlier here, and at the start and the settings of the filter"}));
  }

  [[noreturn]] void refuse_nothing() const {
    if (outcome_.rows == 0 && !options_.recording.select.empty())
      throw InputError(message({.where = file(),
                                .what = fmt::format("no row has {}", fmt::join(options_.recording.select, " and ")),
                                .remedy = "see how the file writes the value"}));
    throw InputError(
        message({.where = file(),
                 .what = targets_.size() > 1 ? "no track is long enough for every filter to start"
                                             : "there is too little for every filter to start",
                 .found = fmt::format("{} rows, {} of them measurements", outcome_.rows, outcome_.measurements),
                 .expected = "at least three measurements (two rows if the start is given)",
                 .remedy = "give more rows, or start = \"given\" with start_time_s"}));
  }

  const TrackOptions& options_;
  RecordingReader& recording_;
  const std::vector<FilterSettings>& filters_;
  TrackSinks sinks_;
  std::map<std::string, Target<Axes>, std::less<>> targets_;
  TrackOutcome outcome_;
  std::optional<LocalFrame<Axes>> file_anchor_;
  /// Below which 95 % of the NIS are, of 1 to 6 quantities.
  std::array<double, 6> usual_nis_ = [] {
    std::array<double, 6> result;
    for (std::size_t m = 0; m < 6; ++m) result[m] = chi_square_quantile(0.95, static_cast<double>(m + 1));
    return result;
  }();
  bool fixed_ = options_.radar || recording_.has_truth();  // whether all is about one point
  Vector<3> radar_at_ = Vector<3>::Zero();
};

}  // namespace

TrackOutcome run_track(const TrackOptions& options, RecordingReader& recording,
                       const std::vector<FilterSettings>& filters, TrackSinks sinks) {
  if (recording.axes() == 3) return TrackRun<3>(options, recording, filters, sinks).run();
  return TrackRun<2>(options, recording, filters, sinks).run();
}

}  // namespace sigmax::apps
