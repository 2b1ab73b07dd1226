#include "himm_demo/tracker.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace sigmax::apps {
namespace {

TargetChoice choice_of(const FilterSettings& settings, int axes) {
  TargetChoice choice = settings;
  choice.axes = axes;
  choice.rules = {.gate_probability = settings.gate_probability,
                  .rejections = static_cast<std::size_t>(settings.restart_after_rejections),
                  .longest_gap = settings.restart_after_s.value_or(std::numeric_limits<double>::infinity()),
                  .record = settings.smooth || (settings.explain && settings.scheme == Scheme::histories)};
  return choice;
}

template <int Axes>
AnyPlot plot_of(double time, const std::optional<Reading<Axes>>& reading, std::size_t tag) {
  AnyPlot plot{.time = time, .tag = tag};
  if (!reading) return plot;
  Vector<6> z = Vector<6>::Zero();
  SquareMatrix<6> R = SquareMatrix<6>::Zero();
  const auto lead = [&](const Gaussian<Axes>& measured, int size) {
    z.head(size) = measured.mean.head(size);
    R.topLeftCorner(size, size) = measured.covariance.topLeftCorner(size, size);
    plot.size = size;
  };
  const auto add = [&](const typename Reading<Axes>::Scalar& quantity) {
    z(plot.size) = quantity.value;
    R(plot.size, plot.size) = quantity.variance;
    ++plot.size;
  };
  if (reading->bearing) {
    plot.sensor = AnyPlot::Sensor::bearing;
    add(*reading->bearing);
    std::copy_n(reading->bearing_from.begin(), 2, plot.origin.begin());
  } else if (reading->seen) {
    plot.sensor = reading->range_rate ? AnyPlot::Sensor::doppler : AnyPlot::Sensor::polar;
    lead(reading->seen->z, Axes);
    if (reading->range_rate) add(*reading->range_rate);
    std::copy_n(reading->seen->radar.origin().begin(), Axes, plot.origin.begin());
  } else {
    lead(reading->position, reading->measured);
    std::iota(plot.places.begin(), plot.places.end(), 0);
    for (std::size_t axis = 0; axis < reading->velocity.size(); ++axis)
      if (const auto& along = reading->velocity[axis]) {
        plot.places[static_cast<std::size_t>(plot.size)] = Axes + static_cast<int>(axis);
        add(*along);
      }
    const bool position = plot.size == Axes && reading->measured == Axes;
    plot.sensor = position ? AnyPlot::Sensor::position : AnyPlot::Sensor::components;
  }
  std::copy_n(z.begin(), plot.size, plot.z.begin());
  Eigen::Map<Eigen::MatrixXd>(plot.covariance.data(), plot.size, plot.size) = R.topLeftCorner(plot.size, plot.size);
  return plot;
}

/// A rate of turn is no derivative of the position.
template <int Axes>
TrackPoint<Axes> point_of(const TargetPoint& known, const std::vector<std::string>& names) {
  TrackPoint<Axes> point;
  point.time = known.time;
  point.tag = known.tag;
  point.is_start = known.is_start;
  const auto all = static_cast<Eigen::Index>(names.size());
  const auto omega = std::find(names.begin(), names.end(), "omega");
  const Eigen::Index n = omega == names.end() ? all : all - 1;  // those of the largest model lead
  point.estimate.mean = Eigen::Map<const Eigen::VectorXd>(known.mean.data(), n);
  point.estimate.covariance = Eigen::Map<const Eigen::MatrixXd>(known.covariance.data(), all, all).topLeftCorner(n, n);
  if (omega != names.end()) point.turn_rate = known.mean[static_cast<std::size_t>(omega - names.begin())];
  point.weights = known.weights;
  point.most_likely_mode = known.most_likely_mode;
  point.nis = known.nis;
  return point;
}

}  // namespace

template <int Axes>
Tracker<Axes>::Tracker(FilterSettings settings) : settings_(std::move(settings)), target_(choice_of(settings_, Axes)) {}

template <int Axes>
void Tracker<Axes>::take(double time, const std::optional<Reading<Axes>>& reading, std::size_t tag,
                         const std::function<void(std::size_t tag)>& stepped) {
  target_.take(plot_of(time, reading, tag), [&](std::size_t of, bool is_start) {
    if (!is_start) stepped(of);
  });
}

template <int Axes>
bool Tracker<Axes>::transform(const SquareMatrix<Axes>& A, const Vector<Axes>& b) {
  const SquareMatrix<Axes> by_rows = A.transpose();
  return target_.transform({by_rows.data(), static_cast<std::size_t>(by_rows.size())},
                           {b.data(), static_cast<std::size_t>(b.size())});
}

template <int Axes>
auto Tracker<Axes>::now() const -> Point {
  return point_of<Axes>(target_.output(), target_.components());
}

template <int Axes>
auto Tracker<Axes>::finish() const -> std::vector<Point> {
  std::vector<Point> points;
  if (!settings_.smooth) return points;
  target_.smoothed([&](const TargetPoint& known) { points.push_back(point_of<Axes>(known, target_.components())); });
  return points;
}

template class Tracker<2>;
template class Tracker<3>;

}  // namespace sigmax::apps
