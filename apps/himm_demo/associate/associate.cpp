#include "himm_demo/associate/associate.hpp"
#include "himm_demo/track/track.hpp"
#include "shell/command_line.hpp"
#include "shell/progress.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t most_printed = 20;  // tracks

/// What became of a confirmed track.
struct TrackLife {
  double first_time = nan, last_time = nan;  ///< of its first detection, and of the last scan in which it is shown
  std::size_t scans = 0, detected = 0;       ///< since it is confirmed; and in all in which it had a detection
  bool goes_on = false;                      ///< whether it is there after the last scan
};

/// What the tracker made of a recording.
struct AssociateOutcome {
  std::size_t scans = 0, detections = 0;
  std::size_t explained = 0;                ///< detections of tracks that are confirmed at last
  std::map<std::size_t, TrackLife> tracks;  ///< those, by number
  std::optional<std::string> finding;
  bool exact = true;
};

/// Leads all scans through the tracker, writes tracks.csv and detections.csv, and tells page and scorer, if there are
/// such.
AssociateOutcome run_associate(const AssociateOptions& options, RecordingReader& recording, ScanReader& scans,
                               const FilterSettings& filter, ResultFiles& files, std::optional<AssociatePage>& page,
                               std::optional<Scorer>& scorer) {
  const int axes = recording.axes();
  MultiTargetTracker tracker = tracker_for(options, filter, axes, associations[options.association].choice);
  EstimatesFile tracks(&files, {filter}, recording, true);
  RowFile detections(files, "detections.csv", {"line", "time_s", "track", "support"});
  AssociateOutcome outcome;
  std::map<std::size_t, std::size_t> owned;  // detections of each track
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
      ++outcome.detections;
      if (owner.track) ++owned[*owner.track];
      detections.write({row.line > 0 ? Cell(row.line) : Cell(), row.detection.time,
                        owner.track ? Cell(*owner.track) : Cell(), owner.support});
    }
    const std::vector<TrackedTarget> shown = confirmed_of(tracker);
    std::map<std::size_t, TrackedTarget> updated;  // at the times of their detections
    for (TrackedTarget& target : tracker.tracks()) updated.emplace(target.number, std::move(target));
    for (auto& [number, life] : outcome.tracks) life.goes_on = false;
    for (const TrackedTarget& predicted : shown) {
      const TrackedTarget& own = updated.at(predicted.number);
      const TrackedTarget& target = own.point.time >= scan.front().detection.time ? own : predicted;
      TrackLife& life = outcome.tracks[target.number];
      life = {target.first_time, target.point.time, life.scans + 1, target.detected, true};
      const EarthPoint point =
          scans.frame() ? on_earth(target.point, *scans.frame(), axes) : EarthPoint{target.point, {}};
      tracks.write(std::to_string(target.number), filter, point, target.existence);
    }
    if (page) page->add(tracker.time(), scan, tracker.owners(), shown, axes);
    if (scorer) scorer->add(tracker.time(), scan, shown);
    progress.advance(recording.csv().bytes_read() - progress.done());
  }
  for (const auto& [number, count] : owned)
    if (outcome.tracks.contains(number)) outcome.explained += count;
  outcome.scans = tracker.scans();
  outcome.finding = tracker.finding();
  outcome.exact = tracker.exact();
  return outcome;
}

void add_tracks(const AssociateOutcome& outcome, Result& result) {
  ResultTable table;
  for (const auto& [number, life] : outcome.tracks) {
    table.row_of({{of_words("track", "track"), std::to_string(number)},
                  {{.key = "first_time_s", .header = "from", .unit = "s", .digits = 1}, life.first_time},
                  {{.key = "last_time_s", .header = "to", .unit = "s", .digits = 1}, life.last_time},
                  {{.key = "scans", .header = "scans"}, life.scans},
                  {{.key = "detected", .header = "detected in"}, life.detected},
                  {{.key = "at_the_end", .header = "at the end"}, life.goes_on ? "yes" : "no"}});
  }
  if (!table.empty())
    result.add(
        table,
        {.printed = outcome.tracks.size() <= most_printed, .summary = {"tracks", "each"}, .title = "Confirmed tracks"});
}

