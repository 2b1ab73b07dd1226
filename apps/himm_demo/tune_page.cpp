#include "himm_demo/tune_page.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "himm_demo/tune_report.hpp"
#include "result/table.hpp"
#include "support/json.hpp"
#include "support/missing.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

constexpr const char *before_name = "before", *best_name = "best", *simple_name = "simple";

const std::string& name_of(const TuneFindings& findings) { return findings.tuned.candidates[0].settings.name; }

const char* unit_of(Objective objective) { return objective == Objective::rmse ? "RMSE, m" : "nats a row"; }

/// The settings before, the best and the simple ones, as far as they differ.
std::vector<std::pair<const char*, const Candidate*>> chosen(const TunedFilter& tuned) {
  std::vector<std::pair<const char*, const Candidate*>> all = {{before_name, &tuned.candidates[0]}};
  if (tuned.best != 0) all.emplace_back(best_name, &tuned.candidates[tuned.best]);
  if (tuned.simple != tuned.best && tuned.simple != 0) all.emplace_back(simple_name, &tuned.candidates[tuned.simple]);
  return all;
}

ResultTable innovations(const std::vector<Diagnosis::Part>& parts, bool modes) {
  std::vector<ResultColumn> columns = {{.key = "part", .header = modes ? "mode" : "sensor", .align = Align::left},
                                       {.key = "rows", .header = "rows"},
                                       {.key = "nis", .header = "NIS", .digits = 3, .sized = true},
                                       {.key = "nis_lower", .header = "from", .group = "right:"},
                                       {.key = "nis_upper", .header = "to", .group = "right:"}};
  if (modes) {
    columns.push_back({.key = "mean_weight", .header = "mean weight", .digits = 3});
  } else {
    columns.push_back({.key = "neighbours", .header = "neighbours", .sign = true});
    columns.push_back({.key = "neighbours_right", .header = "right, ±"});
    columns.push_back({.key = "verdict", .header = "verdict", .align = Align::left});
  }
  ResultTable table(columns);
  for (const auto& part : parts) {
    const InnovationTally& tally = part.innovations;
    const bool any = tally.rows() > 0;
    const Band band = any ? tally.band() : Band{nan, nan};
    std::vector<Cell> cells = {part.name, tally.rows(), any ? tally.mean_square() : nan, band.lower, band.upper};
    if (modes)
      cells.emplace_back(part.weight);
    else
      for (const Cell& cell :
           {Cell(tally.autocorrelation()), Cell(tally.autocorrelation_band()), Cell(Diagnosis::verdict(tally))})
        cells.push_back(cell);
    table.row(std::move(cells));
  }
  return table;
}

/// What a candidate loses in each fold, held out, and in all of them.
std::vector<double> by_fold(const Candidate& candidate, const TuneOptions& options, const TuneData& data) {
  std::vector<double> figures;
  const auto folds = data.folds(options.folds);
  for (std::size_t fold = 0; fold <= options.folds; ++fold)
    figures.push_back(figure_of(
        objective_of(candidate.losses, options.objective,
                     [&](std::size_t t, std::size_t k) { return fold == options.folds || folds[t][k] == fold; }),
        options.objective));
  return figures;
}

std::string name_of_fold(std::size_t fold, const TuneOptions& options) {
  return fold == options.folds ? "all folds" : fmt::format("fold {}", fold + 1);
}

ResultTable folds_table(const TunedFilter& tuned, const TuneOptions& options, const TuneData& data) {
  std::vector<ResultColumn> columns = {{.key = "fold"}};
  std::vector<std::vector<double>> figures;
  for (const auto& [name, candidate] : chosen(tuned)) {
    columns.push_back({.key = name});
    figures.push_back(by_fold(*candidate, options, data));
  }
  ResultTable table(columns);
  for (std::size_t fold = 0; fold <= options.folds; ++fold) {
    std::vector<Cell> cells = {name_of_fold(fold, options)};
    for (const auto& own : figures) cells.emplace_back(own[fold]);
    table.row(std::move(cells));
  }
  return table;
}

