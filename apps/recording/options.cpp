#include "recording/options.hpp"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "support/error.hpp"

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

/// One of two words.
void add_choice(CLI::App& app, const std::string& name, const std::string& first, const std::string& second,
                const std::function<void(bool is_second)>& choose, const std::string& help) {
  app.add_option_function<std::string>(
         name, [=](const std::string& word) { choose(word == second); }, help)
      ->check(CLI::IsMember({first, second}))
      ->option_text(first + "|" + second);
}

}  // namespace

void add_recording(CLI::App& app, RecordingOptions& recording, RadarOptions& radar) {
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
  add_choice(
      app, "--on-bad-time", "error", "skip", [&](bool skip) { recording.skip_bad_times = skip; },
      "What to do where a time repeats or goes back [error]");
  add_triple(app, "--origin", recording.origin, "Where positions are counted from [each track's first row]",
             "LAT,LON,ALT");
  add_choice(
      app, "--azimuth-from", "east", "north", [&](bool north) { recording.azimuth_from_north = north; },
      "Whether azimuths run counter-clockwise from east or clockwise from north [east]");
  add_triple(app, "--radar", radar.sigma,
             "Take the recording as the truth and measure it by a simulated radar with these standard deviations",
             "RANGE_M,AZIMUTH_DEG,ELEVATION_DEG");
  add_triple(app, "--radar-at", radar.at, "Where the radar stands, in m [0,0,0]", "E,N,U");
}

void refuse_radar(const RadarOptions& radar, const RecordingReader& recording) {
  const std::string& file = recording.file();
  if (!radar.sigma) return;
  if (recording.polar()) throw UsageError("--radar measures positions, but " + file + " holds a radar's measurements");
  if (recording.has_truth()) throw UsageError("--radar takes positions as the truth, but " + file + " has true_x_m");
  if (recording.axes() != 3) throw UsageError("--radar needs three axes, but " + file + " has fewer");
}

}  // namespace sigmax::apps
