#include <cmath>
#include <memory>

#include <fmt/format.h>

#include <sigmax/core/transform.hpp>
#include <sigmax/core/update.hpp>
#include <sigmax/recognition/dominance.hpp>

#include "recognition_demo/contest_report.hpp"
#include "recognition_demo/manoeuvre_scenario.hpp"
#include "recognition_demo/pages.hpp"
#include "recognition_demo/subcommands.hpp"
#include "support/command_line.hpp"

namespace sigmax::apps {
namespace {

/// A classifier and the filter whose mode weights it takes.
struct Pairing {
  Contestant contestant;
  bool of_himm;
};

std::vector<Pairing> pairings(const ManoeuvreScenario& scenario) {
  const auto probable = invert(scenario.target_given_manoeuvre_p(), uninformative(scenario.manoeuvre)).relation;
  const auto possible =
      invert(scenario.target_given_manoeuvre_pi(), uninformative(as_fuzzy(scenario.manoeuvre))).relation;
  const SigmaClassifier sigma{uninformative(scenario.target), probable};
  const MaxClassifier max{uninformative(as_fuzzy(scenario.target)), possible};
  return {{{"sigma, of the IMM", sigma}, false},
          {{"max, of the HIMM", max}, true},
          {{"sigma-max, of the IMM", max}, false},
          {{"max-sigma, of the HIMM", sigma}, true}};
}

struct TargetScores {
  std::string target;
  std::vector<Score> scores;
};

/// A flight with what the classifiers made of it.
struct Flight : RunTraces {
  ManoeuvreRun run;
};

ResultTable targets_table(const ManoeuvreScenario& scenario, const std::vector<TargetScores>& all) {
  std::vector<ResultColumn> columns = {{.header = "after the last sample", .align = Align::left}};
  for (std::size_t c = 0; c < all.size(); ++c)
    columns.push_back({.header = fmt::format("{} ({} m/s²)", all[c].target, scenario.acceleration[c]),
                       .digits = 1,
                       .scale = 100.0,
                       .group = "right, %:"});
  for (const TargetScores& target : all)
    columns.push_back({.header = target.target, .digits = 3, .group = "p or π of"});
  columns.push_back({.header = "runs that end in a tie", .unit = "%", .digits = 1, .scale = 100.0});
  ResultTable table(std::move(columns));
  for (std::size_t i = 0; i < all.front().scores.size(); ++i) {
    std::vector<Cell> cells = {all.front().scores[i].name};
    double ties = 0.0;
    for (const TargetScores& target : all) {
      cells.emplace_back(target.scores[i].accuracy.back());
      ties += target.scores[i].ties / static_cast<double>(all.size());
    }
    for (const TargetScores& target : all) cells.emplace_back(target.scores[i].belief_in_truth);
    cells.emplace_back(ties);
    table.row(std::move(cells));
  }
  return table;
}

ResultTable differences_table(const std::vector<TargetScores>& all) {
  const auto& names = all.front().scores;
  std::vector<ResultColumn> columns = {
      {.header = fmt::format("− that of {}, points", names.front().name), .align = Align::left}};
  for (const TargetScores& target : all) columns.push_back({.header = target.target, .scale = 100.0, .sign = true});
  ResultTable table(std::move(columns));
  for (std::size_t i = 1; i < names.size(); ++i) {
    std::vector<Cell> cells = {names[i].name};
    for (const TargetScores& target : all) cells.emplace_back(target.scores[i].minus_first.interval());
    table.row(std::move(cells));
  }
  return table;
}

void say_dominated(Result& result, const std::vector<Contestant>& contestants) {
  for (const Contestant& contestant : contestants)
    std::visit(
        [&](const auto& classifier) {
          const auto& target = classifier.prior().variable();
          for (const Dominance& found : dominated_patterns(classifier))
            result.say(fmt::format("{} can never prefer the {}: whatever is seen, the {} is at least as possible",
                                   contestant.name, target.label(found.pattern), target.label(found.dominator)));
        },
        contestant.classifier);
}

/// samples.csv: the measured positions, and the weights of the filters' modes.
ResultTable samples_table(const ManoeuvreScenario& scenario) {
  std::vector<ResultColumn> columns = {{.key = "target"}, {.key = "run"}, {.key = "sample"}, {.key = "position_m"}};
  for (const char* filter : {"imm", "himm"})
    for (std::size_t j = 0; j < scenario.mode.size(); ++j)
      columns.push_back({.key = fmt::format("{}_{}", filter, scenario.mode.label(j))});
  return ResultTable(std::move(columns));
}

/// runs.csv: what each classifier believed at the end of every run.
ResultTable runs_table(const ManoeuvreScenario& scenario, const std::vector<Contestant>& contestants) {
  std::vector<ResultColumn> columns = {{.key = "target"}, {.key = "run"}};
  for (const Contestant& contestant : contestants)
    for (std::size_t c = 0; c < scenario.target.size(); ++c)
      columns.push_back({.key = contestant.name + ": " + scenario.target.label(c)});
  return ResultTable(std::move(columns));
}

/// Writes samples.csv and runs.csv bit by bit.
class FlightFiles {
 public:
  FlightFiles(const ManoeuvreScenario& scenario, const std::vector<Contestant>& contestants, ResultFiles& files)
      : scenario_(scenario),
        samples_(samples_table(scenario)),
        runs_(runs_table(scenario, contestants)),
        samples_file_(files.open("samples.csv")),
        runs_file_(files.open("runs.csv")) {
    if (!samples_file_) return;
    samples_file_->write(samples_.csv_header());
    runs_file_->write(runs_.csv_header());
  }

