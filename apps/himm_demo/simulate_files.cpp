#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "himm_demo/paper_claims.hpp"
#include "himm_demo/simulate_report.hpp"
#include "support/csv.hpp"
#include "support/output.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

using Json = nlohmann::ordered_json;

Json json(const Interval& interval) { return {{"estimate", interval.mean}, {"half_width", interval.half_width}}; }

Json json(const Performance& performance, const Experiment& experiment, bool filter) {
  Json by_phase;
  for (std::size_t p = 0; p < 3; ++p) {
    Json phase;
    for (std::size_t axis = 0; axis < 3; ++axis) phase["rmse_m"][axis_names[axis]] = performance.phase_rmse[p][axis];
    phase["rmse_m"]["distance"] = performance.position_rmse[p];
    if (filter) {
      phase["nees_position"] = performance.nees_position[p];
      phase["nees_position_velocity"] = performance.nees_velocity[p];
      phase["nis"] = performance.nis[p];
    }
    by_phase[std::string(experiment.scenario.phases[p].name)] = phase;
  }
  Json result = {{"phases", by_phase}};
  for (std::size_t axis = 0; axis < 3; ++axis) result["peak_rmse_m"][axis_names[axis]] = performance.peak[axis];
  if (filter) {
    const auto& time = performance.cross_time;
    result["cross_time"] = {
        {"mean_of_runs", time.mean_of_runs ? json(*time.mean_of_runs) : Json(nullptr)},
        {"runs_crossed", time.runs_crossed ? Json(*time.runs_crossed) : Json(nullptr)},
        {"of_averaged_curves", time.of_averaged_curves ? Json(*time.of_averaged_curves) : Json(nullptr)}};
  }
  return result;
}

AtomicFile summary_file(const SimulateReport& report, const OutputDirectory& directory) {
  const auto& experiment = report.experiment;
  Json summary = {{"version", version},
                  {"command", report.options.output.command},
                  {"scenario", report.options.scenario},
                  {"group", report.options.group},
                  {"preset", report.options.preset == Preset::released ? "released" : "paper_text"},
                  {"runs", experiment.runs},
                  {"seed", experiment.seed},
                  {"settings_toml", as_toml(experiment.filters)}};
  summary["results"]["measurement"] = json(report.outcome.measurement, experiment, false);
  for (std::size_t f = 0; f < experiment.filters.size(); ++f) {
    Json result = json(report.outcome.filters[f], experiment, true);
    if (const auto paper = paper_cross_time(report.options.scenario, report.options.group, report.filter(f)))
      result["cross_time"]["paper"] = *paper;
    summary["results"][report.filter(f).name] = result;
  }
  for (const auto& comparison : report.comparisons) {
    Json entry = {{"filter", report.filter(comparison.filter).name},
                  {"minus", report.filter(comparison.reference).name}};
    for (std::size_t p = 0; p < 3; ++p)
      for (std::size_t axis = 0; axis < 3; ++axis)
        entry["rmse_difference_m"][std::string(experiment.scenario.phases[p].name)][axis_names[axis]] =
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
AtomicFile filters_file(const SimulateReport& report, const OutputDirectory& directory) {
  AtomicFile file = directory.file("filters.csv");
  const auto& phases = report.experiment.scenario.phases;
  file.write("filter");
  for (const auto& phase : phases)
    for (const char* of : {"", "_x", "_y", "_z"}) file.print(",rmse_{}{}_m", phase.name, of);
  for (const char* axis : axis_names) file.print(",peak_{}_m", axis);
  for (const char* what : {"nees_position", "nees_position_velocity", "nis"})
    for (const auto& phase : phases) file.print(",{}_{}", what, phase.name);
  file.write(",cross_time_of_runs,cross_time_half_width,runs_crossed,cross_time_of_curves\n");
  const auto cell = [&](std::optional<double> value) {
    file.print(",{}", value && std::isfinite(*value) ? shortest(*value) : "");
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
    cell(time.mean_of_runs ? std::optional(time.mean_of_runs->mean) : std::nullopt);
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

AtomicFile rmse_file(const SimulateReport& report, const OutputDirectory& directory) {
  AtomicFile file = directory.file("rmse.csv");
  file.write("sample,filter,axis,rmse_m\n");
  const auto rows = [&](std::string_view name, const Performance& performance) {
    for (std::size_t k = 0; k < performance.rmse.size(); ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double value = performance.rmse[k][axis];
        file.print("{},{},{},{}\n", k + 1, name, axis_names[axis], std::isnan(value) ? "" : shortest(value));
      }
  };
  rows("measurement", report.outcome.measurement);
  for (std::size_t f = 0; f < report.experiment.filters.size(); ++f)
    rows(report.filter(f).name, report.outcome.filters[f]);
  return file;
}

AtomicFile weights_file(const SimulateReport& report, const OutputDirectory& directory) {
  const auto& filters = report.experiment.filters;
  const std::vector<std::string> models = model_names(filters);
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

void write_files(const SimulateReport& report, const OutputDirectory& directory) {
  AtomicFile table = filters_file(report, directory);
  AtomicFile rmse = rmse_file(report, directory);
  AtomicFile weights = weights_file(report, directory);
  AtomicFile summary = summary_file(report, directory);
  commit_all(table, rmse, weights, summary);
}

}  // namespace sigmax::apps
