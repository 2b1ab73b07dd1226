#include "himm_demo/track/track.hpp"

#include <Eigen/LU>

#include "support/progress.hpp"
#include "support/random.hpp"
#include "support/timestamp.hpp"

namespace sigmax::apps {
namespace {

/// The frame in which a filter follows a target from a row on, and how what is told in the one before, of the same
/// start, is told in it: turned, and shifted.
struct Segment {
  std::size_t first_tag, starts;
  LocalFrame frame;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
};

/// One target of a recording, followed by every filter.
struct Target {
  RandomStream random;
  std::vector<AnyTarget> filters;
  std::optional<LocalFrame> anchor{};            // where positions are counted from in the output
  std::vector<std::vector<Segment>> segments{};  // of each filter, of a geodetic target
  std::deque<Row> rows{};                        // whose tags are their numbers
  std::map<std::pair<std::size_t, std::string>, std::vector<double>> innovations{};  // the last of a filter and sensor
  TrackTally tally{};
  std::vector<std::size_t> refused{};  // of each filter, the last row that its gate turned away, counted from 1

  std::size_t first_tag() const { return tally.rows - rows.size(); }
  const Row& row(std::size_t tag) const { return rows[tag - first_tag()]; }

  /// That of a row's estimate.
  std::vector<Segment>::const_iterator segment(std::size_t filter, std::size_t tag) const {
    const auto& all = segments[filter];
    return std::prev(std::ranges::upper_bound(all.begin() + 1, all.end(), tag, {}, &Segment::first_tag));
  }
};

Eigen::Matrix3d matrix(const std::array<Position, 3>& rows) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows[0].data());
}

/// Turns the mean and the covariance of each derivative of a point.
void turn_point(const Eigen::Matrix3d& turn, TargetPoint& point, Eigen::Index axes) {
  const auto n = static_cast<Eigen::Index>(point.mean.size());
  Eigen::Map<Eigen::VectorXd> means(point.mean.data(), n);
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> covariances(
      point.covariance.data(), n, n);
  for (Eigen::Index at = 0; at + axes <= n; at += axes) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    mean.head(axes) = means.segment(at, axes);
    covariance.topLeftCorner(axes, axes) = covariances.block(at, at, axes, axes);
    mean = turn * mean;
    covariance = turn * covariance * turn.transpose();
    means.segment(at, axes) = mean.head(axes);
    covariances.block(at, at, axes, axes) = covariance.topLeftCorner(axes, axes);
  }
}

template <class Add>
void add_by_part(SumsByPart& sums, std::optional<double> roll, const Add& add) {
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (parts[p].holds(roll)) add(sums[p]);
}

/// estimates.csv: a row for each filter and step.
class Estimates {
 public:
  /// What a filter tells of a row.
  struct Told {
    const std::string& track;
    const FilterSettings& filter;
    const TargetPoint& point;
    const std::optional<Geodetic>& place;
  };

