#pragma once

#include "apps/recordings.hpp"
#include "support/restatement.hpp"

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

/// A start of nine components, for `start = "given"`, and a time before that of `accelerating_target`.
inline const std::vector<double> start_mean = {1200, 800, 300, -95, -85, 1, 0.5, -0.25, 0};
inline const std::vector<double> start_variance = {400, 500, 600, 100, 110, 120, 25, 16, 9};
inline constexpr double start_time = 2.5;

/// The given start of a model with that many components, as the restatement takes it.
inline restatement::State restated_start(std::size_t components) {
  restatement::State start{restatement::Vector(components), restatement::Matrix(components, components)};
  for (std::size_t i = 0; i < components; ++i) {
    start.mean[i] = start_mean[i];
    start.covariance(i, i) = start_variance[i];
  }
  return start;
}

/// The rows of estimates.csv that are one filter's.
inline std::vector<TextRow> of_filter(const std::vector<TextRow>& all, const std::string& filter) {
  std::vector<TextRow> own;
  for (const auto& row : all)
    if (row.at("filter") == filter) own.push_back(row);
  return own;
}

}  // namespace sigmax::apps
