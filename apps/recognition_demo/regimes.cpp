#include "recognition_demo/regimes.hpp"

#include <functional>
#include <optional>

#include <fmt/format.h>

#include <sigmax/core/transform.hpp>
#include <sigmax/recognition/counts.hpp>

#include "recognition_demo/contest_report.hpp"
#include "recognition_demo/draws.hpp"
#include "recognition_demo/esm_classifiers.hpp"
#include "recognition_demo/esm_world.hpp"
#include "support/parallel.hpp"
#include "support/csv.hpp"
#include "support/progress.hpp"
#include "support/table.hpp"

namespace sigmax::apps {
namespace {

/// What the classifiers believe of the sensor unless a regime says otherwise.
constexpr double believed_hit = 0.7;

/// One setting: what really happens, and what the classifiers know, which may be learned anew in every run.
struct Setting {
  std::string name;
  EsmTruth truth;
  std::function<std::vector<Contestant>(RandomStream&)> contestants;
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
          max_contestant("max, Dubois-Prade", possible, {sensors, dubois_prade})};
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
          {fmt::format("n = {}", seen), {.usage = usages}, [&world, usages, seen](RandomStream& random) {
             return learned(world, usages, seen, random);
           }});
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

void print_regime(const Regime& regime, std::span<const SettingScores> settings) {
  std::vector<TextTable::Column> columns = {{"right, %", Align::left}};
  const auto& first = settings.front().scores;
  for (const Score& score : first) {
    columns.push_back({score.name});
    if (&score != &first.front()) columns.push_back({"− sigma's"});
  }
  TextTable table(columns);
  for (const SettingScores& setting : settings) {
    std::vector<std::string> cells = {setting.setting};
    for (const Score& score : setting.scores) {
      cells.push_back(percent(score.accuracy.back()));
      if (&score != &setting.scores.front()) cells.push_back(points(paired_difference(score, setting.scores.front())));
    }
    table.row(cells);
  }
  fmt::print("\n{}\n\n", regime.description);
  table.print();
}

/// Where possibilities did better, and where worse, by more than the interval.
void print_verdict(const std::vector<SettingScores>& all) {
  std::string better;
  std::size_t better_count = 0, worse = 0, level = 0;
  for (const SettingScores& setting : all)
    for (const Score& score : setting.scores) {
      if (!score.fuzzy) continue;
      const Interval difference = paired_difference(score, setting.scores.front());
      if (difference.lower() > 0.0) {
        ++better_count;
        better += fmt::format("  {}, {}: {} {}\n", setting.regime, setting.setting, score.name, points(difference));
      } else {
        ++(difference.upper() < 0.0 ? worse : level);
      }
    }
  fmt::print(
      "\nOf {} comparisons with sigma inference at 95 % each, {} are worse, {} undecided, {} better (one in forty "
      "would\n"
      "be by chance){}\n{}",
      better_count + worse + level, worse, level, better_count, better.empty() ? "." : ":", better);
}

AtomicFile regimes_file(const std::vector<SettingScores>& all, const OutputDirectory& directory) {
  AtomicFile file = directory.file("regimes.csv");
  file.write("regime,setting,classifier,accuracy,difference,lower,upper\n");
  for (const SettingScores& setting : all)
    for (const Score& score : setting.scores) {
      file.print("{},{},{},{}", csv_field(setting.regime), csv_field(setting.setting), csv_field(score.name),
                 shortest(score.accuracy.back()));
      const Interval difference = paired_difference(score, setting.scores.front());
      file.print(",{},{},{}\n", shortest(difference.mean), shortest(difference.lower()), shortest(difference.upper()));
    }
  return file;
}

}  // namespace

void regimes_and_report(const RegimesOptions& options) {
  std::optional<OutputDirectory> directory;  // made first, so that a bad one is known before the work
  if (!options.out.empty()) directory.emplace(options.out);
  const EsmWorld world;
  const auto all = regimes(world);
  std::size_t settings = 0;
  for (const Regime& regime : all) settings += regime.settings.size();

  std::vector<SettingScores> results;
  Progress progress("runs", options.runs * settings, options.quiet);
  for (const Regime& regime : all)
    for (const Setting& setting : regime.settings) {
      const auto trace = [&](std::size_t run) {
        RandomStream random(options.seed, run);
        const auto contestants = setting.contestants(random);
        const EsmRun drawn = draw_run(world, setting.truth, options.reports, random);
        RunTraces result{drawn.platform, {}};
        for (const Contestant& contestant : contestants)
          result.traces.push_back(follow(contestant, drawn.platform, drawn.reports));
        return result;
      };
      RandomStream for_names(options.seed, 0);
      results.push_back({regime.name, setting.name,
                         score(setting.contestants(for_names), options.runs, threads_or_all(options.threads), trace,
                               [&](std::size_t, const RunTraces&) { progress.advance(); })});
    }
  progress.finish();

  fmt::print(
      "Synthetic emitter world, not recorded data; {} runs of {} reports for each setting, seed {}. Differences are\n"
      "points ± 95 % by paired runs\n",
      options.runs, options.reports, options.seed);
  std::span<const SettingScores> rest = results;
  for (const Regime& regime : all) {
    print_regime(regime, rest.first(regime.settings.size()));
    rest = rest.subspan(regime.settings.size());
  }
  print_verdict(results);

  if (!directory) return;
  Json summary = summary_of(options.command);
  summary["synthetic"] = true;
  summary["runs"] = options.runs;
  summary["reports"] = options.reports;
  summary["seed"] = options.seed;
  for (const SettingScores& setting : results)
    summary["regimes"][setting.regime][setting.setting] = as_json(setting.scores);
  AtomicFile csv = regimes_file(results, *directory), summary_json = summary_file(summary, *directory);
  commit_all(csv, summary_json);
  print_written({"regimes.csv", "summary.json"}, options.out);
}

}  // namespace sigmax::apps
