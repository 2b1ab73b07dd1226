// How well tracks show the targets, and the page of `himm_demo associate`.

#include <sigmax/estimation/trajectory_gospa.hpp>

#include "himm_demo/associate/associate.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t most_points = 60'000;
constexpr std::size_t most_curves = 20;

/// The standard deviation of a position that was measured, along one axis on average; 0 where there is none.
double sigma_of_position(const AnyDetection& detection, int axes) {
  if (axes_seen(detection, axes) < axes) return 0.0;
  const bool in_metres = detection.sensor == Sensor::position || detection.sensor == Sensor::components;
  double sum = 0.0;
  for (int i = 0; i < axes; ++i)
    sum += detection.variance(i) * (in_metres || i == 0 ? 1.0 : detection.z[0] * detection.z[0]);
  return std::sqrt(sum / axes);
}

}  // namespace

std::vector<Field> fields_of(const std::string& name, const std::function<Cell(Score::Figure)>& cell) {
  const std::array<ResultColumn, Score::figures> columns = {
      {{.key = "gospa_m", .header = "GOSPA", .unit = "m"},
       {.key = "localisation_m", .header = "localisation", .group = "parts:"},
       {.key = "missed_m", .header = "missed", .group = "parts:"},
       {.key = "false_m", .header = "false", .group = "parts:"},
       {.key = "switches", .header = "switches", .digits = 1},
       {.key = "false_tracks", .header = "false tracks", .digits = 1},
       {.key = "time_to_confirm_s", .header = "time to confirm", .unit = "s", .digits = 1},
       {.key = "untracked", .header = "targets without a track", .digits = 1},
       {.key = "targets", .header = "targets", .digits = 0}}};
  std::vector<Field> fields = {{of_words("of", "tracks by"), name}};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    Field& field = fields.emplace_back(Field{columns[i], cell(static_cast<Score::Figure>(i))});
    field.column.interval = std::holds_alternative<Interval>(field.cell.value());
  }
  return fields;
}

std::optional<Known> between(const std::vector<Known>& path, double time) {
  const auto after = std::ranges::lower_bound(path, time, {}, &Known::time);
  if (after == path.end() || (after == path.begin() && after->time > time)) return std::nullopt;
  const Known& before = after == path.begin() ? *after : *std::prev(after);
  const double length = after->time - before.time, share = length > 0.0 ? (time - before.time) / length : 1.0;
  Known result{time, after->line, {}};
  for (std::size_t i = 0; i < 3; ++i) result.at[i] = (1.0 - share) * before.at[i] + share * after->at[i];
  return result;
}

void Scorer::add(double time, const Scan& scan, const std::vector<TrackedTarget>& shown) {
  for (const Row& row : scan) {
    if (const double sigma = sigma_of_position(row.detection, axes_); sigma > 0.0) sigmas_.push_back(sigma);
    const auto at = row.truth ? row.truth : position_of(row.detection, axes_);
    if (row.track.empty() || !at) continue;
    auto& path = targets_[row.track];
    if (path.empty() || row.detection.time > path.back().time)  // else of a second sensor
      path.push_back({row.detection.time, row.line, *at});
  }
  auto& tracks = scans_.emplace_back().second;
  scans_.back().first = time;
  for (const TrackedTarget& track : shown)
    tracks.emplace(track.number, Point(track.point.mean.begin(), track.point.mean.begin() + axes_));
}

Score Scorer::score(std::optional<double> cutoff) const {
  Score score;
  std::vector<double> sigmas = sigmas_;
  const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
  std::ranges::nth_element(sigmas, middle);
  score.cutoff = cutoff.value_or(sigmas.empty() ? 10.0 : 10.0 * *middle);
  std::map<std::string, double> confirmed;  // when each target had its first track
  std::map<std::size_t, int> balance;       // of each track the scans as a target's, less all others
  std::map<std::string, Trajectory> truth;
  std::map<std::size_t, Trajectory> tracks;
  for (std::size_t k = 0; k < scans_.size(); ++k) {
    const auto& [time, shown] = scans_[k];
    PointSet here, found;
    std::vector<std::string> labels;
    const auto put = [&](auto& trajectories, const auto& name, PointSet& points, const Point& point) {
      Trajectory& own = trajectories.try_emplace(name, Trajectory{k, {}}).first->second;
      own.positions.resize(k - own.start);
      own.positions.push_back(point);
      points.push_back(point);
    };
    for (const auto& [label, path] : targets_)
      if (const auto known = between(path, time)) {
        labels.push_back(label);
        put(truth, label, here, Point(known->at.begin(), known->at.begin() + axes_));
      }
    for (const auto& [number, point] : shown) put(tracks, number, found, point);
    const Gospa result = sigmax::gospa(here, found, {.cutoff = score.cutoff, .order = 2.0});
    score[Score::localisation] += result.localisation;
    score[Score::missed] += result.missed;
    score[Score::false_targets] += result.false_targets;
    for (const auto& [number, point] : shown) --balance[number];
    for (std::size_t i = 0; i < labels.size(); ++i)
      if (const auto& of = result.estimate_of[i]) {
        balance[std::next(shown.begin(), static_cast<std::ptrdiff_t>(*of))->first] += 2;
        confirmed.try_emplace(labels[i], time);
      }
  }
  score[Score::gospa] = score[Score::localisation] + score[Score::missed] + score[Score::false_targets];
  for (std::size_t i = Score::gospa; i <= Score::false_targets; ++i)
    score.values[i] = std::sqrt(score.values[i] / static_cast<double>(std::max<std::size_t>(scans_.size(), 1)));
  score[Score::targets] = static_cast<double>(targets_.size());
  score[Score::untracked] = static_cast<double>(targets_.size() - confirmed.size());
  for (const auto& [label, time] : confirmed) score[Score::time_to_confirm] += time - targets_.at(label).front().time;
  score[Score::time_to_confirm] /= static_cast<double>(confirmed.size());  // NaN without any
  for (const auto& [number, scans] : balance) score[Score::false_tracks] += scans < 0 ? 1.0 : 0.0;
  const auto values = [](const auto& named) { return each(named, [](const auto& one) { return one.second; }); };
  const TrajectoryGospaSettings settings{
      .cutoff = score.cutoff, .switch_penalty = score.cutoff / 2.0, .max_states = 100};
  score[Score::switches] = trajectory_gospa(values(truth), values(tracks), settings).switches;
  return score;
}

