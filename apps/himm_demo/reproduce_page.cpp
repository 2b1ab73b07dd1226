#include "himm_demo/reproduce_page.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "himm_demo/page_names.hpp"

namespace sigmax::apps {
namespace {

/// All filters, those first that the sentences are about: their colours differ.
std::vector<std::string> names_of(const std::vector<Condition>& conditions) {
  std::vector<std::string> names = {"imm", "himm_own", "himm_released", "himm_selected", "himm_own_recentred"};
  for (const auto& condition : conditions)
    for (const auto& filter : condition.filters())
      if (std::find(names.begin(), names.end(), filter.name) == names.end()) names.push_back(filter.name);
  return names;
}

/// What a figure is shown together with: the RMSE of the same two filters, or other figures of its unit.
std::string chart_of(const Measured& measured) {
  const Statement& statement = *measured.statement;
  if (statement.figure == FigureOf::rmse)
    return fmt::format("RMSE of {} against {}", word_of(statement.of), word_of(statement.against));
  if (scale_of(statement.figure) > 1.0) return "The z axis after the onset, and who leads";
  return statement.against == Actor::nobody ? "Cross-times and switches" : "Differences of cross-times and switches";
}

/// The figures of all sentences that are of this preset, scenario and group, and where the sentences want them.
std::vector<IntervalChart> figures_of(const Judgements& all, const Condition& condition) {
  std::vector<IntervalChart> charts;
  const auto chart = [&](const Measured& measured) -> IntervalChart& {
    const std::string title = chart_of(measured);
    const auto found =
        std::find_if(charts.begin(), charts.end(), [&](const IntervalChart& one) { return one.title == title; });
    if (found != charts.end()) return *found;
    const bool relative = scale_of(measured.statement->figure) > 1.0;
    return charts.emplace_back(IntervalChart{
        .title = title,
        .x_label = relative ? "relative difference or share, %" : "samples, or switches a run",
        .rows = {},
        .series = {{.name = "with the correct IMM", .values = {}}, {.name = "with the released IMM", .values = {}}},
        .reference = measured.statement->against == Actor::nobody ? std::nullopt : std::optional(0.0),
        .wanted_label = "where the sentence wants it",
        .digits = relative ? 1 : 2,
        .note = "The number is the sentence's; the intervals hold together for all its figures."});
  };
  const auto& sentences = all.at(condition.preset()).at(reading_of(condition.preset()));
  for (std::size_t s = 0; s < sentences.size(); ++s)
    for (std::size_t i = 0; i < sentences[s].against_correct.size(); ++i) {
      const Measured& measured = sentences[s].against_correct[i];
      const Statement& statement = *measured.statement;
      if (statement.scenario != condition.scenario_number() || statement.group != condition.group_number()) continue;
      IntervalChart& own = chart(measured);
      const double scale = scale_of(statement.figure);
      const Marked wanted{scale * statement.region.above, scale * statement.region.below};
      own.rows.push_back(
          fmt::format("{}. {}", s + 1,
                      statement.figure == FigureOf::rmse
                          ? fmt::format("{} {}", phase_names[*measured.phase], axis_names[*measured.axis])
                          : subject_of(measured, false)));
      own.series[0].values.push_back(shown(measured));
      own.series[1].values.push_back(shown(sentences[s].against_released[i]));
      for (IntervalSeries& series : own.series) series.wanted.push_back(wanted);
    }
  return charts;
}

IntervalChart rmse_chart(const Condition& condition, const std::vector<std::string>& names, std::size_t axis) {
  IntervalChart chart{
      .title = fmt::format("RMSE in {}", axis_names[axis]), .x_label = "RMSE, m", .rows = {}, .series = {}};
  for (const char* phase : phase_names) chart.rows.emplace_back(phase);
  for (const auto& name : names) {
    IntervalSeries series{.name = name, .group = name, .values = {}};
    for (std::size_t phase = 0; phase < chart.rows.size(); ++phase)
      series.values.push_back(condition.rmse(name, phase, axis).interval());
    chart.series.push_back(std::move(series));
  }
  return chart;
}

View view_of(const Judgements& all, const Condition& condition, const std::vector<std::string>& names) {
  View view{fmt::format("{}: scenario {}, group {}", words_of(condition.preset()), condition.scenario_number(),
                        condition.group_number()),
            {}};
  for (auto& chart : figures_of(all, condition)) view.panels.emplace_back(std::move(chart));
  std::vector<std::string> own = {measurement_name};
  std::copy_if(names.begin(), names.end(), std::back_inserter(own),
               [&](const std::string& name) { return condition.has(name); });
  for (std::size_t axis = 0; axis < axis_names.size(); ++axis)
    view.panels.emplace_back(rmse_chart(condition, own, axis));
  return view;
}

HeatMap overview_map(const std::vector<Condition>& conditions, const std::vector<std::string>& names, Preset preset) {
  HeatMap map{.title = fmt::format("{}: RMSE over that of the measurement", words_of(preset)),
              .row_label = "filter",
              .column_label = "scenario/group",
              .rows = names,
              .columns = {},
              .values = std::vector<std::vector<double>>(names.size()),
              .value_label = "ratio, mean over axes and phases",
              .digits = 3};
  for (const auto& condition : conditions) {
    if (condition.preset() != preset) continue;
    map.columns.push_back(name_of(condition));
    for (std::size_t i = 0; i < names.size(); ++i)
      map.values[i].push_back(condition.has(names[i]) ? over_measurement(condition, names[i])
                                                      : std::numeric_limits<double>::quiet_NaN());
  }
  return map;
}

}  // namespace

const char* words_of(Preset preset) { return preset == Preset::released ? "As released" : "As printed"; }

std::string counts_of_verdicts(const Judgements& all, Preset preset) {
  std::array<int, 4> count{};
  for (const auto& judged : all.at(preset).at(reading_of(preset))) ++count[static_cast<std::size_t>(judged.verdict())];
  return fmt::format("{}: {} of {} hold, {} only against the released IMM, {} do not, {} are undecided.",
                     words_of(preset), count[0], sentences().size(), count[1], count[2], count[3]);
}

Report page_of(const ReproduceOptions& options, const std::vector<Condition>& conditions, const Judgements& all) {
  Report page{.title = "Section VI of the paper, sentence by sentence", .command = options.output.command};
  for (const Preset preset : both_presets) page.verdict.push_back(counts_of_verdicts(all, preset));
  page.verdict.push_back(
      fmt::format("{} runs of each scenario, group and preset, seed {}.", options.choice.runs, options.choice.seed));
  page.panels.emplace_back(ReportTable{
      .title = "The sentences",
      .table = claims(all),
      .note = "\"Only released\": it holds only against the released IMM. HIMM has the reading of (57) that "
              "is printed, or released.",
      .filtered_by = {std::string(name_of(Preset::paper_text)), std::string(name_of(Preset::released))}});
  const std::vector<std::string> names = names_of(conditions);
  page.groups.push_back({measurement_name, true});
  for (const auto& name : names)
    page.groups.push_back({.name = name, .shown = name == "imm" || name == "himm_own" || name == "himm_released"});
  page.chooser = "Show";
  for (const auto& condition : conditions) page.views.push_back(view_of(all, condition, names));
  for (const Preset preset : both_presets) page.last.emplace_back(overview_map(conditions, names, preset));
  for (const Preset preset : both_presets)
    page.last.emplace_back(ReportTable{
        fmt::format("{}: the figures that decide", words_of(preset)), deciding_figures(all, preset),
        "The least favourable one, against both IMMs; \"sure\": how many are where the sentence wants them."});
  page.last.emplace_back(ReportTable{"Each reading of (57), as printed and then as released", by_reading(all),
                                     "(yes): only against the released IMM."});
  return page;
}

}  // namespace sigmax::apps
