#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "himm_demo/simulate.hpp"
#include "himm_demo/track.hpp"
#include "support/error.hpp"
#include "version.hpp"

namespace {

using namespace sigmax::apps;

constexpr int exit_usage = 2;
constexpr int exit_input = 3;

/// A list of exactly three comma-separated numbers, as `--radar 50,0.1,0.1`.
CLI::Option* add_triple(CLI::App& app, const std::string& name, std::vector<double>& values, const std::string& help,
                        const std::string& type) {
  return app.add_option(name, values, help)->delimiter(',')->expected(3)->type_name(type);
}

std::array<double, 3> triple(const std::vector<double>& values) { return {values[0], values[1], values[2]}; }

}  // namespace

int main(int argc, char** argv) {
  std::string command = "himm_demo";
  for (int i = 1; i < argc; ++i) command += fmt::format(" {}", argv[i]);

  CLI::App app{
      "Tracks manoeuvring targets by the interacting multiple-model filter with a random mode (IMM) and with a "
      "fuzzy mode (HIMM)."};
  app.set_version_flag("--version", fmt::format("himm_demo {}", version));
  app.require_subcommand(1);

  SimulateOptions simulate;
  simulate.command = command;
  int runs = 0;
  CLI::App& simulate_app =
      *app.add_subcommand("simulate", "The paper's experiment (section VI) on simulated radar targets.");
  simulate_app.add_option("--scenario", simulate.scenario, "1: fire control radar, 2: surveillance radar")
      ->check(CLI::IsMember({1, 2}))
      ->capture_default_str();
  simulate_app.add_option("--group", simulate.group, "Group of data and model parameters, section VI.C")
      ->check(CLI::IsMember({1, 2, 3, 4}))
      ->capture_default_str();
  simulate_app
      .add_option("--preset", simulate.preset,
                  "The experiment as printed (paper_text) or as the authors' program has it (released)")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Preset>{{"paper_text", Preset::paper_text}, {"released", Preset::released}}))
      ->option_text("paper_text|released [paper_text]");
  CLI::Option* runs_option = simulate_app.add_option("--runs", runs, "Monte Carlo runs [100, or 50 for released]")
                                 ->check(CLI::Range(1, 100000000));
  simulate_app.add_option("--threads", simulate.threads, "Threads; the results do not depend on it [all]")
      ->check(CLI::Range(1, 4096));
  simulate_app.footer(
      "Examples:\n"
      "  himm_demo simulate --scenario 2 --group 3 --out results\n"
      "  himm_demo simulate --set filter.himm.sigma_w=5 --set lift=unbiased --runs 1000");

  TrackOptions track;
  track.command = command;
  std::vector<double> origin, radar, radar_at;
  CLI::App& track_app = *app.add_subcommand("track", "Tracks the target of a recording, a headed CSV file.");
  track_app
      .add_option("file", track.file,
                  "time_s,x_m,y_m[,z_m] or time_s,latitude_deg,longitude_deg,altitude_m (or altitude_gnss_ft, "
                  "altitude_ft); other columns are ignored")
      ->required();
  track_app.add_option("--columns", track.columns, "Headers that stand for these names, as time_s=t,x_m=east")
      ->delimiter(',')
      ->type_name("NAME=HEADER,…");
  CLI::Option* origin_option = add_triple(track_app, "--origin", origin,
                                          "Origin of the local east-north-up frame [the first row]", "LAT,LON,ALT");
  CLI::Option* radar_option =
      add_triple(track_app, "--radar", radar,
                 "Take the recording as the truth and measure it by a simulated radar with these standard deviations",
                 "RANGE_M,AZIMUTH_DEG,ELEVATION_DEG");
  CLI::Option* radar_at_option =
      add_triple(track_app, "--radar-at", radar_at, "Where that radar stands, in m [0,0,0]", "E,N,U")
          ->needs(radar_option);
  track_app.footer(
      "Examples:\n"
      "  himm_demo track flight.csv --set sigma_position_m=25 --out results\n"
      "  himm_demo track flight.csv --radar 50,0.1,0.1 --radar-at=-20000,-10000,0 --columns time_s=t");

  const auto add_common = [](CLI::App& subcommand, auto& options) {
    subcommand.add_option("--seed", options.seed, "Seed of the random numbers")->capture_default_str();
    subcommand.add_option("--config", options.config, "Settings in TOML")->type_name("FILE.toml");
    subcommand.add_option("--set", options.sets, "One setting, as lift=unbiased; may be repeated")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    subcommand.add_flag("--print-config", options.print_config, "Print the settings in force and stop");
    subcommand.add_option("--out", options.out, "Directory for the result files")->type_name("DIR");
    subcommand.add_flag("--quiet", options.quiet, "No progress bar");
  };
  add_common(simulate_app, simulate);
  add_common(track_app, track);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_usage;
  }

  try {
    if (simulate_app.parsed()) {
      if (runs_option->count() > 0) simulate.runs = runs;
      simulate_and_report(simulate);
    } else {
      if (origin_option->count() > 0) track.origin = triple(origin);
      if (radar_option->count() > 0) track.radar = triple(radar);
      if (radar_at_option->count() > 0) track.radar_at = triple(radar_at);
      track_and_report(track);
    }
  } catch (const UsageError& error) {
    fmt::print(stderr, "himm_demo: {}\n", error.what());
    return exit_usage;
  } catch (const std::exception& error) {
    fmt::print(stderr, "himm_demo: {}\n", error.what());
    return exit_input;
  }
  return 0;
}
