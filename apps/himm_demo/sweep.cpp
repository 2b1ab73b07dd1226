#ifdef SIGMAX_TUNING
#include <sigmax/tuning/search.hpp>
#else
#include <sigmax/hybrid/fit.hpp>
#endif

#include "himm_demo/experiment/tally.hpp"
#include "report/result.hpp"
#include "shell/command_line.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

/// What a condition has otherwise than the paper, as multiples: the noise of the radar, believed over true; the
/// sampling period; the acceleration and the length of the manoeuvre.
enum Factor : std::size_t { noise, period, strength, length };
constexpr std::array factor_names = {"noise", "period", "strength", "length"};
constexpr std::array factor_options = {"--mismatch", "--period", "--strength", "--length"};

using Numbers = std::vector<double>;
const std::vector<std::string> rule_names = {"zero", "borrowed_variance", "unbiased"};  // of StateAugmentation

#ifndef SIGMAX_TUNING
struct SearchOptions {
  std::size_t samples, starts, local;
};
template <class Loss>
Fit search(const std::vector<FitParameter>&, const Loss&, const SearchOptions&) {
  throw InputError(
      "this himm_demo was built without an optimiser; install libnlopt-cxx-dev, run cmake again and build it");
}
#endif

/// The options of `himm_demo sweep`, nearly all of which decide its figures.
struct SweepOptions {
  std::vector<int> scenarios = {1, 2};
  std::array<Numbers, 4> factors = {{{0.5, 1.0, 2.0}, {0.5, 1.0, 2.0}, {0.25, 0.5, 1.0, 2.0}, {0.5, 1.0, 2.0}}};
  bool cross = false;  ///< every combination of these rather than each alone, the others being 1
  std::vector<std::string> filters = {"imm",           "himm_selected", "himm_own", "himm_own_recentred",
                                      "himm_released", "gpb2",          "viterbi"};
  /// @{
  /// What is searched, from the least to the greatest of these; one number stays as it is.
  Numbers probability = {1e-6, 0.9};  ///< the off-diagonals of P, each row apart
  Numbers possibility = {1e-6, 1.0};  ///< the same of Π
  Numbers sigma_w = {0.1, 100.0};     ///< of each model apart
  std::vector<std::string> rules = rule_names;
  /// @}
  int tuning_runs = 20;
  int runs = 100;
  std::uint64_t seed = 1;
  Sharing sharing;
  OutputOptions output;
};

/// One situation in which filters are compared.
struct SweepCondition {
  int scenario;
  std::array<double, 4> factors{1.0, 1.0, 1.0, 1.0};

  bool operator==(const SweepCondition&) const = default;
};

