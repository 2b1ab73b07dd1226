#include "himm_demo/simulate_tables.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "himm_demo/paper_claims.hpp"

namespace sigmax::apps {
namespace {

/// Whose figures a row has: of the measurement if there is no filter.
struct Subject {
  std::string name;
  const Performance& performance;
  std::optional<std::size_t> filter;
};

/// One figure: the tables that show it, its column, and its value.
struct Figure {
  std::vector<Figures> tables;
  ResultColumn column;
  std::function<Cell(const Subject&)> value;
};

/// A figure that the measurement does not have.
Figure of_filters(std::vector<Figures> tables, ResultColumn column, std::function<Cell(const Subject&)> value) {
  return {std::move(tables), std::move(column),
          [value = std::move(value)](const Subject& of) { return of.filter ? value(of) : Cell(); }};
}

using ByPhase = std::array<double, 3> Performance::*;

/// The mean over the samples of all phases.
double mean(const Scenario& scenario, const std::array<double, 3>& by_phase) {
  double sum = 0.0;
  double samples = 0.0;
  for (std::size_t p = 0; p < 3; ++p) {
    const double length = scenario.phases[p].last - scenario.phases[p].first + 1;
    sum += length * by_phase[p];
    samples += length;
  }
  return sum / samples;
}

void add_rmse(std::vector<Figure>& all, const Scenario& scenario) {
  for (std::size_t p = 0; p < 3; ++p) {
    const std::string phase(scenario.phases[p].name);
    all.push_back({{Figures::overview, Figures::all},
                   {.key = "rmse_" + phase + "_m", .header = phase, .sized = true, .group = "RMSE, m:"},
                   [p](const Subject& of) { return Cell(of.performance.position_rmse[p]); }});
    for (std::size_t axis = 0; axis < 3; ++axis)
      all.push_back({{Figures::rmse, Figures::all},
                     {.key = fmt::format("rmse_{}_{}_m", phase, axis_names[axis]),
                      .header = axis_names[axis],
                      .sized = true,
                      .group = phase},
                     [p, axis](const Subject& of) { return Cell(of.performance.phase_rmse[p][axis]); }});
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    all.push_back({{Figures::rmse, Figures::all},
                   {.key = fmt::format("peak_{}_m", axis_names[axis]),
                    .header = axis_names[axis],
                    .sized = true,
                    .group = "peak"},
                   [axis](const Subject& of) { return Cell(of.performance.peak[axis]); }});
}

void add_consistency(std::vector<Figure>& all, const Scenario& scenario) {
  struct Kind {
    const char* key;
    const char* group;
    const char* short_name;
    ByPhase values;
  };
  for (const Kind& kind : {Kind{"nees_position", "position:", "position", &Performance::nees_position},
                           Kind{"nees_position_velocity", "and velocity:", "and velocity", &Performance::nees_velocity},
                           Kind{"nis", "", "NIS", &Performance::nis}}) {
    for (std::size_t p = 0; p < 3; ++p) {
      const std::string phase(scenario.phases[p].name);
      std::vector<Figures> tables = {Figures::all};
      if (*kind.group) tables.push_back(Figures::nees);
      all.push_back(
          of_filters(tables, {.key = fmt::format("{}_{}", kind.key, phase), .header = phase, .group = kind.group},
                     [p, values = kind.values](const Subject& of) { return Cell((of.performance.*values)[p]); }));
    }
    all.push_back(of_filters(
        {Figures::overview}, {.header = kind.short_name, .group = *kind.group ? "NEES:" : ""},
        [&scenario, values = kind.values](const Subject& of) { return Cell(mean(scenario, of.performance.*values)); }));
  }
}

void add_cross_time(std::vector<Figure>& all, const SimulateReport& report) {
  const auto time = [](const Subject& of) -> const CrossTime& { return of.performance.cross_time; };
  all.push_back(of_filters({Figures::cross_time, Figures::all},
                           {.key = "cross_time_of_runs", .header = "mean of runs", .interval = true},
                           [=](const Subject& of) { return Cell(time(of).mean_of_runs); }));
  all.push_back(of_filters({Figures::overview}, {.header = "runs", .group = "cross-time:"}, [=](const Subject& of) {
    const auto& interval = time(of).mean_of_runs;
    return Cell(interval ? std::optional(interval->mean) : std::nullopt);
  }));
  all.push_back(of_filters({Figures::all}, {.key = "runs_crossed"},
                           [=](const Subject& of) { return Cell(time(of).runs_crossed); }));
  all.push_back(of_filters({Figures::cross_time}, {.header = "runs that crossed"}, [=, &report](const Subject& of) {
    const auto& crossed = time(of).runs_crossed;
    return crossed ? Cell(fmt::format("{} of {}", *crossed, report.experiment.runs)) : Cell("–");
  }));
  all.push_back(of_filters({Figures::cross_time, Figures::all},
                           {.key = "cross_time_of_curves", .header = "of the averaged curves"},
                           [=](const Subject& of) { return Cell(time(of).of_averaged_curves); }));
  all.push_back(of_filters({Figures::overview}, {.header = "curves", .group = "cross-time:"},
                           [=](const Subject& of) { return Cell(time(of).of_averaged_curves); }));
  all.push_back(of_filters({Figures::cross_time, Figures::all}, {.key = "cross_time_of_paper", .header = "paper"},
                           [&report](const Subject& of) {
                             return Cell(paper_cross_time(report.options.scenario, report.options.group,
                                                          report.filter(*of.filter)));
                           }));
  all.push_back(of_filters({Figures::overview}, {.header = "ns/step", .digits = 0},
                           [&report](const Subject& of) { return Cell(report.ns_per_step[*of.filter]); }));
}

const char* title(Figures which) {
  switch (which) {
    case Figures::rmse:
      return "position RMSE, m";
    case Figures::nees:
      return "mean NEES";
    case Figures::cross_time:
      return "cross-time, sample";
    default:
      return "filter";
  }
}

}  // namespace

ResultTable figures(const SimulateReport& report, Figures which) {
  std::vector<Figure> all;
  all.push_back({{Figures::rmse, Figures::nees, Figures::cross_time, Figures::overview, Figures::all},
                 {.key = "filter", .header = title(which), .align = Align::left},
                 [](const Subject& of) { return Cell(of.name); }});
  add_rmse(all, report.experiment.scenario);
  add_consistency(all, report.experiment.scenario);
  add_cross_time(all, report);
  std::erase_if(all, [&](const Figure& figure) {
    return std::find(figure.tables.begin(), figure.tables.end(), which) == figure.tables.end();
  });

  std::vector<ResultColumn> columns;
  for (const auto& figure : all) columns.push_back(figure.column);
  ResultTable table(columns);
  const auto add = [&](const Subject& of) {
    std::vector<Cell> cells;
    for (const auto& figure : all) cells.push_back(figure.value(of));
    table.row(std::move(cells));
  };
  if (which != Figures::nees && which != Figures::cross_time)
    add({"measurement", report.outcome.measurement, std::nullopt});
  for (std::size_t f = 0; f < report.experiment.filters.size(); ++f)
    add({report.filter(f).name, report.outcome.filters[f], f});
  if (which != Figures::nees && which != Figures::overview) return table;
  table.rule();
  std::vector<Cell> expected;
  for (const auto& column : columns) {
    const std::string& name = which == Figures::nees ? column.group : column.header;
    expected.push_back(name.starts_with("position") || name == "NIS" ? Cell("3")
                       : name.starts_with("and velocity")            ? Cell("6")
                       : column.key == "filter"                      ? Cell("if consistent")
                                                                     : Cell());
  }
  table.row(std::move(expected));
  return table;
}

ResultTable differences(const SimulateReport& report, const Comparison& comparison) {
  const auto& filter = report.filter(comparison.filter);
  const auto& reference = report.filter(comparison.reference);
  const bool claimed = judged(filter, reference);
  std::vector<ResultColumn> columns = {
      {.key = "phase", .header = fmt::format("{} − {}, m", filter.name, reference.name), .align = Align::left}};
  for (const char* axis : axis_names)
    columns.push_back({.key = axis, .header = axis, .sign = true, .sized = true, .interval = true});
  if (claimed) {
    columns.push_back({.header = "the paper says", .align = Align::left});
    columns.push_back({.header = reference.imm_mixing == MixingWeights::correct ? "against the correct IMM that"
                                                                                : "against the released IMM that",
                       .align = Align::left});
  }
  ResultTable table(columns);
  for (std::size_t p = 0; p < 3; ++p) {
    std::vector<Cell> cells = {Cell(report.experiment.scenario.phases[p].name)};
    for (const auto& difference : comparison.difference[p]) cells.emplace_back(difference);
    if (claimed) {
      const Claim claim = claim_of(report.options.scenario, report.options.group, p);
      cells.emplace_back(word(claim));
      cells.emplace_back(
          verdict(claim, comparison.difference[p], report.outcome.filters[comparison.reference].phase_rmse[p]));
    }
    table.row(std::move(cells));
  }
  return table;
}

}  // namespace sigmax::apps
