// How well tracks show the targets, and the page of `himm_demo associate`.

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

/// Those that exist at a scan: their places among all, and where they are.
std::pair<std::vector<std::size_t>, PointSet> present(const std::vector<Trajectory>& paths, std::size_t scan) {
  std::pair<std::vector<std::size_t>, PointSet> found;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto& [start, positions] = paths[i];
    if (scan < start || scan - start >= positions.size() || positions[scan - start].empty()) continue;
    found.first.push_back(i);
    found.second.push_back(positions[scan - start]);
  }
  return found;
}

}  // namespace

std::optional<Known> between(const std::vector<Known>& path, double time) {
  const auto after = std::ranges::lower_bound(path, time, {}, &Known::time);
  if (after == path.end() || (after == path.begin() && after->time > time)) return std::nullopt;
  const Known& before = after == path.begin() ? *after : *std::prev(after);
  const double share = before.time < time ? (time - before.time) / (after->time - before.time) : 1.0;
  Known result = *after;
  for (std::size_t i = 0; i < 3; ++i) result.at[i] = (1.0 - share) * before.at[i] + share * after->at[i];
  return result;
}

void AssociateHistory::add(const MultiTargetTracker& tracker, const Scan& scan,
                           const std::vector<TrackedTarget>& tracks) {
  for (const Row& row : scan) {
    if (const double sigma = sigma_of_position(row.detection, axes_); sigma > 0.0) sigmas_.push_back(sigma);
    const auto at = row.truth ? row.truth : position_of(row.detection, axes_);
    if (row.track.empty() || !at) continue;
    truth_known_ |= row.truth.has_value();
    auto& path = targets_[row.track];
    if (path.empty() || row.detection.time > path.back().time)  // else of a second sensor
      path.push_back({row.detection.time, row.line, *at});
  }
  for (const DetectionOwner& owner : tracker.owners())
    detections_[owner.track.value_or(0)].push_back(
        position_of(scan[owner.tag].detection, axes_).value_or(Position{nan, nan, nan}));
  for (const TrackedTarget& track : tracks) {
    if (!track.confirmed) continue;
    auto& [path, existence] = tracks_.try_emplace(track.number, Track{{times_.size(), {}}, {}}).first->second;
    path.positions.resize(times_.size() - path.start);
    path.positions.emplace_back(track.point.mean.begin(), track.point.mean.begin() + axes_);
    existence.resize(path.positions.size() - 1, nan);
    existence.push_back(track.existence);
  }
  times_.push_back(tracker.time());
}

double AssociateHistory::usual_cutoff() const {
  std::vector<double> sigmas = sigmas_;
  const auto middle = sigmas.begin() + std::ssize(sigmas) / 2;
  std::ranges::nth_element(sigmas, middle);
  return sigmas.empty() ? 10.0 : 10.0 * *middle;
}

std::vector<Field> AssociateHistory::score(double cutoff) const {
  const auto tracks = each(tracks_, [](const auto& one) { return one.second.path; });
  const auto truth = each(targets_, [&](const auto& one) {
    Trajectory path;
    for (const double time : times_)
      if (const auto known = between(one.second, time); !known)
        path.positions.emplace_back();
      else
        path.positions.emplace_back(known->at.begin(), known->at.begin() + axes_);
    return path;
  });
  Gospa sum;
  std::vector<double> confirmed(truth.size(), nan);  // when each target had its first track
  std::vector<int> balance(tracks.size());           // of each track the scans as a target's, less all others
  for (std::size_t k = 0; k < times_.size(); ++k) {
    const auto [targets, here] = present(truth, k);
    const auto [shown, found] = present(tracks, k);
    const Gospa result = sigmax::gospa(here, found, {.cutoff = cutoff, .order = 2.0});
    sum.localisation += result.localisation;
    sum.missed += result.missed;
    sum.false_targets += result.false_targets;
    for (const std::size_t track : shown) --balance[track];
    for (std::size_t i = 0; i < targets.size(); ++i) {
      if (!result.estimate_of[i]) continue;
      balance[shown[*result.estimate_of[i]]] += 2;
      if (double& first = confirmed[targets[i]]; std::isnan(first)) first = times_[k];
    }
  }
  const auto rms = [&](double squares) {
    return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(times_.size(), 1)));
  };
  RunningMean delay;  // from a target's first detection on
  for (auto time = confirmed.begin(); const auto& [label, path] : targets_)
    if (const double since = *time++ - path.front().time; !std::isnan(since)) delay.add(since);
  const TrajectoryGospaSettings settings{.cutoff = cutoff, .switch_penalty = cutoff / 2.0, .max_states = 100};
  return {{{.key = "gospa_m", .header = "GOSPA", .unit = "m"}, rms(sum.localisation + sum.missed + sum.false_targets)},
          {{.key = "localisation_m", .header = "localisation", .group = "parts:"}, rms(sum.localisation)},
          {{.key = "missed_m", .header = "missed", .group = "parts:"}, rms(sum.missed)},
          {{.key = "false_m", .header = "false", .group = "parts:"}, rms(sum.false_targets)},
          {{.key = "switches", .header = "switches", .digits = 1}, trajectory_gospa(truth, tracks, settings).switches},
          {{.key = "false_tracks", .header = "false tracks", .digits = 1},  // no target's in most of their scans
           static_cast<double>(std::ranges::count_if(balance, [](int scans) { return scans < 0; }))},
          {{.key = "time_to_confirm_s", .header = "time to confirm", .unit = "s", .digits = 1},
           delay.count() > 0 ? delay.mean() : nan},
          {{.key = "untracked", .header = "targets without a track", .digits = 1},
           static_cast<double>(targets_.size() - delay.count())},
          {{.key = "targets", .header = "targets", .digits = 0}, static_cast<double>(targets_.size())}};
}

