#include "himm_demo/subcommands.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "himm_demo/sweep/world.hpp"
#include "result/result.hpp"
#include "support/command_line.hpp"
#include "support/options.hpp"

namespace sigmax::apps {
namespace {

struct SweepOptions {
  SweepChoice choice;
  Sharing sharing;
  OutputOptions output;
};

/// "1, strength ×0.5".
std::string words_of(const SweepCondition& condition) {
  std::string text = fmt::format("{}", condition.scenario);
  for (const auto& [name, factor] : {std::pair{"noise", condition.mismatch},
                                     {"period", condition.period},
                                     {"strength", condition.strength},
                                     {"length", condition.length}})
    if (factor != 1.0) text += fmt::format(", {} ×{:g}", name, factor);
  return text;
}

/// Whether zero is outside of it.
bool sure(const Interval& interval) { return interval.above_zero() || interval.below_zero(); }

/// HIMM against the tuned IMM in words; nothing where one of them is missing.
std::string answer(const SweepWorld& world) {
  if (!world.imm() || !world.himm(0)) return "";
  std::size_t better = 0, worse = 0, open = 0, best = 0;
  const auto difference = [&](std::size_t c) { return world.against_imm(c, *world.himm(c)); };
  for (std::size_t c = 0; c < world.conditions().size(); ++c) {
    ++(difference(c).below_zero() ? better : difference(c).above_zero() ? worse : open);
    if (difference(c).mean < difference(best).mean) best = c;
  }
  return fmt::format(
      "HIMM is better than the tuned IMM in {} of {} conditions, worse in {}, and {} are open. At best its score "
      "differs by {} ± {} %: scenario {}. HIMM is what did best on the tuning runs under any reading of (57).",
      better, world.conditions().size(), worse, open, number_text(100.0 * difference(best).mean, 1, true),
      number_text(100.0 * difference(best).half_width, 1), words_of(world.conditions()[best]));
}

/// How many settings were tried, and by how many runs.
std::string searched(const SweepWorld& world) {
  const SweepChoice& choice = world.choice();
  std::string text = fmt::format("{} filters, {} settings each", world.filters().size(), world.listed_settings(0));
  if (choice.beyond > 0) {
    std::size_t tried = 0;
    for (const Tuned& tuned : world.all_tuned()) tried += tuned.tried;
    text += fmt::format(
        " and about {} with those on the way from the best to better neighbours, up to {} steps beyond a list",
        tried / world.all_tuned().size(), choice.beyond);
  }
  return text + fmt::format("; chosen by {} runs and judged by {} others, seed {}", choice.tuning_runs, choice.runs,
                            choice.seed);
}

/// How many of the tuned filters are at the limit of the search; empty if none is.
std::string limits(const SweepWorld& world) {
  const auto stopped = std::count_if(world.all_tuned().begin(), world.all_tuned().end(),
                                     [](const Tuned& tuned) { return tuned.at_the_limit; });
  if (stopped == 0) return "";
  return fmt::format(
      "{} of {} tuned filters {}: there may be better ones beyond.", stopped, world.all_tuned().size(),
      world.choice().beyond == 0 ? "have a number at an end of its list" : "stopped at the limit beyond a list");
}

/// Parts of the table of all filters in all conditions: with the numbers or the name of the condition, or for one.
struct ConditionPart {
  enum : unsigned { numbers = 1, name = 2 };
};

ResultTable filters_table(const SweepWorld& world) {
  ResultTable table;
  for (std::size_t c = 0; c < world.conditions().size(); ++c)
    for (std::size_t f = 0; f < world.filters().size(); ++f) {
      const SweepCondition& condition = world.conditions()[c];
      const Tuned& tuned = world.tuned(c, f);
      const FilterSettings settings = world.settings(c, f);
      const auto sigma_w = [&](std::size_t model) { return settings.motions[model][MotionParameter::sigma_w]; };
      const Cell above_imm = world.imm() ? Cell(world.against_imm(c, f)) : Cell();
      table.row_of(
          {{{.key = "scenario", .parts = ConditionPart::numbers}, condition.scenario},
           {{.key = "noise", .parts = ConditionPart::numbers}, condition.mismatch},
           {{.key = "period", .parts = ConditionPart::numbers}, condition.period},
           {{.key = "strength", .parts = ConditionPart::numbers}, condition.strength},
           {{.key = "length", .parts = ConditionPart::numbers}, condition.length},
           {{.key = "condition", .header = "scenario", .align = Align::left, .parts = ConditionPart::name},
            words_of(condition)},
           {{.key = "filter", .header = "filter", .align = Align::left}, settings.name},
           {{.key = "leaving", .header = "leaving", .digits = 3, .sized = true}, settings.transition[0][1]},
           {{.key = "returning", .header = "returning", .digits = 3, .sized = true}, settings.transition[1][0]},
           {{.key = "sigma_w_dwna", .header = "dwna", .sized = true, .group = "σ_w, m/s²:"}, sigma_w(0)},
           {{.key = "sigma_w_dwpa", .header = "dwpa", .sized = true, .group = "σ_w, m/s²:"}, sigma_w(1)},
           {{.key = "lift", .header = "lift", .align = Align::left}, name_of(settings.lift)},
           {{.key = "at_the_limit"}, tuned.at_the_limit ? 1 : 0},
           {{.key = "settings_tried"}, tuned.tried},
           {{.key = "tuning_score", .header = "tuning", .digits = 3, .group = "score:"}, tuned.tuning_score},
           {{.key = "score", .header = "judged", .digits = 3, .interval = true, .group = "score:"},
            tuned.score.interval()},
           {{.key = "above_imm", .header = "% above imm", .digits = 1, .scale = 100.0, .interval = true}, above_imm},
           {{.key = "is_himm"}, world.himm(c) == f ? 1 : 0}});
    }
  return table;
}

/// The score of the tuned IMM, and by how much the others are above it, with a mark where the interval is on one side
/// of zero.
ResultTable above_imm_table(const SweepWorld& world) {
  std::vector<ResultColumn> columns = {{.header = "scenario", .align = Align::left}, {.header = "imm", .digits = 3}};
  for (const auto& filter : world.filters())
    if (filter.name != "imm") columns.push_back({.header = filter.name, .group = "% above imm:"});
  columns.push_back({.header = "himm", .group = "% above imm:"});
  ResultTable table(columns);
  for (std::size_t c = 0; c < world.conditions().size(); ++c) {
    const auto marked = [&](std::size_t f) {
      const Interval above = world.against_imm(c, f);
      return Cell(number_text(100.0 * above.mean, 1, true) + (sure(above) ? "*" : " "));
    };
    std::vector<Cell> cells = {words_of(world.conditions()[c]), world.tuned(c, *world.imm()).score.value()};
    for (std::size_t f = 0; f < world.filters().size(); ++f)
      if (f != *world.imm()) cells.push_back(marked(f));
    const auto himm = world.himm(c);
    cells.push_back(himm ? marked(*himm) : Cell());
    table.row(std::move(cells));
  }
  return table;
}

/// Whom a column or a view of maps is of: a filter, or HIMM, which is another one in each condition.
struct Choice {
  std::string name;
  std::optional<std::size_t> filter;

