#include <sigmax/core/transform.hpp>

#include "recognition_demo/emitters.hpp"

namespace sigmax::apps {
namespace {

constexpr double sensor_hit = 0.7;

struct EsmOptions {
  std::optional<double> alpha;  ///< usage is drawn by the Dirichlet density, else equal
  std::string regime;           ///< the name of one, or all; else none
  std::size_t reports = 40;
  DrawOptions draws;
};

Usage usage_of(const EsmOptions& options) {
  return options.alpha ? Usage{Usage::Kind::dirichlet, *options.alpha} : Usage{};
}

std::vector<Contestant> contestants(const EsmWorld& world, const EsmOptions& options) {
  const auto sensor = world.sensor(sensor_hit);
  const auto ratio = to_possibility(sensor, RatioScale{}), dubois_prade = to_possibility(sensor, DuboisPrade{});
  const auto usage = world.equal_usage();
  const auto carries = world.carries();
  std::vector<Contestant> all = {
      read_by("sigma", usage, sensor),
      read_by("max, ratio scale", carries, with_fuzzy_condition(ratio)),
      read_by("max, Dubois-Prade", carries, with_fuzzy_condition(dubois_prade)),
      read_by("sigma-max", carries, with_fuzzy_condition(sensor)),
      read_by("max-sigma, ratio scale", usage, ratio),
      read_by("max-sigma, Dubois-Prade", usage, dubois_prade),
  };
  if (options.alpha) all.push_back(usage_aware_contestant(world, usage_of(options), sensor));
  return all;
}

std::string described_usage(const EsmOptions& options) {
  if (!options.alpha) return "equal for all emitters of a platform, as the classifiers assume";
  return fmt::format("Dirichlet({}) over the emitters of a platform, drawn for each run, unknown to the classifiers",
                     *options.alpha);
}

void tell(const EsmOptions& options, const Scores& scores, Result& result) {
  const DrawOptions& draws = options.draws;
  result.say(
      "Synthetic emitter world, not recorded data: 4 platforms carry 2 or 3 of 5 emitters, a sensor reports the true "
      "emitter with probability {}, each other with {:.3g}\nUsage: {}\n{} runs of {} reports, seed {}",
      sensor_hit, (1.0 - sensor_hit) / 4.0, described_usage(options), draws.runs, options.reports, draws.seed);
  result.facts("synthetic", true, "usage", options.alpha ? "dirichlet" : "uniform");
  if (options.alpha) result.fact({"alpha"}, *options.alpha);
  result.facts("probability_of_a_right_reading", sensor_hit, "runs", draws.runs, "reports", options.reports, "seed",
               draws.seed);
  result.page.verdict = {fmt::format("{} runs of {} reports, seed {}; usage: {}.", draws.runs, options.reports,
                                     draws.seed, described_usage(options))};
  add_scores(result, scores);
}

void run_esm(const EsmOptions& options) {
  const EsmWorld esm;
  const auto drawn = [&](std::size_t run) {
    RandomStream random(options.draws.seed, run);
    return draw_run(esm, {.usage = usage_of(options), .hit = sensor_hit}, options.reports, random);
  };
  World world{"Which platform is it?", {{contestants(esm, options), drawn}}};
  ResultFiles files(options.draws.output);
  // A row for each run with the truth, the readings, and what each classifier believed at last.
  std::vector<std::string> keys = {"run", "platform", "readings"};
  for (const Contestant& one : world.conditions.front().contestants)
    for (const std::string& platform : labels_of(esm.platform)) keys.push_back(one.name + ": " + platform);
  RowFile rows(files, "runs.csv", keys);
  world.see = [&](const SeenRun& run) {
    if (!rows) return;
    const auto readings =
        each(drawn(run.run).reports, [&](const Readings& report) { return esm.reading.label(report.front()); });
    std::vector<Cell> cells = {run.run + 1, esm.platform.label(run.truth), fmt::format("{}", fmt::join(readings, " "))};
    for (const Trace& trace : run.traces) cells.insert(cells.end(), trace.belief.begin(), trace.belief.end());
    rows.write(cells);
  };
  world.tell = [&](const std::vector<Scores>& scores, Result& result) { tell(options, scores.front(), result); };
  run_world(world, options.draws, files);
}

}  // namespace

void add_esm(CLI::App& program, const std::string& command) {
  const auto options = std::make_shared<EsmOptions>();
  Subcommand app(program, "esm", "Which platform is it? A synthetic world of emitters, all classifiers.");
  const Option alpha = app.option("--alpha", options->alpha,
                                  "Usage of the emitters is drawn for each run by the Dirichlet density with this "
                                  "parameter, else equal; the smaller, the less equal")
                           .number_in(0.01, 1000.0);
  auto regimes = regime_names();
  regimes.emplace_back("all");
  const Option regime = app.option("--regime", options->regime,
                                   fmt::format("Where is max inference the better one? Beliefs that are wrong in one "
                                               "way, or in all: {}",
                                               fmt::join(regimes, ", ")))
                            .one_of(regimes)
                            .text("NAME");
  app.option("--reports", options->reports, "Reports in a run").in(1, 100000);
  app.option("--runs", options->draws.runs, "Simulated runs").in(2, 100000000);
  add_seed(app, options->draws.seed);
  add_threads(app, options->draws.threads);
  add_results(app, options->draws.output, command);
  app.run([options, alpha, regime] {
    if (regime.given() && alpha.given()) throw UsageError("--regime has usages of its own: leave out --alpha");
    if (regime.given())
      run_regimes(options->regime, options->reports, options->draws);
    else
      run_esm(*options);
  });
}

}  // namespace sigmax::apps