void associate(const AssociateOptions& options) {
  RecordingOptions what = options.recording;
  const auto filters = filters_for(what, options.filters, options.radar.sigma, associate_defaults());
  const FilterSettings& filter = filters.front();
  if (filters.size() > 1)
    throw UsageError("associate runs one filter, and the settings name {}: --set filters={}", filters.size(),
                     filter.name);
  if (options.filters.print_config) return fmt::print("{}", as_toml(filters));
  if (options.radar.sigma && (what.track_id.empty() || !options.scan_s))
    throw UsageError(
        "--radar needs --labels COLUMN, which tells targets apart, and --scan SECONDS, the time of a scan");
  if (options.clutter && !options.radar.sigma) throw UsageError("--clutter is of a simulated radar; give --radar");
  what.simulated = options.radar.sigma.has_value();
  what.mixed = true;
  RecordingReader recording(what);
  refuse_radar(options.radar, recording);
  if (recording.has_only_velocities())
    throw InputError("{}: velocities alone do not tell which detections belong together; give positions",
                     recording.file());
  refuse_to_overwrite(options.output, {what.file, options.filters.config}, {"tracks.csv", "detections.csv"});
  ResultFiles files(options.output);
  ScanReader scans(options, recording, filter);
  std::optional<AssociatePage> page;
  if (files.report_wanted()) page.emplace();
  std::optional<Scorer> scorer;
  if (recording.has_tracks()) scorer.emplace(recording.axes());
  const AssociateOutcome outcome = run_associate(options, recording, scans, filter, files, page, scorer);

  Result result(options.output);
  const NamedAssociation& association = associations[options.association];
  const auto at_the_end = std::ranges::count_if(outcome.tracks, [](const auto& one) { return one.second.goes_on; });
  const std::string verdict = outcome.finding.value_or(fmt::format(
      "{} confirmed track{}, {} of them at the end; {} of {} detections are explained", outcome.tracks.size(),
      outcome.tracks.size() == 1 ? "" : "s", at_the_end, outcome.explained, outcome.detections));
  result.facts("file", recording.file(), "association", association.name, "filter", filter.name, "seed", options.seed,
               "rows", scans.rows(), "scans", outcome.scans, "detections", outcome.detections, "explained",
               outcome.explained, "exact", outcome.exact, "verdict", verdict);
  result.facts_at({"tracks"}, "confirmed", outcome.tracks.size(), "at_the_end", at_the_end);
  if (const auto& frame = scans.frame())
    result.facts_at({"origin"}, "latitude_deg", frame->origin().latitude_deg, "longitude_deg",
                    frame->origin().longitude_deg, "altitude_m", frame->origin().altitude_m);
  result.fact({"settings_toml"}, as_toml(filters));
  result.say("Verdict: {}", verdict);
  result.say("{}: {} rows, {} scans, {} detections; association {}, filter {}", recording.file(), scans.rows(),
             outcome.scans, outcome.detections, association.name, filter.name);
  result.say("Taken for: {}", recording.taken());
  for (const std::string& note : scans.notes()) result.say(note);
  if (!outcome.exact)
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
  if (page) page->add_to(result.page, recording.on_the_earth());
  add_tracks(outcome, result);
  if (scorer) {
    const Score score = scorer->score(options.cutoff);
    ResultTable table;
    table.row_of(fields_of(association.name, [&](Score::Figure figure) { return score.values[figure]; }));
    result.add(table, {.summary = {"score"}, .title = "Tracks and labels"});
    result.facts_at({"score"}, "cutoff_m", score.cutoff);
    result.say("RMS GOSPA with c = {:.3g} m, p = 2; the squares of its parts add up to its square", score.cutoff);
  }
  result.page.last.emplace_back(Words{"Settings in force", as_toml(filters), true});
  result.publish(files);
}

}  // namespace

MultiTargetTracker tracker_for(const AssociateOptions& options, const FilterSettings& filter, int axes,
                               const AssociationChoice& association) {
  MultiTargetRules rules = options.rules;
  if (filter.gate_probability < 1.0) rules.gate_probability = filter.gate_probability;
  return MultiTargetTracker(choice_of(filter, axes), association, rules);
}

std::vector<TrackedTarget> confirmed_of(const MultiTargetTracker& tracker) {
  std::vector<TrackedTarget> tracks = tracker.tracks(tracker.time());
  std::erase_if(tracks, [](const TrackedTarget& one) { return !one.confirmed; });
  return tracks;
}

FilterDefaults associate_defaults() {
  FilterDefaults defaults;
  defaults.names = {"imm"};
  defaults.filter.radar_measurement = RadarForm::polar;
  return defaults;
}

void add_associate(CLI::App& program, const std::string& command) {
  Subcommand app(program, "associate", "Finds the targets behind unlabelled detections, and tracks them.");
  const auto options = std::make_shared<AssociateOptions>();
  app.option("file", options->recording.file, "A recording as of track; - is the standard input");
  app.choice(
         "--association", each(associations, [](const auto& one) { return std::string(one.name); }),
         [options](int of) { options->association = static_cast<std::size_t>(of); },
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
      .one_of(names_of_situations());
  app.option("--radars", options->radars, "Radars at the corners of the situation, in turn; 0: positions are measured")
      .in(0, 4);
  app.option("--runs", options->runs, "Evaluate every association on so many runs of it").in(2, 1000000);
  add_threads(app, options->threads);
  add_seed(app, options->seed);
  add_filter_options(app, options->filters);
  add_results(app, options->output, command);
  app.run([options] {
    if (options->recording.file.empty() == options->situation.empty())
      throw UsageError("associate needs a file, or --simulate SITUATION: {}", fmt::join(names_of_situations(), ", "));
    options->situation.empty() ? associate(*options) : simulate_situation(*options);
  });
}

}  // namespace sigmax::apps
