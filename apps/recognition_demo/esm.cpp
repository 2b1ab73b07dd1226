#include <memory>

#include <fmt/format.h>

#include <sigmax/core/transform.hpp>

#include "recognition_demo/contest_report.hpp"
#include "recognition_demo/esm_classifiers.hpp"
#include "recognition_demo/esm_world.hpp"
#include "recognition_demo/pages.hpp"
#include "recognition_demo/subcommands.hpp"
#include "support/command_line.hpp"
#include "support/error.hpp"

namespace sigmax::apps {
namespace {

constexpr double sensor_hit = 0.7;

struct EsmOptions {
  std::string usage = "uniform";  ///< or dirichlet
  double alpha = 0.5;
  std::size_t reports = 40;
  DrawOptions draws;
};

Usage usage_of(const EsmOptions& options) {
  if (options.usage == "dirichlet") return {Usage::Kind::dirichlet, options.alpha};
  return {};
}

std::vector<Contestant> contestants(const EsmWorld& world, const EsmOptions& options) {
  const auto sensor = world.sensor(sensor_hit);
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

/// A run with what was read in it.
struct EsmTraces : RunTraces {
  std::vector<Readings> reports;
};

/// runs.csv: a row for each run with the truth, the readings, and what each classifier believed at last.
ResultTable runs_table(const EsmWorld& world, const std::vector<Contestant>& contestants) {
  std::vector<ResultColumn> columns = {{.key = "run"}, {.key = "platform"}, {.key = "readings"}};
  for (const Contestant& contestant : contestants)
    for (std::size_t c = 0; c < world.platform.size(); ++c)
      columns.push_back({.key = contestant.name + ": " + world.platform.label(c)});
  return ResultTable(std::move(columns));
}

std::vector<Cell> row_of_run(const EsmWorld& world, std::size_t run, const EsmTraces& traces) {
  std::string readings;
  for (const Readings& report : traces.reports)
    readings += (readings.empty() ? "" : " ") + world.reading.label(report.front());
  std::vector<Cell> cells = {run + 1, world.platform.label(traces.truth), readings};
  for (const Trace& trace : traces.traces) cells.insert(cells.end(), trace.belief.begin(), trace.belief.end());
  return cells;
}

/// A run that the page shows: the support of each platform over its reports.
View view_of(const EsmWorld& world, const std::vector<Contestant>& all, std::size_t run, const EsmTraces& traces) {
  const std::size_t most = std::min<std::size_t>(traces.reports.size(), 100);
  const std::vector<Readings> reports(traces.reports.begin(),
                                      traces.reports.begin() + static_cast<std::ptrdiff_t>(most));
  std::vector<Beliefs> beliefs;
  for (const Contestant& contestant : all) beliefs.push_back(beliefs_over(contestant, reports));
  return {fmt::format("run {}", run + 1),
          support_charts(labels_of(world.platform), all, beliefs, counted_from(1, most), "reports", traces.truth)};
}

void run_esm(const EsmOptions& options) {
  const DrawOptions& draws = options.draws;
  ResultFiles files(draws.output);
  const EsmWorld world;
  const EsmTruth truth{.usage = usage_of(options), .hit = sensor_hit};
  const auto all = contestants(world, options);
  const ResultTable runs = runs_table(world, all);
  AtomicFile* const runs_file = files.open("runs.csv");
  if (runs_file) runs_file->write(runs.csv_header());

  constexpr std::size_t runs_in_page = 6;
  Result result = result_of_contest("Which platform is it?", draws.output, all);
  Report& page = result.page;
  page.chooser = "Show";
  Scoreboard board(all);
  Progress progress("runs", draws.runs, draws.output.quiet);
  for_each_draw(
      draws, progress,
      [&](RandomStream& random) {
        EsmRun drawn = draw_run(world, truth, options.reports, random);
        return EsmTraces{follow_all(all, drawn.platform, drawn.reports), std::move(drawn.reports)};
      },
      [&](std::size_t run, const EsmTraces& traces) {
        board.add(traces);
        if (files.report_wanted() && run < runs_in_page) page.views.push_back(view_of(world, all, run, traces));
        if (runs_file) runs_file->write(runs.csv_line(row_of_run(world, run, traces)));
      });
  progress.finish();

  const auto scores = board.scores();
  result.say(fmt::format(
      "Synthetic emitter world, not recorded data: 4 platforms carry 2 or 3 of 5 emitters, a sensor reports "
      "the true emitter with probability {}, each other with {:.3g}\nUsage: {}\n{} runs of {} reports, "
      "seed {}",
      sensor_hit, (1.0 - sensor_hit) / 4.0, described_usage(options), draws.runs, options.reports, draws.seed));
  result.fact({"synthetic"}, true);
  result.fact({"usage"}, options.usage);
  if (options.usage == "dirichlet") result.fact({"alpha"}, options.alpha);
  result.fact({"probability_of_a_right_reading"}, sensor_hit);
  result.fact({"runs"}, draws.runs);
  result.fact({"reports"}, options.reports);
  result.fact({"seed"}, draws.seed);
  page.verdict = {fmt::format("{} runs of {} reports, seed {}; usage: {}.", draws.runs, options.reports, draws.seed,
                              described_usage(options))};
  page.views.insert(page.views.begin(), View{fmt::format("all {} runs", draws.runs), {accuracy_chart(scores)}});
  page.last.emplace_back(
      witness_map(with_fuzzy_condition(to_possibility(world.sensor(sensor_hit), DuboisPrade{})), world.carries()));
  add_scores(result, scores);
  result.publish(files);
}

}  // namespace

void add_esm(CLI::App& program, const std::string& command) {
  const auto options = std::make_shared<EsmOptions>();
  options->draws.output.command = command;
  options->draws.runs = 20000;
  Subcommand app(program, "esm", "Which platform is it? A synthetic world of emitters, all classifiers.");
  app.option("--usage", options->usage, "How often a platform uses its emitters: equally, or drawn for each run")
      .one_of(std::vector<std::string>{"uniform", "dirichlet"})
      .shows_default();
  const Option alpha =
      app.option("--alpha", options->alpha, "Parameter of the Dirichlet density; the smaller, the less equal")
          .number_in(0.01, 1000.0)
          .shows_default();
  app.option("--reports", options->reports, "Reports in a run").in(1, 100000).shows_default();
  add_draws(app, options->draws);
  add_report(app, options->draws.output);
  app.footer(
      "Examples:\n"
      "  recognition_demo esm --usage dirichlet --alpha 0.5\n"
      "  recognition_demo esm --reports 100 --runs 5000 --out results");
  app.run([options, alpha] {
    if (alpha.given() && options->usage == "uniform") throw UsageError("--alpha needs --usage dirichlet");
    run_esm(*options);
  });
}

}  // namespace sigmax::apps
