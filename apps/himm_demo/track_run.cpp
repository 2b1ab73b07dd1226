#include "himm_demo/track_run.hpp"

#include <algorithm>
#include <deque>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "himm_demo/estimate_lines.hpp"
#include "himm_demo/fix_reading.hpp"
#include "himm_demo/simulated_radar.hpp"
#include "himm_demo/track_ledger.hpp"
#include "himm_demo/track_shares.hpp"
#include "himm_demo/tracker.hpp"
#include "support/output.hpp"
#include "support/progress.hpp"
#include "support/random.hpp"
#include "support/timestamp.hpp"

namespace sigmax::apps {
namespace {

/// The frame in which a filter follows a target from a start on.
template <int Axes>
struct Segment {
  std::size_t first_tag;
  std::size_t starts;
  LocalFrame<Axes> frame;
};

/// One target of a recording, followed by every filter: here, or in another rank.
template <int Axes>
struct Target {
  Target(const std::vector<FilterSettings>& filters, const RandomStream& random_stream, int its_rank, bool here)
      : rank(its_rank),
        trackers(filters.begin(), here ? filters.end() : filters.begin()),
        tallies(filters.size()),
        segments(filters.size()),
        random(random_stream),
        keeps_all(std::any_of(filters.begin(), filters.end(), [](const auto& filter) { return filter.smooth; })) {}

  /// The frame of a row's estimate; there is one if the recording is geodetic.
  const LocalFrame<Axes>& frame(std::size_t filter, std::size_t tag) const {
    const auto& all = segments[filter];
    const auto after =
        std::find_if(all.begin() + 1, all.end(), [&](const auto& segment) { return segment.first_tag > tag; });
    return std::prev(after)->frame;
  }

  int rank;  // that follows it
  std::vector<Tracker<Axes>> trackers;
  std::vector<Tally> tallies;
  std::optional<LocalFrame<Axes>> anchor;                    // where positions are counted from in the output
  std::vector<std::vector<Segment<Axes>>> segments;          // of each filter
  double before = std::numeric_limits<double>::quiet_NaN();  // the time of the row before
  RandomStream random;
  bool keeps_all;        // rows, if a filter is to be smoothed; else two: a start may wait for the row after it
  std::deque<Fix> rows;  // whose tags are their numbers
  std::size_t taken = 0;
  std::size_t measurements = 0;  // of them

  const Fix& row(std::size_t tag) const { return rows[tag + rows.size() - taken]; }
};

/// All filters on all targets of one recording.
template <int Axes>
class TrackRun {
 public:
  TrackRun(const TrackOptions& options, RecordingReader& recording, const std::vector<FilterSettings>& filters,
           TrackSinks sinks, TrackShares& shares)
      : options_(options),
        recording_(recording),
        filters_(filters),
        sinks_(sinks),
        shares_(shares),
        ledger_(options, filters, Axes, sinks) {
    if (options.radar_at) radar_at_ = Vector<3>(options.radar_at->data());
  }

  TrackOutcome run() {
    const auto total = recording_.csv().bytes_total();
    Progress progress(file(), total.value_or(1), options_.output.quiet || !total || !shares_.first());
    std::uint64_t done = 0;
    for (Fix fix; recording_.next(fix);) {
      take(fix);
      progress.advance(recording_.csv().bytes_read() - done);
      done = recording_.csv().bytes_read();
    }
    progress.finish();
    if (options_.predict_to) predict();
    for (auto& [name, target] : targets_) end(name, target);
    shares_.finish();
    if (shares_.first() && outcome_.never_started.size() == targets_.size()) refuse_nothing();
    outcome_.tracks = targets_.size();
    if (file_anchor_ && (fixed_ || recording_.origin() || !recording_.has_tracks()))
      outcome_.origin = file_anchor_->origin();
    return std::move(outcome_);
  }

 private:
  const std::string& file() const { return recording_.csv().file(); }

  /// A last step of each target that ended before the time asked for, without a measurement.
  void predict() {
    for (auto& [name, target] : targets_) {
      if (!shares_.concerns(target.rank)) continue;
      Fix fix;
      fix.line = target.rows.back().line;
      fix.track = name;
      fix.time_s = predict_to(target.before);
      fix.predicted = true;
      if (fix.time_s <= target.before) continue;
      step(target, fix);
      ++outcome_.predicted;
    }
  }

  /// The time asked for; a time of day is on the day of a target's last row, or the next.
  double predict_to(double before) const {
    if (!options_.predict_to_time_of_day || !recording_.times_of_day()) return *options_.predict_to;
    return time_of_day_after(before, *options_.predict_to);
  }