  /// Without files it keeps nothing.
  Estimates(const TrackOptions& options, const std::vector<FilterSettings>& filters, const RecordingReader& recording,
            ResultFiles* files) {
    if (!files) return;
    const auto axes = static_cast<std::size_t>(recording.axes());
    std::vector<std::string> keys;
    const auto add = [&](std::string key, std::function<Cell(const Told&)> cell) {
      keys.push_back(std::move(key));
      cells_.push_back(std::move(cell));
    };
    add("time_s", [](const Told& told) { return told.point.time; });
    if (options.iso_times) add("time_utc", [](const Told& told) { return iso_time(told.point.time); });
    if (recording.has_tracks()) add("track", [](const Told& told) { return told.track; });
    add("filter", [](const Told& told) { return told.filter.name; });
    // What there is of the mean, and of its standard deviations, along each axis.
    constexpr std::array formats = {"{}_m", "v{}_mps", "a{}_mps2", "sigma_{}_m", "sigma_v{}_mps"};
    for (std::size_t k = 0; k < 3 * formats.size(); ++k)
      add(fmt::format(fmt::runtime(formats[k / 3]), "xyz"[k % 3]), [=](const Told& told) {
        const std::size_t n = told.point.mean.size(), i = k / 3 % 3 * axes + k % 3;
        if (k % 3 >= axes || i >= n / axes * axes) return Cell();
        return Cell(k < 9 ? told.point.mean[i] : std::sqrt(told.point.covariance[i * (n + 1)]));
      });
    add("nis", [](const Told& told) { return told.point.nis ? Cell(*told.point.nis) : Cell(); });
    const auto turns = [](const FilterSettings& filter) {
      return !std::ranges::all_of(filter.motions, &MotionChoice::linear);
    };
    if (std::ranges::any_of(filters, turns))
      add("turn_rate_deg_s", [=](const Told& told) {  // which comes after the derivatives
        const std::vector<double>& mean = told.point.mean;
        return mean.size() % axes > 0 ? Cell(mean[mean.size() / axes * axes] / degree) : Cell();
      });
    for (const auto& model : model_names(filters))
      add("weight_" + model, [=](const Told& told) {
        const auto& own = told.filter.models;
        const auto j = static_cast<std::size_t>(std::ranges::find(own, model) - own.begin());
        return j < own.size() ? Cell(told.point.weights[j]) : Cell();
      });
    add("most_likely", [](const Told& told) { return told.filter.models[told.point.most_likely_mode]; });
    if (recording.on_the_earth()) {
      add("latitude_deg", [](const Told& told) { return told.place ? Cell(told.place->latitude_deg) : Cell(); });
      add("longitude_deg", [](const Told& told) { return told.place ? Cell(told.place->longitude_deg) : Cell(); });
      add("altitude_m",
          [=](const Told& told) { return told.place && axes == 3 ? Cell(told.place->altitude_m) : Cell(); });
    }
    file_.emplace(*files, "estimates.csv", keys);
  }

  explicit operator bool() const { return file_ && *file_; }
  void write(const Told& told) {
    if (*this) file_->write(each(cells_, [&](const auto& cell) { return cell(told); }));
  }

 private:
  std::vector<std::function<Cell(const Told&)>> cells_;
  std::optional<RowFile> file_;
};