std::size_t AssociateHistory::detections(bool explained) const {
  std::size_t count = 0;
  for (const auto& [number, own] : detections_) count += !explained || tracks_.contains(number) ? own.size() : 0;
  return count;
}

void AssociateHistory::add_to(Report& page, bool geodetic) const {
  page.groups.push_back({measurement_name, true});
  if (truth_known_) page.groups.push_back({truth_name, true});
  std::size_t points = detections();
  for (const auto& [number, track] : tracks_) points += 2 * track.existence.size();
  const std::size_t every = 1 + points / most_points;
  MapChart plan{.title = "Tracks", .x_label = geodetic ? "east, m" : "x, m", .y_label = geodetic ? "north, m" : "y, m"};
  const auto put = [&](PlanTrace& trace, const auto& all, const auto& at) {
    for (std::size_t k = 0; k < all.size(); k += every) {
      const auto& point = at(all[k]);
      if (point.empty() || std::isnan(point[0])) continue;
      trace.x.push_back(point[0]);
      trace.y.push_back(point[1]);
    }
  };
  PlanTrace unexplained{"unexplained detections", measurement_name, PlanTrace::Shape::crosses};
  PlanTrace explained{"detections of tracks", measurement_name, PlanTrace::Shape::dots};
  PlanTrace truth{truth_name, truth_name};
  for (const auto& [track, own] : detections_)
    put(tracks_.contains(track) ? explained : unexplained, own, std::identity());
  for (const auto& [label, path] : targets_) {
    if (!truth_known_) break;
    put(truth, path, [](const Known& known) { return known.at; });
    truth.x.push_back(nan);
    truth.y.push_back(nan);
  }
  plan.traces = {std::move(unexplained), std::move(explained), std::move(truth)};
  for (const auto& [number, track] : tracks_)
    put(plan.traces.emplace_back(PlanTrace{.name = fmt::format("track {}", number)}), track.path.positions,
        std::identity());
  std::erase_if(plan.traces, [](const PlanTrace& trace) { return trace.x.empty(); });
  page.panels.emplace_back(std::move(plan));

  LineChart existence{.title = "Existence", .x_label = "time, s", .y_label = "existence"};
  existence.greatest_y = 1.0;
  existence.coloured = true;
  for (std::size_t k = 0; k < times_.size(); k += every) existence.x.push_back(times_[k]);
  auto longest = each(tracks_, [](const auto& one) { return &one; });
  std::ranges::stable_sort(longest, std::greater<>(), [](const auto* one) { return one->second.existence.size(); });
  if (longest.size() > most_curves) {
    existence.note = fmt::format("The {} longest of {} tracks.", most_curves, longest.size());
    longest.resize(most_curves);
  }
  for (const auto* one : longest) {
    const auto& [path, own] = one->second;
    existence.curves.push_back({.name = fmt::format("track {}", one->first)});
    for (std::size_t k = 0; k < times_.size(); k += every)
      existence.curves.back().values.push_back(k - path.start < own.size() ? own[k - path.start] : nan);
  }
  if (!existence.curves.empty()) page.panels.emplace_back(std::move(existence));
}

}  // namespace sigmax::apps
