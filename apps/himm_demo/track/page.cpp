#include "himm_demo/track/page.hpp"
#include "himm_demo/track/track.hpp"

#include <sigmax/estimation/chi_square.hpp>

namespace sigmax::apps {
namespace {

constexpr std::size_t most_tracks = 200;

/// Speed, course and climb, each with its standard deviation; NaN where they are not known.
using Moves = std::array<double, 6>;

/// How fast in plan, which way and how fast up a velocity is, with its covariance: to first order in its errors. A
/// course, clockwise from north or y, that may as well be any, ± 2 σ of more than a right angle, is not known. Along
/// one axis there is the velocity alone.
Moves moves_of(const std::array<double, 3>& velocity, const std::array<Position, 3>& covariance, int axes) {
  Moves moves{nan, nan, nan, nan, nan, nan};
  if (axes == 1) return {velocity[0], std::sqrt(covariance[0][0]), nan, nan, nan, nan};
  const double speed = std::hypot(velocity[0], velocity[1]);
  const double c = speed > 0.0 ? velocity[0] / speed : 1.0, s = speed > 0.0 ? velocity[1] / speed : 0.0;
  const double both = 2.0 * c * s * covariance[0][1];
  moves[0] = speed;
  moves[1] = std::sqrt(std::max(0.0, c * c * covariance[0][0] + both + s * s * covariance[1][1]));
  const double across = std::sqrt(std::max(0.0, s * s * covariance[0][0] - both + c * c * covariance[1][1]));
  if (speed > 0.0 && across / speed < 45.0 * degree) {
    moves[2] = std::remainder(std::atan2(c, s) / degree - 180.0, 360.0) + 180.0;
    moves[3] = across / speed / degree;
  }
  if (axes == 3) {
    moves[4] = velocity[2];
    moves[5] = std::sqrt(covariance[2][2]);
  }
  return moves;
}

}  // namespace

/// Null for tracks that are not shown.
TrackPage::Track* TrackPage::track_of(const Row& row) {
  if (const auto found = tracks_.find(row.track); found != tracks_.end()) return &found->second;
  if (tracks_.size() == most_tracks) return nullptr;
  const double time = row.detection.time;
  const bool has_date = recording_.times_are_numbers() ? time >= 1e9 && time < 4e9 : !recording_.times_of_day();
  if (tracks_.empty() && has_date) clock_ = time;
  std::vector<std::size_t> watched = {row_error_at, row_error_at + 1, row_error_at + 2};
  for (std::size_t f = 0; f < filters_.size(); ++f)
    for (std::size_t i = 0; i < weights_at + models_.size(); ++i)
      if (i < sigma_at || i == moves_at || i == moves_at + 4 || i == outlier_at || i >= weights_at)
        watched.push_back(column(f, i));
  const std::size_t least = 4 * watched.size();
  Thinned rows(column(filters_.size(), 0), std::max(most_rows(), least), std::move(watched));
  Track track{
      .first_time = clock_.value_or(time), .rows = std::move(rows), .recent = std::vector<Recent>(filters_.size())};
  return &tracks_.emplace(row.track, std::move(track)).first->second;
}

/// Where a filter's columns are.
std::size_t TrackPage::column(std::size_t filter, std::size_t i) const {
  return row_columns + filter * (weights_at + models_.size()) + i;
}

/// So many rows as make a page of some MB: a curve and its band take about 20 bytes a row.
std::size_t TrackPage::most_rows() const {
  const auto axes = static_cast<std::size_t>(recording_.axes());
  return 4'800'000 / (100 + filters_.size() * (70 * axes + 60));
}

/// The numbers of a row that filters may still tell of.
std::vector<double>& TrackPage::numbers(Track& track, double time, std::size_t line) {
  return track.open.try_emplace({time, line}, column(filters_.size(), 0), nan).first->second;
}

/// Takes rows down of which nothing more is told. When there are too many in all, the longest track has half as many.
void TrackPage::close(Track& track, std::size_t left_open) {
  for (; track.open.size() > left_open; track.open.erase(track.open.begin())) {
    kept_ -= track.rows.kept();
    track.rows.add(track.open.begin()->first.first, track.open.begin()->second);
    kept_ += track.rows.kept();
  }
  if (kept_ <= most_rows()) return;
  Thinned& longest =
      std::ranges::max_element(tracks_, {}, [](const Named& one) { return one.second.rows.kept(); })->second.rows;
  kept_ -= longest.kept();
  longest.limit(longest.kept() / 2);
  kept_ += longest.kept();
}

void TrackPage::finish(const TrackOutcome& outcome) {
  for (auto& [name, track] : tracks_) {
    close(track, 0);
    for (const FilterOutcome& filter : outcome.filters) {
      const auto own = filter.histories.find(name);
      track.histories.push_back(own == filter.histories.end() ? std::vector<ModeStay>{} : own->second);
    }
  }
}

void TrackPage::measured(const Row& row, const std::optional<Position>& position,
                         const std::optional<Geodetic>& anchor) {
  Track* const track = track_of(row);
  if (!track) {
    ++not_shown_;
    return;
  }
  if (anchor) track->anchor = anchor;
  track->last_position = position;
  const bool is_seen_from = row.detection.sensor != Sensor::position && row.detection.sensor != Sensor::components;
  if (is_seen_from && row.measured() && !row.sensor_at && !row.sensor_place)  // that does not move
    stations_[row.detection.origin].insert(row.sensor.empty() ? "radar" : row.sensor);
  std::vector<double>& numbers = this->numbers(*track, row.detection.time, row.line);
  const int axes = recording_.axes();
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = static_cast<int>(i);
    const bool is_seen = position && (axis >= axes || component_of(row.detection, axis) ||
                                      (is_seen_from && axis < axes_seen(row.detection, axes)));
    if (is_seen) numbers[row_at + i] = (*position)[i];
    if (row.truth) numbers[truth_at + i] = (*row.truth)[i];
    if (is_seen && row.truth) numbers[row_error_at + i] = (*position)[i] - (*row.truth)[i];
  }
  if (row.truth) {  // from its last place to this one
    Position velocity{};
    const bool moves = track->last_truth && row.detection.time > track->last_truth->first;
    for (std::size_t i = 0; moves && i < 3; ++i)
      velocity[i] = ((*row.truth)[i] - track->last_truth->second[i]) / (row.detection.time - track->last_truth->first);
    if (moves && track->anchor) {
      const auto turn = LocalFrame(*track->anchor, recording_.axes()).local_axes(*row.truth);
      const Position there = velocity;
      for (std::size_t i = 0; i < 3; ++i)
        velocity[i] = turn[i][0] * there[0] + turn[i][1] * there[1] + turn[i][2] * there[2];
    }
    const Moves all = moves_of(velocity, {}, recording_.axes());
    constexpr double least_speed = 1.0;  // at rest a recorder's noise goes all ways
    for (std::size_t i = 0; moves && i < 3; ++i)
      if (i != 1 || all[0] >= least_speed) numbers[truth_moves_at + i] = all[2 * i];
    if (moves || !track->last_truth) track->last_truth = {row.detection.time, *row.truth};
  }
  constexpr std::size_t awaited = 2;  // a start may wait for the row after it
  if (!smooths_) close(*track, awaited);
}