std::vector<SweepCondition> conditions_of(const SweepOptions& options) {
  std::vector<SweepCondition> all;
  for (const int scenario : options.scenarios) {
    std::vector<SweepCondition> own = {{scenario}};
    for (std::size_t i = 0; i < factor_names.size(); ++i) {
      const std::vector<SweepCondition> before = options.cross ? std::exchange(own, {}) : std::vector{own.front()};
      for (SweepCondition condition : before)
        for (const double factor : options.factors[i]) {
          condition.factors[i] = factor;
          if (std::ranges::find(own, condition) == own.end()) own.push_back(condition);
        }
    }
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

/// "1, strength ×0.5".
std::string words_of(const SweepCondition& condition) {
  std::string text = fmt::format("{}", condition.scenario);
  for (std::size_t i = 0; i < factor_names.size(); ++i)
    if (condition.factors[i] != 1.0) text += fmt::format(", {} ×{:g}", factor_names[i], condition.factors[i]);
  return text;
}

/// The scenario of the paper with another sampling period, and a manoeuvre of another strength and length.
Scenario scenario_of(const SweepCondition& condition) {
  Scenario result = scenario(condition.scenario, Preset::paper_text);
  const auto scaled = [&](int samples, double factor) {
    return std::max(1, static_cast<int>(std::lround(samples * factor / condition.factors[period])));
  };
  const auto& own = result.phases;
  const int before = std::max(own[0].first + 1, scaled(own[0].last, 1.0));
  const int during = scaled(own[1].last - own[1].first + 1, condition.factors[length]);
  const int after = scaled(own[2].last - own[2].first + 1, 1.0);
  result.step_s *= condition.factors[period];
  result.acceleration *= condition.factors[strength];
  result.last_accelerated = before + during;
  result.phases = {
      {{own[0].first, before}, {before + 1, before + during}, {before + during + 1, before + during + after}}};
  return result;
}

/// The settings of a filter that did best on the tuning runs, and what they did on others. The score is the mean over
/// axes and phases of RMSE over that of the measurement.
struct Tuned {
  Numbers numbers;  ///< leaving, returning, and sigma_w of both models
  std::size_t rule;
  double tuning_score;
  std::size_t tried;  ///< how many settings were
  Statistic score{};
};

/// Somebody by the filter that it is in each condition.
struct Rival {
  std::string name;
  std::vector<std::size_t> filter;
};

/// Whether zero is outside of it.
bool sure(const Interval& interval) { return interval.above_zero() || interval.below_zero(); }

/// All conditions and filters, and what was found of them.
class SweepWorld {
 public:
  const SweepOptions& options;
  std::vector<SweepCondition> conditions = conditions_of(options);
  std::vector<FilterSettings> filters;
  std::size_t imm;                 ///< its place among the filters, or their number
  std::vector<Tuned> all_tuned{};  ///< by condition and filter

  /// Throws InputError for a filter that there is not.
  explicit SweepWorld(const SweepOptions& what) : options(what) {
    const std::vector<std::string> sets = {fmt::format("filters=[{}]", fmt::join(options.filters, ","))};
    filters = read_filters(Settings::read({}, sets), defaults_of(Preset::paper_text, group(1, 1)));
    imm = static_cast<std::size_t>(std::ranges::find(filters, "imm", &FilterSettings::name) - filters.begin());
  }

  /// Tunes each filter in each condition and judges it on other runs. A cell is condition · filters + filter.
  Study study() const {
    const auto list = [](const auto& values) { return fmt::format("{}", fmt::join(values, ",")); };
    std::string command = fmt::format("himm_demo {} sweep --scenario {}", version, list(options.scenarios));
    for (std::size_t i = 0; i < factor_names.size(); ++i)
      command += fmt::format(" {} {}", factor_options[i], list(options.factors[i]));
    command += fmt::format(
        " --filters {} --probability {} --possibility {} --sigma-w {} --augmentation {} --tuning-runs {} --runs {} "
        "--seed {}{}",
        list(options.filters), list(options.probability), list(options.possibility), list(options.sigma_w),
        list(options.rules), options.tuning_runs, options.runs, options.seed, options.cross ? " --cross" : "");
    return {"cells", conditions.size() * filters.size(),
            [this](std::size_t cell) { return work(cell / filters.size(), cell % filters.size()); }, command};
  }

  /// Of the next cell.
  void add(const Study::Row& row) {
    all_tuned.push_back({Numbers(row.begin(), row.begin() + 4), static_cast<std::size_t>(row[4]), row[5],
                         static_cast<std::size_t>(row[6]), Statistic::of(std::span(row).subspan(7))});
  }

  const Tuned& tuned(std::size_t condition, std::size_t f) const { return all_tuned[condition * filters.size() + f]; }

  /// Whether there may be better ones beyond the ends of what was searched.
  bool at_the_limit(std::size_t cell) const {
    for (std::size_t i = 0; i < 4; ++i) {
      constexpr double near = 1.1;
      const Numbers& range = this->range(cell % filters.size(), i);
      const double number = all_tuned[cell].numbers[i];
      const bool is_natural = i < 2 && range.back() >= 0.9;  // the greatest that means something
      if (range.size() > 1 && (number < near * range.front() || (number * near > range.back() && !is_natural)))
        return true;
    }
    return false;
  }

  /// The fuzzy interacting filter whose score on the tuning runs is the least: what is called HIMM.
  std::optional<std::size_t> himm(std::size_t condition) const {
    std::optional<std::size_t> best;
    for (std::size_t f = 0; f < filters.size(); ++f)
      if (filters[f].fuzzy && filters[f].scheme == Scheme::interacting &&
          (!best || tuned(condition, f).tuning_score < tuned(condition, *best).tuning_score))
        best = f;
    return best;
  }

  /// Who is compared with the tuned IMM: HIMM, if there is one, and each filter; nobody without the IMM.
  std::vector<Rival> rivals() const {
    std::vector<Rival> all;
    if (imm == filters.size()) return all;
    if (himm(0)) all.push_back({"HIMM", each_below(conditions.size(), [&](std::size_t c) { return *himm(c); })});
    for (std::size_t f = 0; f < filters.size(); ++f)
      if (f != imm) all.push_back({filters[f].name, std::vector(conditions.size(), f)});
    return all;
  }

  /// By how much the score is above that of the tuned IMM, relatively; one of as many intervals as there are
  /// conditions.
  Interval against_imm(std::size_t condition, std::size_t f) const {
    return (tuned(condition, f).score / tuned(condition, imm).score - 1.0).interval(conditions.size());
  }

 private:
  const Numbers& range(std::size_t f, std::size_t number) const {
    return number > 1 ? options.sigma_w : filters[f].fuzzy ? options.possibility : options.probability;
  }
  FilterSettings settings(std::size_t condition, std::size_t f, const Numbers& numbers, std::size_t rule) const {
    const double mismatch = conditions[condition].factors[noise];
    const Polar sigma = group(1, conditions[condition].scenario).data;
    FilterSettings own = filters[f];
    own.accuracy.radar = {mismatch * sigma.range, mismatch * sigma.azimuth.radians(),
                          mismatch * sigma.elevation.radians()};
    own.transition = {{own.fuzzy ? 1.0 : 1.0 - numbers[0], numbers[0]},
                      {numbers[1], own.fuzzy ? 1.0 : 1.0 - numbers[1]}};
    for (const std::size_t model : {0U, 1U}) own.motions[model][MotionParameter::sigma_w] = numbers[2 + model];
    own.augmentation =
        static_cast<StateAugmentation>(std::ranges::find(rule_names, options.rules[rule]) - rule_names.begin());
    return own;
  }
  Tally tally(std::size_t condition, const FilterSettings& filter) const {
    const SweepCondition& own = conditions[condition];
    return Tally({scenario_of(own), group(1, own.scenario), {filter}, options.runs, options.seed, 0});
  }

  // What was tuned, as `add` takes it. All rules of augmentation are sampled alike, and the best one is searched
  // further.
  Study::Row work(std::size_t condition, std::size_t f) const {
    const auto whole = [&](const Numbers& free) {
      Numbers numbers;
      for (std::size_t i = 0, next = 0; i < 4; ++i)
        numbers.push_back(range(f, i).size() == 1 ? range(f, i).front() : free[next++]);
      return numbers;
    };
    const auto loss_of = [&](std::size_t rule) {
      return [=, this](const Numbers& free) {
        Tally tuning = tally(condition, settings(condition, f, whole(free), rule));
        try {
          tuning.add(tuning.row(0, static_cast<std::uint64_t>(options.tuning_runs)));
        } catch (const std::exception&) {
          return infinity;  // a filter that fails with bad settings has no good score
        }
        return tuning.over_measurement(1).value();
      };
    };
    std::vector<FitParameter> free;
    for (std::size_t i = 0; i < 4; ++i)
      if (const Numbers& all = range(f, i); all.size() > 1)
        free.push_back({.name = fmt::format("{}", i),
                        .start = i > 1              ? 3.0
                                 : filters[f].fuzzy ? 0.5
                                                    : 0.05,
                        .least = all.front(),
                        .most = all.back(),
                        .step = std::min(0.5, 0.25 * std::log(all.back() / all.front()))});
    Tuned best{{}, 0, infinity, 0};
    const auto take = [&](std::size_t rule, const SearchOptions& how) {
      const auto loss = loss_of(rule);
      const Fit found = free.empty() ? Fit{{}, loss({}), 1} : search(free, loss, how);
      best.tried += found.evaluations;
      if (!best.numbers.empty() && found.loss >= best.tuning_score) return;
      best.rule = rule;
      best.tuning_score = found.loss;
      best.numbers = whole(found.values);
      for (std::size_t i = 0; i < free.size(); ++i) free[i].start = found.values[i];
    };
    for (std::size_t rule = 0; rule < options.rules.size(); ++rule)
      take(rule, {.samples = 16, .starts = 1, .local = 12});
    if (!free.empty()) take(best.rule, {.samples = 0, .starts = 1, .local = 40});

    Tally judged = tally(condition, settings(condition, f, best.numbers, best.rule));
    const int batches = std::min(25, options.runs);
    const auto bound = [&](int batch) {
      return static_cast<std::uint64_t>(options.tuning_runs + static_cast<long>(options.runs) * batch / batches);
    };
    for (int batch = 0; batch < batches; ++batch) judged.add(judged.row(bound(batch), bound(batch + 1)));
    Study::Row row = best.numbers;
    row.insert(row.end(), {static_cast<double>(best.rule), best.tuning_score, static_cast<double>(best.tried)});
    const Numbers score = judged.over_measurement(1).numbers();
    row.insert(row.end(), score.begin(), score.end());
    return row;
  }
};

/// HIMM against the tuned IMM in words; nothing where one of them is missing.
std::string answer(const SweepWorld& world) {
  const std::vector<Rival> rivals = world.rivals();
  if (rivals.empty() || rivals.front().name != "HIMM") return "";
  std::size_t better = 0, worse = 0, best = 0;
  const auto difference = [&](std::size_t c) { return world.against_imm(c, rivals.front().filter[c]); };
  for (std::size_t c = 0; c < world.conditions.size(); ++c) {
    better += difference(c).below_zero() ? 1 : 0;
    worse += difference(c).above_zero() ? 1 : 0;
    if (difference(c).mean < difference(best).mean) best = c;
  }
  return fmt::format(
      "HIMM is better than the tuned IMM in {} of {} conditions, worse in {}, and {} are open. At best its score "
      "differs by {} ± {} %: scenario {}. HIMM is what did best on the tuning runs under any reading of (57).",
      better, world.conditions.size(), worse, world.conditions.size() - better - worse,
      number_text(100.0 * difference(best).mean, 1, true), number_text(100.0 * difference(best).half_width, 1),
      words_of(world.conditions[best]));
}

/// How many settings were tried, and by how many runs.
std::string searched(const SweepWorld& world) {
  std::size_t tried = 0;
  for (const Tuned& tuned : world.all_tuned) tried += tuned.tried;
  return fmt::format("{} filters, about {} settings each; chosen by {} runs and judged by {} others, seed {}",
                     world.filters.size(), tried / world.all_tuned.size(), world.options.tuning_runs,
                     world.options.runs, world.options.seed);
}

/// How many of the tuned filters are at the limit of the search; empty if none is.
std::string limits(const SweepWorld& world) {
  std::size_t stopped = 0;
  for (std::size_t cell = 0; cell < world.all_tuned.size(); ++cell) stopped += world.at_the_limit(cell) ? 1 : 0;
  if (stopped == 0) return "";
  return fmt::format("{} of {} tuned filters have a number at an end of its range: there may be better ones beyond.",
                     stopped, world.all_tuned.size());
}

/// Parts of the table of all filters in all conditions: with the numbers or the name of the condition.
struct ConditionPart {
  enum : unsigned { numbers = 1, name = 2 };
};

ResultTable filters_table(const SweepWorld& world) {
  ResultTable table;
  for (std::size_t cell = 0; cell < world.all_tuned.size(); ++cell) {
    const std::size_t c = cell / world.filters.size(), f = cell % world.filters.size();
    const SweepCondition& condition = world.conditions[c];
    const Tuned& tuned = world.all_tuned[cell];
    std::vector<Field> fields = {{{.key = "scenario", .parts = ConditionPart::numbers}, condition.scenario}};
    for (std::size_t i = 0; i < factor_names.size(); ++i)
      fields.push_back({{.key = factor_names[i], .parts = ConditionPart::numbers}, condition.factors[i]});
    fields.insert(fields.end(),
                  {{of_words("condition", "scenario", ConditionPart::name), words_of(condition)},
                   {of_words("filter", "filter"), world.filters[f].name},
                   {{.key = "leaving", .header = "leaving", .digits = 3, .sized = true}, tuned.numbers[0]},
                   {{.key = "returning", .header = "returning", .digits = 3, .sized = true}, tuned.numbers[1]},
                   {{.key = "sigma_w_dwna", .header = "dwna", .sized = true, .group = "σ_w, m/s²:"}, tuned.numbers[2]},
                   {{.key = "sigma_w_dwpa", .header = "dwpa", .sized = true, .group = "σ_w, m/s²:"}, tuned.numbers[3]},
                   {of_words("augmentation", "augmentation"), world.options.rules[tuned.rule]},
                   {{.key = "at_the_limit"}, world.at_the_limit(cell) ? 1 : 0},
                   {{.key = "tuning_score", .header = "tuning", .digits = 3, .group = "score:"}, tuned.tuning_score},
                   {{.key = "score", .header = "judged", .digits = 3, .interval = true, .group = "score:"},
                    tuned.score.interval()},
                   {{.key = "above_imm", .header = "% above imm", .digits = 1, .scale = 100.0, .interval = true},
                    world.imm < world.filters.size() ? Cell(world.against_imm(c, f)) : Cell()}});
    table.row_of(fields);
  }
  return table;
}

/// The score of the tuned IMM, and by how much the others are above it, with a mark where the interval is on one side
/// of zero.
ResultTable above_imm_table(const SweepWorld& world) {
  std::vector<Rival> rivals = world.rivals();
  if (world.himm(0)) std::rotate(rivals.begin(), rivals.begin() + 1, rivals.end());
  ResultTable table;
  for (std::size_t c = 0; c < world.conditions.size(); ++c) {
    std::vector<Field> fields = {{of_words("", "scenario"), words_of(world.conditions[c])},
                                 {{.header = "imm", .digits = 3}, world.tuned(c, world.imm).score.value()}};
    for (const Rival& rival : rivals) {
      const Interval above = world.against_imm(c, rival.filter[c]);
      fields.push_back({{.header = lower_case(rival.name), .group = "% above imm:"},
                        number_text(100.0 * above.mean, 1, true) + (sure(above) ? "*" : " ")});
    }
    table.row_of(fields);
  }
  return table;
}

/// By how much rivals, the columns, are above the tuned IMM in conditions, the rows.
HeatMap above_imm_map(const SweepWorld& world, HeatMap map, const std::vector<std::size_t>& conditions) {
  const std::vector<Rival> rivals = world.rivals();
  auto sizes = each_below(world.conditions.size(),
                          [&](std::size_t c) { return std::abs(world.against_imm(c, rivals.front().filter[c]).mean); });
  std::ranges::sort(sizes);
  map.most = sizes[sizes.size() * 19 / 20];
  map.value_label = "% above the score of the tuned IMM";
  map.diverging = map.sign = true;
  map.digits = 1;
  map.scale = 100.0;
  map.note =
      fmt::format("Negative is better. *: the interval is on one side of 0. Colours are strongest from ± {} % on.",
                  number_text(100.0 * *map.most, 1));
  map.fill([&](std::size_t row, std::size_t column) {
    const std::size_t c = conditions[row], f = rivals[column].filter[c];
    const auto& [numbers, rule, tuning_score, tried, judged] = world.tuned(c, f);
    const Interval above = world.against_imm(c, f), score = judged.interval();
    return HeatMap::Cell{
        above.mean,
        fmt::format("± {} %, score {} ± {}; {}: leaving {}, returning {}, sigma_w {} and {}, augmentation {}{}",
                    number_text(100.0 * above.half_width, 1), number_text(score.mean, 3),
                    number_text(score.half_width, 3), world.filters[f].name, numbers[0], numbers[1], numbers[2],
                    numbers[3], world.options.rules[rule],
                    world.at_the_limit(c * world.filters.size() + f) ? ", at the limit of the search" : ""),
        sure(above)};
  });
  return map;
}

/// Conditions by filters, a map for each scenario.
std::vector<Panel> maps_of_all(const SweepWorld& world) {
  std::vector<Panel> panels;
  for (const int scenario : world.options.scenarios) {
    HeatMap map{.title = fmt::format("Scenario {}", scenario),
                .row_label = "condition",
                .column_label = "filter",
                .columns = each(world.rivals(), &Rival::name)};
    std::vector<std::size_t> own;
    for (std::size_t c = 0; c < world.conditions.size(); ++c) {
      if (world.conditions[c].scenario != scenario) continue;
      const std::string words = words_of(world.conditions[c]);
      map.rows.push_back(words.size() > 3 ? words.substr(3) : "as in the paper");
      own.push_back(c);
    }
    panels.emplace_back(above_imm_map(world, std::move(map), own));
  }
  return panels;
}

void report(const SweepWorld& world) {
  constexpr std::size_t most_rows = 300;  // of a table in the page
  ResultFiles files(world.options.output);
  Result result(world.options.output);
  const ResultTable filters = filters_table(world);
  const std::string answered = answer(world), stopped = limits(world);
  const bool all_shown = world.all_tuned.size() <= most_rows;
  result.facts("campaign", world.study().description, "searched", searched(world));
  result.say(searched(world));
  const bool compares = world.imm < world.filters.size();
  if (compares) {
    result.add(above_imm_table(world), {});
    result.say(
        "(imm: mean over axes and phases of RMSE over that of the measurement. *: the 95 % interval, by paired runs "
        "and together for all conditions, is on one side of 0. Negative is better.)");
    result.say("");
  }
  if (!answered.empty()) result.fact({"answer"}, answered);
  result.say({{!answered.empty(), answered}, {!stopped.empty(), stopped}});
  result.add(filters.part(ConditionPart::numbers, ""), {.printed = false, .csv = "tuned.csv"});
  result.add(filters.part(ConditionPart::name, "scenario"),
             {.printed = false, .title = all_shown ? "The best settings" : ""});
  Report& page = result.page;
  page.title = "Every filter at its best settings, against the tuned IMM";
  if (!answered.empty()) page.verdict.push_back(answered);
  if (!stopped.empty()) page.verdict.push_back(stopped);
  page.verdict.push_back(searched(world) +
                         ". The score is the mean over axes and phases of RMSE over that of the measurement.");
  if (!all_shown)
    page.verdict.emplace_back("The best settings of every filter are in tuned.csv, and in each cell of the maps.");
  if (compares && world.filters.size() > 1) page.panels = maps_of_all(world);
  result.publish(files);
}

template <class Value>
Option add_list(Subcommand& app, const std::string& name, std::vector<Value>& values, const std::string& meaning) {
  return app.option(name, values, fmt::format("{} [{}]", meaning, fmt::join(values, ", "))).list().text("A,B,…");
}

}  // namespace

void add_sweep(CLI::App& program, const std::string& command) {
  Subcommand app(program, "sweep", "Every filter at its best settings, in many conditions.");
  const auto options = std::make_shared<SweepOptions>();
  const auto add_range = [&](const char* name, Numbers& range, double least, double most, const char* meaning) {
    add_list(app, name, range, meaning).number_in(least, most);
  };
  add_list(app, "--scenario", options->scenarios, "1: fire control radar, 2: surveillance radar").in({1, 2});
  constexpr std::array meanings = {"Noise of the radar, believed over true", "Sampling period, times the paper's",
                                   "Acceleration, times the paper's", "Length of the manoeuvre, times the paper's"};
  for (std::size_t i = 0; i < meanings.size(); ++i)
    add_list(app, factor_options[i], options->factors[i], meanings[i]).number_in(0.05, 20.0);
  app.flag("--cross", options->cross, "Every combination of these four, rather than each alone with the others 1");
  add_list(app, "--filters", options->filters, "Names as of the setting filters; the others are compared with imm");
  add_range("--probability", options->probability, 1e-12, 0.9,
            "Off-diagonals of P, the two rows apart: one, or the least and the greatest");
  add_range("--possibility", options->possibility, 1e-12, 1.0, "The same of the matrix of possibilities");
  add_range("--sigma-w", options->sigma_w, 1e-6, 1e6, "The same of sigma_w in m/s², the two models apart");
  add_list(app, "--augmentation", options->rules, "What stands for a component that a model lacks").one_of(rule_names);
  app.option("--tuning-runs", options->tuning_runs, "Runs by which the best settings are chosen").in(1, 1000000);
  app.option("--runs", options->runs, "Other runs by which they are judged").in(2, 1000000);
  add_seed(app, options->seed);
  add_threads(app, options->sharing.threads);
  add_shard(app, options->sharing);
  add_results(app, options->output, command);
  app.run([options] {
    for (Numbers* const range : {&options->probability, &options->possibility, &options->sigma_w}) {
      const auto [least, greatest] = std::ranges::minmax(*range);
      *range = least < greatest ? Numbers{least, greatest} : Numbers{least};
    }
    SweepWorld world(*options);
    const auto add = [&](std::size_t, const Study::Row& row) { world.add(row); };
    if (run(world.study(), options->sharing, options->output, add)) report(world);
  });
}

}  // namespace sigmax::apps