/// All filters on all targets of one recording.
class TrackRun {
 public:
  TrackRun(const TrackOptions& options, RecordingReader& recording, const std::vector<FilterSettings>& filters,
           TrackSinks sinks)
      : options_(options), recording_(recording), filters_(filters), sinks_(sinks) {
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
    if (outcome_.never_started.size() == targets_.size()) refuse_nothing();
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
      row.plot.time = of_day ? time_of_day_after(target.tally.last_time, *options_.predict_to) : *options_.predict_to;
      if (row.plot.time <= target.tally.last_time) continue;
      const double ahead = row.plot.time - target.tally.last_time;
      const auto begins_anew = [=](const FilterSettings& filter) {
        return filter.restart_after_s.value_or(infinity) <= ahead;
      };
      outcome_.unpredicted += std::ranges::any_of(filters_, begins_anew) ? 1U : 0U;
      step(target, std::move(row));
      ++outcome_.predicted;
    }
  }

  void take(Row& row) {
    if (options_.iso_times && recording_.times_of_day())
      throw InputError(
          "{}:{}: --iso-times writes dates, and a time of day has none; leave out --iso-times, or write the date "
          "before the times of the recording",
          file(), row.line);
    count(row);
    auto found = targets_.find(row.track);
    if (found == targets_.end()) {
      found = targets_.emplace(row.track, Target{stream_of(options_.seed, row.track), prototypes_}).first;
      found->second.tally.nis.resize(filters_.size());
      found->second.refused.resize(filters_.size());
    }
    Target& target = found->second;
    if (!options_.radar.sigma) places_.place(row);
    if (sinks_.rows) sinks_.rows(row, places_.frame() ? &*places_.frame() : nullptr);
    if (!target.anchor && (places_.frame() || (recording_.geodetic() && axes_seen(row.plot, axes_) > 0)))
      begin_frames(target, places_.frame() ? places_.frame()->origin() : place_of(row.plot, axes_, 0.0));
    if (options_.radar.sigma) see_by_radar(row, where(row, target), axes_, options_.radar, target.random, file());
    measured(row, target);
    step(target, std::move(row));
  }

  /// What the recording holds.
  void count(const Row& row) {
    const int axes = axes_seen(row.plot, axes_);
    ++outcome_.rows;
    outcome_.last_time = row.plot.time;
    if (row.measured()) ++outcome_.measurements;
    if (axes > 0 && axes < axes_) ++outcome_.partial;
    if (row.plot.sensor == AnyPlot::Sensor::bearing) ++outcome_.bearings;
    if (row.measured() && !options_.radar.sigma) count_defaults(row.plot, row.sensor);
    if (!recording_.has_sensors()) return;
    ++outcome_.sensors[row.sensor];
    const auto known = [&](std::optional<double> Accuracy::*sigma) {
      return std::ranges::any_of(
          filters_, [&](const FilterSettings& filter) { return (filter.accuracy_of(row.sensor).*sigma).has_value(); });
    };
    if (is_moving(row.plot, axes_) && !known(&Accuracy::velocity_mps)) ++outcome_.velocity_unknown[row.sensor];
    if (row.plot.sensor == AnyPlot::Sensor::doppler && !known(&Accuracy::range_rate_mps))
      ++outcome_.range_rate_unknown[row.sensor];
  }

  /// Rows of which a position, a range or an azimuth has the sigma of a filter that nobody told another one.
  void count_defaults(const AnyPlot& plot, const std::string& sensor) {
    static const Accuracy usual{};
    std::array<bool, 3> by_default{};
    if (plot.sensor == AnyPlot::Sensor::components) {
      for (int i = 0; i < plot.size; ++i)
        by_default[0] |= plot.places[static_cast<std::size_t>(i)] < axes_ && std::isnan(plot.variance(i));
    } else {
      const bool is_bearing = plot.sensor == AnyPlot::Sensor::bearing;
      by_default = {false, !is_bearing && std::isnan(plot.variance(0)), std::isnan(plot.variance(is_bearing ? 0 : 1))};
    }
    for (const FilterSettings& filter : filters_) {
      const Accuracy& own = filter.accuracy_of(sensor);
      by_default[0] &= own.position_m == usual.position_m && !own.given.contains("sigma_position_m");
      by_default[1] &= own.radar[0] == usual.radar[0] && !own.given.contains("sigma_range_m");
      by_default[2] &= own.radar[1] == usual.radar[1] && !own.given.contains("sigma_azimuth_deg");
    }
    for (std::size_t k = 0; k < by_default.size(); ++k) outcome_.by_default[k] += by_default[k] ? 1U : 0U;
  }

  /// Gives the target its frames at its first place. Where errors or a radar are about one point, that is the frame of
  /// all for good.
  void begin_frames(Target& target, const Geodetic& here) {
    if (!file_anchor_) file_anchor_ = recording_.origin().value_or(here);
    target.anchor.emplace(fixed_ ? *file_anchor_ : recording_.origin().value_or(here), axes_);
    const bool near = !far_away(target.anchor->to_local(here));
    for (const auto& filter : filters_) {
      const bool stays = fixed_ || near || filter.start == StartRule::given || has_home(filter);
      target.segments.push_back({{0, 0, stays ? *target.anchor : LocalFrame(here, axes_)}});
    }
  }

  /// Whether a model wanders about the origin, which then is to stay where it is.
  static bool has_home(const FilterSettings& filter) {
    return std::ranges::count(filter.motions, "ou_position", &MotionChoice::name) > 0;
  }

  /// So far from the origin of a frame its axes are no longer east and north.
  static bool far_away(const Position& position) {
    return std::sqrt(position[0] * position[0] + position[1] * position[1]) > 50e3;
  }

  /// Where a row's measurement was, about where positions are counted from.
  std::optional<Position> where(const Row& row, const Target& target) const {
    if (!recording_.geodetic() || row.plot.sensor != AnyPlot::Sensor::components) return position_of(row.plot, axes_);
    if (axes_seen(row.plot, axes_) == 0) return std::nullopt;
    return target.anchor->to_local(place_of(row.plot, axes_, 0.0));
  }

  /// What a row measured, perhaps after a simulated radar has seen it.
  void measured(const Row& row, const Target& target) {
    const auto position = where(row, target);
    const bool is_seen = axes_seen(row.plot, axes_) == axes_;
    if (is_seen && row.plot.sensor != AnyPlot::Sensor::components) validate(row);
    const bool judged = row.truth && is_seen;
    if (!judged && !sinks_.page) return;
    if (judged)
      add_by_part(outcome_.raw, row.roll_deg, [&](Sums& sums) {
        for (std::size_t axis = 0; axis < 3; ++axis) sums.error[axis].add((*position)[axis] - (*row.truth)[axis]);
      });
    if (sinks_.page)
      sinks_.page->measured(row, position, target.anchor ? std::optional(target.anchor->origin()) : std::nullopt);
  }

  /// Where a radar's measurement is converted by the standard conversion.
  void validate(const Row& row) {
    Validity& validity = outcome_.validity;
    ++validity.measurements;
    const double range = row.plot.z[0];
    double worst = 0.0;
    for (const auto& filter : filters_) {
      if (filter.radar_measurement != RadarForm::standard) continue;
      const auto& sigma = filter.accuracy_of(row.sensor).radar;
      const double value = range * sigma[1] * sigma[1] / sigma[0];
      worst = std::max(worst, value);
      if (value >= Validity::limit)
        validity.sigma_range_needed = std::max(validity.sigma_range_needed, value * sigma[0] / Validity::limit);
    }
    if (worst < Validity::limit || validity.outside++ > 0) return;
    validity.first_line = row.line;
    validity.first_value = worst;
    validity.first_range = range;
  }

  void step(Target& target, Row row) {
    const double time = row.plot.time;
    TrackTally& tally = target.tally;
    const bool again = time == tally.last_time;  // of another sensor: nothing starts from two rows of one time
    if (tally.rows == 0) tally.first_time = time;
    tally.last_time = time;
    row.plot.tag = tally.rows++;
    if (row.measured()) ++tally.measurements;
    target.rows.push_back(std::move(row));
    if (!keeps_all_ && target.rows.size() > 2) target.rows.pop_front();  // a start may wait for the row after it
    follow(target, again);
  }

  /// Leads the last row through every filter.
  void follow(Target& target, bool again) {
    const Row& row = target.rows.back();
    std::vector<std::optional<double>> nis(filters_.size());
    std::size_t refusing = 0;  // filters whose gate turns the measurement away
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      AnyTarget& filter = target.filters[f];
      const std::size_t rejected = filter.rejected(), starts = filter.starts();
      if (!again || filter.running() || (crosses_ && filters_[f].start != StartRule::given))
        nis[f] = follow(target, f, row);
      if (filter.rejected() > rejected) {
        ++refusing;
        target.refused[f] = target.tally.rows;
        if (sinks_.page) sinks_.page->rejected(row, f);
      }
      if (starts == 0 || filter.starts() == starts) continue;
      constexpr std::size_t rows_of_a_start = 3;
      if (target.refused[f] > 0 && target.tally.rows <= target.refused[f] + rows_of_a_start)
        outcome_.filters[f].given_up.add(row.line);
      if (sinks_.page) sinks_.page->restarted(row, f);
    }
    if (refusing == filters_.size()) outcome_.refused_by_all.add(row.line);
    judge(row, nis);
  }

  /// Leads a row through a filter. Returns the NIS of its step.
  std::optional<double> follow(Target& target, std::size_t f, const Row& row) {
    AnyTarget& filter = target.filters[f];
    std::optional<double> nis;
    try {
      const bool moves = target.anchor && !fixed_ && !has_home(filters_[f]);
      if (moves && row.predicted && filter.running()) move_frame(target, f, filter.output(), true);
      const AnyPlot plot = plot_for(target, f, row);
      TargetPoint last;
      filter.follow({&plot, 1}, [&](const TargetPoint& point) {
        if (point.tag == row.plot.tag && !point.is_start) nis = point.nis;
        if (!filters_[f].smooth && !point.is_start) tell(target, f, point, frame_of(target, f, point));
        last = point;
      });
      if (moves && !row.predicted && filter.running()) move_frame(target, f, last);
    } catch (const std::logic_error& error) {
      refuse_failure(f, row, error);
    }
    return nis;
  }

  void judge(const Row& row, const std::vector<std::optional<double>>& nis) {
    std::optional<double> least;
    for (const auto& one : nis)
      if (one && (!least || *one < *least)) least = one;
    if (!least) return;
    if (*least > Outliers::limit) {
      Outliers& outliers = outcome_.outliers;
      ++outliers.count;
      if (*least <= outliers.worst_nis) return;
      outliers.worst_nis = *least;
      outliers.worst_line = row.line;
      return;
    }
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      if (!nis[f] || *nis[f] <= Outliers::limit) continue;
      outcome_.filters[f].lost.add(row.line);
      if (*nis[f] > Outliers::by_far) outcome_.filters[f].lost_by_far.add(row.line);
    }
  }

  /// What a row measures, in the frame of the filter and with the covariances that it believes.
  AnyPlot plot_for(const Target& target, std::size_t f, const Row& row) const {
    const AnyTarget& filter = target.filters[f];
    AnyPlot plot = row.plot;
    const bool geodetic = target.anchor && recording_.geodetic();
    const bool starts_from_it = filters_[f].start != StartRule::given || geodetic;
    if (!filter.running() && starts_from_it && !crosses_ && axes_seen(plot, axes_) < axes_) {
      plot = AnyPlot::missed(plot.time);
      plot.tag = row.plot.tag;
    } else if (geodetic && plot.sensor == AnyPlot::Sensor::components) {
      const LocalFrame& frame = target.segments[f].back().frame;
      const int seen = axes_seen(plot, axes_);
      Position at{};
      double altitude = 0.0;
      if (seen < axes_) {  // what the row does not tell is at the target's, which goes on until then
        const TargetPoint last = filter.output();
        const auto n = static_cast<std::size_t>(axes_);
        for (std::size_t i = 0; i < n; ++i)
          at[i] = last.mean[i] + (i + n < last.mean.size() ? (plot.time - last.time) * last.mean[i + n] : 0.0);
        altitude = frame.to_geodetic(at).altitude_m;
      }
      if (seen > 0) at = frame.to_local(place_of(plot, axes_, altitude));
      plot = in_frame(plot, frame, at, axes_);
    }
    return believed(filters_[f], row.sensor, plot, axes_);
  }

  /// Moves the frame of a filter along with a target that has gone far, or before it does.
  void move_frame(Target& target, std::size_t f, const TargetPoint& last, bool always = false) {
    AnyTarget& filter = target.filters[f];
    auto& segments = target.segments[f];
    if (segments.back().starts == 0) segments.back().starts = filter.starts();
    if (filter.starts() > segments.back().starts) {
      segments.push_back({target.tally.rows - 1, filter.starts(), segments.back().frame});
      if (!filters_[f].smooth) segments.erase(segments.begin());
    }
    Position position{};
    std::copy_n(last.mean.begin(), axes_, position.begin());
    if (!far_away(position) && !always) return;
    const LocalFrame frame = segments.back().frame;
    const Eigen::Matrix3d turn = matrix(frame.local_axes(position));
    const Eigen::Vector3d shift = -turn * Eigen::Map<const Eigen::Vector3d>(position.data());
    std::vector<double> A, b;
    for (Eigen::Index i = 0; i < axes_; ++i) {
      for (Eigen::Index j = 0; j < axes_; ++j) A.push_back(turn(i, j));
      b.push_back(shift(i));
    }
    if (!filter.transform(A, b)) return;
    const std::size_t next = target.tally.rows - (always ? 1 : 0), starts = segments.back().starts;
    segments.push_back({next, starts, LocalFrame(frame.to_geodetic(position), axes_), turn, shift});
    if (!filters_[f].smooth) segments.erase(segments.begin());
  }

  /// In which a point of a filter is told, if the target is geodetic.
  static std::optional<Geodetic> frame_of(const Target& target, std::size_t f, const TargetPoint& point) {
    if (!target.anchor) return std::nullopt;
    return target.segment(f, point.tag)->frame.origin();
  }

  /// A smoothed point, which is told in the last frame of its start, in that of its row.
  TargetPoint smoothed(const Target& target, std::size_t f, TargetPoint point) const {
    if (!target.anchor) return point;
    Eigen::Map<Eigen::VectorXd> position(point.mean.data(), axes_);
    const auto own = target.segment(f, point.tag);
    for (auto later = std::prev(target.segments[f].end()); later != own; --later) {
      if (later->starts != own->starts) continue;
      position -= later->shift.head(axes_);
      turn_point(later->turn.inverse(), point, axes_);
    }
    return point;
  }

  /// By quantity, and of a position with a velocity along and across the way.
  void lean(std::array<Lean, 8>& leans, const AnyPlot& plot, std::span<const double> innovation) const {
    for (std::size_t i = 0; i < innovation.size(); ++i) leans[i].add(innovation[i]);
    if (innovation.empty() || axes_ == 1 || axes_seen(plot, axes_) < axes_ || !is_moving(plot, axes_)) return;
    const double x = *component_of(plot, axes_), y = component_of(plot, axes_ + 1).value_or(0.0), v = std::hypot(x, y);
    if (!(v > 0.0)) return;
    leans[6].add((innovation[0] * x + innovation[1] * y) / v);
    leans[7].add((innovation[1] * x - innovation[0] * y) / v);
  }

  /// Takes down what a filter says of a row.
  void tell(Target& target, std::size_t f, TargetPoint point, const std::optional<Geodetic>& frame) {
    ++target.tally.estimates;
    const Row& row = target.row(point.tag);
    const FilterSettings& filter = filters_[f];
    const std::size_t n = point.mean.size();
    const AnyPlot plot = believed(filter, row.sensor, row.plot, axes_);
    if (!row.predicted) {
      lean(outcome_.filters[f].leans[row.sensor], plot, point.normalized_innovation);
      if (!point.normalized_innovation.empty() && axes_seen(row.plot, axes_) == axes_) {
        std::vector<double>& before = target.innovations[{f, row.sensor}];
        const std::span own = std::span(point.normalized_innovation).first(static_cast<std::size_t>(axes_));
        FilterOutcome& its = outcome_.filters[f];
        (is_moving(row.plot, axes_) ? its.with_velocity : its.without_velocity).add(own, before);
        before.assign(own.begin(), own.end());
      }
      if (point.nis) {
        const bool again = point.tag > target.first_tag() && target.row(point.tag - 1).plot.time == row.plot.time;
        FilterOutcome& its = outcome_.filters[f];
        (again ? its.nis_again : its.nis_first).add(*point.nis / static_cast<double>(plot.size));
        target.tally.nis[f].sum += *point.nis;
        target.tally.nis[f].quantities += static_cast<std::size_t>(plot.size);
      }
      add_by_part(outcome_.filters[f].sums, row.roll_deg, [&](Sums& sums) {
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(axes_); ++axis) {
          sums.sigma[axis].add_square(point.covariance[axis * (n + 1)]);
          if (row.truth) sums.error[axis].add(point.mean[axis] - (*row.truth)[axis]);
        }
        for (std::size_t j = 0; j < sums.weights.size(); ++j) sums.weights[j] += point.weights[j];
        if (!point.nis) return;
        sums.innovations.add_nis(*point.nis, static_cast<std::size_t>(plot.size));
        for (int axis = 0; plot.sensor == AnyPlot::Sensor::position && axis < axes_; ++axis) {
          const double R = plot.variance(axis), left = point.covariance[static_cast<std::size_t>(axis) * (n + 1)];
          if (!(left < R)) continue;
          const double S = R * R / (R - left);  // since P R/S is left of P
          sums.predicted_share.add((S - R) / S);
        }
      });
    }
    if (!estimates_ && !sinks_.page) return;
    std::optional<Geodetic> place;
    if (frame) place = tell_from(*target.anchor, LocalFrame(*frame, axes_), row.predicted && !has_home(filter), point);
    if (f == 0) target.tally.goes_to(point.mean, axes_);
    estimates_.write({row.track, filter, point, place});
    if (sinks_.page) sinks_.page->estimated(row, f, point, plot.size);
  }

  /// Tells a point in `frame` from `anchor`: its position about that, and all else along east, north and up at the
  /// point. Of the covariance, the blocks of each derivative are told. Returns where it is.
  Geodetic tell_from(const LocalFrame& anchor, const LocalFrame& frame, bool predicted, TargetPoint& point) const {
    Position position{};
    std::copy_n(point.mean.begin(), axes_, position.begin());
    // What was predicted goes on about the Earth from where the frame begins, rather than straight into space.
    const bool about = predicted && axes_ == 3 && !fixed_;
    const LocalFrame map = about ? LocalFrame(frame.origin(), 2) : frame;
    turn_point(matrix(map.local_axes(position)), point, axes_);
    Geodetic place = map.to_geodetic(position);
    if (about) place.altitude_m = frame.origin().altitude_m + position[2];
    const Position told = anchor.to_local(place);
    std::copy_n(told.begin(), axes_, point.mean.begin());
    return place;
  }

  /// The end of a target whose rows have all been read: the steps as smoothing sees them, and when the modes changed.
  void end(const std::string& name, Target& target) {
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      try {
        if (filters_[f].smooth)
          target.filters[f].smoothed([&](const TargetPoint& point) {
            if (!point.is_start) tell(target, f, smoothed(target, f, point), frame_of(target, f, point));
          });
        if (filters_[f].explain) outcome_.filters[f].histories[name] = target.filters[f].explained();
      } catch (const std::logic_error& error) {
        refuse_failure(f, target.rows.back(), error);
      }
    }
    bool started = target.tally.estimates > 0;  // what only starts tells nothing
    for (std::size_t f = 0; f < filters_.size(); ++f) {
      FilterOutcome& own = outcome_.filters[f];
      const std::size_t rejected = target.filters[f].rejected(), starts = target.filters[f].starts();
      own.rejected += rejected;
      own.restarts += starts > 0 ? starts - 1 : 0;
      target.tally.nis[f].rejected = rejected;
      started &= starts > 0;
      constexpr std::size_t fewest = 5;
      if (rejected < fewest || 5 * rejected <= target.tally.measurements) continue;
      Refusals& worst = outcome_.refusals;
      ++worst.many;
      if (rejected * worst.measurements > worst.rejected * target.tally.measurements)
        worst = {worst.many, name, &filters_[f], rejected, target.tally.measurements};
    }
    if (!started) outcome_.never_started.push_back(name);
    if (recording_.has_tracks()) outcome_.each.emplace(name, std::move(target.tally));
    target.rows.clear();
  }

  [[noreturn]] void refuse_failure(std::size_t f, const Row& row, const std::exception& error) const {
    throw InputError(
        "{}:{}: filter '{}' at time {} s: {}; look for an outlier here, and at the start and the settings of the "
        "filter",
        file(), row.line, filters_[f].name, shortest(row.plot.time), error.what());
  }

  [[noreturn]] void refuse_nothing() const {
    if (outcome_.rows == 0 && !options_.recording.select.empty())
      throw InputError("{}: no row has {}; see how the file writes the value", file(),
                       fmt::join(options_.recording.select, " and "));
    if (outcome_.bearings > 0 && outcome_.bearings == outcome_.measurements)
      throw InputError(
          {.where = file(),
           .what = places_.several()
                       ? "the bearings cross at angles too small, or are too few, to tell where a target starts"
                       : "bearings from one place do not tell where a target starts",
           .remedy = fmt::format(
               "{}, or give start = \"given\" with start_mean, start_covariance_diagonal and start_time_s",
               places_.several()
                   ? "give two rows or more of each station, or models of less freedom (--set \"models=[dwna]\")"
                   : "name each row's station in a column sensor and say where it stands, as "
                     "sensor.NAME.at = [E, N]")});
    throw InputError(
        {.where = file(),
         .what = targets_.size() > 1 ? "no track is long enough for every filter to start"
                                     : "there is too little for every filter to start",
         .found = fmt::format("{} rows, {} of them measurements{}", outcome_.rows, outcome_.measurements,
                              recording_.skipped() == 0
                                  ? ""
                                  : fmt::format(", and {} that were skipped for their time", recording_.skipped())),
         .expected = "more than the three measurements that start a filter (two rows if the start is given)",
         .remedy = recording_.skipped() > outcome_.rows ? "sort the rows by time"
                   : outcome_.partial > 0
                       ? "a track starts from whole positions; drop a column that is always empty, or give a "
                         "start (himm_demo keys)"
                       : "give more rows, or start = \"given\" with start_time_s"});
  }

  const TrackOptions& options_;
  RecordingReader& recording_;
  int axes_ = recording_.axes();
  const std::vector<FilterSettings>& filters_;
  TrackSinks sinks_;
  Estimates estimates_{options_, filters_, recording_, sinks_.files};
  TrackOutcome outcome_;
  std::vector<AnyTarget> prototypes_;  // each filter before its first row
  bool keeps_all_ = false;             // rows, if a filter is to be smoothed; else two
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
  return TrackRun(options, recording, filters, sinks).run();
}

void TrackTally::goes_to(const std::vector<double>& mean, int axes) {
  Position here{};
  std::copy_n(mean.begin(), axes, here.begin());
  if (before) way_m += std::hypot(here[0] - (*before)[0], here[1] - (*before)[1], here[2] - (*before)[2]);
  before = here;
}

std::string TrackTally::why_silent() const {
  constexpr std::size_t start = 3;  // measurements
  return fmt::format("{} measurement{}; a filter starts from {} whole positions, and tells from the next on{}",
                     measurements, measurements == 1 ? "" : "s", start,
                     measurements > start ? ", and these do not lie so near each other" : "");
}

}  // namespace sigmax::apps