void AssociatePage::add(double time, const Scan& scan, const std::vector<DetectionOwner>& owners,
                        const std::vector<TrackedTarget>& shown, int axes) {
  const std::size_t number = scans_++;
  if (number % every_ != 0) return;
  times_.push_back(time);
  for (const TrackedTarget& track : shown) {
    Point& point = tracks_[track.number].emplace_back(Point{number, {}, track.existence});
    std::copy_n(track.point.mean.begin(), axes, point.at.begin());
  }
  for (const DetectionOwner& owner : owners)
    if (const auto at = position_of(scan[owner.tag].detection, axes))
      seen_[owner.track.value_or(0)].push_back({number, *at});
  for (const Row& row : scan)
    if (row.truth && !row.track.empty()) truth_[row.track].push_back({number, *row.truth});
  kept_ += 2 * shown.size() + owners.size();
  if (kept_ <= most_points) return;
  every_ *= 2;
  kept_ /= 2;
  const auto thin = [&](auto& named) {
    for (auto& [name, points] : named)
      std::erase_if(points, [&](const Point& point) { return point.scan % every_ != 0; });
  };
  thin(tracks_), thin(seen_), thin(truth_);
  for (std::size_t k = 0; 2 * k < times_.size(); ++k) times_[k] = times_[2 * k];
  times_.resize((times_.size() + 1) / 2);
}

void AssociatePage::add_to(Report& page, bool geodetic) const {
  page.groups.push_back({measurement_name, true});
  if (!truth_.empty()) page.groups.push_back({truth_name, true});
  MapChart plan{.title = "Tracks", .x_label = geodetic ? "east, m" : "x, m", .y_label = geodetic ? "north, m" : "y, m"};
  const auto put = [](PlanTrace& trace, const Points& points) {
    for (const Point& point : points) {
      trace.x.push_back(point.at[0]);
      trace.y.push_back(point.at[1]);
    }
  };
  PlanTrace unexplained{"unexplained detections", measurement_name, PlanTrace::Shape::crosses};
  PlanTrace explained{"detections of tracks", measurement_name, PlanTrace::Shape::dots};
  PlanTrace truth{truth_name, truth_name};
  for (const auto& [track, points] : seen_) put(tracks_.contains(track) ? explained : unexplained, points);
  for (const auto& [label, points] : truth_) put(truth, points), put(truth, {{0, {nan, nan, nan}}});
  plan.traces = {std::move(unexplained), std::move(explained), std::move(truth)};
  for (const auto& [number, points] : tracks_)
    put(plan.traces.emplace_back(PlanTrace{.name = fmt::format("track {}", number)}), points);
  std::erase_if(plan.traces, [](const PlanTrace& trace) { return trace.x.empty(); });
  page.panels.emplace_back(std::move(plan));

  LineChart existence{.title = "Existence", .x_label = "time, s", .y_label = "existence", .x = times_};
  existence.greatest_y = 1.0;
  existence.coloured = true;
  auto longest = each(tracks_, [](const auto& one) { return &one; });
  std::ranges::stable_sort(longest, std::greater<>(), [](const auto* one) { return one->second.size(); });
  if (longest.size() > most_curves) {
    existence.note = fmt::format("The {} longest of {} tracks.", most_curves, longest.size());
    longest.resize(most_curves);
  }
  for (const auto* one : longest) {
    Curve curve{.name = fmt::format("track {}", one->first), .values = std::vector<double>(times_.size(), nan)};
    for (const Point& point : one->second) curve.values[point.scan / every_] = point.existence;
    existence.curves.push_back(std::move(curve));
  }
  if (!existence.curves.empty()) page.panels.emplace_back(std::move(existence));
}

}  // namespace sigmax::apps