ResultTable candidates_table(const TunedFilter& tuned, Objective objective) {
  ResultTable table({{.key = "models", .header = "models", .align = Align::left},
                     {.key = "remark", .header = "chosen", .align = Align::left},
                     {.key = "numbers", .header = "numbers"},
                     {.key = "fitted", .header = "fitted", .digits = 4, .sized = true, .group = unit_of(objective)},
                     {.key = "held_out", .header = "held out", .digits = 4, .sized = true, .group = unit_of(objective)},
                     {.key = "gain",
                      .header = objective == Objective::rmse ? "mean, m²" : "mean",
                      .digits = 3,
                      .sign = true,
                      .sized = true,
                      .group = "gain held out:"},
                     {.key = "gain_error", .header = "± s.e.", .digits = 3, .sized = true, .group = "gain held out:"}});
  for (std::size_t c = 0; c < tuned.candidates.size(); ++c) {
    const Candidate& candidate = tuned.candidates[c];
    table.row({candidate.name, remark_of(tuned, c), candidate.numbers, figure_of(candidate.fitted, objective),
               figure_of(candidate.held_out, objective), c == 0 ? Cell() : Cell(candidate.gain),
               c == 0 ? Cell() : Cell(candidate.gain_error)});
  }
  return table;
}

ResultTable settings_table(const TunedFilter& tuned) {
  ResultTable table({{.key = "key", .header = "key", .align = Align::left},
                     {.key = before_name, .header = before_name, .align = Align::left},
                     {.key = best_name, .header = best_name, .align = Align::left},
                     {.key = simple_name, .header = simple_name, .align = Align::left}});
  for (const Change& change : changes(tuned)) table.row({change.key, change.before, change.best, change.simple});
  return table;
}

