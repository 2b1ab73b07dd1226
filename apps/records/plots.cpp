#include "records/plots.hpp"

#include "shell/random.hpp"
#include "shell/text.hpp"

namespace sigmax::apps {

std::optional<Position> position_of(const AnyPlot& plot, int axes) {
  if (axes_seen(plot, axes) == 0) return std::nullopt;
  if (plot.sensor == AnyPlot::Sensor::components || plot.sensor == AnyPlot::Sensor::position)
    return Position{component_of(plot, 0).value_or(0.0), axes > 1 ? component_of(plot, 1).value_or(0.0) : 0.0,
                    axes > 2 ? component_of(plot, 2).value_or(0.0) : 0.0};
  const double range = plot.z[0], azimuth = plot.z[1], elevation = axes_seen(plot, axes) == 3 ? plot.z[2] : 0.0;
  const double ground = range * std::cos(elevation);
  return Position{plot.origin[0] + ground * std::cos(azimuth), plot.origin[1] + ground * std::sin(azimuth),
                  plot.origin[2] + range * std::sin(elevation)};
}

Sighting measured(Sighting exact, const Sighting& sigma, RandomStream& random) {
  for (const std::size_t i : {1U, 2U, 0U}) exact[i] += sigma[i] * random.normal();
  return exact;
}

/// The 64-bit FNV-1a of its name.
RandomStream stream_of(std::uint64_t seed, std::string_view track) {
  if (track.empty()) return {seed, 0};
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char byte : track) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3U;
  return {seed, hash};
}

void see_by_radar(Row& row, const std::optional<Position>& position, int axes, const RadarOptions& radar,
                  RandomStream& random, const std::string& file) {
  if (axes_seen(row.plot, axes) < axes) {
    row.plot = AnyPlot::missed(row.plot.time);
    return;
  }
  const auto& sigma = *radar.sigma;
  const Position at = radar.place();
  const double x = (*position)[0] - at[0], y = (*position)[1] - at[1], z = (*position)[2] - at[2];
  const double ground = std::hypot(x, y);
  const Sighting seen = measured({std::hypot(ground, z), std::atan2(y, x), std::atan2(z, ground)},
                                 {sigma[0], sigma[1] * degree, sigma[2] * degree}, random);
  if (!(seen[0] > 0.0))
    throw InputError(
        "{}:{}: the simulated radar: found a range of {} m, expected a positive one; put the radar farther from the "
        "track with --radar-at=E,N,U",
        file, row.line, shortest(seen[0]));
  row.truth = position;
  row.plot = AnyPlot::polar(row.plot.time, seen, std::array{nan, nan, nan}, at);
}

void add_recording(Subcommand app, RecordingOptions& recording, RadarOptions& radar) {
  app.list("--columns", recording.columns, "Headers that stand for these names, as time_s=t,x_m=east")
      .type("NAME=HEADER,…");
  app.option("--time-format", recording.time_format,
             "How times are written, by the directives of strptime, as '%d/%m/%Y %H:%M:%S'")
      .type("FORMAT");
  app.list("--missing", recording.missing, "Cells that stand for no number, beside empty ones, as -999").type("CELL,…");
  app.option("--select", recording.select, "Only rows that have this value; may be repeated")
      .type("COLUMN=VALUE")
      .repeated();
  app.option("--track-id", recording.track_id, "The column that tells tracks apart: a filter each").type("COLUMN");
  app.option(
         "--on-bad-time", [&](const std::string& what) { recording.skip_bad_times = what == "skip"; },
         "What to do where a time repeats or goes back [error]")
      .one_of({"error", "skip"})
      .text("error|skip");
  app.triple("--origin", recording.origin, "Where positions are counted from [each track's first row]")
      .type("LAT,LON,ALT");
  app.option(
         "--azimuth-from",
         [&](const std::string& from) {
           recording.azimuth_from = from == "north"   ? AzimuthFrom::north
                                    : from == "ahead" ? AzimuthFrom::ahead
                                                      : AzimuthFrom::east;
         },
         "Whether azimuths run counter-clockwise from east (x), or clockwise from north (y) or from ahead (x) [east]")
      .one_of({"east", "north", "ahead"})
      .text("east|north|ahead");
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
