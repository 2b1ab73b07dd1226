#include "himm_demo/associate/associate.hpp"

#include <complex>

namespace sigmax::apps {
namespace {

using Plane = std::complex<double>;  ///< x + iy in m, or its derivative

struct PlannedTurn {
  int first, end;  ///< scans
  double rate;     ///< in rad/s, counter-clockwise
};

/// A target whose state is known at one scan, and drawn before and after. It exists from scan `birth` until before
/// scan `end`.
struct PlannedTarget {
  int known;
  Plane position, velocity;
  std::vector<PlannedTurn> turns{};  ///< after that scan
  int birth = 0, end = 60;
};

struct ScenePlan {
  int scans = 60;
  double step = 2.0, side = 20e3, sigma = 30.0, false_detections = 10.0;
  double q = 0.02;  ///< spectral density of the acceleration, which is white, in m²/s³
  std::vector<PlannedTarget> targets{};
};

ScenePlan plan_of(const std::string& situation, RandomStream& random) {
  const auto normal = [&](double sigma) {
    const double x = random.normal(), y = random.normal();
    return sigma * Plane{x, y};
  };
  constexpr double slow = 3.0 * degree, fast = 6.0 * degree;
  if (situation == "crossing")
    return {.targets = {{30, {10e3, 10e3}, std::polar(150.0, -15.0 * degree)},
                        {30, {10e3, 10e3}, std::polar(150.0, 15.0 * degree)}}};
  if (situation == "parallel")  // each turns by 12° when they are near, and by as much away from the other later
    return {.q = 0.002,
            .targets = {{0, {2000.0, 9014.0}, std::polar(150.0, 4.0 * slow), {{14, 16, -slow}, {46, 48, -slow}}},
                        {0, {2000.0, 10986.0}, std::polar(150.0, -4.0 * slow), {{14, 16, slow}, {46, 48, slow}}}}};
  if (situation == "splitting")
    return {.targets = {{20, {7000.0, 10e3}, 150.0}, {20, {7000.0, 10e3}, 150.0, {{20, 25, slow}}, 20}}};
  if (situation == "manoeuvring")
    return {.targets = {{0, {3000.0, 8000.0}, 150.0, {{25, 32, fast}}},
                        {0, {3000.0, 12e3}, 150.0, {{25, 32, -fast}}},
                        {0, {17e3, 10e3}, -150.0, {{15, 22, fast}, {35, 42, -fast}}}}};
  if (situation == "dense") {
    ScenePlan plan{.side = 8000.0, .false_detections = 60.0};
    for (int i = 0; i < 12; ++i) {
      const Plane spread = normal(10.0), course = std::polar(50.0, 2.0 * std::numbers::pi * random.uniform());
      plan.targets.push_back({30, Plane{4000.0, 4000.0} + normal(1000.0), course + spread, {}, i, 60 - i / 2});
    }
    return plan;
  }
  ScenePlan plan{.scans = 81, .step = 1.0, .side = 300.0, .sigma = 1.0, .q = 0.01};
  for (const int end : {40, 81, 81, 81}) {
    const Plane position = Plane{150.0, 150.0} + normal(std::sqrt(0.1));
    plan.targets.push_back({40, position, normal(std::sqrt(0.1)), {}, 0, end});
  }
  return plan;
}

/// Nearly constant velocity, with turns. Backwards in time it is the same motion with the opposite velocity.
Trajectory path_of(const PlannedTarget& target, const ScenePlan& plan, RandomStream& random) {
  const double T = plan.step, a = std::sqrt(plan.q * T * T * T / 3.0), b = 0.5 * plan.q * T * T / a;
  const double c = std::sqrt(plan.q * T - b * b);
  Plane position = target.position, velocity = -target.velocity;
  Trajectory path{static_cast<std::size_t>(target.birth), {}};
  const auto move = [&](double turned) {
    const Plane half = std::polar(1.0, 0.5 * turned);
    const double ux = random.normal(), uy = random.normal(), wx = random.normal(), wy = random.normal();
    velocity *= half;
    position += T * velocity + a * Plane{ux, uy};
    velocity = velocity * half + b * Plane{ux, uy} + c * Plane{wx, wy};
  };
  const auto keep = [&] { path.positions.push_back({position.real(), position.imag()}); };
  for (int k = target.known; k > target.birth; --k) move(0.0), keep();
  std::ranges::reverse(path.positions);
  position = target.position;
  velocity = target.velocity;
  for (int k = target.known; k < target.end; ++k) {
    keep();
    double turned = 0.0;
    for (const auto& [first, end, rate] : target.turns) turned += k >= first && k < end ? rate * T : 0.0;
    move(turned);
  }
  return path;
}

/// A detection at a position, with errors in their standard deviations.
AnyDetection seen(double time, Plane position, const ScenePlan& plan, int radar, Plane error) {
  const double variance = plan.sigma * plan.sigma;
  position += radar < 0 ? plan.sigma * error : 0.0;
  if (radar < 0)
    return AnyDetection::position(time, std::array{position.real(), position.imag()}, std::array{variance, variance});
  // In the middle of a side, the error across is as great as along.
  const double azimuth_sigma = 2.0 * plan.sigma / plan.side;
  const Plane origin{radar == 1 || radar == 2 ? plan.side : 0.0, radar >= 2 ? plan.side : 0.0};
  const std::array z{std::abs(position - origin) + plan.sigma * error.real(),
                     std::arg(position - origin) + azimuth_sigma * error.imag()};
  return AnyDetection::polar(time, z, std::array{variance, azimuth_sigma * azimuth_sigma},
                             {origin.real(), origin.imag(), 0.0});
}

}  // namespace

Scene simulate(const AssociateOptions& options, std::uint64_t seed) {
  const int radars = options.radars;
  RandomStream truth{seed, 0}, random{seed, 1};
  const ScenePlan plan = plan_of(options.situation, truth);
  Scene scene;
  for (const PlannedTarget& target : plan.targets) scene.truth.push_back(path_of(target, plan, truth));

  for (int k = 0; k < plan.scans; ++k) {
    std::vector<Row> rows, missed;
    const double time = k * plan.step;
    const int radar = radars > 0 ? k % radars : -1;
    const std::string sensor = radars > 0 ? fmt::format("radar{}", radar + 1) : "";
    for (std::size_t i = 0; i < scene.truth.size(); ++i) {
      const auto& [birth, life] = scene.truth[i];
      const std::size_t age = static_cast<std::size_t>(k) - birth;  // beyond all ages before the birth
      if (age >= life.size()) continue;
      const double x = life[age][0], y = life[age][1];
      Row row{.track = std::to_string(i + 1), .sensor = sensor, .detection = AnyDetection::missed(time)};
      row.truth = Position{x, y, 0.0};
      const double chance = random.uniform(), along = random.normal(), across = random.normal();
      const bool detected = chance < options.rules.detection_probability;
      if (detected) row.detection = seen(time, {x, y}, plan, radar, {along, across});
      (detected ? rows : missed).push_back(row);
    }
    for (std::size_t n = random.count(options.clutter.value_or(plan.false_detections)); n > 0; --n) {
      const double x = plan.side * random.uniform(), y = plan.side * random.uniform();
      rows.push_back({.sensor = sensor, .detection = seen(time, {x, y}, plan, radar, {})});
    }
    for (std::size_t i = rows.size(); i > 1; --i) std::swap(rows[i - 1], rows[random.index(i)]);
    rows.insert(rows.end(), missed.begin(), missed.end());
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].detection.tag = i;
    scene.scans.push_back(std::move(rows));
  }
  return scene;
}

}  // namespace sigmax::apps
