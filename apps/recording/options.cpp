#include "recording/options.hpp"

#include <string>

#include "support/error.hpp"
#include "support/options.hpp"

namespace sigmax::apps {

void add_recording(CLI::App& program, RecordingOptions& recording, RadarOptions& radar) {
  Subcommand app(program);
  app.option("--columns", recording.columns, "Headers that stand for these names, as time_s=t,x_m=east")
      .list_alone()
      .type("NAME=HEADER,…");
  app.option("--select", recording.select, "Only rows that have this value; may be repeated")
      .type("COLUMN=VALUE")
      .repeated();
  app.option("--track-id", recording.track_id, "The column that tells tracks apart: a filter each").type("COLUMN");
  app.option(
         "--on-bad-time", [&](const std::string& what) { recording.skip_bad_times = what == "skip"; },
         "What to do where a time repeats or goes back [error]")
      .one_of(std::vector<std::string>{"error", "skip"})
      .text("error|skip");
  app.triple("--origin", recording.origin, "Where positions are counted from [each track's first row]")
      .type("LAT,LON,ALT");
  app.option(
         "--azimuth-from", [&](const std::string& from) { recording.azimuth_from_north = from == "north"; },
         "Whether azimuths run counter-clockwise from east or clockwise from north [east]")
      .one_of(std::vector<std::string>{"east", "north"})
      .text("east|north");
  app.triple("--radar", radar.sigma,
             "Take the recording as the truth and measure it by a simulated radar with these standard deviations")
      .type("RANGE_M,AZIMUTH_DEG,ELEVATION_DEG");
  app.triple("--radar-at", radar.at, "Where the radar stands, in m [0,0,0]").type("E,N,U");
}

void refuse_radar(const RadarOptions& radar, const RecordingReader& recording) {
  const std::string& file = recording.file();
  if (!radar.sigma) return;
  if (recording.polar()) throw UsageError("--radar measures positions, but " + file + " holds a radar's measurements");
  if (recording.has_truth()) throw UsageError("--radar takes positions as the truth, but " + file + " has true_x_m");
  if (recording.axes() != 3) throw UsageError("--radar needs three axes, but " + file + " has fewer");
}

}  // namespace sigmax::apps
