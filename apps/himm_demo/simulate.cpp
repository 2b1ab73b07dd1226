#include "himm_demo/simulate.hpp"

#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "himm_demo/experiment.hpp"
#include "himm_demo/filters/keys.hpp"
#include "himm_demo/simulate_page.hpp"
#include "himm_demo/simulate_report.hpp"
#include "support/braille.hpp"
#include "support/parallel.hpp"
#include "support/progress.hpp"

namespace sigmax::apps {
namespace {

void simulate_and_report(const SimulateOptions& options) {
  const Settings settings = Settings::read(options.config, options.sets);
  const Group parameters = group(options.group, options.scenario);
  const auto filters = read_filters(settings, FilterDefaults::of(options.preset, parameters));
  settings.refuse_unknown();
  if (options.print_config) {
    fmt::print("{}", as_toml(filters));
    return;
  }
  refuse_to_overwrite(options.output, {options.config}, {"filters.csv", "rmse.csv", "weights.csv"});
  ResultFiles files(options.output);

  const bool released = options.preset == Preset::released;
  Experiment experiment{scenario(options.scenario, options.preset),
                        parameters,
                        filters,
                        options.runs.value_or(released ? 50 : 100),
                        options.seed,
                        threads_or_all(options.threads),
                        released ? -1 : 0};
  if (files.report_wanted()) experiment.kept_runs = runs_in_page(experiment);
  Progress progress("runs", static_cast<std::uint64_t>(experiment.runs), options.output.quiet);
  const Outcome outcome = run(experiment, [&] { progress.advance(); });
  progress.finish();

  SimulateReport report{options, experiment, outcome, compare(experiment, outcome), {}};
  if (asks_for_all(settings)) report.ns_per_step = nanoseconds_per_step(experiment);
  print(report);
  print_charts(options.output, charts_of(report));
  write_files(report, files);
  files.commit();
}

}  // namespace

void add_simulate(CLI::App& program, const std::string& command) {
  CLI::App& app =
      *program.add_subcommand("simulate", "The paper's experiment (section VI) on simulated radar targets.");
  const auto options = std::make_shared<SimulateOptions>();
  options->output.command = command;
  app.add_option("--scenario", options->scenario, "1: fire control radar, 2: surveillance radar")
      ->check(CLI::IsMember({1, 2}))
      ->capture_default_str();
  app.add_option("--group", options->group, "Group of data and model parameters, section VI.C")
      ->check(CLI::IsMember({1, 2, 3, 4}))
      ->capture_default_str();
  app.add_option("--preset", options->preset,
                 "The experiment as printed (paper_text) or as the authors' program has it (released)")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Preset>{{"paper_text", Preset::paper_text}, {"released", Preset::released}}))
      ->option_text("paper_text|released [paper_text]");
  app.add_option("--runs", options->runs, "Monte Carlo runs [100, or 50 for released]")
      ->check(CLI::Range(1, 100000000));
  add_threads(app, options->threads);
  app.footer(
      "Examples:\n"
      "  himm_demo simulate --scenario 2 --group 3 --out results\n"
      "  himm_demo simulate --set filters=all\n"
      "  himm_demo simulate --set filter.himm.sigma_w=5 --set lift=unbiased --runs 1000");
  add_seed(app, options->seed);
  add_filter_options(app, options->config, options->sets, options->print_config);
  add_output(app, options->output);
  add_report(app, options->output);
  add_no_chart(app, options->output.no_chart);
  app.callback([options] { simulate_and_report(*options); });
}

}  // namespace sigmax::apps
