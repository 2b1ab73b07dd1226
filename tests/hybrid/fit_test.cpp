#include <sigmax/hybrid/fit.hpp>
#include <sigmax/hybrid/fit_target.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "hybrid/banks.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::near;
using support::throws;

/// A search as plain as can be: along each number by its step, which is halved where nothing is gained.
void compass(const std::function<double(const std::vector<double>&)>& function, const FitSearch& search,
             double least_step = 0.02) {
  std::vector<double> at = search.start, step = search.step;
  double best = function(at);
  for (double greatest = 1.0; greatest > least_step;) {
    bool gained = false;
    for (std::size_t i = 0; i < at.size(); ++i)
      for (const double direction : {1.0, -1.0}) {
        std::vector<double> tried = at;
        tried[i] = std::clamp(tried[i] + direction * step[i], search.lower[i], search.upper[i]);
        const double found = function(tried);
        if (!(found < best)) continue;
        best = found;
        at = tried;
        gained = true;
        break;
      }
    if (gained) continue;
    for (double& each : step) each *= 0.5;
    greatest = *std::max_element(step.begin(), step.end());
  }
}
const auto by_compass = [](const auto& function, const FitSearch& search) { compass(function, search); };

TEST(Fit, FindsTheLeastLossInEveryScale) {
  const std::vector<FitParameter> parameters = {{.name = "any", .start = -2.0, .scale = Scale::linear},
                                                {.name = "positive", .start = 100.0},
                                                {.name = "probability", .start = 0.5, .scale = Scale::logistic}};
  const auto loss = [](const std::vector<double>& x) {
    EXPECT_GT(x[1], 0.0);
    EXPECT_TRUE(x[2] > 0.0 && x[2] < 1.0);
    return std::pow(x[0] - 3.0, 2) + std::pow(std::log(x[1] / 0.7), 2) + std::pow(x[2] - 0.95, 2);
  };
  const Fit found = fit(parameters, loss, by_compass);
  EXPECT_NEAR(found.values[0], 3.0, 0.05);
  EXPECT_NEAR(found.values[1], 0.7, 0.05);
  EXPECT_NEAR(found.values[2], 0.95, 0.01);
  EXPECT_EQ(found.loss, loss(found.values));
}

TEST(Fit, SeveralStartsFindTheDeeperOfTwoValleysAndASeedFindsItAgain) {
  const std::vector<FitParameter> parameters = {{.name = "x", .start = 0.0, .scale = Scale::linear, .step = 1.0}};
  const auto loss = [](const std::vector<double>& x) {
    return std::min(std::pow(x[0] + 0.5, 2), std::pow(4.0 * (x[0] - 1.8), 2) - 1.0);
  };
  EXPECT_NEAR(fit(parameters, loss, by_compass).values[0], -0.5, 0.05);
  const Fit many = fit(parameters, loss, by_compass, {.starts = 12, .seed = 5});
  EXPECT_NEAR(many.values[0], 1.8, 0.05);
  EXPECT_EQ(fit(parameters, loss, by_compass, {.starts = 12, .seed = 5}).values, many.values);

  Fit best;  // the starts one by one, in another order
  for (const std::size_t s : {7U, 3U, 11U, 0U, 1U, 2U, 4U, 5U, 6U, 8U, 9U, 10U}) {
    const Fit one = fit_from(parameters, loss, by_compass, fit_search(parameters, 5, s));
    if (one.loss < best.loss) best = one;
  }
  EXPECT_EQ(best.values, many.values);
  EXPECT_NE(fit_search(parameters, 6, 1).start, fit_search(parameters, 5, 1).start);
}

TEST(Fit, IsNeverWorseThanItsStartAndPassesOverWhatFails) {
  const std::vector<FitParameter> parameters = {{.name = "x", .start = 1.0}};
  const auto loss = [](const std::vector<double>& x) -> double {
    if (x[0] > 1.2) throw std::domain_error("no filter");
    return x[0] < 0.9 ? std::nan("") : 2.0;
  };
  const Fit found = fit(parameters, loss, by_compass, {.starts = 3});
  EXPECT_EQ(found.loss, 2.0);
  EXPECT_TRUE(found.values[0] >= 0.9 && found.values[0] <= 1.2);
  EXPECT_EQ(fit(
                {}, [](const auto&) { return 7.0; }, by_compass)
                .loss,
            7.0);
}

