#include "himm_demo/associate/associate.hpp"

#include <complex>

namespace sigmax::apps {
namespace {

using Plane = std::complex<double>;  ///< x + iy in m, or its derivative

struct PlannedTurn {
  int first, end;  ///< scans
  double rate;     ///< in rad/s, counter-clockwise
};

/// A target that exists from scan `birth` until before scan `end`.
struct PlannedTarget {
  int birth, end, known;  ///< its state is known at one scan, and drawn before and after
  Plane position, velocity;
  std::vector<PlannedTurn> turns{};  ///< after that scan
};

struct ScenePlan {
  int scans = 60;
  double step = 2.0, side = 20e3, sigma = 30.0, false_detections = 10.0;
  double q = 0.02;  ///< spectral density of the acceleration, which is white, in m²/s³
  std::vector<PlannedTarget> targets{};
};

ScenePlan plan_of(Situation situation, RandomStream& random) {
  ScenePlan plan;
  const auto normal = [&](double sigma) {
    const double x = random.normal(), y = random.normal();
    return sigma * Plane{x, y};
  };
  switch (situation) {
    case Situation::crossing:
      for (const double angle : {-15.0 * degree, 15.0 * degree})
        plan.targets.push_back({0, 60, 30, {10e3, 10e3}, std::polar(150.0, angle)});
      break;
    case Situation::parallel:  // each target turns by 12° when they are near, and by as much away from the other later
      plan.q = 0.002;
      for (const double rate : {-3.0 * degree, 3.0 * degree})
        plan.targets.push_back({0,
                                60,
                                0,
                                {2000.0, rate < 0.0 ? 9014.0 : 10986.0},
                                std::polar(150.0, -4.0 * rate),
                                {{14, 16, rate}, {46, 48, rate}}});
      break;
    case Situation::splitting:
      plan.targets = {{0, 60, 20, {7000.0, 10e3}, 150.0},
                      {20, 60, 20, {7000.0, 10e3}, 150.0, {{20, 25, 3.0 * degree}}}};
      break;
    case Situation::manoeuvring:
      plan.targets = {{0, 60, 0, {3000.0, 8000.0}, 150.0, {{25, 32, 6.0 * degree}}},
                      {0, 60, 0, {3000.0, 12e3}, 150.0, {{25, 32, -6.0 * degree}}},
                      {0, 60, 0, {17e3, 10e3}, -150.0, {{15, 22, 6.0 * degree}, {35, 42, -6.0 * degree}}}};
      break;
    case Situation::dense:
      plan = {.side = 8000.0, .false_detections = 60.0};
      for (int i = 0; i < 12; ++i) {
        const Plane velocity = std::polar(50.0, 2.0 * std::numbers::pi * random.uniform()) + normal(10.0);
        plan.targets.push_back({i, 60 - i / 2, 30, Plane{4000.0, 4000.0} + normal(1000.0), velocity});
      }
      break;
    case Situation::meeting:
      plan = {.scans = 81, .step = 1.0, .side = 300.0, .sigma = 1.0, .q = 0.01};
      for (const int end : {40, 81, 81, 81}) {
        const Plane position = Plane{150.0, 150.0} + normal(std::sqrt(0.1));
        plan.targets.push_back({0, end, 40, position, normal(std::sqrt(0.1))});
      }
      break;
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

Scene simulate(Situation situation, std::uint64_t seed, const Visibility& visibility) {
  const auto [probability, false_detections, radars] = visibility;
  RandomStream truth{seed, 0}, random{seed, 1};
  const ScenePlan plan = plan_of(situation, truth);
  Scene scene{false_detections.value_or(plan.false_detections)};
  if (!(probability >= 0.0 && probability <= 1.0 && scene.false_detections >= 0.0 && scene.false_detections <= 500.0) ||
      radars < 0 || radars > 4)
    throw std::invalid_argument(
        fmt::format("found P_D {}, {} false detections a scan and {} radars; expected 0 to 1, 0 to 500 and 0 to 4",
                    probability, scene.false_detections, radars));
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
      if (chance < probability) row.detection = seen(time, {x, y}, plan, radar, {along, across});
      (chance < probability ? rows : missed).push_back(row);
    }
    for (std::size_t n = random.count(scene.false_detections); n > 0; --n) {
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
