// Smoothing on the paper's scenarios: below the filter's error in every phase, whatever the filter.
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <random>
#include <vector>

#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/metrics.hpp>
#include <sigmax/estimation/radar.hpp>
#include <sigmax/estimation/start.hpp>
#include <sigmax/hybrid/fixed_interval_smoother.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>
#include <sigmax/hybrid/second_order_multiple_model.hpp>

namespace sigmax {
namespace {

using Moves = AnyMotion<9, IndependentAxes<3, DiscreteWhiteNoise<2>>, IndependentAxes<3, DiscreteWhiteNoise<3>>>;
using Bank3 = std::vector<Extended<Moves>>;
using Estimate = Gaussian<Eigen::Dynamic, 9>;

/// A scenario of section VI.A, group 1: samples are counted from one, the target accelerates from `first` to `last`.
struct Scenario {
  double T;
  int samples, before, first, last;
  Vector<3> position;
  double sigma_r, sigma_a;
};
const double degree = std::numbers::pi / 180.0;
const Scenario scenario_1{0.2, 200, 10, 81, 130, {12e3, 8e3, 1e3}, 10.0, 0.1 * degree};
const Scenario scenario_2{2.0, 80, 10, 31, 40, {120e3, 80e3, 20e3}, 100.0, 0.9 * degree};

struct Flight {
  std::vector<Vector<3>> truth;
  std::vector<Gaussian<3>> measured;
};

Flight fly(const Scenario& scenario, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  const double T = scenario.T;
  Vector<3> x = scenario.position, v{-100.0, -100.0, 0.0};
  Flight flight;
  for (int k = 1; k <= scenario.samples; ++k) {
    Polar seen = to_polar(x);
    seen.range += scenario.sigma_r * normal(generator);
    seen.azimuth += scenario.sigma_a * normal(generator);
    seen.elevation += scenario.sigma_a * normal(generator);
    flight.truth.push_back(x);
    flight.measured.push_back(to_cartesian(seen, {scenario.sigma_r, scenario.sigma_a, scenario.sigma_a}));
    Vector<3> a = Vector<3>::Zero();
    if (k >= scenario.first && k <= scenario.last) a = Vector<3>{-30.0, -50.0, 0.0};
    for (double& component : a) component += 3.0 * normal(generator);
    x += T * v + 0.5 * T * T * a;
    v += T * a;
  }
  return flight;
}

/// Before, during and after the manoeuvre, over `runs` flights.
template <class Filter, class Kind>
void smoothing_is_better(const Scenario& scenario, const Relation<Kind, Kind>& transition,
                         const Interaction<Kind>& interaction = {}, int runs = 8) {
  const Bank3 models{Extended<Moves>{dwna<3>(3.0)}, Extended<Moves>{dwpa<3>(3.0)}};
  std::mt19937_64 generator(11);
  std::array<RootMeanSquare, 3> filtered, smoothed;
  for (int run = 0; run < runs; ++run) {
    const Flight flight = fly(scenario, generator);
    const auto& z = flight.measured;
    const double T = scenario.T;
    const auto narrow = two_point_start<3>({T, z[1]}, {2.0 * T, z[2]});
    const auto wide = three_point_start<3>({0.0, z[0]}, {T, z[1]}, {2.0 * T, z[2]});
    Filter filter{models, transition,
                  std::vector<Estimate>{{narrow.mean, narrow.covariance}, {wide.mean, wide.covariance}}, interaction};
    std::vector record{filter.recorded(0.0)};
    std::vector<Vector<3>> estimates{filter.estimate().mean.template head<3>()};
    for (std::size_t k = 3; k < z.size(); ++k) {
      filter.step(T, z[k]);
      record.push_back(filter.recorded(T, z[k]));
      estimates.push_back(filter.estimate().mean.template head<3>());
    }
    const auto states = smooth(filter, record);
    for (std::size_t k = 0; k < states.size(); ++k) {
      const int sample = static_cast<int>(k) + 3;
      if (sample < scenario.before) continue;
      const std::size_t phase = sample < scenario.first ? 0 : sample <= scenario.last ? 1 : 2;
      const Vector<3>& truth = flight.truth[k + 2];
      filtered[phase].add((estimates[k] - truth).norm());
      smoothed[phase].add((filter.estimate(states[k]).mean.template head<3>() - truth).norm());
    }
  }
  for (std::size_t phase = 0; phase < 3; ++phase)
    EXPECT_LT(smoothed[phase].value(), filtered[phase].value()) << "phase " << phase;
}

const RandomVariable random_mode{"mode", {"dwna", "dwpa"}};
const FuzzyVariable fuzzy_mode{"mode", {"dwna", "dwpa"}};
const Relation probable{random_mode, random_mode, {{0.95, 0.05}, {0.05, 0.95}}};
const Relation possible{fuzzy_mode, fuzzy_mode, {{1.0, 0.5}, {0.5, 1.0}}};

TEST(SmoothingScenarios, OfAnImmIsBetterThanFilteringInEveryPhase) {
  for (const Scenario& scenario : {scenario_1, scenario_2})
    smoothing_is_better<InteractingMultipleModel<Bank3, Random>>(scenario, probable);
}

TEST(SmoothingScenarios, OfAHimmIsBetterThanFilteringInEveryPhaseUnderEachReading) {
  for (const Scenario& scenario : {scenario_1, scenario_2})
    for (const auto reading :
         {MixedCovariance::selected, MixedCovariance::own, MixedCovariance::own_recentred, MixedCovariance::released})
      smoothing_is_better<InteractingMultipleModel<Bank3, Fuzzy>>(scenario, possible,
                                                                  {Lift::borrowed_variance, {reading}});
}

TEST(SmoothingScenarios, OfGpb1IsBetterThanFilteringInEveryPhase) {
  for (const Scenario& scenario : {scenario_1, scenario_2})
    smoothing_is_better<InteractingMultipleModel<Bank3, Random>>(
        scenario, probable, {Lift::borrowed_variance, {}, Tie::stay, MixedStart::common});
}

TEST(SmoothingScenarios, OfGpb2IsBetterThanFilteringInEveryPhase) {
  for (const Scenario& scenario : {scenario_1, scenario_2})
    smoothing_is_better<SecondOrderMultipleModel<Bank3, Random>>(scenario, probable);
}

TEST(SmoothingScenarios, OfAViterbiFilterIsBetterThanFilteringInEveryPhase) {
  for (const Scenario& scenario : {scenario_1, scenario_2})
    smoothing_is_better<SecondOrderMultipleModel<Bank3, Fuzzy>>(scenario, possible);
}

}  // namespace
}  // namespace sigmax