TEST(Fit, RefusesAParameterThatCannotStart) {
  const auto loss = [](const std::vector<double>&) { return 0.0; };
  EXPECT_TRUE(throws<std::invalid_argument>([&] { fit({{.name = "sigma_w", .start = 0.0}}, loss, by_compass); },
                                            {"'sigma_w'", "start at 0"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] { fit({{.name = "p", .start = 1.5, .scale = Scale::logistic}}, loss, by_compass); }, {"'p'", "1.5"}));
}

/// The filter whose score of a position is asked for, after some scans of a manoeuvring target.
template <Uncertainty Kind>
InteractingMultipleModel<VectorBank, Kind> amid_a_turn() {
  InteractingMultipleModel<VectorBank, Kind> filter{
      VectorBank{support::calm(1.0), support::calm(5.0), support::turning()}, support::transition_of<Kind>(),
      support::starts()};
  for (const support::Scan& scan : support::manoeuvring_target(90)) support::step(filter, scan);
  return filter;
}

/// The integral over the position of exp(value(filter after a step with that position)), by rectangles.
template <class Filter, class Value>
double integral(const Filter& before, const Value& value) {
  Filter predicted = before;
  predicted.step(0.2);
  const Vector<2> centre = predicted.estimate().mean.template head<2>();
  const SquareMatrix<2> R = 400.0 * SquareMatrix<2>::Identity();
  constexpr double side = 12.0;
  double sum = 0.0;
  for (int i = -15; i <= 15; ++i)
    for (int j = -15; j <= 15; ++j) {
      Filter filter = before;
      filter.step(0.2, Gaussian<2>{centre + side * Vector<2>(i, j), R});
      sum += side * side * std::exp(value(filter));
    }
  return sum;
}

TEST(LogScore, IsOfADensityOrOfLess) {
  const auto score = [](const auto& filter) { return filter.log_score(); };
  const auto evidence = [](const auto& filter) { return filter.log_evidence(); };
  EXPECT_NEAR(integral(amid_a_turn<Random>(), score), 1.0, 1e-3);
  EXPECT_NEAR(integral(amid_a_turn<Random>(), evidence), 1.0, 1e-3);
  const double fuzzy = integral(amid_a_turn<Fuzzy>(), score);
  EXPECT_LT(fuzzy, 1.0);
  EXPECT_GT(fuzzy, 1.0 / 3.0);
  EXPECT_GT(integral(amid_a_turn<Fuzzy>(), evidence), 1.0);  // the maximum of three possible densities is none
}

TEST(LogEvidence, OfAFuzzyModeNeverBlamesAPossibleChange) {
  const std::vector<support::Scan> scans = support::manoeuvring_target(60);
  for (const support::Scan& scan : scans) {
    if (!scan.z) continue;
    double before = log_zero;
    for (const double leaving : {0.05, 0.2, 0.5, 1.0}) {
      const std::vector<std::vector<double>> rows = {
          {1.0, leaving, leaving}, {leaving, 1.0, leaving}, {leaving, leaving, 1.0}};
      InteractingMultipleModel<VectorBank, Fuzzy> filter{
          VectorBank{support::calm(1.0), support::calm(1.0), support::calm(1.0)}, support::transition_by<Fuzzy>(rows),
          std::vector<support::State>(3, support::starts()[0])};
      filter.step(scan.dt, *scan.z);
      ASSERT_GE(filter.log_evidence(), before);
      before = filter.log_evidence();
    }
  }
}

TargetChoice two_speeds(bool fuzzy) {
  TargetChoice choice{.axes = 2, .fuzzy = fuzzy, .motions = {{"dwna"}, {"dwna"}}, .models = {"calm", "turn"}};
  choice.motions[0][MotionParameter::sigma_w] = 1.0;
  choice.motions[1][MotionParameter::sigma_w] = 12.0;
  choice.transition = fuzzy ? std::vector<std::vector<double>>{{1.0, 0.2}, {0.2, 1.0}}
                            : std::vector<std::vector<double>>{{0.95, 0.05}, {0.10, 0.90}};
  return choice;
}

