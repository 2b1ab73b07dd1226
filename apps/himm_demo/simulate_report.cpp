#include "himm_demo/simulate_report.hpp"

#include <fmt/format.h>

#include "himm_demo/paper_claims.hpp"
#include "himm_demo/simulate_tables.hpp"

namespace sigmax::apps {
namespace {

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
  const std::size_t width = report.options.output.width();
  const auto& experiment = report.experiment;
  const auto& phases = experiment.scenario.phases;
  const auto note = [&](const std::string& text) { fmt::print("{}", wrapped(text, width)); };
  fmt::print("Scenario {}, group {}, preset {}: {} runs, seed {}\n", report.options.scenario, report.options.group,
             name_of(report.options.preset), experiment.runs, experiment.seed);
  fmt::print("Phases by sample: {} {}–{}, {} {}–{}, {} {}–{}\n\n", phases[0].name, phases[0].first, phases[0].last,
             phases[1].name, phases[1].first, phases[1].last, phases[2].name, phases[2].first, phases[2].last);
  if (!report.ns_per_step.empty()) {
    figures(report, Figures::overview).print(width);
    note(
        "(RMSE of the distance. NEES and NIS: means over all phases. Cross-time: mean of the runs' that crossed, and "
        "of "
        "the averaged curves, in samples. ns/step: CPU time on one thread, median; all else is the same for a seed.)");
    return;
  }
  figures(report, Figures::rmse).print(width);
  for (const auto& comparison : report.comparisons) {
    fmt::print("\n");
    differences(report, comparison).print(width);
  }
  if (!report.comparisons.empty())
    note(fmt::format("(RMSE differences ± 95 % by paired runs; negative is better. \"Competitive\": within {:.0f} %.)",
                     100.0 * competitive_fraction));
  fmt::print("\n");
  figures(report, Figures::nees).print(width);
  fmt::print("\n");
  figures(report, Figures::cross_time).print(width);
  if (experiment.mode_sample_shift != 0)
    note("(As in the released program, mode weights are counted one sample early.)");
}

}  // namespace sigmax::apps
