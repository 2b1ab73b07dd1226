#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "himm_demo/filters/keys.hpp"
#include "himm_demo/subcommands.hpp"
#include "himm_demo/track/page.hpp"
#include "himm_demo/track/report.hpp"
#include "himm_demo/track/run.hpp"
#include "himm_demo/track/shares.hpp"
#include "result/braille.hpp"
#include "result/result.hpp"
#include "support/command_line.hpp"
#include "support/options.hpp"
#include "support/run.hpp"
#include "support/timestamp.hpp"

namespace sigmax::apps {
namespace {

void refuse_what_means_nothing(const TrackOptions& options, const RecordingReader& recording) {
  if (options.radar.at && !options.radar.sigma && !recording.polar() && !recording.bearings())
    throw UsageError("--radar-at is for --radar, for radar input and for bearings, but " + recording.file() +
                     " has no range_m and no azimuth_deg");
  refuse_radar(options.radar, recording);
}

/// Each rank reads the recording for itself.
void refuse_what_ranks_cannot_share(const TrackOptions& options) {
  if (options.recording.track_id.empty())
    throw UsageError(
        message({.what = "under mpirun each rank follows its share of the tracks, but all rows are one",
                 .remedy = "name the column that tells tracks apart by --track-id, or run it without mpirun"}));
  if (options.recording.file == "-")
    throw UsageError(message({.what = "under mpirun every rank reads the recording, but standard input comes only once",
                              .remedy = "give the name of a file"}));
}

void track_and_report(const TrackOptions& options, TrackShares& shares) {
  RecordingOptions what = options.recording;
  const auto filters = filters_for(what, options.config, options.sets, options.radar.sigma);
  if (options.print_config) {
    if (shares.first()) fmt::print("{}", as_toml(filters));
    return;
  }
  if (!shares.alone()) refuse_what_ranks_cannot_share(options);
  what.simulated = options.radar.sigma.has_value();
  RecordingReader recording(what);
  refuse_what_means_nothing(options, recording);
  refuse_to_overwrite(options.output, {options.recording.file, options.config}, {"estimates.csv"});
  if (!shares.first()) {
    run_track(options, recording, filters, {}, shares);
    return;
  }
  ResultFiles files(options.output);
  TrackSinks sinks{.estimates = files.open("estimates.csv")};
  std::optional<TrackPage> tracks;
  const bool charts = shares.alone() && charts_on_terminal(options.output);  // mpirun's output is no such place
  if (files.report_wanted() || charts) tracks.emplace(filters, recording, options.radar.sigma || recording.has_truth());
  sinks.page = tracks ? &*tracks : nullptr;
  const TrackOutcome outcome = run_track(options, recording, filters, sinks, shares);
  for (std::size_t f = 0; tracks && f < filters.size(); ++f)
    for (const auto& [name, stays] : outcome.filters[f].histories) tracks->explained(name, f, stays);
  Result result(options.output);
  const auto warnings = report(options, recording, filters, outcome, result);
  if (tracks) tracks->add_to(result.page);
  if (charts) result.on_terminal = tracks->charts_of_the_first();
  result.publish(files);
  if (!warnings.empty()) std::fflush(stdout);  // they come last where both streams are one
  for (const auto& warning : warnings) complain("himm_demo: warning: " + warning);
}

}  // namespace

void add_track(CLI::App& program, const std::string& command) {
  Subcommand app(program, "track", "Tracks the targets of a recording, a headed CSV file.");
  const auto options = std::make_shared<TrackOptions>();
  options->output.command = command;
  app.option("file", options->recording.file, "A recording as below; - is the standard input").required();
  add_recording(app, options->recording, options->radar);
  app.footer(
      "Recordings are told apart by their columns; others are ignored:\n"
      "  time_s,x_m[,y_m[,z_m]]                             positions in m\n"
      "  time_s,latitude_deg,longitude_deg[,altitude_m]     or altitude_gnss_ft, altitude_ft\n"
      "  time_s,range_m,azimuth_deg[,elevation_deg]         a radar's measurements\n"
      "  time_s,sensor,x_m,y_m[,z_m],range_m,azimuth_deg…   rows of several sensors\n"
      "  time_s,azimuth_deg                                 bearings\n"
      "Lengths may be in m, km, ft, nmi or mi, as range_nmi; speeds in mps, kmh, kt,\n"
      "mph, fps or fpm; angles in deg or rad; azimuth_deg_north is clockwise from\n"
      "north. What is not used of them is said, and why. Beside them may stand\n"
      "true_x_m,true_y_m[,true_z_m], roll_deg, and sigma_x_m … or sigma_range_m …, the\n"
      "accuracy of the row. Times are seconds, dates and times as\n"
      "2016-01-12T13:02:11.218Z, or times of day as 10:15:08. Tabs may separate. A row\n"
      "without a position is a missed measurement; one with some of x_m, y_m, z_m, or a\n"
      "place without its height, measures what it has, and a radar's row with nothing\n"
      "but an azimuth is a bearing.\n"
      "With sigma_velocity_mps, vx_mps,vy_mps[,vz_mps] are measurements too, or\n"
      "groundspeed_kt,track_deg (speed_mps, course_deg) and vertical_rate_fpm; with\n"
      "sigma_range_rate_mps a radar's range_rate_mps.\n"
      "\n"
      "Examples:\n"
      "  himm_demo track flight.csv --set sigma_position_m=25 --out results\n"
      "  himm_demo track plots.csv --azimuth-from north --set sigma_range_m=50 --set sigma_azimuth_deg=0.2\n"
      "  himm_demo track flight.csv --radar 50,0.1,0.1 --radar-at=-20000,-10000,0\n"
      "  himm_demo track ais.csv --track-id MMSI --on-bad-time skip --set sigma_w=0.05 \\\n"
      "    --columns time_s=Time,latitude_deg=Latitude,longitude_deg=Longitude --out results");
  app.option(
         "--predict-to",
         [options](const std::string& text) {
           options->predict_to = parse_timestamp(text);
           options->predict_to_time_of_day = is_time_of_day(text);
           if (!options->predict_to)
             throw UsageError(
                 message({.what = "--predict-to", .found = in_quotes(text), .expected = "a time as in the file"}));
         },
         "A time up to which each target is predicted after its last row")
      .type("TIME");
  app.flag("--iso-times", options->iso_times,
           "Also write times, seconds since 1970, as dates, 2016-01-12T13:02:11.218Z");
  add_seed(app, options->seed);
  add_filter_options(app, options->config, options->sets, options->print_config);
  add_output(app, options->output);
  add_report(app, options->output);
  add_no_chart(app, options->output.no_chart);
  app.run([options] {
    TrackShares shares;
    shares.run([&] { track_and_report(*options, shares); });
  });
}

}  // namespace sigmax::apps
