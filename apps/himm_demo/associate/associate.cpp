#include "himm_demo/associate/associate.hpp"
#include "himm_demo/track/track.hpp"
#include "shell/command_line.hpp"
#include "shell/progress.hpp"

namespace sigmax::apps {
namespace {

void associate(const AssociateOptions& options) {
  RecordingOptions what = options.recording;
  const auto filters = filters_for(what, options.filters, options.radar.sigma, associate_defaults());
  const FilterSettings& filter = filters.front();
  if (filters.size() > 1)
    throw UsageError("associate runs one filter, and the settings name {}: --set filters={}", filters.size(),
                     filter.name);
  if (options.filters.print_config) return fmt::print("{}", as_toml(filters));
  if (options.radar.sigma && (what.track_id.empty() || !options.scan_s))
    throw UsageError("--radar needs --labels COLUMN, which tells targets apart, and --scan SECONDS");
  if (options.clutter && !options.radar.sigma) throw UsageError("--clutter is of a simulated radar; give --radar");
  if (options.runs) throw UsageError("--runs is for --simulate, which has a truth; of a file give --labels COLUMN");
  what.simulated = options.radar.sigma.has_value();
  what.mixed = true;
  RecordingReader recording(what);
  refuse_radar(options.radar, recording);
  if (!recording.located() && !recording.polar())
    throw InputError("{}: velocities or bearings alone do not tell where a target is; give positions",
                     recording.file());
  refuse_to_overwrite(options.output, {what.file, options.filters.config}, {"tracks.csv", "detections.csv"});
  ResultFiles files(options.output);
  EstimatesFile tracks_file(&files, filters, recording, true);
  RowFile detections_file(files, "detections.csv", {"line", "time_s", "track", "support"});
  ScanReader scans(options, recording, filter);
  const int axes = recording.axes();
  MultiTargetTracker tracker = tracker_for(options, filter, axes, options.association.choice);
  AssociateHistory history(axes);
  std::map<std::size_t, double> written;  // the time of each track's last row
  const auto total = recording.csv().bytes_total();
  Progress progress(recording.file(), total.value_or(1), options.output.quiet || !total);
  for (Scan scan; scans.next(scan);) {
    try {
      tracker.scan(each(scan, &Row::detection));
    } catch (const std::logic_error& error) {
      throw InputError("{}:{}: scan of lines {} to {}: {}; look for an outlier here, and at the settings of the filter",
                       recording.file(), scan.front().line, scan.front().line, scan.back().line, error.what());
    }
    for (const DetectionOwner& owner : tracker.owners()) {
      const Row& row = scan[owner.tag];
      detections_file.write({row.line > 0 ? Cell(row.line) : Cell(), row.detection.time,
                             owner.track ? Cell(*owner.track) : Cell(), owner.support});
    }
    const auto updated = tracker.tracks(), predicted = tracker.tracks(tracker.time());
    history.add(tracker, scan, predicted);
    for (std::size_t i = 0; i < predicted.size(); ++i) {
      if (!predicted[i].confirmed) continue;
      const bool seen = updated[i].point.time >= scan.front().detection.time;
      const auto& [number, estimate, existence, _, confirmed, first_time, detected] = (seen ? updated : predicted)[i];
      if (std::exchange(written[number], estimate.time) == estimate.time) continue;  // in a scan of another sensor
      const EarthPoint point = scans.frame() ? on_earth(estimate, *scans.frame(), axes) : EarthPoint{estimate, {}};
      tracks_file.write(std::to_string(number), filter, point, existence);
    }
    progress.advance(recording.csv().bytes_read() - progress.done());
  }
  progress.finish();
  if (scans.rows() == 0) throw InputError("{}: there are no rows; give detections", recording.file());

  Result result(options.output);
  const std::size_t confirmed = history.confirmed();
  const auto at_the_end = std::ranges::count_if(tracker.tracks(tracker.time()), &TrackedTarget::confirmed);
  const std::size_t detections = history.detections(), explained = history.detections(true);
  const std::string verdict = tracker.finding().value_or(
      fmt::format("{} confirmed track{}, {} of them at the end; {} of {} detections are explained", confirmed,
                  confirmed == 1 ? "" : "s", at_the_end, explained, detections));
  result.facts("file", recording.file(), "association", options.association.name, "filter", filter.name, "seed",
               options.seed, "rows", scans.rows(), "scans", tracker.scans(), "detections", detections, "explained",
               explained, "exact", tracker.exact(), "verdict", verdict);
  result.facts_at({"tracks"}, "confirmed", confirmed, "at_the_end", at_the_end);
  if (const auto& frame = scans.frame())
    result.facts_at({"origin"}, "latitude_deg", frame->origin().latitude_deg, "longitude_deg",
                    frame->origin().longitude_deg, "altitude_m", frame->origin().altitude_m);
  result.fact({"settings_toml"}, as_toml(filters));
  result.say("Verdict: {}", verdict);
  result.say("{}: {} rows, {} scans, {} detections; association {}, filter {}", recording.file(), scans.rows(),
             tracker.scans(), detections, options.association.name, filter.name);
  result.say("Taken for: {}", recording.taken());
  for (const std::string& note : scans.notes()) result.say(note);
  if (!tracker.exact())
    result.say("Some marginals are by message passing: too many tracks contend for the same detections");
  if (options.radar.sigma)
    result.say(
        "The recording is taken as the truth, and measured by a simulated radar: {} m, {}°, {}°, P_D {}, {} false "
        "detections a scan, seed {}",
        shortest((*options.radar.sigma)[0]), shortest((*options.radar.sigma)[1]), shortest((*options.radar.sigma)[2]),
        shortest(options.rules.detection_probability), shortest(options.clutter.value_or(0.0)), options.seed);
  result.page.title = "Tracks of unlabelled detections in " + what.file;
  result.page.verdict = {verdict};
  result.page.panels.emplace_back(Words{"The recording", result.text});
  if (files.report_wanted()) history.add_to(result.page, recording.on_the_earth());
  if (recording.has_tracks()) {
    const double cutoff = options.cutoff.value_or(history.usual_cutoff());
    std::vector<Field> score = history.score(cutoff);
    score.insert(score.begin(), {of_words("of", "tracks by"), options.association.name});
    ResultTable table;
    table.row_of(score);
    result.add(table, {.summary = {"score"}, .title = "Tracks and labels"});
    result.facts_at({"score"}, "cutoff_m", cutoff);
    result.say("RMS GOSPA with c = {:.3g} m, p = 2; the squares of its parts add up to its square", cutoff);
  }
  result.page.last.emplace_back(Words{"Settings in force", as_toml(filters), true});
  result.publish(files);
}

}  // namespace

MultiTargetTracker tracker_for(const AssociateOptions& options, const FilterSettings& filter, int axes,
                               const AssociationChoice& association) {
  MultiTargetRules rules = options.rules;
  rules.gate_probability = filter.gate_probability;
  return MultiTargetTracker(choice_of(filter, axes), association, rules);
}

FilterDefaults associate_defaults() {
  FilterDefaults defaults;
  defaults.names = {"imm"};
  defaults.filter.radar_measurement = RadarForm::polar;
  defaults.filter.gate_probability = MultiTargetRules().gate_probability;
  return defaults;
}

void add_associate(CLI::App& program, const std::string& command) {
  Subcommand app(program, "associate", "Finds the targets behind unlabelled detections, and tracks them.");
  const auto options = std::make_shared<AssociateOptions>();
  const auto names = each(situations, &Situation::name);
  app.option("file", options->recording.file, "A recording as of track; - is the standard input");
  app.choice(
         "--association", each(associations, [](const auto& one) { return std::string(one.name); }),
         [options](int of) { options->association = associations[static_cast<std::size_t>(of)]; },
         "Kinds of pattern and permutation: random and random (jpda), random and fuzzy (jpda_star), fuzzy and fuzzy "
         "(gnn), fuzzy and random [jpda_star]")
      .text("jpda|jpda_star|gnn|fuzzy_random");
  app.option("--scan", options->scan_s, "How long a scan takes [rows of equal times, or a turn of the radar]")
      .number_in(1e-6, 1e9)
      .text("SECONDS");
  app.option("--detection-probability", options->rules.detection_probability, "That a target is detected in a scan")
      .number_in(0.01, 1.0);
  app.option("--clutter-density", options->rules.clutter_density,
             "False detections a scan, per unit of what is measured, as m² [estimated]")
      .number_in(1e-30, 1e30)
      .text("NUMBER");
  app.option("--greatest-speed", options->rules.greatest_speed, "Of a target, in m/s").number_in(1e-3, 1e6);
  app.option("--cutoff", options->cutoff, "The distance c of GOSPA, in m [ten standard deviations of a position]")
      .number_in(1e-6, 1e9)
      .text("METRES");
  add_recording(app, options->recording, options->radar, "--labels",
                "The column that says whose a row is: for metrics; the filter does not see it");
  app.option("--clutter", options->clutter, "False detections a scan of what is simulated, on average [0 with --radar]")
      .number_in(0.0, 500.0);
  app.option("--simulate", options->situation, "Write a situation with its truth instead of reading a file")
      .one_of(names);
  app.option("--radars", options->radars, "Radars at the corners of the situation, in turn; 0: positions are measured")
      .in(0, 4);
  app.option("--runs", options->runs, "Evaluate every association on so many runs of it").in(2, 1000000);
  add_threads(app, options->threads);
  add_seed(app, options->seed);
  add_filter_options(app, options->filters);
  add_results(app, options->output, command);
  app.run([options, names] {
    if (options->recording.file.empty() == options->situation.empty())
      throw UsageError("associate needs a file, or --simulate SITUATION: {}", fmt::join(names, ", "));
    options->situation.empty() ? associate(*options) : simulate_situation(*options);
  });
}

}  // namespace sigmax::apps