void TrackPage::estimated(const Row& row, std::size_t filter, const TargetPoint& point, int measured) {
  Track* const track = track_of(row);
  if (!track) return;
  double* const numbers = &this->numbers(*track, point.time, row.line)[column(filter, 0)];
  if (filter == 0) ++track->estimates;
  const auto axes = static_cast<std::size_t>(recording_.axes());
  const std::size_t n = point.mean.size();
  for (std::size_t axis = 0; axis < axes; ++axis) {
    numbers[position_at + axis] = point.mean[axis];
    if (row.truth) numbers[error_at + axis] = point.mean[axis] - (*row.truth)[axis];
    numbers[sigma_at + axis] = std::sqrt(point.covariance[axis * (n + 1)]);
  }
  if (n >= 2 * axes) {
    Position velocity{};
    std::array<Position, 3> covariance{};
    for (std::size_t i = 0; i < axes; ++i) {
      velocity[i] = point.mean[axes + i];
      for (std::size_t j = 0; j < axes; ++j) covariance[i][j] = point.covariance[(axes + i) * n + axes + j];
    }
    std::ranges::copy(moves_of(velocity, covariance, recording_.axes()), numbers + moves_at);
  }
  if (point.nis) judge(row, point, measured, track->recent[filter], numbers);
  const auto& own = filters_[filter].models;
  for (std::size_t j = 0; j < own.size(); ++j)
    numbers[weights_at + static_cast<std::size_t>(std::ranges::find(models_, own[j]) - models_.begin())] =
        point.weights[j];
}

/// The mean NIS of the last rows, and what of this one stands by itself.
void TrackPage::judge(const Row& row, const TargetPoint& point, int measured, Recent& recent, double* numbers) {
  constexpr double one_in_a_thousand = 0.999;
  recent.emplace_back(*point.nis, measured);
  if (recent.size() > recent_rows) recent.pop_front();
  double nis = 0.0, number = 0.0;
  for (const auto& [one, its_number] : recent) {
    nis += one;
    number += its_number;
  }
  numbers[nis_at] = nis / number;
  numbers[quantities_at] = number;
  if (*point.nis > chi_square_quantile(one_in_a_thousand, measured)) numbers[outlier_at] = *point.nis / measured;
  const auto sensor = std::ranges::find(sensors_, row.sensor);
  numbers[sensor_at] = static_cast<double>(sensor - sensors_.begin());
  if (sensor == sensors_.end()) sensors_.push_back(row.sensor);
  std::copy_n(point.normalized_innovation.begin(), std::min(innovations, point.normalized_innovation.size()),
              numbers + innovation_at);
}

/// A rejection is marked where the measurement was, and not where there was none.
void TrackPage::mark(const Row& row, std::size_t filter, bool rejection) {
  Track* const track = track_of(row);
  if (!track || (rejection && !track->last_position)) return;
  auto& marks = rejection ? track->rejections : track->restarts;
  if (marks.size() < most_marks)
    marks.push_back({row.detection.time, filter, track->last_position.value_or(Position{nan, nan, nan})});
}

}  // namespace sigmax::apps
