#include "himm_demo/simulate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "himm_demo/experiment.hpp"
#include "support/csv.hpp"
#include "support/output.hpp"
#include "support/progress.hpp"
#include "support/table.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> axes = {"x", "y", "z"};

/// What section VI says of HIMM against IMM in a phase.
enum class Claim { better, worse, competitive };

std::string_view word(Claim claim) {
  return claim == Claim::better ? "better" : claim == Claim::worse ? "worse" : "competitive";
}

/// By scenario, group and phase.
constexpr Claim B = Claim::better, W = Claim::worse, C = Claim::competitive;
constexpr Claim claims[2][4][3] = {{{B, B, B}, {B, C, B}, {B, W, B}, {C, C, C}},
                                   {{B, W, B}, {B, W, C}, {B, W, C}, {W, B, C}}};

/// IMM and HIMM, by scenario, in group 1.
constexpr std::array<std::array<double, 2>, 2> paper_cross_times = {{{85.92, 83.77}, {32.28, 31.88}}};

/// A difference of less than a tenth of the reference on every axis is called competitive here.
constexpr double competitive_fraction = 0.1;

struct Comparison {
  std::size_t filter;
  std::size_t reference;
  std::array<std::array<Interval, 3>, 3> difference;  ///< by phase and axis
};

struct Report {
  const SimulateOptions& options;
  const Experiment& experiment;
  const Outcome& outcome;
  std::vector<Comparison> comparisons;
  std::vector<double> ns_per_step;  ///< of each filter; empty unless all filters were asked for

  const FilterSettings& filter(std::size_t f) const { return experiment.filters[f]; }
};

/// Whether two filters take the same and make the same of it, but for the kind of the mode.
bool alike(const FilterSettings& a, const FilterSettings& b) {
  return a.scheme == b.scheme && a.smooth == b.smooth && a.radar_measurement == b.radar_measurement &&
         a.sojourn_s == b.sojourn_s;
}

/// Every fuzzy filter against every random one like it; without such a pair, every
/// filter against the first.
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

/// Whether the paper has such a filter.
bool in_the_paper(const FilterSettings& filter) {
  return filter.scheme == Scheme::interacting && !filter.smooth && filter.sojourn_s.empty() &&
         filter.radar_measurement == RadarForm::standard;
}

/// What the paper's claims are about: HIMM against IMM.
bool judged(const FilterSettings& filter, const FilterSettings& reference) {
  return filter.fuzzy && !reference.fuzzy && in_the_paper(filter) && in_the_paper(reference);
}

std::string fixed(double value) { return std::isnan(value) ? "–" : fmt::format("{:.2f}", value); }
std::string fixed(const Interval& interval) {
  return fmt::format("{:+.2f} ± {:.2f}", interval.estimate, interval.half_width);
}

