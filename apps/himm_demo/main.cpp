#include <CLI/CLI.hpp>
#include <array>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "himm_demo/filter_keys.hpp"
#include "himm_demo/simulate.hpp"
#include "himm_demo/track.hpp"
#include "support/run.hpp"
#include "version.hpp"

namespace {

using namespace sigmax::apps;

constexpr int exit_usage = 2;

/// A list of exactly three comma-separated numbers, as `--radar 50,0.1,0.1`.
CLI::Option* add_triple(CLI::App& app, const std::string& name, std::vector<double>& values, const std::string& help,
                        const std::string& type) {
  return app.add_option(name, values, help)->delimiter(',')->expected(3)->type_name(type);
}

std::array<double, 3> triple(const std::vector<double>& values) { return {values[0], values[1], values[2]}; }

}  // namespace

int main(int argc, char** argv) {
  std::ios::sync_with_stdio(false);  // so that a failure to read the standard input shows
  std::string command = "himm_demo";
  for (int i = 1; i < argc; ++i) command += fmt::format(" {}", argv[i]);

  CLI::App app{
      "Tracks manoeuvring targets by the interacting multiple-model filter with a random mode (IMM) and with a "
      "fuzzy mode (HIMM).",
      "himm_demo"};
  app.set_version_flag("--version", fmt::format("himm_demo {}", version));
  app.require_subcommand(1);
  app.footer("himm_demo SUBCOMMAND --help lists the options of a subcommand, with examples.");

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
      "  himm_demo simulate --set filters=all\n"
      "  himm_demo simulate --set filter.himm.sigma_w=5 --set lift=unbiased --runs 1000");

  TrackOptions track;
  track.command = command;
  std::vector<double> origin, radar, radar_at;
  std::string azimuth_from, on_bad_time;
  CLI::App& track_app = *app.add_subcommand("track", "Tracks the targets of a recording, a headed CSV file.");
  track_app.add_option("file", track.recording.file, "A recording as below; - is the standard input")->required();
  track_app
      .add_option("--columns", track.recording.columns, "Headers that stand for these names, as time_s=t,x_m=east")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME=HEADER,…");
  track_app.add_option("--select", track.recording.select, "Only rows that have this value; may be repeated")
      ->type_name("COLUMN=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  track_app.add_option("--track-id", track.recording.track_id, "The column that tells tracks apart: a filter each")
      ->type_name("COLUMN");
  track_app.add_option("--on-bad-time", on_bad_time, "What to do where a time repeats or goes back [error]")
      ->check(CLI::IsMember({"error", "skip"}))
      ->option_text("error|skip");
  CLI::Option* origin_option = add_triple(track_app, "--origin", origin,
                                          "Origin of the local east-north-up frame [the first row]", "LAT,LON,ALT");
  CLI::Option* azimuth_option =
      track_app
          .add_option("--azimuth-from", azimuth_from,
                      "Whether azimuths run counter-clockwise from east or clockwise from north [east]")
          ->check(CLI::IsMember({"east", "north"}))
          ->option_text("east|north");
  CLI::Option* radar_option =
      add_triple(track_app, "--radar", radar,
                 "Take the recording as the truth and measure it by a simulated radar with these standard deviations",
                 "RANGE_M,AZIMUTH_DEG,ELEVATION_DEG");
  CLI::Option* radar_at_option =
      add_triple(track_app, "--radar-at", radar_at, "Where the radar stands, in m [0,0,0]", "E,N,U");
  track_app.footer(
      "Recordings are told apart by their columns; others are ignored:\n"
      "  time_s,x_m,y_m[,z_m]                               positions in m\n"
      "  time_s,latitude_deg,longitude_deg[,altitude_m]     or altitude_gnss_ft, altitude_ft\n"
      "  time_s,range_m,azimuth_deg[,elevation_deg]         a radar's measurements\n"
      "  time_s,sensor,x_m,y_m[,z_m],range_m,azimuth_deg…   rows of several sensors\n"
      "Beside them may stand true_x_m,true_y_m[,true_z_m] and roll_deg. Times are seconds, or dates and times as\n"
      "2016-01-12T13:02:11.218Z. A row without a position is a missed measurement.\n"
      "\n"
      "Examples:\n"
      "  himm_demo track flight.csv --set sigma_position_m=25 --out results\n"
      "  himm_demo track plots.csv --azimuth-from north --set sigma_range_m=50 --set sigma_azimuth_deg=0.2\n"
      "  himm_demo track flight.csv --radar 50,0.1,0.1 --radar-at=-20000,-10000,0\n"
      "  himm_demo track ais.csv --track-id MMSI --on-bad-time skip --set sigma_w=0.05 \\\n"
      "    --columns time_s=Time,latitude_deg=Latitude,longitude_deg=Longitude --out results");

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

  CLI::App& keys_app = *app.add_subcommand("keys", "Lists the keys of --config and --set.");
  keys_app.footer("Examples:\n  himm_demo keys\n  himm_demo keys | grep -A 3 gate");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_usage;
  }

  return run_program("himm_demo", [&] {
    if (keys_app.parsed()) return fmt::print("{}", key_table());
    if (simulate_app.parsed()) {
      if (runs_option->count() > 0) simulate.runs = runs;
      simulate_and_report(simulate);
    } else {
      if (origin_option->count() > 0) track.recording.origin = triple(origin);
      if (azimuth_option->count() > 0) track.recording.azimuth_from_north = azimuth_from == "north";
      track.recording.skip_bad_times = on_bad_time == "skip";
      if (radar_option->count() > 0) track.radar = triple(radar);
      if (radar_at_option->count() > 0) track.radar_at = triple(radar_at);
      track_and_report(track);
    }
  });
}
