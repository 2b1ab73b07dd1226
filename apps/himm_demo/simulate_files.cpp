#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "himm_demo/simulate_report.hpp"
#include "himm_demo/simulate_tables.hpp"
#include "support/csv.hpp"
#include "support/output.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

using Json = nlohmann::ordered_json;

AtomicFile summary_file(const SimulateReport& report, const OutputDirectory& directory) {
  const auto& experiment = report.experiment;
  Json summary = {{"version", version},
                  {"command", report.options.output.command},
                  {"scenario", report.options.scenario},
                  {"group", report.options.group},
                  {"preset", name_of(report.options.preset)},
                  {"runs", experiment.runs},
                  {"seed", experiment.seed},
                  {"settings_toml", as_toml(experiment.filters)}};
  summary["results"] = figures(report, Figures::all).json();
  for (const auto& comparison : report.comparisons)
    summary["comparisons"].push_back({{"filter", report.filter(comparison.filter).name},
                                      {"minus", report.filter(comparison.reference).name},
                                      {"rmse_difference_m", differences(report, comparison).json()}});
  for (std::size_t f = 0; f < report.ns_per_step.size(); ++f)
    summary["not_reproducible"]["ns_per_step"][report.filter(f).name] = report.ns_per_step[f];
  AtomicFile file = directory.file("summary.json");
  file.write(summary.dump(2) + "\n");
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
  AtomicFile table = directory.file("filters.csv");
  table.write(figures(report, Figures::all).csv());
  AtomicFile rmse = rmse_file(report, directory);
  AtomicFile weights = weights_file(report, directory);
  AtomicFile summary = summary_file(report, directory);
  commit_all(table, rmse, weights, summary);
}

}  // namespace sigmax::apps
