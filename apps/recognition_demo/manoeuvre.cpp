#include "recognition_demo/manoeuvre.hpp"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <sigmax/core/transform.hpp>
#include <sigmax/core/update.hpp>
#include <sigmax/recognition/dominance.hpp>

#include "recognition_demo/contest_report.hpp"
#include "recognition_demo/manoeuvre_scenario.hpp"
#include "support/parallel.hpp"
#include "support/csv.hpp"
#include "support/progress.hpp"
#include "support/table.hpp"

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
  std::size_t target;
  std::vector<Score> scores;
};

void print(const ManoeuvreScenario& scenario, const std::vector<TargetScores>& all) {
  std::vector<TextTable::Column> columns = {{"right, % after the last sample", Align::left}};
  for (const TargetScores& target : all)
    columns.push_back(
        {fmt::format("{} ({} m/s²)", scenario.target.label(target.target), scenario.acceleration[target.target])});
  for (const TargetScores& target : all) columns.push_back({"p or π of " + scenario.target.label(target.target)});
  columns.push_back({"runs that end in a tie, %"});
  TextTable table(columns);
  for (std::size_t i = 0; i < all.front().scores.size(); ++i) {
    std::vector<std::string> cells = {all.front().scores[i].name};
    double ties = 0.0;
    for (const TargetScores& target : all) {
      cells.push_back(percent(target.scores[i].accuracy.back()));
      ties += target.scores[i].ties / static_cast<double>(all.size());
    }
    for (const TargetScores& target : all) cells.push_back(fmt::format("{:.3f}", target.scores[i].belief_in_truth));
    cells.push_back(percent(ties));
    table.row(cells);
  }
  table.print();
  fmt::print("(Ties share the credit.)\n");
}

void print_differences(const ManoeuvreScenario& scenario, const std::vector<TargetScores>& all) {
  const auto& names = all.front().scores;
  std::vector<TextTable::Column> columns = {{fmt::format("− that of {}, points", names.front().name), Align::left}};
  for (const TargetScores& target : all) columns.push_back({scenario.target.label(target.target)});
  TextTable table(columns);
  for (std::size_t i = 1; i < names.size(); ++i) {
    std::vector<std::string> cells = {names[i].name};
    for (const TargetScores& target : all)
      cells.push_back(points(paired_difference(target.scores[i], target.scores.front())));
    table.row(cells);
  }
  fmt::print("\n");
  table.print();
  fmt::print("(± 95 % by paired runs.)\n");
}

void print_dominated(const std::vector<Pairing>& pairings) {
  for (const Pairing& pairing : pairings)
    std::visit(
        [&](const auto& classifier) {
          const auto& target = classifier.prior().variable();
          for (const Dominance& found : dominated_patterns(classifier))
            fmt::print("{} can never prefer the {}: whatever is seen, the {} is at least as possible\n",
                       pairing.contestant.name, target.label(found.pattern), target.label(found.dominator));
        },
        pairing.contestant.classifier);
}

}  // namespace