  void take(Fix fix) {
    if (options_.iso_times && recording_.times_of_day()) refuse_dates(fix);
    ledger_.read(fix, recording_.has_sensors());
    Target<Axes>& target = target_of(fix.track);
    if (fix.place) place(target, fix);
    if (!shares_.concerns(target.rank)) return;
    if (options_.radar && fix.position && fix.whole())
      see_by_radar(fix, *options_.radar, radar_at_, target.random, file());
    else if (options_.radar)
      fix.position.reset();
    std::optional<Geodetic> anchor;
    if (target.anchor) anchor = target.anchor->origin();
    ledger_.measured(fix, position_of(fix, target), anchor);
    step(target, fix);
  }

  Target<Axes>& target_of(const std::string& track) {
    if (const auto found = targets_.find(track); found != targets_.end()) return found->second;
    const int rank = shares_.rank_of(targets_.size());
    return targets_.try_emplace(track, filters_, stream_of(options_.seed, track), rank, shares_.follows(rank))
        .first->second;
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
  static bool far_away(const Vector<Axes>& position) {
    return position.template head<std::min(Axes, 2)>().norm() > 50e3;
  }

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
    if (fix.measured()) ++target.measurements;
    if (!target.keeps_all && target.rows.size() > 2) target.rows.pop_front();
    const auto step = shares_.by<Step>(target.rank, [&] { return followed(target, fix, again); });
    if (!step) return;
    std::optional<double> least;  // of the filters' NIS
    for (const Said& said : step->said) {
      ledger_.said(target.row(said.tag), said);
      if (said.tag + 1 == target.taken && said.nis && (!least || *said.nis < *least)) least = said.nis;
    }
    ledger_.stepped(fix, target.tallies, step->tallies, least);
    target.tallies = step->tallies;
  }

  /// What the filters make of the last row.
  Step followed(Target<Axes>& target, const Fix& fix, bool again) {
    Step step;
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      auto& tracker = target.trackers[f];
      try {
        if (!again || tracker.running()) {
          tracker.take(fix.time_s, reading(fix, target, f), target.taken - 1, [&](std::size_t tag) {
            if (!tracker.settings().smooth) step.said.push_back(said(target, tag, f, tracker.now()));
          });
          follow(target, f);
        }
      } catch (const std::exception& error) {
        refuse_failure(f, fix, error);
      }
      step.tallies.push_back({tracker.rejected(), tracker.starts()});
    }
    return step;
  }

  /// The end of a target whose rows have all been read.
  void end(const std::string& name, Target<Axes>& target) {
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      auto words = shares_.by<LastWords>(target.rank, [&] { return last_words(target, f); });
      if (!words) continue;
      for (const Said& said : words->said) ledger_.said(target.row(said.tag), said);
      ledger_.history(name, f, std::move(words->history));
    }
    target.rows.clear();
    ledger_.ended(name, target.tallies, target.measurements);
  }

  /// The steps as smoothing sees them, and when the modes changed.
  LastWords last_words(const Target<Axes>& target, std::size_t f) const {
    LastWords words;
    try {
      for (const auto& point : target.trackers[f].finish())
        if (!point.is_start) words.said.push_back(said(target, point.tag, f, point));
    } catch (const std::exception& error) {
      refuse_failure(f, target.rows.back(), error);
    }
    words.history = target.trackers[f].explained();
    return words;
  }

  /// What a row measures, in the frame of the filter and with the covariances that it believes.
  std::optional<Reading<Axes>> reading(const Fix& fix, const Target<Axes>& target, std::size_t f) const {
    const Tracker<Axes>& tracker = target.trackers[f];
    const bool starts_from_it = filters_[f].start != StartRule::given || target.anchor;
    if (!tracker.running() && starts_from_it && !fix.whole()) return std::nullopt;
    if (!target.anchor) return reading_of<Axes>(fix, filters_[f], radar_at_);
    return reading_of<Axes>(localized(fix, target.segments[f].back().frame, tracker), filters_[f], radar_at_);
  }

