#include "records/recording.hpp"

#include "shell/random.hpp"

namespace sigmax::apps {

std::optional<Position> position_of(const AnyDetection& detection, int axes) {
  if (axes_seen(detection, axes) == 0) return std::nullopt;
  const bool is_seen = detection.sensor == Sensor::polar || detection.sensor == Sensor::doppler;
  const sigmax::Vector<3> from = to_cartesian(
      {detection.z[0], radians(detection.z[1]), radians(axes_seen(detection, axes) == 3 ? detection.z[2] : 0.0)});
  Position at = detection.origin;
  for (int i = 0; i < axes; ++i)
    at[static_cast<std::size_t>(i)] =
        is_seen ? at[static_cast<std::size_t>(i)] + from[i] : component_of(detection, i).value_or(0.0);
  return at;
}

Polar measured(Polar exact, const Polar& sigma, RandomStream& random) {
  exact.azimuth += random.normal() * sigma.azimuth;
  exact.elevation += random.normal() * sigma.elevation;
  exact.range += sigma.range * random.normal();
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
  if (axes_seen(row.detection, axes) < axes) {
    row.detection = AnyDetection::missed(row.detection.time);
    return;
  }
  const auto& sigma = *radar.sigma;
  const Position at = radar.place();
  const auto size = static_cast<std::size_t>(axes);
  const Polar seen = measured(to_polar(sigmax::Vector<3>(position->data()) - sigmax::Vector<3>(at.data())),
                              {sigma[0], degrees(sigma[1]), degrees(sigma[2])}, random);
  if (!(seen.range > 0.0))
    throw InputError(
        "{}:{}: the simulated radar: found a range of {} m, expected a positive one; put the radar farther from the "
        "track with --radar-at=E,N,U",
        file, row.line, shortest(seen.range));
  const std::array z = {seen.range, seen.azimuth.radians(), seen.elevation.radians()}, unknown = {nan, nan, nan};
  row.truth = position;
  row.detection = AnyDetection::polar(row.detection.time, std::span(z).first(size), std::span(unknown).first(size), at);
}

void add_recording(Subcommand app, RecordingOptions& recording, RadarOptions& radar, const std::string& tracks,
                   const std::string& meaning) {
  app.list("--columns", recording.columns, "Headers that stand for these names, as time_s=t,x_m=east")
      .type("NAME=HEADER,…");
  app.option("--time-format", recording.time_format,
             "How times are written, by the directives of strptime, as '%d/%m/%Y %H:%M:%S'")
      .type("FORMAT");
  app.list("--missing", recording.missing, "Cells that stand for no number, beside empty ones, as -999").type("CELL,…");
  app.option("--select", recording.select, "Only rows that have this value; may be repeated")
      .type("COLUMN=VALUE")
      .repeated();
  app.option(tracks, recording.track_id, meaning).type("COLUMN");
  app.choice(
         "--on-bad-time", {"error", "skip"}, [&](int what) { recording.skip_bad_times = what == 1; },
         "What to do where a time repeats or goes back [error]")
      .text("error|skip");
  app.triple("--origin", recording.origin, "Where positions are counted from [each track's first row]")
      .type("LAT,LON,ALT");
  app.choice(
         "--azimuth-from", {"east", "north", "ahead"},
         [&](int from) { recording.azimuth_from = static_cast<AzimuthFrom>(from); },
         "Whether azimuths run counter-clockwise from east (x), or clockwise from north (y) or from ahead (x) [east]")
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
  if (recording.axes() == 1) throw UsageError("--radar needs two axes or three, but " + file + " has one");
}

}  // namespace sigmax::apps