  void write(std::size_t run, const Flight& flight) {
    if (!samples_file_) return;
    const std::string& target = scenario_.target.label(flight.truth);
    for (std::size_t k = 0; k < ManoeuvreScenario::samples; ++k) {
      std::vector<Cell> cells = {target, run + 1, k + 1, flight.run.positions[k]};
      for (const auto* weights : {&flight.run.imm[k], &flight.run.himm[k]})
        for (std::size_t j = 0; j < scenario_.mode.size(); ++j)
          cells.push_back(weights->empty() ? Cell() : Cell(std::exp((*weights)[j])));
      samples_file_->write(samples_.csv_line(cells));
    }
    std::vector<Cell> cells = {target, run + 1};
    for (const Trace& trace : flight.traces) cells.insert(cells.end(), trace.belief.begin(), trace.belief.end());
    runs_file_->write(runs_.csv_line(cells));
  }

 private:
  const ManoeuvreScenario& scenario_;
  ResultTable samples_, runs_;
  AtomicFile *samples_file_, *runs_file_;
};

Flight flown(const ManoeuvreScenario& scenario, const std::vector<Pairing>& pairings, std::size_t target,
             RandomStream& random) {
  Flight flight{{target, {}}, fly(scenario, scenario.acceleration[target], random)};
  const auto by_sum = reports_by_sum(scenario, flight.run), by_max = reports_by_max(scenario, flight.run);
  for (const Pairing& pairing : pairings)
    flight.traces.push_back(follow(pairing.contestant, target, pairing.of_himm ? by_max : by_sum));
  return flight;
}

ResultTable curves_of_targets(const std::vector<TargetScores>& all) {
  ResultTable table({{.key = "target"}, {.key = "sample"}, {.key = "classifier"}, {.key = "accuracy"}});
  for (const TargetScores& target : all)
    for (const Score& score : target.scores)
      for (std::size_t k = 0; k < score.accuracy.size(); ++k)
        table.row({target.target, ManoeuvreScenario::first_classified + k, score.name, score.accuracy[k]});
  return table;
}

std::string described(const DrawOptions& options) {
  using Scenario = ManoeuvreScenario;
  return fmt::format(
      "Simulated targets on one axis: {} runs of each, seed {}. {} samples, {} s apart, measured to {} m; from {} m at "
      "{} m/s, accelerated during samples {}-{}. IMM and HIMM: constant velocity, ±3 g, ±5 g, σ_w {} m/s², p(stay) {}. "
      "From sample {} on their mode weights are the reports: cv weak, ±3 g medium, ±5 g strong.",
      options.runs, options.seed, Scenario::samples, Scenario::step_s, Scenario::sigma_position, Scenario::start_m,
      Scenario::speed, Scenario::first_accelerated, Scenario::last_accelerated, Scenario::sigma_w, Scenario::stay,
      Scenario::first_classified);
}

LineChart with_acceleration(LineChart chart) {
  using Scenario = ManoeuvreScenario;
  chart.shaded = {{double{Scenario::first_accelerated}, double{Scenario::last_accelerated}, "acceleration"}};
  return chart;
}

/// A flight: what each filter thinks of the modes, and what that says of the target.
View view_of(const ManoeuvreScenario& scenario, const std::vector<Pairing>& pairings,
             const std::vector<Contestant>& contestants, const Flight& flight) {
  View view{fmt::format("run 1, {}", scenario.target.label(flight.truth)), {}};
  const auto modes = [&](std::string title, std::string y_label, const std::vector<std::vector<double>>& logs) {
    LineChart chart{.title = std::move(title),
                    .x_label = "sample",
                    .y_label = std::move(y_label),
                    .x = counted_from(1, logs.size()),
                    .curves = {},
                    .greatest_y = 1.05};
    for (std::size_t j = 0; j < scenario.mode.size(); ++j) {
      chart.curves.push_back({.name = scenario.mode.label(j), .values = {}});
      for (const auto& weights : logs)
        chart.curves.back().values.push_back(weights.empty() ? std::nan("") : std::exp(weights[j]));
    }
    return with_acceleration(std::move(chart));
  };
  view.panels.emplace_back(modes("Modes of the IMM", "probability", flight.run.imm));
  view.panels.emplace_back(modes("Modes of the HIMM", "possibility", flight.run.himm));
  const auto by_sum = reports_by_sum(scenario, flight.run), by_max = reports_by_max(scenario, flight.run);
  std::vector<Beliefs> beliefs;
  for (const Pairing& pairing : pairings)
    beliefs.push_back(beliefs_over(pairing.contestant, pairing.of_himm ? by_max : by_sum));
  for (Panel& chart :
       support_charts(labels_of(scenario.target), contestants, beliefs,
                      counted_from(ManoeuvreScenario::first_classified, by_sum.size()), "sample", flight.truth))
    view.panels.emplace_back(with_acceleration(std::get<LineChart>(std::move(chart))));
  return view;
}

/// Right decisions about each target over the samples, from all runs.
View view_of_all(std::size_t runs, const std::vector<TargetScores>& results) {
  View view{fmt::format("all {} runs", runs), {}};
  for (const TargetScores& result : results) {
    LineChart chart = with_acceleration(accuracy_chart(result.scores, "sample", ManoeuvreScenario::first_classified));
    chart.title = "Right decisions about the " + result.target;
    chart.greatest_y = 1.05;
    view.panels.emplace_back(std::move(chart));
  }
  return view;
}

void run_manoeuvre(const DrawOptions& options) {
  ResultFiles files(options.output);
  const ManoeuvreScenario scenario;
  const auto all = pairings(scenario);
  std::vector<Contestant> contestants;
  for (const Pairing& pairing : all) contestants.push_back(pairing.contestant);
  FlightFiles flights(scenario, contestants, files);

  const std::size_t targets = scenario.target.size();
  std::vector<TargetScores> results;
  Result result = result_of_contest("Airliner, bomber or fighter?", options.output, contestants);
  Report& page = result.page;
  page.chooser = "Show";
  Progress progress("runs", options.runs * targets, options.output.quiet);
  for (std::size_t target = 0; target < targets; ++target) {
    Scoreboard board(contestants);
    for_each_draw(
        options, progress, [&](RandomStream& random) { return flown(scenario, all, target, random); },
        [&](std::size_t run, const Flight& flight) {
          board.add(flight);
          flights.write(run, flight);
          if (run == 0 && files.report_wanted()) page.views.push_back(view_of(scenario, all, contestants, flight));
        },
        targets, target);
    results.push_back({scenario.target.label(target), board.scores()});
  }
  progress.finish();

  result.say(described(options));
  result.add(targets_table(scenario, results), {.title = "After the last sample"});
  result.say("(Ties share the credit.)");
  result.add(differences_table(results), {.title = "Differences, ± 95 % by paired runs"});
  result.say("(± 95 % by paired runs.)\n\n");
  say_dominated(result, contestants);
  result.fact({"simulated"}, true);
  result.fact({"runs"}, options.runs);
  result.fact({"seed"}, options.seed);
  for (const TargetScores& target : results)
    result.add(scores_table(target.scores), {.printed = false, .summary = {"targets", target.target}});
  result.add(curves_of_targets(results), {.printed = false, .csv = "curves.csv"});
  page.verdict = {
      fmt::format("Simulated targets on one axis: {} runs of each, seed {}. The mode weights of IMM and HIMM are the "
                  "reports.",
                  options.runs, options.seed)};
  page.views.insert(page.views.begin(), view_of_all(options.runs, results));
  result.publish(files);
}

}  // namespace

void add_manoeuvre(CLI::App& program, const std::string& command) {
  const auto options = std::make_shared<DrawOptions>();
  options->runs = 1000;
  options->output.command = command;
  Subcommand app(program, "manoeuvre", "Airliner, bomber or fighter? From how a tracked target manoeuvres; simulated.");
  add_draws(app, *options);
  add_report(app, options->output);
  app.footer(
      "Examples:\n"
      "  recognition_demo manoeuvre\n"
      "  recognition_demo manoeuvre --runs 20000 --out results");
  app.run([options] { run_manoeuvre(*options); });
}

}  // namespace sigmax::apps
