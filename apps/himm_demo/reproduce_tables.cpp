#include "himm_demo/reproduce_tables.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace sigmax::apps {
namespace {

constexpr std::array finding_names = {"inside", "outside", "open"};

std::string_view name_of(FigureOf figure) {
  switch (figure) {
    case FigureOf::rmse:
      return "RMSE";
    case FigureOf::onset_rmse:
      return "RMSE of z after 81";
    case FigureOf::cross_time:
      return "cross-time";
    case FigureOf::cross_time_curves:
      return "crossing of curves";
    case FigureOf::lead:
      return "share of DWPA";
    case FigureOf::switches:
      return "switches";
    default:
      return "switches of a run";
  }
}

/// The place of the figure that speaks most against the sentence, in half widths of its interval.
std::size_t least_favourable(const std::vector<Measured>& all) {
  const auto margin = [](const Measured& measured) {
    const Region& region = measured.statement->region;
    const double inside = std::min(measured.interval.mean - region.above, region.below - measured.interval.mean);
    return std::isnan(inside) ? 0.0 : inside / std::max(measured.interval.half_width, 1e-12);
  };
  const auto worst = std::min_element(all.begin(), all.end(),
                                      [&](const Measured& a, const Measured& b) { return margin(a) < margin(b); });
  return static_cast<std::size_t>(worst - all.begin());
}

std::string text_of(const Measured& measured) {
  const Interval interval = shown(measured);
  return fmt::format("{} ± {}{}", number_text(interval.mean, 1, measured.statement->against != Actor::nobody),
                     number_text(interval.half_width, 1), scale_of(measured.statement->figure) > 1.0 ? " %" : "");
}

/// Columns, and after them those of the RMSE by phase and axis.
std::vector<ResultColumn> with_rmse(std::vector<ResultColumn> columns) {
  for (const char* phase : phase_names)
    for (const char* axis : axis_names)
      columns.push_back({.key = fmt::format("rmse_{}_{}_m", phase, axis), .interval = true});
  return columns;
}

/// Rows of the measurement and all filters of a condition, which begin with these cells.
void add_rmse(const Condition& condition, const std::vector<Cell>& first, ResultTable& table) {
  std::vector<std::string> names = {"measurement"};
  for (const auto& filter : condition.filters()) names.push_back(filter.name);
  for (const auto& name : names) {
    std::vector<Cell> cells = first;
    cells.emplace_back(name);
    for (std::size_t phase = 0; phase < 3; ++phase)
      for (std::size_t axis = 0; axis < 3; ++axis) cells.emplace_back(condition.rmse(name, phase, axis).interval());
    table.row(std::move(cells));
  }
}

/// What fits above a verdict in a table of 80 columns.
std::string short_name(std::string_view reading) {
  const auto last = reading.rfind('_');
  const auto word = reading.substr(last == std::string_view::npos ? 0 : last + 1);
  return word.size() <= 3 ? std::string(word) : std::string(word.substr(0, 3)) + ".";
}

}  // namespace

std::string name_of(const Condition& condition) {
  return fmt::format("{}/{}", condition.scenario_number(), condition.group_number());
}

double scale_of(FigureOf figure) {
  const bool relative = figure == FigureOf::rmse || figure == FigureOf::onset_rmse || figure == FigureOf::lead;
  return relative ? 100.0 : 1.0;
}

std::string_view word_of(Actor actor) {
  switch (actor) {
    case Actor::himm_wide:
      return "himm_5";
    case Actor::imm:
      return "imm";
    case Actor::imm_most_likely:
      return "most likely";
    case Actor::measurement:
      return "measurement";
    default:
      return "himm";
  }
}

Interval shown(const Measured& measured) {
  const double scale = scale_of(measured.statement->figure);
  return {scale * measured.interval.mean, scale * measured.interval.half_width};
}

std::string subject_of(const Measured& measured, bool with_place) {
  const Statement& statement = *measured.statement;
  std::string text = with_place ? fmt::format("{}/{} ", statement.scenario, statement.group) : "";
  text += word_of(statement.of);
  if (statement.against != Actor::nobody) text.append(" : ").append(word_of(statement.against));
  if (statement.figure != FigureOf::rmse) text.append(", ").append(name_of(statement.figure));
  if (measured.phase) text.append(", ").append(phase_names[*measured.phase]);
  if (measured.axis) text.append(" ").append(axis_names[*measured.axis]);
  return text;
}

Judgements judge(const std::vector<Condition>& conditions) {
  Judgements all;
  for (const Preset preset : both_presets) {
    std::vector<const Condition*> own;
    for (const auto& condition : conditions)
      if (condition.preset() == preset) own.push_back(&condition);
    for (const char* reading : himm_readings)
      for (const auto& sentence : sentences())
        all[preset][reading].push_back(
            {measure(sentence, own, {reading, false}), measure(sentence, own, {reading, true})});
  }
  return all;
}

ResultTable claims(const Judgements& all) {
  ResultTable table({{.key = "sentence", .header = "no."},
                     {.key = "place", .header = "where", .align = Align::left},
                     {.key = "words", .header = "the paper says", .align = Align::left},
                     {.key = name_of(Preset::paper_text), .header = "as printed", .align = Align::left},
                     {.key = name_of(Preset::released), .header = "as released", .align = Align::left}});
  for (std::size_t s = 0; s < sentences().size(); ++s) {
    std::vector<Cell> cells = {std::to_string(s + 1), sentences()[s].place, sentences()[s].words};
    for (const Preset preset : both_presets)
      cells.emplace_back(words_of(all.at(preset).at(reading_of(preset))[s].verdict()));
    table.row(std::move(cells));
  }
  return table;
}

