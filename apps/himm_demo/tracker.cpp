#include "himm_demo/tracker.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace sigmax::apps {
namespace {

TargetChoice choice_of(const FilterSettings& settings, int axes) {
  TargetChoice choice = settings;
  choice.axes = axes;
  choice.rules = {.gate_probability = settings.gate_probability,
                  .rejections = static_cast<std::size_t>(settings.restart_after_rejections),
                  .longest_gap = settings.restart_after_s.value_or(std::numeric_limits<double>::infinity()),
                  .record = settings.smooth};
  return choice;
}

template <int Axes>
AnyPlot plot_of(double time, const std::optional<Reading<Axes>>& reading, std::size_t tag) {
  AnyPlot plot{.time = time, .tag = tag};
  if (!reading) return plot;
  if (reading->measured < Axes) {
    plot.sensor = AnyPlot::Sensor::components;
    plot.size = reading->measured;
    for (int i = 0; i < plot.size; ++i) {
      plot.places[static_cast<std::size_t>(i)] = i;
      plot.z[static_cast<std::size_t>(i)] = reading->position.mean(i);
      for (int j = 0; j < plot.size; ++j)
        plot.covariance[static_cast<std::size_t>(i * plot.size + j)] = reading->position.covariance(i, j);
    }
    return plot;
  }
  plot.sensor = reading->seen ? AnyPlot::Sensor::polar : AnyPlot::Sensor::position;
  plot.size = Axes;
  const auto& z = reading->z();
  std::copy(z.mean.begin(), z.mean.end(), plot.z.begin());
  std::copy(z.covariance.data(), z.covariance.data() + z.covariance.size(), plot.covariance.begin());
  if (reading->seen) std::copy_n(reading->seen->radar.origin().begin(), Axes, plot.origin.begin());
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
  target_.smoothed([&](const TargetPoint& known) { points.push_back(point_of<Axes>(known, target_.components())); });
  return points;
}

template class Tracker<2>;
template class Tracker<3>;

}  // namespace sigmax::apps
