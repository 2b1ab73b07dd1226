#include <algorithm>
#include <array>
#include <cmath>

#include "himm_demo/simulate_page.hpp"
#include "himm_demo/simulate_report.hpp"
#include "himm_demo/simulate_tables.hpp"
#include "support/csv.hpp"
#include "support/json.hpp"
#include "support/output.hpp"
#include "support/result_files.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

Json summary_of(const SimulateReport& report) {
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
  return summary;
}

void write_rmse(const SimulateReport& report, AtomicFile& file) {
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
}

void write_weights(const SimulateReport& report, AtomicFile& file) {
  const auto& filters = report.experiment.filters;
  const std::vector<std::string> models = model_names(filters);
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
}

}  // namespace

void write_files(const SimulateReport& report, ResultFiles& files) {
  if (files.wanted()) {
    files.write("filters.csv", figures(report, Figures::all).csv());
    write_rmse(report, *files.open("rmse.csv"));
    write_weights(report, *files.open("weights.csv"));
    Json summary = summary_of(report);
    if (files.report_wanted()) summary["report_data"] = report_data_name;
    files.write_json("summary.json", summary);
  }
  if (files.report_wanted()) files.write_report(page_of(report));
}

}  // namespace sigmax::apps
