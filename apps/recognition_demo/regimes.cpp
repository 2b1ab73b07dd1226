#include "recognition_demo/world.hpp"

#include <sigmax/core/transform.hpp>
#include <sigmax/recognition/counts.hpp>

namespace sigmax::apps {
namespace {

/// One setting: what really happens, and what the classifiers know.
struct Setting {
  std::string name{};
  EsmTruth truth{};
  double hit = 0.7;        ///< what they believe of the sensor
  double elsewhere = 0.0;  ///< how possible they take emitters that a platform does not carry
  bool averaged = false;   ///< one more knows how usages are drawn
  /// They learn from so many reports of each platform, anew in every run; 0: they know the lists.
  std::size_t seen = 0;
  Scores scores{};  ///< when the runs are done
};

/// Settings of one kind, in which one number changes.
struct Regime {
  std::string name;  ///< one word, for files
  std::string description;
  std::vector<Setting> settings;
};

/// Sigma, sigma-max and max inference from the same knowledge.
std::vector<NamedClassifier> equally_informed(const Relation<Random, Random>& probable,
                                              const Relation<Fuzzy, Fuzzy>& possible,
                                              const Relation<Random, Random>& sensor, std::size_t sensors) {
  const auto dubois_prade = to_possibility(sensor, DuboisPrade{});
  return {read_by("sigma", probable, sensor, sensors),
          read_by("sigma-max", possible, with_fuzzy_condition(sensor), sensors),
          read_by("max, Dubois-Prade", possible, with_fuzzy_condition(dubois_prade), sensors),
          read_by("max-sigma, Dubois-Prade", probable, dubois_prade, sensors)};
}

/// From the lists of what platforms carry; emitters elsewhere are possible to a degree, and probable in proportion,
/// (35).
std::vector<NamedClassifier> from_the_lists(const EsmWorld& world, const Setting& setting) {
  const auto possible = world.carries(setting.elsewhere);
  const auto probable = with_random_condition(to_probability(possible, RatioScale{}));
  const auto sensor = world.sensor(setting.hit);
  auto all = equally_informed(probable, possible, sensor, setting.truth.sensors);
  if (setting.averaged) all.push_back(usage_aware(world, setting.truth.usage, sensor));
  return all;
}

/// From labelled reports of each platform, earlier, when the usages were others.
std::vector<NamedClassifier> learned(const EsmWorld& world, const Setting& setting, RandomStream& random) {
  Counts counts{world.platform, {world.emitter}};
  for (std::size_t c = 0; c < world.platform.size(); ++c) {
    const auto earlier = draw_usage(world, c, setting.truth.usage, random);
    for (std::size_t k = 0; k < setting.seen; ++k) counts.observe_value(c, 0, random.draw(earlier));
  }
  const auto sensor = world.sensor(setting.hit);
  auto all = equally_informed(learned_relation(counts, 0, 1.0), learned_relations(counts, 1.0, RatioScale{}).front(),
                              sensor, 1);
  all.push_back(read_by("sigma-max, p(f|c) by Dubois-Prade", learned_relations(counts, 1.0, DuboisPrade{}).front(),
                        with_fuzzy_condition(sensor)));
  return all;
}

template <class SettingOf>
Regime regime(std::string name, std::string description, const char* symbol, std::initializer_list<double> numbers,
              const SettingOf& setting_of) {
  Regime result{std::move(name), std::move(description), {}};
  for (const double number : numbers) {
    Setting setting = setting_of(number);
    setting.name = fmt::format("{} = {}", symbol, number);
    result.settings.push_back(std::move(setting));
  }
  return result;
}

std::vector<Regime> regimes() {
  std::vector<Regime> all;
  const auto dirichlet = [](double alpha) { return Usage{Usage::Kind::dirichlet, alpha}; };
  all.push_back(regime("usage", "Usage is Dirichlet(α), drawn for each run; the classifiers assume it equal", "α",
                       {2.0, 1.0, 0.5, 0.2, 0.1},
                       [&](double alpha) { return Setting{.truth = {.usage = dirichlet(alpha)}}; }));
  all.back().settings.insert(all.back().settings.begin(), Setting{"equal"});
  for (const double hit : {0.7, 0.95, 0.99})
    all.push_back(regime(
        fmt::format("dominant_{}", hit),
        fmt::format("All emitters are used, but one, drawn for each run, has the share d; the classifiers assume equal "
                    "shares.\nThe sensor is right with probability {}, as they believe",
                    hit),
        "d", {0.5, 0.7, 0.8, 0.9, 0.95, 0.99}, [&](double share) {
          return Setting{.truth = {.usage = {Usage::Kind::dominant, share}, .hit = hit}, .hit = hit, .averaged = true};
        }));
  all.push_back(regime("sensor", "The sensor is right with probability h; the classifiers believe 0.7", "h",
                       {0.9, 0.7, 0.5, 0.4, 0.3}, [](double hit) { return Setting{.truth = {.hit = hit}}; }));
  for (const double alpha : {0.5, 0.1})
    all.push_back(regime(fmt::format("learned_{}", alpha),
                         fmt::format("Usage is Dirichlet({0}); p(f|c) is learned from n labelled reports of each "
                                     "platform, under an earlier draw of the usage",
                                     alpha),
                         "n", {1.0, 3.0, 10.0, 30.0, 100.0, 1000.0}, [&](double seen) {
                           return Setting{.truth = {.usage = dirichlet(alpha)}, .seen = static_cast<std::size_t>(seen)};
                         }));
  for (const double elsewhere : {0.0, 0.2})
    all.push_back(regime(fmt::format("unlisted_{}", elsewhere),
                         fmt::format("A report comes from an emitter that the platform does not carry with probability "
                                     "u; believed possible to {}",
                                     elsewhere),
                         "u", {0.0, 0.1, 0.2, 0.4}, [&](double unlisted) {
                           return Setting{.truth = {.unlisted = unlisted}, .elsewhere = elsewhere};
                         }));
  all.push_back(regime("conflict", "Two sensors; in a share s of the runs the second listens to another platform", "s",
                       {0.0, 0.25, 0.5, 1.0},
                       [](double astray) { return Setting{.truth = {.astray = astray, .sensors = 2}}; }));
  return all;
}

ResultTable regime_table(const Regime& regime) {
  ResultTable table;
  for (const Setting& setting : regime.settings) {
    std::vector<Field> row = {{of_words("", "setting"), setting.name}};
    for (const Score& score : setting.scores) {
      const std::string group = score.name + ":";
      row.push_back({{.header = "right, %", .digits = 1, .scale = 100.0, .group = group}, score.accuracy()});
      if (&score != &setting.scores.front())
        row.push_back(
            {{.header = "− sigma's", .scale = 100.0, .sign = true, .group = group}, score.minus_first.interval()});
    }
    table.row_of(row);
  }
  return table;
}

/// How often possibilities did better and worse, by more than the interval, and where better. What is the same in every
/// run counts once.
std::pair<std::string, ResultTable> verdict_of(const std::vector<Regime>& all) {
  ResultTable better({of_words("", "regime"),
                      of_words("", "setting"),
                      of_words("", "better than sigma"),
                      {.header = "points", .scale = 100.0, .sign = true}});
  std::size_t better_count = 0, worse = 0, undecided = 0;
  for (const Regime& regime : all)
    for (const Setting& setting : regime.settings)
      for (const Score& score : setting.scores) {
        const Interval difference = score.minus_first.interval();
        const auto decides_alike = [&](const Score& other) {
          const Interval its = other.minus_first.interval();
          return its.mean == difference.mean && its.half_width == difference.half_width;
        };
        if (!score.has_possibilities || std::any_of(setting.scores.data(), &score, decides_alike)) continue;
        ++(difference.above_zero() ? better_count : difference.below_zero() ? worse : undecided);
        if (difference.above_zero()) better.row({regime.name, setting.name, score.name, difference});
      }
  return {fmt::format("Of {} comparisons with sigma inference at 95 % each, {} are worse, {} undecided, {} better; one "
                      "in forty would be better by chance. Classifiers that decide alike in every run count once.",
                      better_count + worse + undecided, worse, undecided, better_count),
          std::move(better)};
}

/// Points more than sigma inference, by setting and classifier.
HeatMap regime_map(const Regime& regime) {
  HeatMap map{.title = fmt::format("Regime {}", regime.name),
              .row_label = "setting",
              .column_label = "classifier",
              .value_label = "points more than sigma inference",
              .diverging = true,
              .digits = 1,
              .scale = 100.0,
              .sign = true,
              .most = 0.2,
              .note = regime.description + "."};
  for (const Score& score : std::span(regime.settings.front().scores).subspan(1)) map.columns.push_back(score.name);
  for (const Setting& setting : regime.settings) map.rows.push_back(setting.name);
  map.fill([&](std::size_t r, std::size_t c) {
    const auto& scores = regime.settings[r].scores;
    const Interval points = scores[c + 1].minus_first.interval();
    return HeatMap::Cell{std::abs(points.mean) < 1e-12 ? 0.0 : points.mean,  // what only rounding parts
                         fmt::format("± {:.1f}; {:.1f} % right, sigma {:.1f} %", 100.0 * points.half_width,
                                     100.0 * scores[c + 1].accuracy(), 100.0 * scores.front().accuracy())};
  });
  return map;
}

Condition condition_of(const EsmWorld& world, const Setting& setting, std::size_t reports, std::uint64_t seed) {
  const auto contestants = [&](RandomStream& random) {
    return setting.seen > 0 ? learned(world, setting, random) : from_the_lists(world, setting);
  };
  RandomStream for_names(seed, 0);
  return {contestants(for_names), [&, contestants, reports, seed](std::size_t run) {
            RandomStream random(seed, run);
            auto anew = setting.seen > 0 ? contestants(random) : std::vector<NamedClassifier>();
            Drawn drawn = draw_run(world, setting.truth, reports, random);
            drawn.contestants = std::move(anew);
            return drawn;
          }};
}

void tell(const std::vector<Regime>& all, std::size_t reports, const DrawOptions& draws, Result& result) {
  const auto [verdict, better] = verdict_of(all);
  result.page.groups.clear();  // no chart has curves
  result.page.verdict = {
      verdict, fmt::format("Synthetic emitter world; {} runs of {} reports for each setting, seed {}. Purple: more "
                           "often right than sigma inference, orange: more seldom; the colours end at 20 points.",
                           draws.runs, reports, draws.seed)};
  result.say(
      "Synthetic emitter world, not recorded data; {} runs of {} reports for each setting, seed {}. Differences are "
      "points ± 95 % by paired runs.",
      draws.runs, reports, draws.seed);
  for (const Regime& regime : all) {
    result.text += "\n";
    result.say(regime.description);
    result.add(regime_table(regime), {});
    result.page.panels.emplace_back(regime_map(regime));
  }
  result.text += "\n";
  result.say(verdict);
  if (!better.empty()) result.add(better, {.title = "Better than sigma inference"});
  result.facts("synthetic", true, "runs", draws.runs, "reports", reports, "seed", draws.seed);
  auto rows = ResultTable::of_keys({"regime", "setting", "classifier", "accuracy", "difference", "lower", "upper"});
  for (const Regime& regime : all)
    for (const Setting& setting : regime.settings) {
      result.add(scores_table(setting.scores), {.printed = false, .summary = {"regimes", regime.name, setting.name}});
      for (const Score& score : setting.scores) {
        const Interval difference = score.minus_first.interval();
        rows.row({regime.name, setting.name, score.name, score.accuracy(), difference.mean, difference.lower(),
                  difference.upper()});
      }
    }
  result.add(rows, {.printed = false, .csv = "regimes.csv"});
}

}  // namespace

std::vector<std::string> regime_names() { return each(regimes(), &Regime::name); }

void run_regimes(const std::string& name_or_all, std::size_t reports, const DrawOptions& draws) {
  ResultFiles files(draws.output);
  const EsmWorld esm;
  auto all = regimes();
  if (name_or_all != "all") std::erase_if(all, [&](const Regime& regime) { return regime.name != name_or_all; });
  World world{"Where is max inference the better one?", {}};
  for (const Regime& regime : all)
    for (const Setting& setting : regime.settings)
      world.conditions.push_back(condition_of(esm, setting, reports, draws.seed));
  world.tell = [&](const std::vector<Scores>& scores, Result& result) {
    auto next = scores.begin();
    for (Regime& regime : all)
      for (Setting& setting : regime.settings) setting.scores = *next++;
    tell(all, reports, draws, result);
  };
  run_world(world, draws, files);
}

}  // namespace sigmax::apps