/// NIS or correlation of neighbours, before and after, in their bands. `figure(tally)` is the number and its band.
template <class Figure>
IntervalChart innovation_chart(IntervalChart chart, const TuneFindings& findings, bool modes, const Figure& figure) {
  chart.wanted_label = "95 % of right filters";
  std::vector<std::pair<const char*, const Diagnosis*>> all = {{before_name, &findings.before}};
  if (findings.after) all.emplace_back(best_name, &*findings.after);
  const auto parts = [&](const Diagnosis& diagnosis) {
    std::vector<std::pair<std::string, const InnovationTally*>> own;
    for (const auto& sensor : diagnosis.sensors) own.emplace_back(sensor.name, &sensor.innovations);
    for (const auto& mode : diagnosis.modes)
      if (modes) own.emplace_back("mode " + mode.name, &mode.innovations);
    return own;
  };
  for (const auto& [name, diagnosis] : all)
    for (const auto& [row, tally] : parts(*diagnosis))
      if (std::find(chart.rows.begin(), chart.rows.end(), row) == chart.rows.end()) chart.rows.push_back(row);
  for (const auto& [name, diagnosis] : all) {
    IntervalSeries series{.name = name, .group = name, .values = {}};
    const auto own = parts(*diagnosis);
    for (const auto& row : chart.rows) {
      const auto found = std::find_if(own.begin(), own.end(), [&](const auto& part) { return part.first == row; });
      const bool any = found != own.end() && found->second->rows() > 0;
      const auto [value, band] = any ? figure(*found->second) : std::pair(nan, Band{nan, nan});
      series.values.push_back({value, 0.0});
      series.wanted.push_back({band.lower, band.upper});
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

std::vector<Panel> innovation_charts(const TuneFindings& findings) {
  return {innovation_chart({.title = "NIS a measured quantity",
                            .x_label = "NIS; right is 1",
                            .rows = {},
                            .series = {},
                            .reference = 1.0,
                            .digits = 3},
                           findings, true,
                           [](const InnovationTally& tally) { return std::pair(tally.mean_square(), tally.band()); }),
          innovation_chart({.title = "Correlation of neighbouring innovations",
                            .x_label = "correlation; right is 0",
                            .rows = {},
                            .series = {},
                            .reference = 0.0,
                            .digits = 3},
                           findings, false, [](const InnovationTally& tally) {
                             const double band = tally.autocorrelation_band();
                             return std::pair(tally.autocorrelation(), Band{-band, band});
                           })};
}

IntervalChart fold_chart(const TunedFilter& tuned, const TuneOptions& options, const TuneData& data) {
  IntervalChart chart{.title = "Held out, by fold",
                      .x_label = fmt::format("{}; less is better", unit_of(options.objective)),
                      .rows = {},
                      .series = {},
                      .digits = 4};
  for (std::size_t fold = 0; fold <= options.folds; ++fold) chart.rows.push_back(name_of_fold(fold, options));
  for (const auto& [name, candidate] : chosen(tuned)) {
    IntervalSeries series{.name = name, .group = name, .values = {}};
    for (const double figure : by_fold(*candidate, options, data)) series.values.push_back({figure, 0.0});
    chart.series.push_back(std::move(series));
  }
  return chart;
}

/// What came of it.
std::string sentence_of(const TuneFindings& findings, Objective objective) {
  const TunedFilter& tuned = findings.tuned;
  const Candidate &before = tuned.candidates[0], &best = tuned.candidates[tuned.best];
  if (tuned.best == 0) return fmt::format("{}: no settings are better than those before.", name_of(findings));
  std::string text = fmt::format("{}: {} with {} fitted numbers is best; held out it has {:.4g} {} rather than {:.4g}.",
                                 name_of(findings), best.name, best.numbers, figure_of(best.held_out, objective),
                                 unit_of(objective), figure_of(before.held_out, objective));
  if (findings.before.rmse_m && findings.after->rmse_m)
    text += fmt::format(" RMSE against the truth: {:.4g} m before, {:.4g} m now.", *findings.before.rmse_m,
                        *findings.after->rmse_m);
  return text;
}

View view_of(const TuneFindings& findings, const TuneOptions& options, const TuneData& data) {
  View view{name_of(findings), {}};
  std::vector<std::pair<const char*, const Diagnosis*>> all = {{"before", &findings.before}};
  if (findings.after) all.emplace_back("with the best settings", &*findings.after);
  for (const auto& [when, diagnosis] : all)
    view.panels.emplace_back(Words{fmt::format("What the innovations say, {}", when),
                                   fmt::format("{}", fmt::join(diagnosis->advice(), "\n"))});
  for (auto& chart : innovation_charts(findings)) view.panels.emplace_back(std::move(chart));
  view.panels.emplace_back(fold_chart(findings.tuned, options, data));
  view.panels.emplace_back(ReportTable{"Sets of models", candidates_table(findings.tuned, options.objective)});
  for (const auto& [when, diagnosis] : all) {
    view.panels.emplace_back(
        ReportTable{fmt::format("Innovations of each sensor, {}", when), innovations(diagnosis->sensors, false)});
    view.panels.emplace_back(
        ReportTable{fmt::format("Rows by their most likely mode, {}", when), innovations(diagnosis->modes, true)});
  }
  if (const ResultTable settings = settings_table(findings.tuned); !settings.empty())
    view.panels.emplace_back(ReportTable{"Settings that change", settings});
  return view;
}

}  // namespace

Json summary_of(const TuneOptions& options, const TuneData& data, const std::vector<TuneFindings>& all) {
  Json summary = {{"version", version},
                  {"command", options.page.command},
                  {"measurements", data.measurements},
                  {"objective", unit_of(options.objective)},
                  {"folds", options.folds},
                  {"seed", options.seed}};
  for (const TuneFindings& findings : all) {
    Json& filter = summary["filters"][name_of(findings)];
    const auto add = [&](const char* when, const Diagnosis& diagnosis) {
      filter[when]["sensors"] = innovations(diagnosis.sensors, false).json();
      filter[when]["modes"] = innovations(diagnosis.modes, true).json();
      filter[when]["advice"] = diagnosis.advice();
      if (diagnosis.rmse_m) filter[when]["rmse_m"] = *diagnosis.rmse_m;
    };
    add(before_name, findings.before);
    if (findings.after) add(best_name, *findings.after);
    filter["held_out"] = folds_table(findings.tuned, options, data).json();
    filter["candidates"] = candidates_table(findings.tuned, options.objective).json();
    filter["settings"] = settings_table(findings.tuned).json();
  }
  return summary;
}

Report page_of(const std::string& heading, const TuneOptions& options, const TuneData& data,
               const std::vector<TuneFindings>& all) {
  Report page{.title = fmt::format("Settings for {}", fmt::join(options.files, ", ")),
              .verdict = {heading},
              .command = options.page.command,
              .groups = {{before_name}},
              .panels = {},
              .chooser = "Filter"};
  for (const TuneFindings& findings : all) {
    page.verdict.push_back(sentence_of(findings, options.objective));
    page.views.push_back(view_of(findings, options, data));
    for (const auto& one : chosen(findings.tuned))
      if (std::none_of(page.groups.begin(), page.groups.end(),
                       [&](const auto& group) { return group.name == one.first; }))
        page.groups.push_back({one.first});
    const Candidate& best = findings.tuned.candidates[findings.tuned.best];
    page.last.emplace_back(Words{"The best settings of " + name_of(findings), as_toml({best.settings}), true});
  }
  return page;
}

}  // namespace sigmax::apps
