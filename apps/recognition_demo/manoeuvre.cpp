#include <sigmax/core/transform.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/start.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include "recognition_demo/subcommands.hpp"
#include "recognition_demo/world.hpp"

namespace sigmax::apps {
namespace {

/// The authors' example of kinematic recognition on one axis. The target flies at −150 m/s from 10 km and accelerates
/// during the steps that lead to samples 15 … 20, by its class's acceleration. SI units.
struct Scenario {
  static constexpr double step_s = 2.0;
  static constexpr std::size_t samples = 30;
  static constexpr std::size_t first_accelerated = 15, last_accelerated = 20;
  static constexpr double start_m = 10000.0, speed = -150.0;
  static constexpr double sigma_position = 50.0;
  static constexpr std::size_t first_classified = 10;  ///< the sample from which mode weights are reports

  /// The filter: constant velocity, and known inputs of ±3 g and ±5 g, all with this process noise.
  static constexpr double sigma_w = 5.0;
  static constexpr double gravity = 9.80665;
  static constexpr double stay = 0.9;  ///< p(mode|same mode); the possibilities are in proportion

  RandomVariable mode{"mode", {"cv", "+3g", "-3g", "+5g", "-5g"}};
  std::array<double, 5> inputs{0.0, 3.0 * gravity, -3.0 * gravity, 5.0 * gravity, -5.0 * gravity};
  RandomVariable manoeuvre{"manoeuvre", {"weak", "medium", "strong"}};
  std::array<std::size_t, 5> manoeuvre_of_mode{0, 1, 1, 2, 2};
  RandomVariable target{"target", {"airliner", "bomber", "fighter"}};
  std::array<double, 3> acceleration{-5.0, -25.0, -45.0};  ///< by target
};

using Model = IndependentAxes<1, DiscreteWhiteNoise<2>>;
using Point = TimedMeasurement<1>;

/// The logarithms of the mode's weights after every sample; none before the filter starts, from samples 1 and 2.
template <Uncertainty Kind>
std::vector<std::vector<double>> mode_weights(const Scenario& scenario, const Relation<Kind, Kind>& transition,
                                              const std::vector<Point>& points) {
  std::vector<Model> models;
  for (const double input : scenario.inputs) models.push_back(dwna<1>(Scenario::sigma_w, Vector<1>(input)));
  const std::vector<Gaussian<2>> starts(models.size(), two_point_start(points[0], points[1]));
  InteractingMultipleModel<std::vector<Model>, Kind> filter(std::move(models), transition, starts);
  std::vector<std::vector<double>> weights(2);
  for (std::size_t k = 2; k < points.size(); ++k) {
    filter.step(Scenario::step_s, points[k].measurement);
    weights.emplace_back(filter.belief().logs().begin(), filter.belief().logs().end());
  }
  return weights;
}

/// Manoeuvres instead of modes, from sample `first_classified` on: their weights are the ⊕ of those of their modes.
template <Uncertainty Kind>
std::vector<AnyReport> reports_of(const Scenario& scenario, const std::vector<std::vector<double>>& weights) {
  const auto mode = interpreted_as<Kind>(scenario.mode);
  const auto manoeuvre = interpreted_as<Kind>(scenario.manoeuvre);
  std::vector<std::vector<double>> rows(mode.size(), std::vector<double>(manoeuvre.size(), 0.0));
  for (std::size_t j = 0; j < rows.size(); ++j) rows[j][scenario.manoeuvre_of_mode[j]] = 1.0;
  const Relation<Kind, Kind> manoeuvre_given_mode{manoeuvre, mode, rows};
  Belief<Kind> of_mode{uninformative(mode)};
  std::vector<AnyReport> result;
  for (std::size_t k = Scenario::first_classified - 1; k < weights.size(); ++k) {
    of_mode.assign([&](std::size_t j) { return weights[k][j]; });
    const auto belief = compose(manoeuvre_given_mode, of_mode);
    result.emplace_back(GradedReading(belief.logs().begin(), belief.logs().end()));
  }
  return result;
}

/// A flight of one of the targets, and what each contestant is told of it. Its numbers are of each sample, one after
/// the other, the measured position and the weights of the filters' modes; NaN where there is no weight.
Drawn fly(const Scenario& scenario, std::size_t target, RandomStream& random) {
  constexpr double T = Scenario::step_s;
  std::vector<Point> points;
  double x = Scenario::start_m, v = Scenario::speed;
  for (std::size_t k = 1; k <= Scenario::samples; ++k) {
    if (k > 1) {
      const double a =
          k >= Scenario::first_accelerated && k <= Scenario::last_accelerated ? scenario.acceleration[target] : 0.0;
      x += T * v + 0.5 * T * T * a;
      v += T * a;
    }
    const double measured = x + Scenario::sigma_position * random.normal();
    points.push_back({T * static_cast<double>(k - 1),
                      {Vector<1>(measured), SquareMatrix<1>(Scenario::sigma_position * Scenario::sigma_position)}});
  }
  const auto transition = mostly_right(scenario.mode, scenario.mode, Scenario::stay, 1.0 - Scenario::stay);
  const auto imm = mode_weights(scenario, transition, points);
  const auto himm = mode_weights(scenario, with_fuzzy_condition(to_possibility(transition, RatioScale{})), points);
  const auto by_sum = reports_of<Random>(scenario, imm), by_max = reports_of<Fuzzy>(scenario, himm);
  Drawn run{target, {by_sum, by_max, by_sum, by_max}};
  for (std::size_t k = 0; k < points.size(); ++k) {
    run.numbers.push_back(points[k].measurement.mean(0));
    for (const auto* weights : {&imm[k], &himm[k]})
      for (std::size_t j = 0; j < scenario.mode.size(); ++j)
        run.numbers.push_back(weights->empty() ? std::nan("") : std::exp((*weights)[j]));
  }
  return run;
}

/// Two classifiers of each filter's mode weights: those of the HIMM by maxima, those of the IMM by sums.
std::vector<Contestant> contestants(const Scenario& scenario) {
  const RandomVariable &target = scenario.target, &manoeuvre = scenario.manoeuvre;
  // p(target|manoeuvre) and π(target|manoeuvre), as the authors give them.
  const Relation<Random, Random> probable{
      target, manoeuvre, {{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, {0.0, 0.5, 0.5}, {0.0, 0.0, 1.0}}};
  const Relation<Fuzzy, Fuzzy> possible{
      as_fuzzy(target), as_fuzzy(manoeuvre), {{1.0, 1.0, 1.0}, {0.0, 1.0, 1.0}, {0.0, 0.0, 1.0}}};
  const SigmaClassifier sigma{uninformative(target), invert(probable, uninformative(manoeuvre)).relation};
  const MaxClassifier max{uninformative(as_fuzzy(target)),
                          invert(possible, uninformative(as_fuzzy(manoeuvre))).relation};
  return {{"sigma, of the IMM", sigma},
          {"max, of the HIMM", max},
          {"sigma-max, of the IMM", max},
          {"max-sigma, of the HIMM", sigma}};
}

ResultTable targets_table(const Scenario& scenario, const std::vector<Scores>& all) {
  ResultTable table;
  for (std::size_t i = 0; i < all.front().size(); ++i) {
    std::vector<Field> row = {{of_words("", "after the last sample"), all.front()[i].name}};
    for (std::size_t c = 0; c < all.size(); ++c) {
      const std::string name = fmt::format("{} ({} m/s²)", scenario.target.label(c), scenario.acceleration[c]);
      row.push_back({{.header = name, .digits = 1, .scale = 100.0, .group = "right, %:"}, all[c][i].accuracy.back()});
    }
    double ties = 0.0;
    for (std::size_t c = 0; c < all.size(); ++c) {
      row.push_back(
          {{.header = scenario.target.label(c), .digits = 3, .group = "p or π of"}, all[c][i].belief_in_truth});
      ties += all[c][i].ties / static_cast<double>(all.size());
    }
    row.push_back({{.header = "runs that end in a tie", .unit = "%", .digits = 1, .scale = 100.0}, ties});
    table.row_of(row);
  }
  return table;
}

ResultTable differences_table(const Scenario& scenario, const std::vector<Scores>& all) {
  const auto& names = all.front();
  ResultTable table;
  for (std::size_t i = 1; i < names.size(); ++i) {
    std::vector<Field> row = {{of_words("", fmt::format("− that of {}, points", names.front().name)), names[i].name}};
    for (std::size_t c = 0; c < all.size(); ++c)
      row.push_back(
          {{.header = scenario.target.label(c), .scale = 100.0, .sign = true}, all[c][i].minus_first.interval()});
    table.row_of(row);
  }
  return table;
}

LineChart with_acceleration(LineChart chart) {
  chart.shaded = {{double{Scenario::first_accelerated}, double{Scenario::last_accelerated}, "acceleration"}};
  return chart;
}

/// A flight: what each filter thinks of the modes, and what that says of the target.
View view_of(const Scenario& scenario, const Condition& condition, const SeenRun& run) {
  View view{fmt::format("run 1, {}", scenario.target.label(run.truth)), {}};
  const std::size_t modes = scenario.mode.size(), numbers = 1 + 2 * modes;  // of a sample
  const auto add_modes = [&](std::string title, std::string y_label, std::size_t first) {
    LineChart chart{.title = std::move(title),
                    .x_label = "sample",
                    .y_label = std::move(y_label),
                    .x = counted_from(1, Scenario::samples),
                    .greatest_y = 1.05};
    for (std::size_t j = 0; j < modes; ++j) {
      const auto weight = [&](std::size_t k) { return run.numbers[k * numbers + first + j]; };
      chart.curves.push_back({.name = scenario.mode.label(j), .values = each_below(Scenario::samples, weight)});
    }
    view.panels.emplace_back(with_acceleration(std::move(chart)));
  };
  add_modes("Modes of the IMM", "probability", 1);
  add_modes("Modes of the HIMM", "possibility", 1 + modes);
  const auto reports = condition.draw(run.run).reports;
  const auto beliefs =
      each_below(reports.size(), [&](std::size_t i) { return beliefs_over(condition.contestants[i], reports[i]); });
  for (Panel& chart :
       support_charts(labels_of(scenario.target), condition.contestants, beliefs,
                      counted_from(Scenario::first_classified, reports.front().size()), "sample", run.truth))
    view.panels.emplace_back(with_acceleration(std::get<LineChart>(std::move(chart))));
  return view;
}

void tell(const Scenario& scenario, const DrawOptions& options, const std::vector<Contestant>& contestants,
          const std::vector<Scores>& scores, Result& result) {
  result.say(
      "Simulated targets on one axis: {} runs of each, seed {}. {} samples, {} s apart, measured to {} m; from {} m at "
      "{} m/s, accelerated during samples {}-{}. IMM and HIMM: constant velocity, ±3 g, ±5 g, σ_w {} m/s², p(stay) {}. "
      "From sample {} on their mode weights are the reports: cv weak, ±3 g medium, ±5 g strong.",
      options.runs, options.seed, Scenario::samples, Scenario::step_s, Scenario::sigma_position, Scenario::start_m,
      Scenario::speed, Scenario::first_accelerated, Scenario::last_accelerated, Scenario::sigma_w, Scenario::stay,
      Scenario::first_classified);
  result.add(targets_table(scenario, scores), {.title = "After the last sample"});
  result.say("(Ties share the credit.)");
  result.add(differences_table(scenario, scores), {.title = "Differences, ± 95 % by paired runs"});
  result.say("(± 95 % by paired runs.)\n\n");
  for (const auto& [contestant, target, dominator] : dominated(contestants))
    result.say("{} can never prefer the {}: whatever is seen, the {} is at least as possible", contestant, target,
               dominator);
  result.facts("simulated", true, "runs", options.runs, "seed", options.seed);
  auto curves = ResultTable::of_keys({"target", "sample", "classifier", "accuracy"});
  for (std::size_t target = 0; target < scores.size(); ++target) {
    const std::string& name = scenario.target.label(target);
    for (const Score& score : scores[target])
      for (std::size_t k = 0; k < score.accuracy.size(); ++k)
        curves.row({name, Scenario::first_classified + k, score.name, score.accuracy[k]});
    result.add(scores_table(scores[target]), {.printed = false, .summary = {"targets", name}});
    LineChart chart = with_acceleration(accuracy_chart(scores[target], "sample", Scenario::first_classified));
    chart.title = "Right decisions about the " + name;
    chart.greatest_y = 1.05;
    result.page.views.front().panels.emplace_back(std::move(chart));
  }
  result.add(curves, {.printed = false, .csv = "curves.csv"});
  result.page.verdict = {fmt::format(
      "Simulated targets on one axis: {} runs of each, seed {}. The mode weights of IMM and HIMM are the reports.",
      options.runs, options.seed)};
}

void run_manoeuvre(const DrawOptions& options) {
  ResultFiles files(options.output);
  const Scenario scenario;
  const auto all = contestants(scenario);
  std::vector<std::string> keys = {"target", "run", "sample", "position_m"};
  for (const char* filter : {"imm", "himm"})
    for (const auto& mode : labels_of(scenario.mode)) keys.push_back(fmt::format("{}_{}", filter, mode));
  RowFile samples(files, "samples.csv", keys);
  RowFile runs(files, "runs.csv", with_beliefs({"target", "run"}, all, labels_of(scenario.target)));
  World world{"Airliner, bomber or fighter?", {}};
  const std::size_t targets = scenario.target.size();
  for (std::size_t target = 0; target < targets; ++target)
    world.conditions.push_back({all, [&, target](std::size_t run) {
                                  RandomStream random(options.seed, run * targets + target);
                                  return fly(scenario, target, random);
                                }});
  world.view = [&](const SeenRun& run) { return view_of(scenario, world.conditions[run.condition], run); };
  world.runs_in_page = 1;
  world.see = [&](const SeenRun& run) {
    auto number = run.numbers.begin();
    for (std::size_t k = 0; k < Scenario::samples && samples; ++k) {
      std::vector<Cell> cells = {scenario.target.label(run.truth), run.run + 1, k + 1};
      while (cells.size() < keys.size()) cells.emplace_back(*number++);
      samples.write(cells);
    }
    runs.write(with_beliefs({scenario.target.label(run.truth), run.run + 1}, run));
  };
  world.tell = [&](const std::vector<Scores>& scores, Result& result) { tell(scenario, options, all, scores, result); };
  run_world(world, options, files);
}

}  // namespace

void add_manoeuvre(CLI::App& program, const std::string& command) {
  const auto options = std::make_shared<DrawOptions>();
  Subcommand app(program, "manoeuvre", "Airliner, bomber or fighter? From how a tracked target manoeuvres; simulated.");
  add_draws(app, *options, command, 1000);
  app.run([options] { run_manoeuvre(*options); });
}

}  // namespace sigmax::apps
