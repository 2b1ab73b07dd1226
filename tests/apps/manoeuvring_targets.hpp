#pragma once

#include "apps/recordings.hpp"

namespace sigmax::apps {

/// A measured position on two or three axes.
struct Point {
  double time;
  std::vector<double> z;
};

inline std::string csv(const std::vector<Point>& points) {
  std::string text = points.front().z.size() == 3 ? "time_s,x_m,y_m,z_m\n" : "time_s,x_m,y_m\n";
  for (const auto& point : points) {
    text += exact(point.time);
    for (const double z : point.z) text += "," + exact(z);
    text += "\n";
  }
  return text;
}

/// As a restatement takes them, with an accuracy of 10 m.
inline std::vector<Detection> detections(const std::vector<Point>& points, std::size_t from = 0) {
  std::vector<Detection> result;
  for (std::size_t k = from; k < points.size(); ++k)
    result.push_back({points[k].time, {{points[k].z, 100.0 * restatement::identity(points[k].z.size())}}});
  return result;
}

/// A target that flies straight, accelerates for 50 scans and flies on, seen to 10 m at irregular times.
inline std::vector<Point> accelerating_target(std::size_t axes = 3) {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> noise(0.0, 10.0);
  std::uniform_real_distribution<double> step(0.1, 0.4);
  std::vector<double> x = {1200.0, 800.0, 300.0};
  std::vector<double> v = {-100.0, -80.0, 0.0};
  std::vector<Point> points;
  double time = 3.0;
  for (int k = 0; k < 220; ++k) {
    const std::vector<double> a = k >= 80 && k < 130 ? std::vector{-30.0, -50.0, 4.0} : std::vector{0.0, 0.0, 0.0};
    const double dt = step(engine);
    time += dt;
    Point point{time, {}};
    for (std::size_t i = 0; i < axes; ++i) {
      x[i] += dt * v[i] + 0.5 * dt * dt * a[i];
      v[i] += dt * a[i];
      point.z.push_back(x[i] + noise(engine));
    }
    points.push_back(point);
  }
  return points;
}

/// A target that flies straight and then on a circle, at 1 Hz, seen to 5 m.
inline std::vector<Point> turning_target() {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> noise(0.0, 5.0);
  double x = 0.0, y = 0.0, heading = 0.3;
  std::vector<Point> points;
  for (int k = 0; k < 100; ++k) {
    points.push_back({static_cast<double>(k), {x + noise(engine), y + noise(engine)}});
    x += 50.0 * std::cos(heading);
    y += 50.0 * std::sin(heading);
    if (k >= 30) heading += 0.06;
  }
  return points;
}

/// A given start, before the times of `accelerating_target`, and other settings.
inline constexpr double start_time = 2.5;
inline const Arguments given = {"start=given",
                                "start_mean=[1200,800,300,-95,-85,1,0.5,-0.25,0]",
                                "start_covariance_diagonal=[400,500,600,100,110,120,25,16,9]",
                                "start_time_s=2.5",
                                "sigma_w=[3,4]",
                                "transition_probability=[[0.95,0.05],[0.1,0.9]]",
                                "transition_possibility=[[1,0.5],[0.25,1]]"};

/// That start of a model with so many components, as a restatement takes it.
inline restatement::State restated_start(std::size_t components) {
  const restatement::Vector variances = {400, 500, 600, 100, 110, 120, 25, 16, 9};
  restatement::State start{{1200, 800, 300, -95, -85, 1, 0.5, -0.25, 0}, restatement::Matrix(9, 9)};
  for (std::size_t i = 0; i < 9; ++i) start.covariance(i, i) = variances[i];
  return restatement::leading(start, components);
}

/// The filter with those settings, of which the options tell the kind.
inline restatement::Filter restated(const restatement::Options& options, std::vector<restatement::State> starts = {},
                                    std::size_t axes = 3, restatement::Matrix transition = {}) {
  if (starts.empty()) starts = {restated_start(6), restated_start(9)};
  const bool fuzzy = options.kind == restatement::Kind::himm;
  if (transition.rows == 0)
    transition = {2, 2, fuzzy ? std::vector{1.0, 0.5, 0.25, 1.0} : std::vector{0.95, 0.05, 0.1, 0.9}};
  return {{restatement::dwna(axes, 3.0), restatement::dwpa(axes, 4.0)}, transition, starts, {1.0, 1.0}, options};
}

/// The options of a filter by default.
inline restatement::Options usual(restatement::Kind kind) {
  restatement::Options options;
  options.kind = kind;
  options.augmentation = restatement::StateAugmentation::borrowed_variance;
  options.mixed_covariance = restatement::MixedCovariance::own_recentred;
  return options;
}

}  // namespace sigmax::apps
