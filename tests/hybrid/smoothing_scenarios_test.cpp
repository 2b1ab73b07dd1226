// Smoothing on the paper's scenarios: below the filter's error in every phase, whatever the filter.

#include "hybrid/flights.hpp"

namespace smoothing_scenarios_test {

/// A scenario of section VI.A, group 1: samples are counted from one, the target accelerates from `first` to `last`.
struct Scenario {
  double T;
  int samples, before, first, last;
  Vector<3> position;
  double sigma_r, sigma_a;
};
const Scenario scenario_1{0.2, 200, 10, 81, 130, {12e3, 8e3, 1e3}, 10.0, 0.1 * degree};
const Scenario scenario_2{2.0, 80, 10, 31, 40, {120e3, 80e3, 20e3}, 100.0, 0.9 * degree};

struct Flown {
  std::vector<Vector<3>> truth;
  std::vector<Gaussian<3>> measured;
};

Flown fly(const Scenario& scenario, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  const double T = scenario.T;
  Vector<3> x = scenario.position, v{-100.0, -100.0, 0.0};
  Flown flight;
  for (int k = 1; k <= scenario.samples; ++k) {
    Polar seen = to_polar(x);
    seen.range += scenario.sigma_r * normal(generator);
    seen.azimuth += normal(generator) * radians(scenario.sigma_a);
    seen.elevation += normal(generator) * radians(scenario.sigma_a);
    flight.truth.push_back(x);
    flight.measured.push_back(
        to_cartesian(seen, {scenario.sigma_r, radians(scenario.sigma_a), radians(scenario.sigma_a)}));
    Vector<3> a = Vector<3>::Zero();
    if (k >= scenario.first && k <= scenario.last) a = Vector<3>{-30.0, -50.0, 0.0};
    for (double& component : a) component += 3.0 * normal(generator);
    x += T * v + 0.5 * T * T * a;
    v += T * a;
  }
  return flight;
}

/// Before, during and after the manoeuvre, over eight flights.
void is_better(const Scenario& scenario, const TargetChoice& choice) {
  std::mt19937_64 generator(11);
  std::array<RootMeanSquare, 3> filtered, smoothed;
  for (int run = 0; run < 8; ++run) {
    const auto [truth, z] = fly(scenario, generator);
    const double T = scenario.T;
    Estimates start;
    start.add(two_point_start<3>({T, z[1]}, {2.0 * T, z[2]}));
    start.add(three_point_start<3>({0.0, z[0]}, {T, z[1]}, {2.0 * T, z[2]}));
    std::vector<Row> rows;
    for (std::size_t k = 3; k < z.size(); ++k)
      rows.push_back({T, Gaussian<Eigen::Dynamic, 3>{z[k].mean, z[k].covariance}});
    const Flight flight = flown(choice, start, rows);
    for (std::size_t k = 0; k < flight.smoothed.size(); ++k) {
      const int sample = static_cast<int>(k) + 3;
      if (sample < scenario.before) continue;
      const std::size_t phase = sample < scenario.first ? 0 : sample <= scenario.last ? 1 : 2;
      filtered[phase].add((flight.filtered[k].output.mean.head<3>() - truth[k + 2]).norm());
      smoothed[phase].add((flight.smoothed[k].output.mean.head<3>() - truth[k + 2]).norm());
    }
  }
  for (std::size_t phase = 0; phase < 3; ++phase)
    EXPECT_LT(smoothed[phase].value(), filtered[phase].value()) << "phase " << phase;
}

TEST(SmoothingScenarios, IsBetterThanFilteringInEveryPhaseWhateverTheFilter) {
  for_each(every_reading(), [](TargetChoice choice) {
    const bool paper =
        choice.imm_mixing == MixingWeights::correct && !(choice.fuzzy && choice.scheme == Scheme::common_start);
    if (choice.augmentation != StateAugmentation::borrowed_variance || !paper) return;
    choice = with(choice, {calm(3.0), turning(3.0)},
                  choice.fuzzy ? Rows{{1.0, 0.5}, {0.5, 1.0}} : Rows{{0.95, 0.05}, {0.05, 0.95}});
    choice.axes = 3;
    for (const Scenario& scenario : {scenario_1, scenario_2}) is_better(scenario, choice);
  });
}

}  // namespace smoothing_scenarios_test
