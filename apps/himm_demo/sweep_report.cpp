#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "himm_demo/sweep.hpp"
#include "support/result_files.hpp"
#include "support/result_table.hpp"
#include "support/table.hpp"

namespace sigmax::apps {
namespace {

/// What was found of all filters in all conditions.
struct Findings {
  const SweepWorld& world;
  std::vector<std::vector<Tuned>> tuned;  ///< by condition and filter
  std::optional<std::size_t> imm;         ///< its place among the filters

  /// The fuzzy interacting filter whose score on the tuning runs is the least: what is called HIMM below.
  std::optional<std::size_t> himm(std::size_t condition) const {
    std::optional<std::size_t> best;
    for (std::size_t f = 0; f < world.filters().size(); ++f)
      if (is_himm(f) && (!best || tuned[condition][f].tuning_score < tuned[condition][*best].tuning_score)) best = f;
    return best;
  }

  bool is_himm(std::size_t f) const {
    return world.filters()[f].fuzzy && world.filters()[f].scheme == Scheme::interacting;
  }

  /// By how much the score is above that of the tuned IMM, relatively; one of as many intervals as there are
  /// conditions.
  Interval against_imm(std::size_t condition, std::size_t f) const {
    return (tuned[condition][f].score / tuned[condition][*imm].score - 1.0).interval(world.conditions().size());
  }
};

Findings findings_of(const SweepWorld& world, const CellRows& rows) {
  Findings findings{world, {}, {}};
  for (std::size_t c = 0; c < world.conditions().size(); ++c) {
    auto& tuned = findings.tuned.emplace_back();
    for (std::size_t f = 0; f < world.filters().size(); ++f) tuned.push_back(world.tuned(rows, c, f));
  }
  for (std::size_t f = 0; f < world.filters().size(); ++f)
    if (world.filters()[f].name == "imm") findings.imm = f;
  return findings;
}

/// "1, strength ×0.5".
std::string words_of(const SweepCondition& condition) {
  std::string text = fmt::format("{}", condition.scenario);
  const auto add = [&](const char* name, double factor) {
    if (factor != 1.0) text += fmt::format(", {} ×{:g}", name, factor);
  };
  add("noise", condition.mismatch);
  add("period", condition.period);
  add("strength", condition.strength);
  add("length", condition.length);
  return text;
}

/// The figure with a mark that the interval is on one side of zero.
std::string marked(const Interval& interval) {
  const bool sure = interval.above_zero() || interval.below_zero();
  return number_text(100.0 * interval.mean, 1, true) + (sure ? "*" : " ");
}

/// The score of the tuned IMM, and by how much the others are above it.
ResultTable map_for_people(const Findings& findings) {
  std::vector<ResultColumn> columns = {{.header = "scenario", .align = Align::left}, {.header = "imm", .digits = 3}};
  for (const auto& filter : findings.world.filters())
    if (filter.name != "imm") columns.push_back({.header = filter.name, .group = "% above imm:"});
  columns.push_back({.header = "himm", .group = "% above imm:"});
  ResultTable table(columns);
  for (std::size_t c = 0; c < findings.tuned.size(); ++c) {
    std::vector<Cell> cells = {words_of(findings.world.conditions()[c]),
                               findings.tuned[c][*findings.imm].score.value()};
    for (std::size_t f = 0; f < findings.world.filters().size(); ++f)
      if (f != *findings.imm) cells.emplace_back(marked(findings.against_imm(c, f)));
    const auto himm = findings.himm(c);
    cells.push_back(himm ? Cell(marked(findings.against_imm(c, *himm))) : Cell());
    table.row(std::move(cells));
  }
  return table;
}

/// Everything about every filter in every condition, for files.
ResultTable tuned_table(const Findings& findings) {
  ResultTable table({{.key = "scenario"},
                     {.key = "noise"},
                     {.key = "period"},
                     {.key = "strength"},
                     {.key = "length"},
                     {.key = "filter"},
                     {.key = "leaving"},
                     {.key = "returning"},
                     {.key = "sigma_w_dwna"},
                     {.key = "sigma_w_dwpa"},
                     {.key = "lift"},
                     {.key = "at_the_edge"},
                     {.key = "tuning_score"},
                     {.key = "score", .interval = true},
                     {.key = "above_imm", .interval = true},
                     {.key = "is_himm"}});
  for (std::size_t c = 0; c < findings.tuned.size(); ++c) {
    const SweepCondition& condition = findings.world.conditions()[c];
    for (std::size_t f = 0; f < findings.tuned[c].size(); ++f) {
      const Tuned& tuned = findings.tuned[c][f];
      const FilterSettings settings = findings.world.grid(f, condition)[tuned.settings];
      const auto sigma_w = [&](std::size_t model) { return settings.motions[model][MotionParameter::sigma_w]; };
      const char* lift = settings.lift == Lift::zero       ? "zero"
                         : settings.lift == Lift::unbiased ? "unbiased"
                                                           : "borrowed_variance";
      table.row({condition.scenario, condition.mismatch, condition.period, condition.strength, condition.length,
                 settings.name, settings.transition[0][1], settings.transition[1][0], sigma_w(0), sigma_w(1), lift,
                 findings.world.at_the_edge(f, tuned.settings) ? 1 : 0, tuned.tuning_score, tuned.score.interval(),
                 findings.imm ? Cell(findings.against_imm(c, f)) : Cell(), findings.himm(c) == f ? 1 : 0});
    }
  }
  return table;
}

/// The answer in words.
std::string answer(const Findings& findings) {
  std::size_t better = 0, worse = 0, open = 0;
  std::size_t best = 0;
  for (std::size_t c = 0; c < findings.tuned.size(); ++c) {
    const Interval difference = findings.against_imm(c, *findings.himm(c));
    ++(difference.below_zero() ? better : difference.above_zero() ? worse : open);
    if (difference.mean < findings.against_imm(best, *findings.himm(best)).mean) best = c;
  }
  const Interval most = findings.against_imm(best, *findings.himm(best));
  return fmt::format(
      "HIMM is better than the tuned IMM in {} of {} conditions, worse in {}, and {} are open. At best its score "
      "differs "
      "by {} ± {} %: scenario {}. HIMM is what did best on the tuning runs under any reading of (57).",
      better, findings.tuned.size(), worse, open, number_text(100.0 * most.mean, 1, true),
      number_text(100.0 * most.half_width, 1), words_of(findings.world.conditions()[best]));
}

/// How many of the tuned filters stand at the edge of the grid.
std::string edges(const Findings& findings) {
  std::size_t at_the_edge = 0, all = 0;
  for (const auto& tuned : findings.tuned)
    for (std::size_t f = 0; f < tuned.size(); ++f, ++all)
      if (findings.world.at_the_edge(f, tuned[f].settings)) ++at_the_edge;
  return fmt::format("{} of {} tuned filters have a number at an end of its list: there may be better ones beyond.",
                     at_the_edge, all);
}

}  // namespace

void report(const SweepOptions& options, const SweepWorld& world, const CellRows& rows) {
  ResultFiles files(options.output);
  const Findings findings = findings_of(world, rows);
  const std::size_t width = options.output.width();
  const auto note = [&](const std::string& text) { fmt::print("{}", wrapped(text, width)); };
  note(fmt::format("{} filters, {} settings each, chosen by {} runs and judged by {} others, seed {}",
                   world.filters().size(), world.grid(0, world.conditions()[0]).size(), options.choice.tuning_runs,
                   options.choice.runs, options.choice.seed));
  if (findings.imm) {
    fmt::print("\n");
    map_for_people(findings).print(width);
    note(
        "(imm: mean over axes and phases of RMSE over that of the measurement. *: the 95 % interval, by paired runs "
        "and "
        "together for all conditions, is on one side of 0. Negative is better.)");
    fmt::print("\n");
    if (findings.himm(0)) note(answer(findings));
  }
  note(edges(findings));
  if (files.wanted()) {
    files.write("tuned.csv", tuned_table(findings).csv());
    auto summary = summary_of(options.output);
    summary["campaign"] = world.campaign().description;
    if (findings.imm && findings.himm(0)) summary["answer"] = answer(findings);
    files.write_json("summary.json", summary);
  }
  files.commit();
}

}  // namespace sigmax::apps
