#include "himm_demo/simulate.hpp"

#include <algorithm>
#include <thread>

#include <fmt/format.h>

#include "himm_demo/experiment.hpp"
#include "himm_demo/simulate_report.hpp"
#include "support/output.hpp"
#include "support/progress.hpp"

namespace sigmax::apps {

void simulate_and_report(const SimulateOptions& options) {
  const Settings settings = Settings::read(options.config, options.sets);
  const Group parameters = group(options.group, options.scenario);
  FilterDefaults defaults = FilterDefaults::of(options.preset);
  for (auto& motion : defaults.filter.motions) motion[MotionParameter::sigma_w] = parameters.sigma_w;
  defaults.filter.accuracy.radar = parameters.model;
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

  SimulateReport report{options, experiment, outcome, compare(experiment, outcome), {}};
  if (asks_for_all(settings)) report.ns_per_step = nanoseconds_per_step(experiment);
  print(report);
  if (directory) {
    write_files(report, *directory);
    fmt::print("\nWrote filters.csv, rmse.csv, weights.csv and summary.json to {}\n", options.out);
  }
}

}  // namespace sigmax::apps