  std::size_t in(const SweepWorld& world, std::size_t condition) const {
    return filter ? *filter : *world.himm(condition);
  }
};

/// Makes maps of by how much filters are above the tuned IMM.
class Maps {
 public:
  explicit Maps(const SweepWorld& world) : world_(world) {
    if (world.himm(0)) choices_.push_back({"HIMM", {}});
    for (std::size_t f = 0; f < world.filters().size(); ++f)
      if (f != world.imm()) choices_.push_back({world.filters()[f].name, f});
    std::vector<double> sizes;
    for (std::size_t c = 0; c < world.conditions().size(); ++c)
      sizes.push_back(std::abs(world.against_imm(c, choices_.front().in(world, c)).mean));
    std::sort(sizes.begin(), sizes.end());
    most_ = sizes[sizes.size() * 19 / 20];
  }

  /// Conditions by filters, a map for each scenario.
  std::vector<Panel> of_all_filters() const {
    std::vector<Panel> panels;
    for (const int scenario : world_.choice().scenarios) {
      HeatMap map = empty(fmt::format("Scenario {}", scenario), "condition", "filter");
      for (const Choice& choice : choices_) map.columns.push_back(choice.name);
      std::vector<std::size_t> own;
      for (std::size_t c = 0; c < world_.conditions().size(); ++c) {
        if (world_.conditions()[c].scenario != scenario) continue;
        const std::string words = words_of(world_.conditions()[c]);
        map.rows.push_back(words.size() > 3 ? words.substr(3) : "as in the paper");
        own.push_back(c);
      }
      map.fill([&](std::size_t r, std::size_t column) { return cell(own[r], choices_[column]); });
      panels.emplace_back(std::move(map));
    }
    return panels;
  }

