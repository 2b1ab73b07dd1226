#include "recognition_demo/manoeuvre_scenario.hpp"

#include <utility>

#include <sigmax/core/compose.hpp>
#include <sigmax/core/transform.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/start.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>

namespace sigmax::apps {
namespace {

using Model = IndependentAxes<1, DiscreteWhiteNoise<2>>;
using Point = TimedMeasurement<1>;

Relation<Random, Random> transition(const ManoeuvreScenario& scenario) {
  const std::size_t n = scenario.mode.size();
  std::vector<std::vector<double>> rows(
      n, std::vector<double>(n, (1.0 - ManoeuvreScenario::stay) / static_cast<double>(n - 1)));
  for (std::size_t i = 0; i < n; ++i) rows[i][i] = ManoeuvreScenario::stay;
  return {scenario.mode, scenario.mode, rows};
}

/// The logarithms of the mode's weights after every sample.
template <Uncertainty Kind>
std::vector<std::vector<double>> mode_weights(const ManoeuvreScenario& scenario, const Relation<Kind, Kind>& transition,
                                              const std::vector<Point>& points) {
  std::vector<Model> models;
  for (const double input : scenario.inputs) models.push_back(dwna<1>(ManoeuvreScenario::sigma_w, Vector<1>(input)));
  const Gaussian<2> start = two_point_start(points[0], points[1]);
  const std::vector<Gaussian<2>> starts(models.size(), start);
  InteractingMultipleModel<std::vector<Model>, Kind> filter(std::move(models), transition, starts);
  std::vector<std::vector<double>> weights(2);
  for (std::size_t k = 2; k < points.size(); ++k) {
    filter.step(ManoeuvreScenario::step_s, points[k].measurement);
    weights.emplace_back(filter.belief().logs().begin(), filter.belief().logs().end());
  }
  return weights;
}

/// Manoeuvres instead of modes: their weights are the ⊕ of those of their modes.
template <Uncertainty Kind>
std::vector<GradedReport> reports(const ManoeuvreScenario& scenario, const std::vector<std::vector<double>>& weights) {
  const auto mode = interpreted_as<Kind>(scenario.mode);
  const auto manoeuvre = interpreted_as<Kind>(scenario.manoeuvre);
  std::vector<std::vector<double>> rows(mode.size(), std::vector<double>(manoeuvre.size(), 0.0));
  for (std::size_t j = 0; j < rows.size(); ++j) rows[j][scenario.manoeuvre_of_mode[j]] = 1.0;
  const Relation<Kind, Kind> manoeuvre_given_mode{manoeuvre, mode, rows};
  Belief<Kind> of_mode{uninformative(mode)};
  std::vector<GradedReport> result;
  for (std::size_t k = ManoeuvreScenario::first_classified - 1; k < weights.size(); ++k) {
    of_mode.assign([&](std::size_t j) { return weights[k][j]; });
    const auto belief = compose(manoeuvre_given_mode, of_mode);
    result.emplace_back(belief.logs().begin(), belief.logs().end());
  }
  return result;
}

}  // namespace

Relation<Fuzzy, Fuzzy> ManoeuvreScenario::target_given_manoeuvre_pi() const {
  return {as_fuzzy(target), as_fuzzy(manoeuvre), {{1.0, 1.0, 1.0}, {0.0, 1.0, 1.0}, {0.0, 0.0, 1.0}}};
}

ManoeuvreRun fly(const ManoeuvreScenario& scenario, double acceleration, RandomStream& random) {
  using Scenario = ManoeuvreScenario;
  constexpr double T = Scenario::step_s;
  ManoeuvreRun run;
  std::vector<Point> points;
  double x = Scenario::start_m, v = Scenario::speed;
  for (std::size_t k = 1; k <= Scenario::samples; ++k) {
    if (k > 1) {
      const double a = k >= Scenario::first_accelerated && k <= Scenario::last_accelerated ? acceleration : 0.0;
      x += T * v + 0.5 * T * T * a;
      v += T * a;
    }
    run.positions.push_back(x + Scenario::sigma_position * random.normal());
    points.push_back(
        {T * static_cast<double>(k - 1),
         {Vector<1>(run.positions.back()), SquareMatrix<1>(Scenario::sigma_position * Scenario::sigma_position)}});
  }
  const auto random_transition = transition(scenario);
  run.imm = mode_weights(scenario, random_transition, points);
  run.himm = mode_weights(scenario, with_fuzzy_condition(to_possibility(random_transition, RatioScale{})), points);
  return run;
}

std::vector<GradedReport> reports_by_sum(const ManoeuvreScenario& scenario, const ManoeuvreRun& run) {
  return reports<Random>(scenario, run.imm);
}

std::vector<GradedReport> reports_by_max(const ManoeuvreScenario& scenario, const ManoeuvreRun& run) {
  return reports<Fuzzy>(scenario, run.himm);
}

}  // namespace sigmax::apps
