#include "himm_demo/simulate_report.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "himm_demo/paper_claims.hpp"
#include "support/table.hpp"

namespace sigmax::apps {
namespace {

std::string fixed(double value) { return std::isnan(value) ? "–" : fmt::format("{:.2f}", value); }
/// One run has no interval.
std::string fixed(const Interval& interval, bool sign = true) {
  const std::string mean = sign ? fmt::format("{:+.2f}", interval.mean) : fmt::format("{:.2f}", interval.mean);
  return std::isfinite(interval.half_width) ? fmt::format("{} ± {:.2f}", mean, interval.half_width) : mean;
}

/// Every filter as one row.
void print_overview(const SimulateReport& report) {
  const auto& phases = report.experiment.scenario.phases;
  TextTable table({{"filter", Align::left},
                   {fmt::format("RMSE, m: {}", phases[0].name)},
                   {std::string(phases[1].name)},
                   {std::string(phases[2].name)},
                   {"NEES: position"},
                   {"and velocity"},
                   {"NIS"},
                   {"cross-time: runs"},
                   {"curves"},
                   {"ns/step"}});
  const auto mean = [&](const std::array<double, 3>& by_phase) {  // over the samples of all phases
    double sum = 0.0;
    double samples = 0.0;
    for (std::size_t p = 0; p < 3; ++p) {
      const double length = phases[p].last - phases[p].first + 1;
      sum += length * by_phase[p];
      samples += length;
    }
    return sum / samples;
  };
  const auto rmse = [](const Performance& performance) {
    std::vector<std::string> cells;
    for (const double value : performance.position_rmse) cells.push_back(fixed(value));
    return cells;
  };
  const auto row = [&](const std::string& name, std::vector<std::string> cells) {
    cells.insert(cells.begin(), name);
    cells.resize(10);
    table.row(cells);
  };
  row("measurement", rmse(report.outcome.measurement));
  for (std::size_t f = 0; f < report.experiment.filters.size(); ++f) {
    const Performance& performance = report.outcome.filters[f];
    const CrossTime& time = performance.cross_time;
    auto cells = rmse(performance);
    for (const auto& by_phase : {performance.nees_position, performance.nees_velocity, performance.nis})
      cells.push_back(fixed(mean(by_phase)));
    cells.push_back(time.mean_of_runs ? fixed(time.mean_of_runs->mean) : "–");
    cells.push_back(time.of_averaged_curves ? fixed(*time.of_averaged_curves) : "–");
    cells.push_back(fmt::format("{:.0f}", report.ns_per_step[f]));
    row(report.filter(f).name, cells);
  }
  table.rule();
  row("if consistent", {"", "", "", "3", "6", "3"});
  table.print();
  fmt::print(
      "(RMSE of the distance. NEES and NIS: means over all phases. Cross-time: mean of the runs' that crossed, and of "
      "the\naveraged curves, in samples. ns/step: CPU time on one thread, median; all else is the same for a seed.)\n");
}

void print_rmse(const SimulateReport& report) {
  const auto& phases = report.experiment.scenario.phases;
  std::vector<TextTable::Column> columns = {{"position RMSE, m", Align::left}};
  for (const auto& phase : phases)
    for (std::size_t axis = 0; axis < 3; ++axis)
      columns.push_back({axis == 0 ? fmt::format("{} x", phase.name) : axis_names[axis]});
  for (const char* axis : axis_names) columns.push_back({axis[0] == 'x' ? "peak x" : axis});
  TextTable table(columns);
  const auto row = [&](const std::string& name, const Performance& performance) {
    std::vector<std::string> cells = {name};
    for (const auto& phase : performance.phase_rmse)
      for (const double value : phase) cells.push_back(fixed(value));
    for (const double value : performance.peak) cells.push_back(fixed(value));
    table.row(cells);
  };
  row("measurement", report.outcome.measurement);
  for (std::size_t f = 0; f < report.experiment.filters.size(); ++f)
    row(report.filter(f).name, report.outcome.filters[f]);
  table.print();
}

void print_nees(const SimulateReport& report) {
  const auto& phases = report.experiment.scenario.phases;
  std::vector<TextTable::Column> columns = {{"mean NEES", Align::left}};
  for (const char* what : {"position", "position and velocity"})
    for (const auto& phase : phases)
      columns.push_back(
          {&phase == &phases.front() ? fmt::format("{}: {}", what, phase.name) : std::string(phase.name)});
  TextTable table(columns);
  for (std::size_t f = 0; f < report.experiment.filters.size(); ++f) {
    const auto& performance = report.outcome.filters[f];
    std::vector<std::string> cells = {report.filter(f).name};
    for (const double value : performance.nees_position) cells.push_back(fixed(value));
    for (const double value : performance.nees_velocity) cells.push_back(fixed(value));
    table.row(cells);
  }
  table.row({"if consistent", "3", "3", "3", "6", "6", "6"});
  table.print();
}

void print_cross_times(const SimulateReport& report) {
  TextTable table({{"cross-time, sample", Align::left},
                   {"mean of runs"},
                   {"runs that crossed"},
                   {"of the averaged curves"},
                   {"paper"}});
  for (std::size_t f = 0; f < report.experiment.filters.size(); ++f) {
    const auto& time = report.outcome.filters[f].cross_time;
    const auto paper = paper_cross_time(report.options.scenario, report.options.group, report.filter(f));
    table.row({report.filter(f).name, time.mean_of_runs ? fixed(*time.mean_of_runs, false) : "–",
               time.runs_crossed ? fmt::format("{} of {}", *time.runs_crossed, report.experiment.runs) : "–",
               time.of_averaged_curves ? fixed(*time.of_averaged_curves) : "–", paper ? fixed(*paper) : "–"});
  }
  table.print();
}

void print_comparisons(const SimulateReport& report) {
  const auto& phases = report.experiment.scenario.phases;
  for (const auto& comparison : report.comparisons) {
    const auto& filter = report.filter(comparison.filter);
    const auto& reference = report.filter(comparison.reference);
    const bool claimed = judged(filter, reference);
    std::vector<TextTable::Column> columns = {
        {fmt::format("{} − {}, m", filter.name, reference.name), Align::left}, {"x"}, {"y"}, {"z"}};
    if (claimed) {
      columns.push_back({"the paper says", Align::left});
      columns.push_back({reference.imm_mixing == MixingWeights::correct ? "against the correct IMM that"
                                                                        : "against the released IMM that",
                         Align::left});
    }
    TextTable table(columns);
    for (std::size_t p = 0; p < 3; ++p) {
      std::vector<std::string> cells = {std::string(phases[p].name)};
      for (const auto& difference : comparison.difference[p]) cells.push_back(fixed(difference));
      if (claimed) {
        const Claim claim = claim_of(report.options.scenario, report.options.group, p);
        cells.emplace_back(word(claim));
        cells.push_back(
            verdict(claim, comparison.difference[p], report.outcome.filters[comparison.reference].phase_rmse[p]));
      }
      table.row(cells);
    }
    fmt::print("\n");
    table.print();
  }
}

/// Whether two filters take the same and make the same of it, but for the kind of the mode.
bool alike(const FilterSettings& a, const FilterSettings& b) {
  return a.scheme == b.scheme && a.smooth == b.smooth && a.radar_measurement == b.radar_measurement &&
         a.sojourn_s == b.sojourn_s;
}

}  // namespace

std::vector<Comparison> compare(const Experiment& experiment, const Outcome& outcome) {
  std::vector<Comparison> comparisons;
  const auto add = [&](std::size_t filter, std::size_t reference) {
    Comparison comparison{filter, reference, {}};
    for (std::size_t p = 0; p < 3; ++p)
      for (std::size_t axis = 0; axis < 3; ++axis)
        comparison.difference[p][axis] =
            paired_difference(outcome.filters[filter], outcome.filters[reference], p, axis);
    comparisons.push_back(comparison);
  };
  const auto& filters = experiment.filters;
  for (std::size_t f = 0; f < filters.size(); ++f)
    for (std::size_t r = 0; r < filters.size(); ++r)
      if (filters[f].fuzzy && !filters[r].fuzzy && alike(filters[f], filters[r])) add(f, r);
  if (comparisons.empty())
    for (std::size_t f = 1; f < filters.size(); ++f) add(f, 0);
  return comparisons;
}

void print(const SimulateReport& report) {
  const auto& experiment = report.experiment;
  const auto& phases = experiment.scenario.phases;
  fmt::print("Scenario {}, group {}, preset {}: {} runs, seed {}\n", report.options.scenario, report.options.group,
             report.options.preset == Preset::released ? "released" : "paper_text", experiment.runs, experiment.seed);
  fmt::print("Phases by sample: {} {}–{}, {} {}–{}, {} {}–{}\n\n", phases[0].name, phases[0].first, phases[0].last,
             phases[1].name, phases[1].first, phases[1].last, phases[2].name, phases[2].first, phases[2].last);
  if (!report.ns_per_step.empty()) return print_overview(report);
  print_rmse(report);
  print_comparisons(report);
  if (!report.comparisons.empty())
    fmt::print("(RMSE differences ± 95 % by paired runs; negative is better. \"Competitive\": within {:.0f} %.)\n",
               100.0 * competitive_fraction);
  fmt::print("\n");
  print_nees(report);
  fmt::print("\n");
  print_cross_times(report);
  if (experiment.mode_sample_shift != 0)
    fmt::print("(As in the released program, mode weights are counted one sample early.)\n");
}

}  // namespace sigmax::apps
