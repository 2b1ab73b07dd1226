#include "himm_demo/reproduce/judged.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "result/report.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t first_filter = 1 + squares;  // after the number of runs and the measurement's squares

/// In words that --set takes: the filters of the paper and those that it is to be compared with.
std::vector<std::string> settings_of(int scenario_number, int group_number) {
  std::string names = "imm, imm_released, imm_most_likely, imm_released_most_likely, gpb2, viterbi";
  std::vector<std::string> sets = {"filter.imm.imm_mixing=correct", "filter.imm_most_likely.imm_mixing=correct",
                                   "filter.imm_released_most_likely.imm_mixing=released",
                                   "filter.imm_released_most_likely.output=most_likely"};
  for (const std::string reading : himm_readings) {
    names += ", himm_" + reading;
    if (scenario_number != 2 || group_number != 1) continue;
    names += ", himm_" + reading + "_5";  // with σ_w = 5, section VI.D
    sets.push_back(fmt::format("filter.himm_{0}_5.mixed_covariance={0}", reading));
    sets.push_back(fmt::format("filter.himm_{}_5.sigma_w=5", reading));
  }
  sets.push_back("filters=[" + names + "]");
  return sets;
}

Experiment experiment_of(Preset preset, int scenario_number, int group_number, const ReproduceChoice& choice) {
  const Group parameters = group(group_number, scenario_number);
  const Settings settings = Settings::read({}, settings_of(scenario_number, group_number));
  auto filters = read_filters(settings, FilterDefaults::of(preset, parameters));
  settings.refuse_unknown();
  return {scenario(scenario_number, preset),  parameters, std::move(filters), choice.runs, choice.seed,
          preset == Preset::released ? -1 : 0};
}

/// What one run of a filter adds to its columns.
void add_figures(const Experiment& experiment, const Trace& trace, std::size_t model, double* sums) {
  const auto& phases = experiment.scenario.phases;
  const int onset = phases[1].first;
  add_squares(experiment.scenario, trace.error, sums + Column::square);
  const auto squared_z = [&](std::size_t k) { return trace.squared_error(k, 2); };
  sums[Column::onset_z] += phase_mean({"before", onset - 10, onset - 1}, squared_z);
  sums[Column::onset_z + 1] += phase_mean({"after", onset, onset + 9}, squared_z);

  const auto leads = [&](std::size_t k) { return weight_difference(trace.weights[k], model); };
  for (std::size_t p = 0; p < phases.size(); ++p) {
    sums[Column::lead + p] += phase_mean(phases[p], [&](std::size_t k) { return leads(k) > 0.0 ? 1.0 : 0.0; });
    for (auto k = static_cast<std::size_t>(phases[p].first - 1); k < static_cast<std::size_t>(phases[p].last); ++k)
      sums[Column::switches + p] += (leads(k) > 0.0) != (leads(k - 1) > 0.0) ? 1.0 : 0.0;
  }
  if (const auto crosses = cross_time(experiment, leads)) {
    sums[Column::crossing] += *crosses;
    sums[Column::crossed] += 1.0;
  }
  for (std::size_t i = 0; i < Column::curve_samples; ++i)
    sums[Column::curve + i] += leads(static_cast<std::size_t>(onset - 2) + i);
}

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

Condition::Condition(Preset under, int scenario_number, int group_number, const ReproduceChoice& choice)
    : preset(under),
      scenario(scenario_number),
      group(group_number),
      experiment(experiment_of(preset, scenario, group, choice)),
      batches(first_filter + Column::count * experiment.filters.size()) {}

Study::Row Condition::batch(std::uint64_t first, std::uint64_t last) const {
  Study::Row row(first_filter + Column::count * experiment.filters.size(), 0.0);
  row[0] = static_cast<double>(last - first);
  for (std::uint64_t number = first; number < last; ++number) {
    const TracedRun run = experiment.traced(number);
    add_squares(experiment.scenario, run.measurement.error, &row[1]);
    for (std::size_t f = 0; f < run.filters.size(); ++f)
      add_figures(experiment, run.filters[f], manoeuvre_model(experiment.filters[f]).value(),
                  &row[first_filter + Column::count * f]);
  }
  return row;
}

bool Condition::has(std::string_view filter) const {
  const auto& filters = experiment.filters;
  return filter == measurement_name ||
         std::any_of(filters.begin(), filters.end(), [&](const FilterSettings& own) { return own.name == filter; });
}

std::size_t Condition::place(std::string_view filter) const {
  if (filter == measurement_name) return 1;
  for (std::size_t f = 0; f < experiment.filters.size(); ++f)
    if (experiment.filters[f].name == filter) return first_filter + Column::count * f;
  throw std::logic_error(fmt::format("there is no filter {} here", filter));
}

Statistic Condition::cross_time_of_curves(std::string_view filter) const {
  for (std::size_t i = 1; i < Column::curve_samples; ++i) {
    const Statistic before = mean(filter, Column::curve + i - 1), now = mean(filter, Column::curve + i);
    if (before.value() <= 0.0 && now.value() > 0.0)
      return before / (before - now) +
             (experiment.scenario.phases[1].first - 2.0 + static_cast<double>(i) + experiment.mode_sample_shift);
  }
  return {};
}

std::vector<Condition> conditions(const ReproduceChoice& choice) {
  std::vector<Condition> all;
  for (const Preset preset : both_presets)
    for (const int scenario_number : {1, 2})
      for (const int group_number : {1, 2, 3, 4}) all.emplace_back(preset, scenario_number, group_number, choice);
  return all;
}

bool run(const ReproduceChoice& choice, const Sharing& sharing, const OutputOptions& options,
         std::vector<Condition>& conditions) {
  constexpr std::size_t most_batches = 100;
  const std::size_t batches = std::min(most_batches, static_cast<std::size_t>(choice.runs));
  const auto bound = [=](std::size_t batch) { return static_cast<std::uint64_t>(choice.runs) * batch / batches; };
  const Study study{"batches", conditions.size() * batches,
                    [&](std::size_t cell) {
                      const std::size_t batch = cell % batches;
                      return conditions[cell / batches].batch(bound(batch), bound(batch + 1));
                    },
                    fmt::format("himm_demo {} reproduce --runs {} --seed {}", version, choice.runs, choice.seed)};
  return run(study, sharing, options,
             [&](std::size_t cell, const Study::Row& row) { conditions[cell / batches].batches.add(row); });
}

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
