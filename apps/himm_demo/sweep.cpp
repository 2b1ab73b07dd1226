#include "himm_demo/sweep.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sigmax::apps {
namespace {

void sweep_and_report(const SweepOptions& options) {
  const SweepWorld world(options.choice);
  if (const auto rows = run(world.campaign(), options.shard, options.threads, options.output))
    report(options, world, *rows);
}

template <class Value>
CLI::Option* add_list(CLI::App& app, const std::string& name, std::vector<Value>& values, const std::string& meaning) {
  return app.add_option(name, values, fmt::format("{} [{}]", meaning, fmt::join(values, ", ")))
      ->delimiter(',')
      ->option_text("A,B,…");
}

void add_conditions(CLI::App& app, SweepChoice& choice) {
  const auto factor = number_in(0.05, 20.0);
  add_list(app, "--scenario", choice.scenarios, "1: fire control radar, 2: surveillance radar")
      ->check(CLI::IsMember({1, 2}));
  add_list(app, "--mismatch", choice.mismatch, "Noise of the radar, believed over true")->check(factor);
  add_list(app, "--period", choice.period, "Sampling period, times the paper's")->check(factor);
  add_list(app, "--strength", choice.strength, "Acceleration, times the paper's")->check(factor);
  add_list(app, "--length", choice.length, "Length of the manoeuvre, times the paper's")->check(factor);
  app.add_flag("--cross", choice.cross, "Every combination of these four, rather than each alone with the others 1");
}

void add_settings(CLI::App& app, SweepChoice& choice) {
  add_list(app, "--filters", choice.filters, "Names as of the setting filters; the others are compared with imm");
  add_list(app, "--probability", choice.probability, "Off-diagonals of P, the two rows apart")
      ->check(number_in(1e-12, 1.0));
  add_list(app, "--possibility", choice.possibility, "Off-diagonals of the matrix of possibilities, the two rows apart")
      ->check(number_in(1e-12, 1.0));
  add_list(app, "--sigma-w", choice.sigma_w, "sigma_w in m/s², the two models apart")->check(number_in(1e-6, 1e6));
  add_list(app, "--lift", choice.lifts, "What stands for a component that a model lacks")
      ->check(CLI::IsMember({"zero", "borrowed_variance", "unbiased"}));
  app.add_option("--beyond", choice.beyond,
                 "Steps that the search may go beyond an end of a list of numbers, each by the ratio of the last two; "
                 "0: only what is listed")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
}

}  // namespace

void add_sweep(CLI::App& program, const std::string& command) {
  CLI::App& app = *program.add_subcommand("sweep", "Every filter at its best settings, in many conditions.");
  const auto options = std::make_shared<SweepOptions>();
  options->output.command = command;
  add_conditions(app, options->choice);
  add_settings(app, options->choice);
  app.add_option("--tuning-runs", options->choice.tuning_runs, "Runs by which the best settings are chosen")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--runs", options->choice.runs, "Other runs by which they are judged")
      ->check(CLI::Range(2, 1000000))
      ->capture_default_str();
  add_seed(app, options->choice.seed);
  add_threads(app, options->threads);
  add_shard(app, options->shard);
  app.footer(
      "With --out every finished cell, a filter in a condition, is on the disk at once: a command that was killed goes "
      "on from there when it is given again.\n\n"
      "Examples:\n"
      "  himm_demo sweep --out results\n"
      "  himm_demo sweep --scenario 1 --cross --filters imm,himm_own --out results\n"
      "  himm_demo sweep --cross --shard 1/16 --out part1");
  add_output(app, options->output);
  add_report(app, options->output);
  app.callback([options] { sweep_and_report(*options); });
}

}  // namespace sigmax::apps
