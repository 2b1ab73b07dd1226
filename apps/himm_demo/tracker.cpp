#include "himm_demo/tracker.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "support/error.hpp"

namespace sigmax::apps {

TargetChoice choice_of(const FilterSettings& settings, int axes) {
  for (const auto& motion : settings.motions)
    if (axes < motion.known().least_axes)
      throw UsageError(message({.what = "filter '" + settings.name + "': the recording has one axis, and " +
                                        motion.name + " turns in a plane",
                                .remedy = "choose motions that do not turn"}));
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
  const auto lead = [&](const auto& measured) {
    plot.size = static_cast<int>(measured.mean.size());
    z.head(plot.size) = measured.mean;
    R.topLeftCorner(plot.size, plot.size) = measured.covariance;
  };
  const auto add = [&](const typename Reading<Axes>::Scalar& quantity) {
    z(plot.size) = quantity.value;
    R(plot.size, plot.size) = quantity.variance;
    ++plot.size;
  };
  const auto add_component = [&](int place, const typename Reading<Axes>::Scalar& quantity) {
    plot.places[static_cast<std::size_t>(plot.size)] = place;
    add(quantity);
  };
  if (reading->bearing) {
    plot.sensor = AnyPlot::Sensor::bearing;
    add(*reading->bearing);
    std::copy_n(reading->bearing_from.begin(), 2, plot.origin.begin());
  } else if (reading->seen) {
    plot.sensor = reading->range_rate ? AnyPlot::Sensor::doppler : AnyPlot::Sensor::polar;
    lead(reading->seen->z);
    if (reading->range_rate) add(*reading->range_rate);
    const auto& origin = reading->seen->radar.origin();
    std::copy(origin.begin(), origin.end(), plot.origin.begin());
  } else {
    const auto missing = std::count(reading->missing.begin(), reading->missing.end(), true);
    const auto moving = std::count_if(reading->velocity.begin(), reading->velocity.end(),
                                      [](const auto& along) { return along.has_value(); });
    if (missing == 0 && moving == 0) {
      plot.sensor = AnyPlot::Sensor::position;
      lead(reading->position);
    } else {
      plot.sensor = AnyPlot::Sensor::components;
      const auto& [mean, covariance] = reading->position;
      for (int i = 0; i < Axes; ++i)
        if (!reading->missing[static_cast<std::size_t>(i)]) add_component(i, {mean(i), covariance(i, i)});
      for (int i = 0; i < Axes; ++i)
        if (const auto& along = reading->velocity[static_cast<std::size_t>(i)]) add_component(Axes + i, *along);
    }
  }
  std::copy_n(z.begin(), plot.size, plot.z.begin());
  Eigen::Map<Eigen::MatrixXd>(plot.covariance.data(), plot.size, plot.size) = R.topLeftCorner(plot.size, plot.size);
  return plot;
}

template AnyPlot plot_of<1>(double, const std::optional<Reading<1>>&, std::size_t);
template AnyPlot plot_of<2>(double, const std::optional<Reading<2>>&, std::size_t);
template AnyPlot plot_of<3>(double, const std::optional<Reading<3>>&, std::size_t);

namespace {

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

template class Tracker<1>;
template class Tracker<2>;
template class Tracker<3>;

}  // namespace sigmax::apps