/// Every filter as one row.
void print_overview(const Report& report) {
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
    cells.push_back(time.mean_of_runs ? fixed(time.mean_of_runs->estimate) : "–");
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

void print_rmse(const Report& report) {
  const auto& phases = report.experiment.scenario.phases;
  std::vector<TextTable::Column> columns = {{"position RMSE, m", Align::left}};
  for (const auto& phase : phases)
    for (std::size_t axis = 0; axis < 3; ++axis)
      columns.push_back({axis == 0 ? fmt::format("{} x", phase.name) : axes[axis]});
  for (const char* axis : axes) columns.push_back({axis[0] == 'x' ? "peak x" : axis});
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

void print_nees(const Report& report) {
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

std::optional<double> paper_cross_time(const Report& report, const FilterSettings& filter) {
  if (report.options.group != 1 || !in_the_paper(filter)) return std::nullopt;
  return paper_cross_times[static_cast<std::size_t>(report.options.scenario - 1)][filter.fuzzy ? 1 : 0];
}

void print_cross_times(const Report& report) {
  TextTable table({{"cross-time, sample", Align::left},
                   {"mean of runs"},
                   {"runs that crossed"},
                   {"of the averaged curves"},
                   {"paper"}});
  for (std::size_t f = 0; f < report.experiment.filters.size(); ++f) {
    const auto& time = report.outcome.filters[f].cross_time;
    const auto paper = paper_cross_time(report, report.filter(f));
    table.row({report.filter(f).name,
               time.mean_of_runs
                   ? fmt::format("{:.2f} ± {:.2f}", time.mean_of_runs->estimate, time.mean_of_runs->half_width)
                   : "–",
               time.runs_crossed ? fmt::format("{} of {}", *time.runs_crossed, report.experiment.runs) : "–",
               time.of_averaged_curves ? fixed(*time.of_averaged_curves) : "–", paper ? fixed(*paper) : "–"});
  }
  table.print();
}

/// Whether the paper's claim about a phase is what the runs show.
std::string verdict(Claim claim, const std::array<Interval, 3>& difference, const std::array<double, 3>& reference) {
  const auto count = [&](auto holds) { return std::count_if(difference.begin(), difference.end(), holds); };
  long axes_that_hold = 0;
  if (claim == Claim::better) axes_that_hold = count([](const Interval& d) { return d.below_zero(); });
  if (claim == Claim::worse) axes_that_hold = count([](const Interval& d) { return d.above_zero(); });
  if (claim == Claim::competitive)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (std::abs(difference[axis].estimate) <= competitive_fraction * reference[axis]) ++axes_that_hold;
  return axes_that_hold == 3   ? "holds"
         : axes_that_hold == 0 ? "does NOT hold"
                               : fmt::format("holds on {} of 3 axes", axes_that_hold);
}

void print_comparisons(const Report& report) {
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
        const Claim claim = claims[report.options.scenario - 1][report.options.group - 1][p];
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

void print(const Report& report) {
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

Json json(const Interval& interval) { return {{"estimate", interval.estimate}, {"half_width", interval.half_width}}; }

Json json(const Performance& performance, const Experiment& experiment, bool filter) {
  Json by_phase;
  for (std::size_t p = 0; p < 3; ++p) {
    Json phase;
    for (std::size_t axis = 0; axis < 3; ++axis) phase["rmse_m"][axes[axis]] = performance.phase_rmse[p][axis];
    phase["rmse_m"]["distance"] = performance.position_rmse[p];
    if (filter) {
      phase["nees_position"] = performance.nees_position[p];
      phase["nees_position_velocity"] = performance.nees_velocity[p];
      phase["nis"] = performance.nis[p];
    }
    by_phase[std::string(experiment.scenario.phases[p].name)] = phase;
  }
  Json result = {{"phases", by_phase}};
  for (std::size_t axis = 0; axis < 3; ++axis) result["peak_rmse_m"][axes[axis]] = performance.peak[axis];
  if (filter) {
    const auto& time = performance.cross_time;
    result["cross_time"] = {
        {"mean_of_runs", time.mean_of_runs ? json(*time.mean_of_runs) : Json(nullptr)},
        {"runs_crossed", time.runs_crossed ? Json(*time.runs_crossed) : Json(nullptr)},
        {"of_averaged_curves", time.of_averaged_curves ? Json(*time.of_averaged_curves) : Json(nullptr)}};
  }
  return result;
}

AtomicFile summary_file(const Report& report, const OutputDirectory& directory) {
  const auto& experiment = report.experiment;
  Json summary = {{"version", version},
                  {"command", report.options.command},
                  {"scenario", report.options.scenario},
                  {"group", report.options.group},
                  {"preset", report.options.preset == Preset::released ? "released" : "paper_text"},
                  {"runs", experiment.runs},
                  {"seed", experiment.seed},
                  {"settings_toml", as_toml(experiment.filters)}};
  summary["results"]["measurement"] = json(report.outcome.measurement, experiment, false);
  for (std::size_t f = 0; f < experiment.filters.size(); ++f) {
    Json result = json(report.outcome.filters[f], experiment, true);
    if (const auto paper = paper_cross_time(report, report.filter(f))) result["cross_time"]["paper"] = *paper;
    summary["results"][report.filter(f).name] = result;
  }
  for (const auto& comparison : report.comparisons) {
    Json entry = {{"filter", report.filter(comparison.filter).name},
                  {"minus", report.filter(comparison.reference).name}};
    for (std::size_t p = 0; p < 3; ++p)
      for (std::size_t axis = 0; axis < 3; ++axis)
        entry["rmse_difference_m"][std::string(experiment.scenario.phases[p].name)][axes[axis]] =
            json(comparison.difference[p][axis]);
    summary["comparisons"].push_back(entry);
  }
  for (std::size_t f = 0; f < report.ns_per_step.size(); ++f)
    summary["not_reproducible"]["ns_per_step"][report.filter(f).name] = report.ns_per_step[f];
  AtomicFile file = directory.file("summary.json");
  file.write(summary.dump(2) + "\n");
  return file;
}

/// A row for each filter: what the tables show.
AtomicFile filters_file(const Report& report, const OutputDirectory& directory) {
  AtomicFile file = directory.file("filters.csv");
  const auto& phases = report.experiment.scenario.phases;
  file.write("filter");
  for (const auto& phase : phases)
    for (const char* of : {"", "_x", "_y", "_z"}) file.print(",rmse_{}{}_m", phase.name, of);
  for (const char* axis : axes) file.print(",peak_{}_m", axis);
  for (const char* what : {"nees_position", "nees_position_velocity", "nis"})
    for (const auto& phase : phases) file.print(",{}_{}", what, phase.name);
  file.write(",cross_time_of_runs,cross_time_half_width,runs_crossed,cross_time_of_curves\n");
  const auto cell = [&](std::optional<double> value) {
    file.print(",{}", value && !std::isnan(*value) ? shortest(*value) : "");
  };
  const auto row = [&](std::string_view name, const Performance& performance, bool filter) {
    file.write(name);
    for (std::size_t p = 0; p < 3; ++p) {
      cell(performance.position_rmse[p]);
      for (const double rmse : performance.phase_rmse[p]) cell(rmse);
    }
    for (const double peak : performance.peak) cell(peak);
    for (const auto& by_phase : {performance.nees_position, performance.nees_velocity, performance.nis})
      for (const double value : by_phase) cell(filter ? std::optional(value) : std::nullopt);
    const CrossTime& time = performance.cross_time;
    cell(time.mean_of_runs ? std::optional(time.mean_of_runs->estimate) : std::nullopt);
    cell(time.mean_of_runs ? std::optional(time.mean_of_runs->half_width) : std::nullopt);
    file.print(",{}", time.runs_crossed ? std::to_string(*time.runs_crossed) : "");
    cell(time.of_averaged_curves);
    file.write("\n");
  };
  row("measurement", report.outcome.measurement, false);
  for (std::size_t f = 0; f < report.experiment.filters.size(); ++f)
    row(csv_field(report.filter(f).name), report.outcome.filters[f], true);
  return file;
}

AtomicFile rmse_file(const Report& report, const OutputDirectory& directory) {
  AtomicFile file = directory.file("rmse.csv");
  file.write("sample,filter,axis,rmse_m\n");
  const auto rows = [&](std::string_view name, const Performance& performance) {
    for (std::size_t k = 0; k < performance.rmse.size(); ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double value = performance.rmse[k][axis];
        file.print("{},{},{},{}\n", k + 1, name, axes[axis], std::isnan(value) ? "" : shortest(value));
      }
  };
  rows("measurement", report.outcome.measurement);
  for (std::size_t f = 0; f < report.experiment.filters.size(); ++f)
    rows(report.filter(f).name, report.outcome.filters[f]);
  return file;
}

AtomicFile weights_file(const Report& report, const OutputDirectory& directory) {
  const auto& filters = report.experiment.filters;
  std::vector<std::string> models;  // of all filters, in order
  for (const auto& filter : filters)
    for (const auto& model : filter.models)
      if (std::find(models.begin(), models.end(), model) == models.end()) models.push_back(model);
  AtomicFile file = directory.file("weights.csv");
  file.write("sample,filter");
  for (const auto& model : models) file.print(",weight_{}", model);
  file.write("\n");
  for (std::size_t f = 0; f < filters.size(); ++f) {
    const auto& weights = report.outcome.filters[f].weights;
    const auto samples = static_cast<int>(weights.size());
    for (int k = 1; k <= samples; ++k) {
      file.print("{},{}", k, filters[f].name);
      const int source = k - report.experiment.mode_sample_shift;
      for (const auto& model : models) {
        const auto own = std::find(filters[f].models.begin(), filters[f].models.end(), model);
        const auto j = static_cast<std::size_t>(own - filters[f].models.begin());
        const bool known = source >= 1 && source <= samples && own != filters[f].models.end() &&
                           !weights[static_cast<std::size_t>(source - 1)].empty();
        file.print(",{}", known ? shortest(weights[static_cast<std::size_t>(source - 1)][j]) : "");
      }
      file.write("\n");
    }
  }
  return file;
}

}  // namespace

void simulate_and_report(const SimulateOptions& options) {
  const Settings settings = Settings::read(options.config, options.sets);
  const Group parameters = group(options.group, options.scenario);
  FilterDefaults defaults = FilterDefaults::of(options.preset);
  defaults.sigma_w = parameters.sigma_w;
  defaults.sigma_radar = parameters.model;
  const auto filters = read_filters(settings, defaults);
  settings.refuse_unknown();
  if (options.print_config) {
    fmt::print("{}", as_toml(filters));
    return;
  }
  std::optional<OutputDirectory> directory;  // made first, so that a bad one is known before the work
  if (!options.out.empty()) directory.emplace(options.out);

  const bool released = options.preset == Preset::released;
  const int threads =
      options.threads > 0 ? options.threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const Experiment experiment{scenario(options.scenario, options.preset),
                              parameters,
                              filters,
                              options.runs.value_or(released ? 50 : 100),
                              options.seed,
                              threads,
                              released ? -1 : 0};
  Progress progress("runs", static_cast<std::uint64_t>(experiment.runs), options.quiet);
  const Outcome outcome = run(experiment, [&] { progress.advance(); });
  progress.finish();

  Report report{options, experiment, outcome, compare(experiment, outcome), {}};
  if (asks_for_all(settings)) report.ns_per_step = nanoseconds_per_step(experiment);
  print(report);
  if (directory) {
    AtomicFile table = filters_file(report, *directory);
    AtomicFile rmse = rmse_file(report, *directory);
    AtomicFile weights = weights_file(report, *directory);
    AtomicFile summary = summary_file(report, *directory);
    commit_all(table, rmse, weights, summary);
    fmt::print("\nWrote filters.csv, rmse.csv, weights.csv and summary.json to {}\n", options.out);
  }
}

}  // namespace sigmax::apps
