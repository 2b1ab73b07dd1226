#include "himm_demo/recording_options.hpp"

#include <CLI/CLI.hpp>

#include "support/angle.hpp"

namespace sigmax::apps {
namespace {

/// A list of exactly three comma-separated numbers, as `--radar 50,0.1,0.1`.
void add_triple(CLI::App& app, const std::string& name, std::optional<std::array<double, 3>>& values,
                const std::string& help, const std::string& type) {
  app.add_option_function<std::vector<double>>(
         name,
         [&values](const std::vector<double>& given) {
           values = {given[0], given[1], given[2]};
         },
         help)
      ->delimiter(',')
      ->expected(3)
      ->type_name(type);
}

}  // namespace

void add_recording(CLI::App& app, RecordingOptions& recording) {
  app.add_option("--columns", recording.columns, "Headers that stand for these names, as time_s=t,x_m=east")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME=HEADER,…");
  app.add_option("--select", recording.select, "Only rows that have this value; may be repeated")
      ->type_name("COLUMN=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--track-id", recording.track_id, "The column that tells tracks apart: a filter each")
      ->type_name("COLUMN");
  app.add_option_function<std::string>(
         "--on-bad-time", [&recording](const std::string& what) { recording.skip_bad_times = what == "skip"; },
         "What to do where a time repeats or goes back [error]")
      ->check(CLI::IsMember({"error", "skip"}))
      ->option_text("error|skip");
  add_triple(app, "--origin", recording.origin, "Where positions are counted from [each track's first row]",
             "LAT,LON,ALT");
  app.add_option_function<std::string>(
         "--azimuth-from", [&recording](const std::string& from) { recording.azimuth_from_north = from == "north"; },
         "Whether azimuths run counter-clockwise from east or clockwise from north [east]")
      ->check(CLI::IsMember({"east", "north"}))
      ->option_text("east|north");
}

void add_simulated_radar(CLI::App& app, std::optional<std::array<double, 3>>& radar,
                         std::optional<std::array<double, 3>>& radar_at) {
  add_triple(app, "--radar", radar,
             "Take the recording as the truth and measure it by a simulated radar with these standard deviations",
             "RANGE_M,AZIMUTH_DEG,ELEVATION_DEG");
  add_triple(app, "--radar-at", radar_at, "Where the radar stands, in m [0,0,0]", "E,N,U");
}

std::vector<FilterSettings> filters_for_recording(const Settings& settings,
                                                  const std::optional<std::array<double, 3>>& radar) {
  FilterDefaults defaults;
  const auto [range, azimuth, elevation] = radar.value_or(std::array{10.0, 0.1, 0.1});
  defaults.filter.accuracy.radar = {range, azimuth * degree, elevation * degree};
  auto filters = read_filters(settings, defaults);
  settings.refuse_unknown();
  return filters;
}

void take_what_filters_know(const std::vector<FilterSettings>& filters, RecordingOptions& recording) {
  for (const auto& filter : filters) {
    recording.velocity |= filter.knows(&Accuracy::velocity_mps);
    recording.range_rate |= filter.knows(&Accuracy::range_rate_mps);
  }
}

}  // namespace sigmax::apps
