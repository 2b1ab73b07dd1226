#include "himm_demo/reproduce_world.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "himm_demo/trace.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

using Columns = FigureColumns;

constexpr std::size_t first_filter = 10;  // after the number of runs and the measurement's nine squares
constexpr std::size_t most_batches = 100;

std::size_t batches(int runs) { return std::min(most_batches, static_cast<std::size_t>(runs)); }

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
  return {scenario(scenario_number, preset),  parameters, std::move(filters), choice.runs, choice.seed, 1,
          preset == Preset::released ? -1 : 0};
}

void add_squares(const Scenario& scenario, const Trace& trace, double* sums) {
  for (std::size_t p = 0; p < 3; ++p)
    for (std::size_t axis = 0; axis < 3; ++axis)
      sums[3 * p + axis] += phase_mean(scenario.phases[p], [&](std::size_t k) { return trace.squared_error(k, axis); });
}

/// What one run of a filter adds to its columns.
void add_figures(const Scenario& scenario, int sample_shift, const Trace& trace, std::size_t model, double* sums) {
  add_squares(scenario, trace, sums + Columns::square);
  const Onset onset = onset_of(scenario);
  const auto squared_z = [&](std::size_t k) { return trace.squared_error(k, 2); };
  sums[Columns::onset_z] += phase_mean(onset.before, squared_z);
  sums[Columns::onset_z + 1] += phase_mean(onset.after, squared_z);

  const auto leads = [&](std::size_t k) { return weight_difference(trace.weights[k], model); };
  for (std::size_t p = 0; p < 3; ++p) {
    const Phase& phase = scenario.phases[p];
    sums[Columns::lead + p] += phase_mean(phase, [&](std::size_t k) { return leads(k) > 0.0 ? 1.0 : 0.0; });
    for (auto k = static_cast<std::size_t>(phase.first - 1); k < static_cast<std::size_t>(phase.last); ++k)
      sums[Columns::switches + p] += (leads(k) > 0.0) != (leads(k - 1) > 0.0) ? 1.0 : 0.0;
  }
  const int first = scenario.phases[1].first;
  const auto crossing =
      first_crossing(first, scenario.samples, [&](int k) { return leads(static_cast<std::size_t>(k - 1)); });
  if (crossing) {
    sums[Columns::crossing] += *crossing + sample_shift;
    sums[Columns::crossed] += 1.0;
  }
  for (std::size_t i = 0; i < Columns::curve_samples; ++i)
    sums[Columns::curve + i] += leads(static_cast<std::size_t>(first - 2) + i);
}

}  // namespace

std::string_view reading_of(Preset preset) { return preset == Preset::released ? "released" : "own"; }

Onset onset_of(const Scenario& scenario) {
  const int first = scenario.phases[1].first;
  return {{"before", first - 10, first - 1}, {"after", first, first + 9}};
}

Condition::Condition(Preset preset, int scenario_number, int group_number, const ReproduceChoice& choice)
    : preset_(preset),
      scenario_number_(scenario_number),
      group_number_(group_number),
      experiment_(experiment_of(preset, scenario_number, group_number, choice)),
      columns_(first_filter + Columns::count * experiment_.filters.size()) {}

std::vector<double> Condition::batch(std::uint64_t first, std::uint64_t last) const {
  std::vector<double> row(columns_.size(), 0.0);
  row[0] = static_cast<double>(last - first);
  for (std::uint64_t number = first; number < last; ++number) {
    const TracedRun run = trace_run(scenario(), experiment_.group.data, filters(), experiment_.seed, number);
    add_squares(scenario(), run.measurement, &row[1]);
    for (std::size_t f = 0; f < filters().size(); ++f)
      add_figures(scenario(), sample_shift(), run.filters[f], manoeuvre_model(filters()[f]).value(),
                  &row[first_filter + Columns::count * f]);
  }
  return row;
}

void Condition::add(const std::vector<double>& row) {
  if (row.size() != columns_.size())
    throw std::runtime_error(fmt::format("a cell of {} numbers, expected {}", row.size(), columns_.size()));
  for (std::size_t c = 0; c < row.size(); ++c) columns_[c].push_back(row[c]);
}

bool Condition::has(std::string_view filter) const {
  return filter == "measurement" ||
         std::any_of(filters().begin(), filters().end(), [&](const FilterSettings& own) { return own.name == filter; });
}

std::size_t Condition::place(std::string_view filter) const {
  if (filter == "measurement") return 1;
  const auto found =
      std::find_if(filters().begin(), filters().end(), [&](const FilterSettings& own) { return own.name == filter; });
  if (found == filters().end()) throw std::logic_error(fmt::format("there is no filter {} here", filter));
  return first_filter + Columns::count * static_cast<std::size_t>(found - filters().begin());
}

Statistic Condition::mean(std::string_view filter, std::size_t column) const {
  return Statistic::mean(columns_[place(filter) + column], columns_[0]);
}

Statistic Condition::rmse(std::string_view filter, std::size_t phase, std::size_t axis) const {
  return sqrt(mean(filter, Columns::square + 3 * phase + axis));
}

Statistic Condition::cross_time_of_runs(std::string_view filter) const {
  const std::size_t begin = place(filter);
  return Statistic::mean(columns_[begin + Columns::crossing], columns_[begin + Columns::crossed]);
}

Statistic Condition::cross_time_of_curves(std::string_view filter) const {
  for (std::size_t i = 1; i < Columns::curve_samples; ++i) {
    const Statistic before = mean(filter, Columns::curve + i - 1);
    const Statistic now = mean(filter, Columns::curve + i);
    if (before.value() <= 0.0 && now.value() > 0.0)
      return before / (before - now) + (scenario().phases[1].first - 2.0 + static_cast<double>(i) + sample_shift());
  }
  return {};
}

std::vector<Condition> conditions(const ReproduceChoice& choice) {
  std::vector<Condition> all;
  for (const Preset preset : {Preset::paper_text, Preset::released})
    for (const int scenario_number : {1, 2})
      for (const int group_number : {1, 2, 3, 4}) all.emplace_back(preset, scenario_number, group_number, choice);
  return all;
}

Campaign campaign_of(const ReproduceChoice& choice, const std::vector<Condition>& conditions) {
  const std::size_t of_a_condition = batches(choice.runs);
  const auto bound = [=](std::size_t batch) {
    return static_cast<std::uint64_t>(choice.runs) * batch / of_a_condition;
  };
  return {"batches", fmt::format("himm_demo {} reproduce --runs {} --seed {}", version, choice.runs, choice.seed),
          conditions.size() * of_a_condition, [=, &conditions](std::size_t cell) {
            const std::size_t batch = cell % of_a_condition;
            return conditions[cell / of_a_condition].batch(bound(batch), bound(batch + 1));
          }};
}

void take_rows(const CellRows& rows, std::vector<Condition>& conditions) {
  const std::size_t of_a_condition = rows.size() / conditions.size();
  for (const auto& [cell, row] : rows) conditions[cell / of_a_condition].add(row);
}

}  // namespace sigmax::apps