  /// The row with its place as a position in a frame, and its velocity, which is along the place's own east, north and
  /// up, along the axes of the frame.
  static Fix localized(Fix fix, const LocalFrame<Axes>& frame, const Tracker<Axes>& tracker) {
    const auto known = [&] { return Vector<Axes>(tracker.now().estimate.mean.template head<Axes>()); };
    if (fix.place) {
      if (fix.missing[2]) fix.place->altitude_m = frame.to_geodetic(known()).altitude_m;  // it is at the target's
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

  /// What a filter says of a row, as estimates.csv has it and as the sums and the page need it.
  Said said(const Target<Axes>& target, std::size_t tag, std::size_t f, TrackPoint<Axes> point) const {
    Said said{.filter = f, .tag = tag, .time = point.time, .own = position_of(point), .nis = point.nis};
    std::optional<Geodetic> place;
    if (target.anchor && tells_) place = tell_from(*target.anchor, target.frame(f, tag), point);
    said.told = position_of(point);
    if (sinks_.lines) said.line = sinks_.lines->line(target.row(tag).track, filters_[f], point, place);
    said.weights = std::move(point.weights);
    return said;
  }

  static Said::Position position_of(const TrackPoint<Axes>& point) {
    Said::Position position;
    for (Eigen::Index i = 0; i < Axes; ++i) {
      position.mean[static_cast<std::size_t>(i)] = point.estimate.mean(i);
      position.variance[static_cast<std::size_t>(i)] = point.estimate.covariance(i, i);
    }
    return position;
  }

  /// Where a row's measurement was.
  std::optional<Vector<3>> position_of(const Fix& fix, const Target<Axes>& target) const {
    if (fix.seen) return radar_at_ + to_cartesian(*fix.seen);
    if (!fix.place || !sinks_.page) return fix.position;
    Vector<3> position = Vector<3>::Zero();
    position.template head<Axes>() = target.anchor->to_local(*fix.place);
    return position;
  }

  [[noreturn]] void refuse_failure(std::size_t f, const Fix& fix, const std::exception& error) const {
    throw InputError(message(
        {.where = fmt::format("{}:{}", file(), fix.line),
         .what = fmt::format("filter '{}' at time {} s: {}", filters_[f].name, shortest(fix.time_s), error.what()),
         .remedy = "look for an outlier here, and at the start and the settings of the filter"}));
  }

  [[noreturn]] void refuse_dates(const Fix& fix) const {
    throw InputError(message({.where = fmt::format("{}:{}", file(), fix.line),
                              .what = "--iso-times writes dates, and a time of day has none",
                              .remedy = "leave out --iso-times, or write the date before the times of the recording"}));
  }

  [[noreturn]] void refuse_nothing() const {
    if (outcome_.rows == 0 && !options_.recording.select.empty())
      throw InputError(message({.where = file(),
                                .what = fmt::format("no row has {}", fmt::join(options_.recording.select, " and ")),
                                .remedy = "see how the file writes the value"}));
    throw InputError(message(
        {.where = file(),
         .what = targets_.size() > 1 ? "no track is long enough for every filter to start"
                                     : "there is too little for every filter to start",
         .found = fmt::format("{} rows, {} of them measurements", outcome_.rows, outcome_.measurements),
         .expected = "at least three measurements (two rows if the start is given)",
         .remedy = outcome_.bearings == outcome_.measurements && outcome_.bearings > 0
                       ? "bearings do not tell where a target starts; give start = \"given\" with start_mean, "
                         "start_covariance_diagonal and start_time_s"
                   : outcome_.partial > 0 ? "a track starts from whole positions; drop a column that is always empty"
                                          : "give more rows, or start = \"given\" with start_time_s"}));
  }

  const TrackOptions& options_;
  RecordingReader& recording_;
  const std::vector<FilterSettings>& filters_;
  TrackSinks sinks_;
  TrackShares& shares_;
  TrackLedger ledger_;
  TrackOutcome& outcome_ = ledger_.outcome;
  bool tells_ = sinks_.lines || sinks_.page || !shares_.first();  // where a target is on the earth
  std::map<std::string, Target<Axes>, std::less<>> targets_;
  std::optional<LocalFrame<Axes>> file_anchor_;
  bool fixed_ = options_.radar || recording_.has_truth();  // whether all is about one point
  Vector<3> radar_at_ = Vector<3>::Zero();
};

}  // namespace

TrackOutcome run_track(const TrackOptions& options, RecordingReader& recording,
                       const std::vector<FilterSettings>& filters, TrackSinks sinks, TrackShares& shares) {
  if (recording.axes() == 1) return TrackRun<1>(options, recording, filters, sinks, shares).run();
  if (recording.axes() == 3) return TrackRun<3>(options, recording, filters, sinks, shares).run();
  return TrackRun<2>(options, recording, filters, sinks, shares).run();
}

}  // namespace sigmax::apps
