#include "himm_demo/tracker.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include <sigmax/estimation/chi_square.hpp>

#include "support/output.hpp"

namespace sigmax::apps {
namespace {

/// A start in the type of a bank's models. That of a rate of turn, which no start tells, has no correlation with the
/// rest.
template <class Start, class Estimate>
Start widened(const Estimate& estimate, bool turns, double sigma_turn) {
  const Eigen::Index n = estimate.size();
  const Eigen::Index all = turns ? n + 1 : n;
  Start start;
  start.mean.setZero(all);
  start.mean.head(n) = estimate.mean;
  start.covariance.setZero(all, all);
  start.covariance.topLeftCorner(n, n) = estimate.covariance;
  if (turns) start.covariance(n, n) = sigma_turn * sigma_turn;
  return start;
}

/// An output of a filter, whose rate of turn is no derivative of the position.
template <int Axes, class Filter>
TrackPoint<Axes> point(const Filter& filter, const typename Filter::Output& output) {
  TrackPoint<Axes> point;
  const auto& names = filter.components();  // those of the largest model lead
  const auto omega = std::find(names.begin(), names.end(), "omega");
  const auto n = static_cast<Eigen::Index>(names.size()) - (omega == names.end() ? 0 : 1);
  point.estimate = {output.estimate.mean.head(n), output.estimate.covariance.topLeftCorner(n, n)};
  if (omega != names.end()) point.turn_rate = output.estimate.mean(omega - names.begin());
  point.weights = output.weights;
  point.most_likely_mode = output.most_likely_mode;
  return point;
}

}  // namespace

template <int Axes>
Tracker<Axes>::Tracker(FilterSettings settings)
    : settings_(std::move(settings)),
      radar_(std::make_unique<typename RowSensor<Axes>::Radar>()),
      gate_(settings_.gate_probability < 1.0 ? chi_square_quantile(settings_.gate_probability, Axes) : no_gate) {}

template <int Axes>
void Tracker<Axes>::take(double time, const std::optional<Reading<Axes>>& reading,
                         const std::function<void(double time)>& stepped) {
  if (running() && settings_.restart_after_s && time - last_measured_ > *settings_.restart_after_s) end();
  if (running()) {
    step(time, reading);
    stepped(time);
  } else if (given()) {
    waiting_.push_back({time, reading});
    if (!settings_.start_time_s && waiting_.size() < 2) return;
    start(settings_.start_time_s ? *settings_.start_time_s : 2.0 * waiting_[0].first - waiting_[1].first);
    for (const auto& [waited, waiting] : waiting_) {
      step(waited, waiting);
      stepped(waited);
    }
    waiting_.clear();
  } else if (reading) {
    points_.push_back({time, reading->position});
    if (points_.size() < 3) return;
    start(time);
    points_.clear();
  }
}

template <int Axes>
auto Tracker<Axes>::now() const -> Point {
  Point now = std::visit([](const auto& filter) { return point<Axes>(filter, filter.output()); }, *filter_);
  now.time = time_;
  now.nis = nis();
  return now;
}

template <int Axes>
auto Tracker<Axes>::finish() -> std::vector<Point> {
  if (running()) end();
  return std::exchange(smoothed_, {});
}

template <int Axes>
void Tracker<Axes>::end() {
  if (settings_.smooth) {
    try {
      std::visit(
          [&](const auto& filter) {
            auto known = recorded_.begin();
            for (const auto& output : filter.smoothed()) {
              auto& smoothed = smoothed_.emplace_back(point<Axes>(filter, output));
              smoothed.time = known->time;
              smoothed.nis = known->nis;
              smoothed.is_start = known->is_start;
              ++known;
            }
          },
          *filter_);
    } catch (const std::domain_error& error) {
      throw std::domain_error(
          fmt::format("smoothing back to the start at {} s: {}", shortest(recorded_.front().time), error.what()));
    }
    recorded_.clear();
  }
  filter_.reset();
}

template <int Axes>
std::optional<double> Tracker<Axes>::nis() const {
  return std::visit([](const auto& filter) { return filter.nis(); }, *filter_);
}

template <int Axes>
void Tracker<Axes>::step(double time, const std::optional<Reading<Axes>>& reading) {
  *radar_ = reading && reading->seen ? std::optional(reading->seen->radar) : std::nullopt;
  const std::optional<Gaussian<Axes>> z = reading ? std::optional(reading->z()) : std::nullopt;
  const double dt = time - time_;
  const bool measured = std::visit([&](auto& filter) { return filter.step(dt, z, gate_); }, *filter_);
  time_ = time;
  if (measured) last_measured_ = time;
  if (z && !measured) ++rejected_;
  record(dt, false);
}

template <int Axes>
void Tracker<Axes>::record(double dt, bool is_start) {
  if (!settings_.smooth) return;
  std::visit([&](auto& filter) { filter.record(dt); }, *filter_);
  recorded_.push_back({time_, nis(), is_start});
}

template <int Axes>
void Tracker<Axes>::start(double time) {
  time_ = last_measured_ = time;
  const auto start_bank = [&](const auto& bank) {
    using Models = std::decay_t<decltype(bank)>;
    using Starts = typename ModeFilter<Models>::Starts;
    const double sigma_turn = settings_.start_sigma_turn_deg_s * std::numbers::pi / 180.0;
    Starts starts;
    for (const auto& motion : settings_.motions)
      starts.push_back(
          widened<typename Starts::value_type>(start_of(motion), motion.type == MotionType::ct, sigma_turn));
    filter_.emplace(ModeFilter<Models>(settings_, bank, starts));
  };
  const bool polar = settings_.radar_measurement == RadarForm::polar;
  if (kinematic(settings_.motions) && !polar)
    start_bank(kinematic_bank<Axes>(settings_.motions));
  else
    start_bank(any_bank<Axes>(settings_.motions, polar ? settings_.member : MemberType::kf, settings_.member, *radar_));
  ++starts_;
  record(0.0, true);
}

template <int Axes>
auto Tracker<Axes>::start_of(const Motion& motion) const -> Estimate {
  return given() ? given_start(motion) : start_from_points(motion);
}

template <int Axes>
auto Tracker<Axes>::start_from_points(const Motion& motion) const -> Estimate {
  const Eigen::Index n = motion.order() * Axes;
  const bool released = settings_.start == Start::released;
  if (motion.order() == 3 || released) {
    const auto wide = released ? released_start<Axes>(points_[0], points_[1], points_[2])
                               : three_point_start<Axes>(points_[0], points_[1], points_[2]);
    return {wide.mean.head(n), wide.covariance.topLeftCorner(n, n)};
  }
  const auto narrow = two_point_start<Axes>(points_[1], points_[2]);
  return {narrow.mean.head(n), narrow.covariance.topLeftCorner(n, n)};
}

template <int Axes>
auto Tracker<Axes>::given_start(const Motion& motion) const -> Estimate {
  const Eigen::Index n = motion.order() * Axes;
  Estimate start;
  start.mean.resize(n);
  start.covariance.setZero(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {  // the keys always speak of three axes
    const auto key = static_cast<std::size_t>(k / Axes * 3 + k % Axes);
    start.mean(k) = settings_.start_mean[key];
    start.covariance(k, k) = settings_.start_covariance_diagonal[key];
  }
  return start;
}

template class Tracker<2>;
template class Tracker<3>;

}  // namespace sigmax::apps
