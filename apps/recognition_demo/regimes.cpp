#include <cmath>
#include <functional>
#include <memory>
#include <span>

#include <fmt/format.h>

#include <sigmax/core/transform.hpp>
#include <sigmax/recognition/counts.hpp>

#include "recognition_demo/contest_report.hpp"
#include "recognition_demo/draws.hpp"
#include "recognition_demo/esm_classifiers.hpp"
#include "recognition_demo/esm_world.hpp"
#include "recognition_demo/subcommands.hpp"
#include "result/report.hpp"
#include "support/command_line.hpp"

namespace sigmax::apps {
namespace {

/// What the classifiers believe of the sensor unless a regime says otherwise.
constexpr double believed_hit = 0.7;

struct RegimesOptions {
  std::size_t reports = 40;
  DrawOptions draws;
};

/// One setting: what really happens, and what the classifiers know, which may be learned anew in every run.
struct Setting {
  std::string name;
  EsmTruth truth;
  std::function<std::vector<Contestant>(RandomStream&)> contestants;
  bool learned = false;
};

/// Settings of one kind, in which one number changes.
struct Regime {
  std::string name;  ///< one word, for files
  std::string description;
  std::vector<Setting> settings;
};

struct SettingScores {
  std::string regime;
  std::string setting;
  std::vector<Score> scores;
};

/// Sigma, sigma-max and max inference from the same knowledge.
std::vector<Contestant> equally_informed(const Relation<Random, Random>& probable,
                                         const Relation<Fuzzy, Fuzzy>& possible, const Relation<Random, Random>& sensor,
                                         std::size_t sensors) {
  const auto dubois_prade = with_fuzzy_condition(to_possibility(sensor, DuboisPrade{}));
  return {sigma_contestant("sigma", probable, {sensors, sensor}),
          sigma_max_contestant("sigma-max", possible, {sensors, sensor}),
          max_contestant("max, Dubois-Prade", possible, {sensors, dubois_prade}),
          max_sigma_contestant("max-sigma, Dubois-Prade", probable, {sensors, dubois_prade})};
}

/// From the lists of what platforms carry; emitters elsewhere are possible to a degree, and probable in proportion,
/// (35).
std::vector<Contestant> from_the_lists(const EsmWorld& world, double hit, double elsewhere, std::size_t sensors) {
  const auto possible = world.carries(elsewhere);
  const auto probable = with_random_condition(to_probability(possible, RatioScale{}));
  return equally_informed(probable, possible, world.sensor(hit), sensors);
}

/// From `seen` labelled reports of each platform, earlier, when the usages were others.
std::vector<Contestant> learned(const EsmWorld& world, const Usage& usage, std::size_t seen, RandomStream& random) {
  Counts counts{world.platform, {world.emitter}};
  for (std::size_t c = 0; c < world.platform.size(); ++c) {
    const auto earlier = draw_usage(world, c, usage, random);
    for (std::size_t k = 0; k < seen; ++k) counts.observe_value(c, 0, draw(random, earlier));
  }
  const auto sensor = world.sensor(believed_hit);
  auto all = equally_informed(learned_relation(counts, 0, 1.0), learned_relations(counts, 1.0, RatioScale{}).front(),
                              sensor, 1);
  all.push_back(sigma_max_contestant("sigma-max, p(f|c) by Dubois-Prade",
                                     learned_relations(counts, 1.0, DuboisPrade{}).front(), {sensor}));
  return all;
}

std::vector<Regime> regimes(const EsmWorld& world) {
  const auto lists = [&world](double hit, double elsewhere, std::size_t sensors) {
    return [&world, hit, elsewhere, sensors](RandomStream&) { return from_the_lists(world, hit, elsewhere, sensors); };
  };
  std::vector<Regime> all;

  Regime usage{"usage", "Usage is Dirichlet(α), drawn for each run; the classifiers assume it equal", {}};
  usage.settings.push_back({"equal", {}, lists(believed_hit, 0.0, 1)});
  for (const double alpha : {2.0, 1.0, 0.5, 0.2, 0.1}) {
    const EsmTruth truth{.usage = {Usage::Kind::dirichlet, alpha}};
    usage.settings.push_back({fmt::format("α = {}", alpha), truth, lists(believed_hit, 0.0, 1)});
  }
  all.push_back(std::move(usage));

  for (const double hit : {0.7, 0.95, 0.99}) {
    Regime dominant{fmt::format("dominant_{}", hit),
                    fmt::format("All emitters are used, but one, drawn for each run, has the share d; the classifiers "
                                "assume equal shares.\nThe sensor is right with probability {}, as they believe",
                                hit),
                    {}};
    for (const double share : {0.5, 0.7, 0.8, 0.9, 0.95, 0.99}) {
      const EsmTruth truth{.usage = {Usage::Kind::dominant, share}, .hit = hit};
      dominant.settings.push_back({fmt::format("d = {}", share), truth, [&world, hit, truth](RandomStream&) {
                                     auto informed = from_the_lists(world, hit, 0.0, 1);
                                     informed.push_back(usage_aware_contestant("sigma, averages over usages", world,
                                                                               truth.usage, {world.sensor(hit)}));
                                     return informed;
                                   }});
    }
    all.push_back(std::move(dominant));
  }

  Regime sensor{"sensor", "The sensor is right with probability h; the classifiers believe 0.7", {}};
  for (const double hit : {0.9, 0.7, 0.5, 0.4, 0.3})
    sensor.settings.push_back({fmt::format("h = {}", hit), {.hit = hit}, lists(believed_hit, 0.0, 1)});
  all.push_back(std::move(sensor));

  for (const double alpha : {0.5, 0.1}) {
    Regime few{
        fmt::format("learned_{}", alpha),
        fmt::format("Usage is Dirichlet({0}); p(f|c) is learned from n labelled reports of each platform, under an "
                    "earlier draw of the usage",
                    alpha),
        {}};
    const Usage usages{Usage::Kind::dirichlet, alpha};
    for (const std::size_t seen : {1U, 3U, 10U, 30U, 100U, 1000U})
      few.settings.push_back(
          {fmt::format("n = {}", seen),
           {.usage = usages},
           [&world, usages, seen](RandomStream& random) { return learned(world, usages, seen, random); },
           true});
    all.push_back(std::move(few));
  }

  for (const double elsewhere : {0.0, 0.2}) {
    Regime unlisted{fmt::format("unlisted_{}", elsewhere),
                    fmt::format("A report comes from an emitter that the platform does not carry with probability u; "
                                "believed possible to {}",
                                elsewhere),
                    {}};
    for (const double u : {0.0, 0.1, 0.2, 0.4})
      unlisted.settings.push_back({fmt::format("u = {}", u), {.unlisted = u}, lists(believed_hit, elsewhere, 1)});
    all.push_back(std::move(unlisted));
  }

  Regime conflict{"conflict", "Two sensors; in a share s of the runs the second listens to another platform", {}};
  for (const double s : {0.0, 0.25, 0.5, 1.0})
    conflict.settings.push_back({fmt::format("s = {}", s), {.astray = s, .sensors = 2}, lists(believed_hit, 0.0, 2)});
  all.push_back(std::move(conflict));
  return all;
}

ResultTable regime_table(std::span<const SettingScores> settings) {
  std::vector<ResultColumn> columns = {{.header = "setting", .align = Align::left}};
  const auto& first = settings.front().scores;
  for (const Score& score : first) {
    columns.push_back({.header = "right, %", .digits = 1, .scale = 100.0, .group = score.name + ":"});
    if (&score != &first.front())
      columns.push_back({.header = "− sigma's", .scale = 100.0, .sign = true, .group = score.name + ":"});
  }
  ResultTable table(std::move(columns));
  for (const SettingScores& setting : settings) {
    std::vector<Cell> cells = {setting.setting};
    for (const Score& score : setting.scores) {
      cells.emplace_back(score.accuracy.back());
      if (&score != &setting.scores.front()) cells.emplace_back(score.minus_first.interval());
    }
    table.row(std::move(cells));
  }
  return table;
}

/// Where possibilities did better, and where worse, by more than the interval. What is the same in every run counts
/// once.
struct Verdict {
  std::string sentence;
  ResultTable better;
};

Verdict verdict_of(const std::vector<SettingScores>& all) {
  ResultTable better({{.header = "regime", .align = Align::left},
                      {.header = "setting", .align = Align::left},
                      {.header = "better than sigma", .align = Align::left},
                      {.header = "points", .scale = 100.0, .sign = true}});
  std::size_t better_count = 0, worse = 0, undecided = 0;
  for (const SettingScores& setting : all)
    for (std::size_t i = 0; i < setting.scores.size(); ++i) {
      const Score& score = setting.scores[i];
      if (!score.has_possibilities || score.same_as < i) continue;
      const Interval difference = score.minus_first.interval();
      ++(difference.above_zero() ? better_count : difference.below_zero() ? worse : undecided);
      if (difference.above_zero()) better.row({setting.regime, setting.setting, score.name, difference});
    }
  return {fmt::format("Of {} comparisons with sigma inference at 95 % each, {} are worse, {} undecided, {} better; one "
                      "in forty would be better by chance. Classifiers that decide alike in every run count once.",
                      better_count + worse + undecided, worse, undecided, better_count),
          std::move(better)};
}

/// Points more than sigma inference, by setting and classifier.
HeatMap regime_map(const Regime& regime, std::span<const SettingScores> settings) {
  HeatMap map{.title = fmt::format("Regime {}", regime.name),
              .row_label = "setting",
              .column_label = "classifier",
              .rows = {},
              .columns = {},
              .values = {},
              .value_label = "points more than sigma inference",
              .diverging = true,
              .digits = 1,
              .scale = 100.0,
              .sign = true,
              .most = 0.2,
              .note = regime.description + "."};
  for (const Score& score : std::span(settings.front().scores).subspan(1)) map.columns.push_back(score.name);
  for (const SettingScores& setting : settings) map.rows.push_back(setting.setting);
  map.fill([&](std::size_t r, std::size_t c) {
    const auto& scores = settings[r].scores;
    const Interval points = scores[c + 1].minus_first.interval();
    return HeatMap::Cell{std::abs(points.mean) < 1e-12 ? 0.0 : points.mean,  // what only rounding parts
                         fmt::format("± {:.1f}; {:.1f} % right, sigma {:.1f} %", 100.0 * points.half_width,
                                     100.0 * scores[c + 1].accuracy.back(), 100.0 * scores.front().accuracy.back())};
  });
  return map;
}

ResultTable regimes_table(const std::vector<SettingScores>& all) {
  ResultTable table({{.key = "regime"},
                     {.key = "setting"},
                     {.key = "classifier"},
                     {.key = "accuracy"},
                     {.key = "difference"},
                     {.key = "lower"},
                     {.key = "upper"}});
  for (const SettingScores& setting : all)
    for (const Score& score : setting.scores) {
      const Interval difference = score.minus_first.interval();
      table.row({setting.regime, setting.setting, score.name, score.accuracy.back(), difference.mean,
                 difference.lower(), difference.upper()});
    }
  return table;
}

SettingScores scores_of(const EsmWorld& world, const Regime& regime, const Setting& setting,
                        const RegimesOptions& options, Progress& progress) {
  RandomStream for_names(options.draws.seed, 0);
  const auto all = setting.contestants(for_names);
  Scoreboard board(all);
  for_each_draw(
      options.draws, progress,
      [&](RandomStream& random) {
        const auto learned_anew =
            setting.learned ? std::optional(setting.contestants(random)) : std::optional<std::vector<Contestant>>();
        const EsmRun drawn = draw_run(world, setting.truth, options.reports, random);
        return follow_all(learned_anew ? *learned_anew : all, drawn.platform, drawn.reports);
      },
      [&](std::size_t, const RunTraces& traces) { board.add(traces); });
  return {regime.name, setting.name, board.scores()};
}

void run_regimes(const RegimesOptions& options) {
  const DrawOptions& draws = options.draws;
  ResultFiles files(draws.output);
  const EsmWorld world;
  const auto all = regimes(world);
  std::size_t settings = 0;
  for (const Regime& regime : all) settings += regime.settings.size();

  std::vector<SettingScores> results;
  Progress progress("runs", draws.runs * settings, draws.output.quiet);
  for (const Regime& regime : all)
    for (const Setting& setting : regime.settings)
      results.push_back(scores_of(world, regime, setting, options, progress));
  progress.finish();

  Result result = result_of_contest("Where is max inference the better one?", draws.output);
  const Verdict verdict = verdict_of(results);
  result.page.verdict = {
      verdict.sentence,
      fmt::format("Synthetic emitter world; {} runs of {} reports for each setting, seed {}. Purple: more often right "
                  "than sigma inference, orange: more seldom; the colours end at 20 points.",
                  draws.runs, options.reports, draws.seed)};
  result.say(
      fmt::format("Synthetic emitter world, not recorded data; {} runs of {} reports for each setting, seed {}. "
                  "Differences are points ± 95 % by paired runs.",
                  draws.runs, options.reports, draws.seed));
  std::span<const SettingScores> rest = results;
  for (const Regime& regime : all) {
    const auto own = rest.first(regime.settings.size());
    rest = rest.subspan(own.size());
    result.text += "\n";
    result.say(regime.description);
    result.add(regime_table(own), {});
    result.page.panels.emplace_back(regime_map(regime, own));
  }
  result.text += "\n";
  result.say(verdict.sentence);
  if (!verdict.better.empty()) result.add(verdict.better, {.title = "Better than sigma inference"});
  result.fact({"synthetic"}, true);
  result.fact({"runs"}, draws.runs);
  result.fact({"reports"}, options.reports);
  result.fact({"seed"}, draws.seed);
  for (const SettingScores& setting : results)
    result.add(scores_table(setting.scores),
               {.printed = false, .summary = {"regimes", setting.regime, setting.setting}});
  result.add(regimes_table(results), {.printed = false, .csv = "regimes.csv"});
  result.publish(files);
}

}  // namespace

void add_regimes(CLI::App& program, const std::string& command) {
  const auto options = std::make_shared<RegimesOptions>();
  options->draws.output.command = command;
  options->draws.runs = 5000;
  Subcommand app(
      program, "regimes",
      "Where is max inference the better one? The synthetic world, with beliefs that are wrong in several ways.");
  app.option("--reports", options->reports, "Reports in a run").in(1, 100000).shows_default();
  add_draws(app, options->draws);
  add_report(app, options->draws.output);
  app.footer(
      "Examples:\n"
      "  recognition_demo regimes\n"
      "  recognition_demo regimes --reports 10 --runs 5000 --out results");
  app.run([options] { run_regimes(*options); });
}

}  // namespace sigmax::apps