void manoeuvre_and_report(const ManoeuvreOptions& options) {
  using Scenario = ManoeuvreScenario;
  std::optional<OutputDirectory> directory;  // made first, so that a bad one is known before the work
  if (!options.out.empty()) directory.emplace(options.out);
  const Scenario scenario;
  const auto all = pairings(scenario);
  std::vector<Contestant> contestants;
  for (const Pairing& pairing : all) contestants.push_back(pairing.contestant);

  std::optional<AtomicFile> samples, runs;
  if (directory) {
    samples.emplace(directory->file("samples.csv"));
    samples->write("target,run,sample,position_m");
    for (const char* filter : {"imm", "himm"})
      for (std::size_t j = 0; j < scenario.mode.size(); ++j) samples->print(",{}_{}", filter, scenario.mode.label(j));
    samples->write("\n");
    runs.emplace(directory->file("runs.csv"));
    runs->write("target,run");
    for (const Contestant& contestant : contestants)
      for (std::size_t c = 0; c < scenario.target.size(); ++c)
        runs->print(",{}", csv_field(contestant.name + ": " + scenario.target.label(c)));
    runs->write("\n");
  }

  std::vector<TargetScores> results;
  Progress progress("runs", options.runs * scenario.target.size(), options.quiet);
  for (std::size_t target = 0; target < scenario.target.size(); ++target) {
    const auto flown = [&](std::size_t run) {
      RandomStream random(options.seed, run * scenario.target.size() + target);
      return fly(scenario, scenario.acceleration[target], random);
    };
    const auto trace = [&](std::size_t run) {
      const ManoeuvreRun flight = flown(run);
      const auto by_sum = reports_by_sum(scenario, flight), by_max = reports_by_max(scenario, flight);
      RunTraces result{target, {}};
      for (const Pairing& pairing : all)
        result.traces.push_back(follow(pairing.contestant, target, pairing.of_himm ? by_max : by_sum));
      return result;
    };
    const auto see = [&](std::size_t run, const RunTraces& result) {
      progress.advance();
      if (!directory) return;
      const ManoeuvreRun flight = flown(run);
      for (std::size_t k = 0; k < Scenario::samples; ++k) {
        samples->print("{},{},{},{}", scenario.target.label(target), run + 1, k + 1, shortest(flight.positions[k]));
        for (const auto* weights : {&flight.imm[k], &flight.himm[k]})
          for (std::size_t j = 0; j < scenario.mode.size(); ++j)
            samples->print(",{}", weights->empty() ? "" : shortest(std::exp((*weights)[j])));
        samples->write("\n");
      }
      runs->print("{},{}", scenario.target.label(target), run + 1);
      for (const Trace& one : result.traces)
        for (const double value : one.belief) runs->print(",{}", shortest(value));
      runs->write("\n");
    };
    results.push_back({target, score(contestants, options.runs, threads_or_all(options.threads), trace, see)});
  }
  progress.finish();

  fmt::print(
      "Simulated targets on one axis: {} runs of each, seed {}. {} samples, {} s apart, measured to {} m; from {} m at "
      "{} m/s,\n"
      "accelerated during samples {}-{}. IMM and HIMM: constant velocity, ±3 g, ±5 g, σ_w {} m/s², p(stay) {}.\n"
      "From sample {} on their mode weights are the reports: cv weak, ±3 g medium, ±5 g strong.\n\n",
      options.runs, options.seed, Scenario::samples, Scenario::step_s, Scenario::sigma_position, Scenario::start_m,
      Scenario::speed, Scenario::first_accelerated, Scenario::last_accelerated, Scenario::sigma_w, Scenario::stay,
      Scenario::first_classified);
  print(scenario, results);
  print_differences(scenario, results);
  fmt::print("\n");
  print_dominated(all);

  if (!directory) return;
  AtomicFile curves = directory->file("curves.csv");
  curves.write("target,sample,classifier,accuracy\n");
  for (const TargetScores& result : results)
    for (const Score& score : result.scores)
      for (std::size_t k = 0; k < score.accuracy.size(); ++k)
        curves.print("{},{},{},{}\n", scenario.target.label(result.target), Scenario::first_classified + k,
                     csv_field(score.name), shortest(score.accuracy[k]));
  Json summary = summary_of(options.command);
  summary["simulated"] = true;
  summary["runs"] = options.runs;
  summary["seed"] = options.seed;
  for (const TargetScores& result : results)
    summary["targets"][scenario.target.label(result.target)] = as_json(result.scores);
  AtomicFile summary_json = summary_file(summary, *directory);
  commit_all(*samples, *runs, curves, summary_json);
  print_written({"samples.csv", "runs.csv", "curves.csv", "summary.json"}, options.out);
}

}  // namespace sigmax::apps