ResultTable by_reading(const Judgements& all) {
  std::vector<ResultColumn> columns = {{.key = "sentence", .header = "no."}};
  for (const Preset preset : both_presets)
    for (const char* reading : himm_readings)
      columns.push_back(
          {.key = fmt::format("{}_{}", name_of(preset), reading), .header = short_name(reading), .align = Align::left});
  ResultTable table(columns);
  for (std::size_t s = 0; s < sentences().size(); ++s) {
    std::vector<Cell> cells = {Cell(std::to_string(s + 1))};
    for (const Preset preset : both_presets)
      for (const char* reading : himm_readings) cells.emplace_back(letter_of(all.at(preset).at(reading)[s].verdict()));
    table.row(std::move(cells));
  }
  return table;
}

ResultTable deciding_figures(const Judgements& all, Preset preset) {
  ResultTable table({{.header = "no."},
                     {.header = "sure"},
                     {.header = "least favourable", .align = Align::left},
                     {.header = "correct IMM"},
                     {.header = "released IMM"}});
  for (std::size_t s = 0; s < sentences().size(); ++s) {
    const Judged& judged = all.at(preset).at(reading_of(preset))[s];
    const auto& figures = judged.against_correct;
    const auto inside = std::count_if(figures.begin(), figures.end(),
                                      [](const Measured& measured) { return measured.finding == Finding::inside; });
    const std::size_t worst = least_favourable(figures);
    table.row({s + 1, fmt::format("{}/{}", inside, figures.size()), subject_of(figures[worst]), text_of(figures[worst]),
               text_of(judged.against_released[worst])});
  }
  return table;
}

ResultTable figures_table(const Judgements& all) {
  ResultTable table({{.key = "sentence"},
                     {.key = "preset"},
                     {.key = "reading"},
                     {.key = "imm"},
                     {.key = "scenario"},
                     {.key = "group"},
                     {.key = "phase"},
                     {.key = "axis"},
                     {.key = "figure"},
                     {.key = "of"},
                     {.key = "against"},
                     {.key = "value", .interval = true},
                     {.key = "wanted_above"},
                     {.key = "wanted_below"},
                     {.key = "finding"}});
  const auto add = [&](std::size_t sentence, Preset preset, const Cast& cast, const Measured& measured) {
    const Statement& statement = *measured.statement;
    table.row({sentence + 1, name_of(preset), cast.reading, cast.released_imm ? "released" : "correct",
               statement.scenario, statement.group, measured.phase ? Cell(phase_names[*measured.phase]) : Cell(),
               measured.axis ? Cell(axis_names[*measured.axis]) : Cell(), name_of(statement.figure),
               cast.filter(statement.of), cast.filter(statement.against), measured.interval, statement.region.above,
               statement.region.below, finding_names[static_cast<std::size_t>(measured.finding)]});
  };
  for (const auto& [preset, by_reading] : all)
    for (const auto& [reading, judged] : by_reading)
      for (std::size_t s = 0; s < judged.size(); ++s) {
        for (const auto& measured : judged[s].against_correct) add(s, preset, {reading, false}, measured);
        for (const auto& measured : judged[s].against_released) add(s, preset, {reading, true}, measured);
      }
  return table;
}

ResultTable filters_table(const std::vector<Condition>& conditions) {
  ResultTable table(with_rmse({{.key = "preset"}, {.key = "scenario"}, {.key = "group"}, {.key = "filter"}}));
  for (const auto& condition : conditions)
    add_rmse(condition, {name_of(condition.preset()), condition.scenario_number(), condition.group_number()}, table);
  return table;
}

ResultTable rmse_table(const Condition& condition) {
  ResultTable table(with_rmse({{.key = "filter"}}));
  add_rmse(condition, {}, table);
  return table;
}

double over_measurement(const Condition& condition, std::string_view filter) {
  double sum = 0.0;
  for (std::size_t phase = 0; phase < 3; ++phase)
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum += condition.rmse(filter, phase, axis).value() / condition.rmse("measurement", phase, axis).value();
  return sum / 9.0;
}

ResultTable overview(const std::vector<Condition>& conditions, Preset preset) {
  std::vector<ResultColumn> columns = {{.key = "filter", .header = "filter", .align = Align::left}};
  std::vector<const Condition*> own;
  std::vector<std::string> names;
  for (const auto& condition : conditions) {
    if (condition.preset() != preset) continue;
    own.push_back(&condition);
    columns.push_back({.key = name_of(condition), .header = name_of(condition), .digits = 3});
    for (const auto& filter : condition.filters())
      if (std::find(names.begin(), names.end(), filter.name) == names.end()) names.push_back(filter.name);
  }
  ResultTable table(columns);
  for (const auto& name : names) {
    std::vector<Cell> cells = {name};
    for (const Condition* condition : own)
      cells.push_back(condition->has(name) ? Cell(over_measurement(*condition, name)) : Cell());
    table.row(std::move(cells));
  }
  return table;
}

}  // namespace sigmax::apps