  /// All conditions of a scenario, a view for each filter: strength and length by noise and period.
  std::vector<View> of_each_filter() const {
    const SweepChoice& all = world_.choice();
    const std::size_t lengths = all.length.size(), periods = all.period.size();
    const auto names = [](const std::vector<double>& first, const std::vector<double>& second) {
      std::vector<std::string> crossed;
      for (const double a : first)
        for (const double b : second) crossed.push_back(fmt::format("×{:g}, ×{:g}", a, b));
      return crossed;
    };
    std::vector<View> views;
    for (const Choice& choice : choices_) {
      View& view = views.emplace_back(View{choice.name, {}});
      for (const int scenario : all.scenarios) {
        HeatMap map = empty(fmt::format("{}, scenario {}", choice.name, scenario), "strength, length of the manoeuvre",
                            "noise, period");
        map.rows = names(all.strength, all.length);
        map.columns = names(all.mismatch, all.period);
        map.fill([&](std::size_t r, std::size_t c) {
          const auto& conditions = world_.conditions();
          const SweepCondition here{scenario, all.mismatch[c / periods], all.period[c % periods],
                                    all.strength[r / lengths], all.length[r % lengths]};
          const auto found = std::find(conditions.begin(), conditions.end(), here);
          return cell(static_cast<std::size_t>(found - conditions.begin()), choice);
        });
        view.panels.emplace_back(std::move(map));
      }
    }
    return views;
  }

 private:
  HeatMap empty(std::string title, std::string row_label, std::string column_label) const {
    return {.title = std::move(title),
            .row_label = std::move(row_label),
            .column_label = std::move(column_label),
            .rows = {},
            .columns = {},
            .values = {},
            .value_label = "% above the score of the tuned IMM",
            .diverging = true,
            .digits = 1,
            .scale = 100.0,
            .sign = true,
            .most = most_,
            .note = fmt::format(
                "Negative is better. *: the interval is on one side of 0. Colours are strongest from ± {} % on.",
                number_text(100.0 * most_, 1))};
  }

  HeatMap::Cell cell(std::size_t c, const Choice& choice) const {
    const std::size_t f = choice.in(world_, c);
    const FilterSettings settings = world_.settings(c, f);
    const Interval above = world_.against_imm(c, f), score = world_.tuned(c, f).score.interval();
    return {above.mean,
            fmt::format("± {} %, score {} ± {}; {}: leaving {}, returning {}, sigma_w {} and {}, lift {}{}",
                        number_text(100.0 * above.half_width, 1), number_text(score.mean, 3),
                        number_text(score.half_width, 3), settings.name, settings.transition[0][1],
                        settings.transition[1][0], settings.motions[0][MotionParameter::sigma_w],
                        settings.motions[1][MotionParameter::sigma_w], name_of(settings.lift),
                        world_.tuned(c, f).at_the_limit ? ", at the limit of the search" : ""),
            sure(above)};
  }

