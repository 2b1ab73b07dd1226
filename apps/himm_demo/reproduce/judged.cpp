#include "himm_demo/reproduce/judged.hpp"

#include <algorithm>
#include <stdexcept>

#include "result/report.hpp"

namespace sigmax::apps {
namespace {

const Condition& condition_of(const Statement& statement, const std::vector<Condition>& conditions, Preset preset) {
  for (const Condition& condition : conditions)
    if (condition.preset == preset && condition.scenario == statement.scenario && condition.group == statement.group)
      return condition;
  throw std::logic_error("a sentence speaks of what was not run");
}

/// The figure of one filter that is not by axis.
Statistic figure_of(const Statement& statement, const Condition& condition, const std::string& filter,
                    std::size_t phase) {
  switch (statement.figure) {
    case FigureOf::onset_rmse:
      return sqrt(condition.mean(filter, Column::onset_z + 1) / condition.mean(filter, Column::onset_z)) - 1.0;
    case FigureOf::cross_time:
      return condition.cross_time_of_runs(filter);
    case FigureOf::cross_time_curves:
      return condition.cross_time_of_curves(filter);
    case FigureOf::lead:
      return condition.mean(filter, Column::lead + phase);
    case FigureOf::switches_of_the_run:
      return condition.mean(filter, Column::switches) + condition.mean(filter, Column::switches + 1) +
             condition.mean(filter, Column::switches + 2);
    default:
      return condition.mean(filter, Column::switches + phase);
  }
}

/// All figures of a sentence under a preset.
std::vector<Measured> measure(const Sentence& sentence, const std::vector<Condition>& conditions, Preset preset,
                              const Cast& cast) {
  std::vector<Measured> all;
  std::vector<Statistic> values;  // their intervals depend on how many there are
  for (const auto& statement : sentence.statements) {
    const Condition& condition = condition_of(statement, conditions, preset);
    const std::string of = cast.filter(statement.of), against = cast.filter(statement.against);
    const auto add = [&](std::optional<std::size_t> phase, std::optional<std::size_t> axis, Statistic value) {
      all.push_back({&statement, phase, axis, {}, Finding::open});
      values.push_back(std::move(value));
    };
    const auto add_figure = [&](std::optional<std::size_t> phase) {
      const Statistic own = figure_of(statement, condition, of, phase.value_or(0));
      add(phase, {}, against.empty() ? own : own - figure_of(statement, condition, against, phase.value_or(0)));
    };
    const bool by_phase = statement.figure == FigureOf::lead || statement.figure == FigureOf::switches;
    if (!by_phase && statement.figure != FigureOf::rmse) add_figure({});
    for (const std::size_t phase : statement.phases)
      if (by_phase)
        add_figure(phase);
      else
        for (std::size_t axis = 0; axis < 3 && statement.figure == FigureOf::rmse; ++axis)
          add(phase, axis, condition.rmse(of, phase, axis) / condition.rmse(against, phase, axis) - 1.0);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].interval = values[i].interval(values.size());
    all[i].finding = finding_of(all[i].interval, all[i].statement->region);
  }
  return all;
}

Finding finding_of(const std::vector<Measured>& all) {
  const auto is = [](Finding finding) { return [=](const Measured& measured) { return measured.finding == finding; }; };
  if (std::all_of(all.begin(), all.end(), is(Finding::inside))) return Finding::inside;
  return std::any_of(all.begin(), all.end(), is(Finding::outside)) ? Finding::outside : Finding::open;
}

}  // namespace

std::string Cast::filter(Actor subject) const {
  switch (subject) {
    case Actor::himm:
      return "himm_" + std::string(reading);
    case Actor::himm_wide:
      return "himm_" + std::string(reading) + "_5";
    case Actor::imm:
      return released_imm ? "imm_released" : "imm";
    case Actor::imm_most_likely:
      return released_imm ? "imm_released_most_likely" : "imm_most_likely";
    case Actor::measurement:
      return measurement_name;
    default:
      return "";
  }
}

Verdict Judged::verdict() const {
  const Finding correct = finding_of(against_correct);
  if (correct == Finding::inside) return Verdict::holds;
  if (finding_of(against_released) == Finding::inside) return Verdict::only_against_released;
  return correct == Finding::outside ? Verdict::does_not_hold : Verdict::undecided;
}

Judgements judge(const std::vector<Condition>& conditions) {
  Judgements all;
  for (const Preset preset : both_presets)
    for (const char* reading : himm_readings)
      for (const auto& sentence : sentences())
        all[preset][reading].push_back({measure(sentence, conditions, preset, {reading, false}),
                                        measure(sentence, conditions, preset, {reading, true})});
  return all;
}

}  // namespace sigmax::apps
