#include "himm_demo/reproduce.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "support/parallel.hpp"

namespace sigmax::apps {
namespace {

void reproduce_and_report(const ReproduceOptions& options) {
  auto world = conditions(options.choice);
  const auto rows = run(campaign_of(options.choice, world), options.shard, options.threads, options.output);
  if (!rows) return;
  take_rows(*rows, world);
  report(options, world);
}

}  // namespace

void add_reproduce(CLI::App& program, const std::string& command) {
  CLI::App& app = *program.add_subcommand("reproduce", "What section VI of the paper says, sentence by sentence.");
  const auto options = std::make_shared<ReproduceOptions>();
  options->output.command = command;
  app.add_option("--runs", options->choice.runs, "Monte Carlo runs of each scenario, group and preset")
      ->check(CLI::Range(2, 100000000))
      ->capture_default_str();
  add_threads(app, options->threads);
  add_seed(app, options->choice.seed);
  add_shard(app, options->shard);
  app.footer(
      "With --out every finished batch of runs is on the disk at once: a command that was killed goes on from there "
      "when it is given again.\n\n"
      "Examples:\n"
      "  himm_demo reproduce\n"
      "  himm_demo reproduce --runs 100 --out results\n"
      "  himm_demo reproduce --runs 10000 --shard 1/4 --out part1");
  add_output(app, options->output);
  add_report(app, options->output);
  app.callback([options] { reproduce_and_report(*options); });
}

}  // namespace sigmax::apps