/// A target that moves as `two_speeds` says, seen every second with these standard deviations, and its modes.
struct Simulated {
  std::vector<AnyPlot> plots;
  std::vector<std::size_t> modes;
};
Simulated simulate(const TargetChoice& choice, double sigma, std::size_t rows, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  Simulated result;
  std::size_t mode = 0;
  std::array<double, 2> x{}, v{100.0, 50.0};
  for (std::size_t k = 0; k < rows; ++k) {
    if (uniform(generator) > choice.transition[mode][mode]) mode = 1 - mode;
    AnyPlot plot{.time = static_cast<double>(k), .tag = k, .sensor = AnyPlot::Sensor::position, .size = 2};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double w = choice.motions[mode][MotionParameter::sigma_w] * normal(generator);
      x[axis] += v[axis] + 0.5 * w;
      v[axis] += w;
      plot.z[axis] = x[axis] + sigma * normal(generator);
    }
    result.plots.push_back(plot);
    result.modes.push_back(mode);
  }
  return result;
}
void believe(std::vector<AnyPlot>& plots, double sigma) {
  for (AnyPlot& plot : plots) plot.covariance = {sigma * sigma, 0.0, 0.0, sigma * sigma};
}

TEST(LogScores, AreThoseOfTheTargetStepByStep) {
  const TargetChoice choice = two_speeds(true);
  Simulated target = simulate(choice, 5.0, 30, 1);
  believe(target.plots, 5.0);
  target.plots[10].sensor = AnyPlot::Sensor::none;
  const auto scores = log_scores(choice, target.plots);
  ASSERT_EQ(scores.size(), 30U);
  AnyTarget same(choice);
  for (const AnyPlot& plot : target.plots) {
    same.take(plot);
    const TargetPoint point = same.output();
    if (plot.tag < 3 || plot.tag == 10) {
      EXPECT_TRUE(std::isnan(scores[plot.tag])) << plot.tag;
      EXPECT_FALSE(point.log_score);
      continue;
    }
    EXPECT_EQ(scores[plot.tag], point.log_score);
    EXPECT_GE(*point.log_evidence, *point.log_score);  // the weights of a fuzzy mode sum to one or more
    double squares = 0.0;
    for (const double number : point.normalized_innovation) squares += number * number;
    EXPECT_PRED_FORMAT3(near, squares, *point.nis, 1e-12);
  }
  target.plots[3].tag = 30;
  EXPECT_TRUE(throws<std::invalid_argument>([&] { log_scores(choice, target.plots); }, {"tag 30", "30"}));
}

TEST(LogScores, OfAMeasurementThatTheGateRejectedAreKnown) {
  TargetChoice choice = two_speeds(false);
  Simulated target = simulate(choice, 5.0, 12, 2);
  believe(target.plots, 5.0);
  target.plots[8].z[0] += 1e4;
  const double open = log_scores(choice, target.plots)[8];
  choice.rules.gate_probability = 0.999;
  EXPECT_EQ(log_scores(choice, target.plots)[8], open);
  EXPECT_LT(open, -100.0);
}

TEST(TransitionCounts, OfARandomModeAddUpTheSmoothedPairs) {
  const TargetChoice choice = two_speeds(false);
  Simulated target = simulate(choice, 5.0, 60, 3);
  believe(target.plots, 5.0);
  TargetChoice recorded = choice;
  recorded.rules.record = true;
  AnyTarget smoothed(recorded);
  for (const AnyPlot& plot : target.plots) smoothed.take(plot);
  std::map<std::size_t, std::vector<double>> weights;
  TransitionCounts counts(2, false);
  std::size_t steps = 0, last = 60;
  smoothed.smoothed([&](const TargetPoint& point) { weights[point.tag] = point.weights; }, {});
  smoothed.smoothed({}, [&](const ModePairs& pairs) {
    ASSERT_EQ(pairs.tag, --last);  // backwards
    ASSERT_EQ(pairs.is_last, pairs.tag == 59);
    for (std::size_t i = 0; i < 2; ++i) {  // the pairs' margins are the smoothed modes before and after
      EXPECT_PRED_FORMAT3(near, std::exp(pairs.log_weights[2 * i]) + std::exp(pairs.log_weights[2 * i + 1]),
                          weights[pairs.tag - 1][i], 1e-9);
      EXPECT_PRED_FORMAT3(near, std::exp(pairs.log_weights[i]) + std::exp(pairs.log_weights[2 + i]),
                          weights[pairs.tag][i], 1e-9);
    }
    counts.add(pairs, pairs.tag != 30);
    ++steps;
  });
  ASSERT_EQ(steps, 57U);  // the start is of the third plot
  double sum = 0.0;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) sum += counts(i, j);
  EXPECT_PRED_FORMAT3(near, sum, 56.0, 1e-9);
  TransitionCounts same(2, false);
  count_transitions(
      choice, target.plots, [](std::size_t tag) { return tag != 30; }, same);
  EXPECT_EQ(same(0, 1), counts(0, 1));
  const auto rows = counts.transition(choice.transition);
  EXPECT_PRED_FORMAT3(near, rows[0][1], counts(0, 1) / (counts(0, 0) + counts(0, 1)), 1e-12);
  EXPECT_PRED_FORMAT3(near, counts.sojourns({1.0, 1.0})[0], (counts(0, 0) + counts(0, 1)) / counts(0, 1), 1e-12);
}