  const SweepWorld& world_;
  std::vector<Choice> choices_;
  double most_ = 0.0;
};

void report(const SweepOptions& options, const SweepWorld& world) {
  constexpr std::size_t most_rows = 300;  // of a table in the page
  ResultFiles files(options.output);
  Result result(options.output);
  const ResultTable filters = filters_table(world);
  const std::string answered = answer(world), stopped = limits(world);
  const bool all_shown = world.all_tuned().size() <= most_rows;
  result.fact({"campaign"}, world.study().description);
  result.fact({"searched"}, searched(world));
  result.say(searched(world));
  if (world.imm()) {
    result.add(above_imm_table(world), {});
    result.say(
        "(imm: mean over axes and phases of RMSE over that of the measurement. *: the 95 % interval, by paired runs "
        "and together for all conditions, is on one side of 0. Negative is better.)");
    result.say("");
  }
  if (!answered.empty()) result.fact({"answer"}, answered);
  result.say({{!answered.empty(), answered}, {!stopped.empty(), stopped}});
  result.add(filters.part(ConditionPart::numbers, ""), {.printed = false, .csv = "tuned.csv"});
  for (std::size_t c = 0; c < world.conditions().size(); ++c)
    result.add(filters.part(ResultColumn::all_parts ^ (ConditionPart::numbers | ConditionPart::name), "",
                            c * world.filters().size(), world.filters().size()),
               {.printed = false, .summary = {"conditions", words_of(world.conditions()[c])}});
  result.add(filters.part(ConditionPart::name, "scenario"),
             {.printed = false, .title = all_shown ? "The best settings" : "", .filtered_by = {"condition", "filter"}});
  Report& page = result.page;
  page.title = "Every filter at its best settings, against the tuned IMM";
  if (!answered.empty()) page.verdict.push_back(answered);
  if (!stopped.empty()) page.verdict.push_back(stopped);
  page.verdict.push_back(searched(world) +
                         ". The score is the mean over axes and phases of RMSE over that of the measurement.");
  if (!all_shown)
    page.verdict.emplace_back("The best settings of every filter are in tuned.csv, and in each cell of the maps.");
  if (world.imm() && world.filters().size() > 1) {
    const Maps maps(world);
    if (options.choice.cross) {
      page.chooser = "Filter";
      page.views = maps.of_each_filter();
    } else {
      page.panels = maps.of_all_filters();
    }
  }
  result.publish(files);
}

template <class Value>
Option add_list(Subcommand& app, const std::string& name, std::vector<Value>& values, const std::string& meaning) {
  return app.option(name, values, fmt::format("{} [{}]", meaning, fmt::join(values, ", "))).list().text("A,B,…");
}

void add_conditions(Subcommand& app, SweepChoice& choice) {
  const auto add_factors = [&](const char* name, std::vector<double>& values, const char* meaning) {
    add_list(app, name, values, meaning).number_in(0.05, 20.0);
  };
  add_list(app, "--scenario", choice.scenarios, "1: fire control radar, 2: surveillance radar").one_of({1, 2});
  add_factors("--mismatch", choice.mismatch, "Noise of the radar, believed over true");
  add_factors("--period", choice.period, "Sampling period, times the paper's");
  add_factors("--strength", choice.strength, "Acceleration, times the paper's");
  add_factors("--length", choice.length, "Length of the manoeuvre, times the paper's");
  app.flag("--cross", choice.cross, "Every combination of these four, rather than each alone with the others 1");
}

void add_settings(Subcommand& app, SweepChoice& choice) {
  add_list(app, "--filters", choice.filters, "Names as of the setting filters; the others are compared with imm");
  add_list(app, "--probability", choice.probability, "Off-diagonals of P, the two rows apart").number_in(1e-12, 1.0);
  add_list(app, "--possibility", choice.possibility, "Off-diagonals of the matrix of possibilities, the two rows apart")
      .number_in(1e-12, 1.0);
  add_list(app, "--sigma-w", choice.sigma_w, "sigma_w in m/s², the two models apart").number_in(1e-6, 1e6);
  add_list(app, "--lift", choice.lifts, "What stands for a component that a model lacks")
      .one_of({"zero", "borrowed_variance", "unbiased"});
  app.option("--beyond", choice.beyond,
             "Steps that the search may go beyond an end of a list of numbers, each by the ratio of the last two; 0: "
             "only what is listed")
      .in(0, 100)
      .shows_default();
}

}  // namespace

void add_sweep(CLI::App& program, const std::string& command) {
  Subcommand app(program, "sweep", "Every filter at its best settings, in many conditions.");
  const auto options = std::make_shared<SweepOptions>();
  options->output.command = command;
  add_conditions(app, options->choice);
  add_settings(app, options->choice);
  app.option("--tuning-runs", options->choice.tuning_runs, "Runs by which the best settings are chosen")
      .in(1, 1000000)
      .shows_default();
  app.option("--runs", options->choice.runs, "Other runs by which they are judged").in(2, 1000000).shows_default();
  add_seed(app, options->choice.seed);
  add_threads(app, options->sharing.threads);
  add_shard(app, options->sharing);
  app.footer(
      "With --out every finished cell, a filter in a condition, is on the disk at once: a command that was killed goes "
      "on from there when it is given again.\n\n"
      "Examples:\n"
      "  himm_demo sweep --out results\n"
      "  himm_demo sweep --scenario 1 --cross --filters imm,himm_own --out results\n"
      "  himm_demo sweep --cross --shard 1/16 --out part1");
  add_output(app, options->output);
  add_report(app, options->output);
  app.run([options] {
    SweepWorld world(options->choice);
    const auto add = [&](std::size_t, const Study::Row& row) { world.add(row); };
    if (run(world.study(), options->sharing, options->output, add)) report(*options, world);
  });
}

}  // namespace sigmax::apps
