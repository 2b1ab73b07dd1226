#include "recognition_demo/esm.hpp"

#include <optional>

#include <fmt/format.h>

#include <sigmax/core/transform.hpp>

#include "recognition_demo/contest_report.hpp"
#include "recognition_demo/esm_classifiers.hpp"
#include "recognition_demo/esm_world.hpp"
#include "support/parallel.hpp"
#include "support/csv.hpp"
#include "support/progress.hpp"

namespace sigmax::apps {
namespace {

constexpr double hit = 0.7;

Usage usage_of(const EsmOptions& options) {
  if (options.usage == "dirichlet") return {Usage::Kind::dirichlet, options.alpha};
  return {};
}

std::vector<Contestant> contestants(const EsmWorld& world, const EsmOptions& options) {
  const auto sensor = world.sensor(hit);
  const auto ratio = with_fuzzy_condition(to_possibility(sensor, RatioScale{}));
  const auto dubois_prade = with_fuzzy_condition(to_possibility(sensor, DuboisPrade{}));
  const auto usage = world.equal_usage();
  const auto carries = world.carries();
  std::vector<Contestant> all = {
      sigma_contestant("sigma", usage, {sensor}),
      max_contestant("max, ratio scale", carries, {ratio}),
      max_contestant("max, Dubois-Prade", carries, {dubois_prade}),
      sigma_max_contestant("sigma-max", carries, {sensor}),
      max_sigma_contestant("max-sigma, ratio scale", usage, {ratio}),
      max_sigma_contestant("max-sigma, Dubois-Prade", usage, {dubois_prade}),
  };
  if (options.usage == "dirichlet")
    all.push_back(usage_aware_contestant("sigma, averages over usages", world, usage_of(options), {sensor}));
  return all;
}

std::string described_usage(const EsmOptions& options) {
  return options.usage == "uniform"
             ? "equal for all emitters of a platform, as the classifiers assume"
             : fmt::format(
                   "Dirichlet({}) over the emitters of a platform, drawn for each run, unknown to the classifiers",
                   options.alpha);
}

/// The header of runs.csv: a row for each run with the truth, the readings, and what each classifier believed at last.
std::string runs_header(const EsmWorld& world, const std::vector<Contestant>& contestants) {
  std::string header = "run,platform,readings";
  for (const Contestant& contestant : contestants)
    for (std::size_t c = 0; c < world.platform.size(); ++c)
      header += "," + csv_field(contestant.name + ": " + world.platform.label(c));
  return header + "\n";
}

}  // namespace

void esm_and_report(const EsmOptions& options) {
  std::optional<OutputDirectory> directory;  // made first, so that a bad one is known before the work
  if (!options.out.empty()) directory.emplace(options.out);
  const EsmWorld world;
  const EsmTruth truth{.usage = usage_of(options), .hit = hit};
  const auto all = contestants(world, options);

  std::optional<AtomicFile> runs_file;
  if (directory) {
    runs_file.emplace(directory->file("runs.csv"));
    runs_file->write(runs_header(world, all));
  }
  const auto reports_of = [&](std::size_t run) {
    RandomStream random(options.seed, run);
    return draw_run(world, truth, options.reports, random);
  };
  const auto trace = [&](std::size_t run) {
    const EsmRun drawn = reports_of(run);
    RunTraces result{drawn.platform, {}};
    for (const Contestant& contestant : all) result.traces.push_back(follow(contestant, drawn.platform, drawn.reports));
    return result;
  };
  Progress progress("runs", options.runs, options.quiet);
  const auto see = [&](std::size_t run, const RunTraces& result) {
    progress.advance();
    if (!runs_file) return;
    std::string readings;
    for (const Readings& report : reports_of(run).reports)
      readings += (readings.empty() ? "" : " ") + world.reading.label(report.front());
    runs_file->print("{},{},{}", run + 1, world.platform.label(result.truth), readings);
    for (const Trace& one : result.traces)
      for (const double value : one.belief) runs_file->print(",{}", shortest(value));
    runs_file->write("\n");
  };
  const auto scores = score(all, options.runs, threads_or_all(options.threads), trace, see);
  progress.finish();

  fmt::print(
      "Synthetic emitter world, not recorded data: 4 platforms carry 2 or 3 of 5 emitters, a sensor reports the\n"
      "true emitter with probability {}, each other with {:.3g}\n"
      "Usage: {}\n{} runs of {} reports, seed {}\n\n",
      hit, (1.0 - hit) / 4.0, described_usage(options), options.runs, options.reports, options.seed);
  print_scores(scores);

  if (!directory) return;
  Json summary = summary_of(options.command);
  summary["synthetic"] = true;
  summary["usage"] = options.usage;
  if (options.usage == "dirichlet") summary["alpha"] = options.alpha;
  summary["probability_of_a_right_reading"] = hit;
  summary["runs"] = options.runs;
  summary["reports"] = options.reports;
  summary["seed"] = options.seed;
  summary["classifiers"] = as_json(scores);
  AtomicFile curves = curves_file(scores, *directory), summary_json = summary_file(summary, *directory);
  commit_all(curves, *runs_file, summary_json);
  print_written({"curves.csv", "runs.csv", "summary.json"}, options.out);
}

}  // namespace sigmax::apps