/// Pairs of three steps, told backwards, whose best path is known by going through all of them.
TEST(TransitionCounts, OfAFuzzyModeCountTheBestPath) {
  const std::vector<std::array<double, 4>> steps = {                           // from the last: (i, j) at 2 i + j
                                                    {-1.0, -2.0, 0.0, -0.5},   // best end 0, which came from 1
                                                    {-3.0, 0.0, -1.0, -0.2},   // into 1 from 0
                                                    {-0.1, -4.0, 0.0, -2.0}};  // into 0 from 1
  TransitionCounts counts(2, true);
  for (std::size_t k = 0; k < 3; ++k)
    counts.add({.tag = 3 - k, .dt = 2.0, .is_last = k == 0, .log_weights = steps[k]}, k != 1);
  EXPECT_EQ(counts(1, 0), 2.0);
  EXPECT_EQ(counts(0, 1), 0.0);  // that step only leads the path on
  TransitionCounts twice(2, true);
  twice.add(counts);
  twice.add(counts);
  EXPECT_EQ(twice(1, 0), 4.0);
  const std::vector<std::vector<double>> otherwise = {{1.0, 0.7}, {0.3, 1.0}};
  EXPECT_EQ(twice.transition(otherwise)[0], otherwise[0]);
  EXPECT_EQ(twice.transition(otherwise)[1], (std::vector<double>{1.0, 0.5 / 4.5}));
  EXPECT_EQ(twice.sojourns({9.0, 9.0}), (std::vector<double>{9.0, 8.0 / 4.5}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { counts.add({.log_weights = {}}); }, {"0 weights", "4"}));
}

/// 50 targets of known settings, each fitted alone: search, EM, search. The estimates lie about the truth.
TEST(Fit, FindsTheSettingsThatMadeTheData) {
  constexpr std::size_t targets = 50, rows = 120;
  const TargetChoice truth = two_speeds(false);
  const std::vector<double> known = {1.0, 12.0, 2.0, 0.05, 0.10};
  std::vector<std::vector<double>> logs(known.size());
  for (std::size_t t = 0; t < targets; ++t) {
    auto plots = simulate(truth, known[2], rows, 100 + t).plots;
    TargetChoice choice = truth;
    choice.transition = {{0.9, 0.1}, {0.1, 0.9}};
    std::vector<double> found = {2.0, 8.0, 3.0};
    const auto set = [&](const std::vector<double>& x) {
      choice.motions[0][MotionParameter::sigma_w] = x[0];
      choice.motions[1][MotionParameter::sigma_w] = x[1];
      believe(plots, x[2]);
    };
    const auto loss = [&](const std::vector<double>& x) {
      set(x);
      double sum = 0.0;
      for (const double score : log_scores(choice, plots)) sum -= std::isnan(score) ? 0.0 : score;
      return sum;
    };
    const auto coarse = [](const auto& function, const FitSearch& search) { compass(function, search, 0.15); };
    for (int round = 0; round < 2; ++round) {
      found = fit({{.name = "calm", .start = found[0]},
                   {.name = "turn", .start = found[1]},
                   {.name = "sensor", .start = found[2]}},
                  loss, coarse)
                  .values;
      set(found);
      for (int step = 0; step < 3; ++step) {
        TransitionCounts counts(2, false);
        count_transitions(
            choice, plots, [](std::size_t) { return true; }, counts);
        choice.transition = counts.transition(choice.transition);
      }
    }
    found.push_back(choice.transition[0][1]);
    found.push_back(choice.transition[1][0]);
    for (std::size_t i = 0; i < found.size(); ++i) logs[i].push_back(std::log(found[i]));
  }
  for (std::size_t i = 0; i < known.size(); ++i) {
    std::sort(logs[i].begin(), logs[i].end());
    const double median = 0.5 * (logs[i][24] + logs[i][25]), spread = (logs[i][37] - logs[i][12]) / 1.35;
    // the median of 50 lies within three of its standard errors, 0.53 of their spread
    EXPECT_LT(std::abs(median - std::log(known[i])), 0.53 * spread) << i << ": " << std::exp(median);
    EXPECT_LT(spread, 1.0) << i;
  }
}

}  // namespace
}  // namespace sigmax
