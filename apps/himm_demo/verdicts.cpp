#include "himm_demo/verdicts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sigmax::apps {
namespace {

/// One figure before its interval is known, which depends on how many there are.
struct RawFigure {
  const Statement* statement;
  std::optional<std::size_t> phase;
  std::optional<std::size_t> axis;
  Statistic value;
};

const Condition& condition_of(const Statement& statement, const std::vector<const Condition*>& conditions) {
  const auto found = std::find_if(conditions.begin(), conditions.end(), [&](const Condition* condition) {
    return condition->scenario_number() == statement.scenario && condition->group_number() == statement.group;
  });
  if (found == conditions.end()) throw std::logic_error("a sentence speaks of what was not run");
  return **found;
}

/// The figure of one filter that is not by axis.
Statistic figure_of(const Statement& statement, const Condition& condition, const std::string& filter,
                    std::size_t phase) {
  switch (statement.figure) {
    case FigureOf::onset_rmse:
      return sqrt(condition.mean(filter, FigureColumns::onset_z + 1) / condition.mean(filter, FigureColumns::onset_z)) -
             1.0;
    case FigureOf::cross_time:
      return condition.cross_time_of_runs(filter);
    case FigureOf::cross_time_curves:
      return condition.cross_time_of_curves(filter);
    case FigureOf::lead:
      return condition.mean(filter, FigureColumns::lead + phase);
    case FigureOf::switches_of_the_run:
      return condition.mean(filter, FigureColumns::switches) + condition.mean(filter, FigureColumns::switches + 1) +
             condition.mean(filter, FigureColumns::switches + 2);
    default:
      return condition.mean(filter, FigureColumns::switches + phase);
  }
}

void add_figures(const Statement& statement, const Condition& condition, const Cast& cast,
                 std::vector<RawFigure>& figures) {
  const std::string of = cast.filter(statement.of);
  const std::string against = cast.filter(statement.against);
  if (statement.figure == FigureOf::rmse) {
    for (const std::size_t phase : statement.phases)
      for (std::size_t axis = 0; axis < 3; ++axis)
        figures.push_back(
            {&statement, phase, axis, condition.rmse(of, phase, axis) / condition.rmse(against, phase, axis) - 1.0});
    return;
  }
  const auto add = [&](std::optional<std::size_t> phase) {
    const Statistic own = figure_of(statement, condition, of, phase.value_or(0));
    figures.push_back({&statement,
                       phase,
                       {},
                       against.empty() ? own : own - figure_of(statement, condition, against, phase.value_or(0))});
  };
  if (statement.figure == FigureOf::lead || statement.figure == FigureOf::switches)
    for (const std::size_t phase : statement.phases) add(phase);
  else
    add({});
}

Finding finding_of(const Interval& interval, const Region& region) {
  if (interval.lower() > region.above && interval.upper() < region.below) return Finding::inside;
  if (interval.upper() < region.above || interval.lower() > region.below) return Finding::outside;
  return Finding::open;
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
      return "measurement";
    default:
      return "";
  }
}

std::vector<Measured> measure(const Sentence& sentence, const std::vector<const Condition*>& conditions,
                              const Cast& cast) {
  std::vector<RawFigure> figures;
  for (const auto& statement : sentence.statements)
    add_figures(statement, condition_of(statement, conditions), cast, figures);
  std::vector<Measured> all;
  for (const auto& figure : figures) {
    const Interval interval = figure.value.interval(figures.size());
    all.push_back(
        {figure.statement, figure.phase, figure.axis, interval, finding_of(interval, figure.statement->region)});
  }
  return all;
}

Verdict verdict(const std::vector<Measured>& against_correct, const std::vector<Measured>& against_released) {
  const Finding correct = finding_of(against_correct);
  if (correct == Finding::inside) return Verdict::holds;
  if (finding_of(against_released) == Finding::inside) return Verdict::only_against_released;
  return correct == Finding::outside ? Verdict::does_not_hold : Verdict::undecided;
}

std::string_view words_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::only_against_released:
      return "only released";
    case Verdict::does_not_hold:
      return "does not hold";
    default:
      return "undecided";
  }
}

std::string_view letter_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "yes";
    case Verdict::only_against_released:
      return "(yes)";
    case Verdict::does_not_hold:
      return "no";
    default:
      return "?";
  }
}

}  // namespace sigmax::apps
