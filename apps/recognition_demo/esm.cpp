#include <sigmax/core/transform.hpp>
#include <sigmax/core/witness.hpp>

#include "recognition_demo/emitters.hpp"
#include "recognition_demo/subcommands.hpp"

namespace sigmax::apps {
namespace {

constexpr double sensor_hit = 0.7;

struct EsmOptions {
  std::string usage = "uniform";  ///< or dirichlet
  double alpha = 0.5;
  std::string regime;  ///< the name of one, or all; else none
  std::size_t reports = 40;
  DrawOptions draws;
};

Usage usage_of(const EsmOptions& options) {
  return options.usage == "dirichlet" ? Usage{Usage::Kind::dirichlet, options.alpha} : Usage{};
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
  if (options.usage == "dirichlet") all.push_back(usage_aware_contestant(world, usage_of(options), sensor));
  return all;
}

std::string described_usage(const EsmOptions& options) {
  return options.usage == "uniform"
             ? "equal for all emitters of a platform, as the classifiers assume"
             : fmt::format(
                   "Dirichlet({}) over the emitters of a platform, drawn for each run, unknown to the classifiers",
                   options.alpha);
}

/// What may be read of each emitter, and of which emitter that most possibly is.
HeatMap witness_map(const Relation<Fuzzy, Fuzzy>& reading_given_feature,
                    const Relation<Fuzzy, Fuzzy>& feature_given_pattern) {
  const auto witnessed = compose_with_witness(reading_given_feature, feature_given_pattern);
  const auto& relation = witnessed.relation();
  return map_of(relation, "What may be read of each " + relation.from().name(), "possibility by max inference",
                [&](std::size_t c, std::size_t value) {
                  const bool possible = relation(c, value) > 0.0;
                  return "through " +
                         (possible ? feature_given_pattern.to().label(witnessed.winner(c, value)) : "nothing");
                });
}

/// A run that the page shows: the support of each platform over its reports.
View view_of(const EsmWorld& world, const std::vector<Contestant>& all, std::size_t run, const Drawn& drawn) {
  constexpr std::size_t most = 100;
  std::vector<Readings> reports = drawn.reports;
  if (reports.size() > most) reports.resize(most);
  const auto beliefs = each(all, [&](const Contestant& one) { return beliefs_over(one, reports); });
  return {fmt::format("run {}", run + 1), support_charts(labels_of(world.platform), all, beliefs,
                                                         counted_from(1, reports.size()), "reports", drawn.truth)};
}

void tell(const EsmWorld& world, const EsmOptions& options, const Scores& scores, Result& result) {
  const DrawOptions& draws = options.draws;
  result.say(
      "Synthetic emitter world, not recorded data: 4 platforms carry 2 or 3 of 5 emitters, a sensor reports the true "
      "emitter with probability {}, each other with {:.3g}\nUsage: {}\n{} runs of {} reports, seed {}",
      sensor_hit, (1.0 - sensor_hit) / 4.0, described_usage(options), draws.runs, options.reports, draws.seed);
  result.facts("synthetic", true, "usage", options.usage);
  if (options.usage == "dirichlet") result.fact({"alpha"}, options.alpha);
  result.facts("probability_of_a_right_reading", sensor_hit, "runs", draws.runs, "reports", options.reports, "seed",
               draws.seed);
  result.page.verdict = {fmt::format("{} runs of {} reports, seed {}; usage: {}.", draws.runs, options.reports,
                                     draws.seed, described_usage(options))};
  result.page.views.front().panels.emplace_back(accuracy_chart(scores));
  result.page.last.emplace_back(
      witness_map(with_fuzzy_condition(to_possibility(world.sensor(sensor_hit), DuboisPrade{})), world.carries()));
  add_scores(result, scores);
}

void run_esm(const EsmOptions& options) {
  const EsmWorld esm;
  const auto drawn = [&](std::size_t run) {
    RandomStream random(options.draws.seed, run);
    return draw_run(esm, {.usage = usage_of(options), .hit = sensor_hit}, options.reports, random);
  };
  World world{"Which platform is it?", {{contestants(esm, options), drawn}}};
  const auto& all = world.conditions.front().contestants;
  ResultFiles files(options.draws.output);
  // A row for each run with the truth, the readings, and what each classifier believed at last.
  RowFile rows(files, "runs.csv", with_beliefs({"run", "platform", "readings"}, all, labels_of(esm.platform)));
  world.view = [&](const SeenRun& run) { return view_of(esm, all, run.run, drawn(run.run)); };
  world.runs_in_page = 6;
  world.see = [&](const SeenRun& run) {
    if (!rows) return;
    std::string readings;
    for (const Readings& report : drawn(run.run).reports)
      readings += (readings.empty() ? "" : " ") + esm.reading.label(report.front());
    rows.write(with_beliefs({run.run + 1, esm.platform.label(run.truth), readings}, run));
  };
  world.tell = [&](const std::vector<Scores>& scores, Result& result) { tell(esm, options, scores.front(), result); };
  run_world(world, options.draws, files);
}

}  // namespace

void add_esm(CLI::App& program, const std::string& command) {
  const auto options = std::make_shared<EsmOptions>();
  Subcommand app(program, "esm", "Which platform is it? A synthetic world of emitters, all classifiers.");
  const Option usage =
      app.option("--usage", options->usage, "How often a platform uses its emitters: equally, or drawn for each run")
          .one_of({"uniform", "dirichlet"});
  const Option alpha =
      app.option("--alpha", options->alpha, "Parameter of the Dirichlet density; the smaller, the less equal")
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
  add_draws(app, options->draws, command, 20000);
  app.run([options, alpha, usage, regime] {
    if (regime.given() && usage.given()) throw UsageError("--regime has usages of its own: leave out --usage");
    if (alpha.given() && options->usage == "uniform") throw UsageError("--alpha needs --usage dirichlet");
    if (regime.given())
      run_regimes(options->regime, options->reports, options->draws);
    else
      run_esm(*options);
  });
}

}  // namespace sigmax::apps
