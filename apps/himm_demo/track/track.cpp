#include "himm_demo/track/track.hpp"
#include "checks/checks.hpp"
#include "himm_demo/track/page.hpp"
#include "shell/command_line.hpp"

namespace sigmax::apps {

namespace {

template <class Counts>
std::string numbered(const Counts& counts) {
  return list_of(counts, [](const auto& one) { return fmt::format("{} {}", one.first, one.second); });
}

/// Makes the report part by part.
struct Reporter {
  const TrackOptions& options;
  const RecordingReader& recording;
  const std::vector<FilterSettings>& filters;
  const TrackOutcome& outcome;
  Result& result;
  const std::string& file = recording.file();
  bool truth_known = options.radar.sigma || recording.has_truth();

  /// With the recording's checks, and what a gate would make of it, if that was tried.
  void make(const RecordingChecks& checks, const std::vector<std::string>& findings, const TrackOutcome* gated) {
    add_facts();
    describe();
    result.page.title = "Tracks of " + options.recording.file;
    result.page.panels.emplace_back(Words{"The recording", result.text});
    judge(findings, gated, checks.assumed());
    if (recording.has_tracks()) list_tracks();
    for (std::size_t p = 0; p < (recording.has_roll() ? row_parts.size() : 1); ++p) tabulate(p);
    explain();
    result.page.last.emplace_back(Words{"Settings in force", as_toml(filters), true});
  }

  void add_facts() {
    result.facts("file", file, "seed", options.seed);
    if (const auto& sigma = options.radar.sigma)
      result.facts_at({"radar"}, "sigma_range_m", (*sigma)[0], "sigma_azimuth_deg", (*sigma)[1], "sigma_elevation_deg",
                      (*sigma)[2]);
    if (options.radar.sigma || outcome.some_unplaced)
      for (std::size_t i = 0; i < 3; ++i) result.fact({"radar", "at_m", i}, options.radar.place()[i]);
    if (const auto& origin = outcome.origin)
      result.facts_at({"origin"}, "latitude_deg", origin->latitude_deg, "longitude_deg", origin->longitude_deg,
                      "altitude_m", origin->altitude_m);
    result.facts("rows", outcome.rows, "measurements", outcome.measurements);
    if (outcome.partial > 0) result.fact({"partial_measurements"}, outcome.partial);
    if (outcome.bearings > 0) result.fact({"bearings"}, outcome.bearings);
    result.fact({"skipped"}, recording.skipped());
    for (const auto& [sensor, rows] : outcome.sensors) result.fact({"sensors", sensor}, rows);
    if (recording.has_tracks())
      result.facts_at({"tracks"}, "count", outcome.each.size(), "never_started", outcome.never_started);
    result.fact({"settings_toml"}, as_toml(filters));
  }

  /// The verdict, above all else: the findings, which are causes, or what they leave to be said of the result.
  void judge(const std::vector<std::string>& findings, const TrackOutcome* gated,
             const std::optional<std::string>& assumed) {
    std::vector<std::string> lines = findings;
    if (lines.empty()) lines.push_back(verdict_of(options, recording, filters, outcome, gated));
    for (const auto& filter : filters)
      for (const auto& [sensor, own] : filter.sensors)
        if (!outcome.sensors.contains(sensor))
          lines.push_back(fmt::format("key 'sensor.{}' of filter '{}': {} has no row of that sensor; correct the name",
                                      sensor, filter.name, file));
    result.fact({"verdict"}, lines);
    result.page.verdict = lines;
    const std::string described = std::exchange(result.text, "");
    if (assumed) result.say(*assumed);
    for (std::size_t i = 0; i < lines.size(); ++i) result.say((i == 0 ? "Verdict: " : "Also: ") + lines[i]);
    result.text += described;
  }

  /// Which filters have some of these, and how many.
  std::vector<std::pair<std::string, std::size_t>> counted(const char* what, std::size_t FilterOutcome::*count) {
    std::vector<std::pair<std::string, std::size_t>> counts;
    for (std::size_t f = 0; f < filters.size(); ++f) {
      if (outcome.filters[f].*count == 0) continue;
      counts.emplace_back(filters[f].name, outcome.filters[f].*count);
      result.fact({what, filters[f].name}, counts.back().second);
    }
    return counts;
  }

  /// What was read and how the filters started, in sentences.
  void describe() {
    const auto say = [&](bool holds, const std::string& words) { result.say({{holds, words}}); };
    const bool has_angles = recording.axes() == 2 || recording.holds(place_of(Role::polar) + 2);
    const bool converted = has_angles && std::ranges::none_of(filters, [](const FilterSettings& filter) {
                             return filter.radar_measurement == RadarForm::polar || filter.accuracy.range_rate_mps;
                           });
    std::vector<std::string> parts;  // of the measurements that are not positions along all axes
    if (outcome.partial > 0) parts.push_back(fmt::format("{} along some axes only", outcome.partial));
    if (outcome.bearings > 0) parts.push_back(fmt::format("{} bearings", outcome.bearings));
    say(true, fmt::format("{}: {} rows, {} measurements{}, {} {}{}{}", file, outcome.rows, outcome.measurements,
                          parts.empty() ? "" : fmt::format(" ({})", fmt::join(parts, ", ")), recording.axes(),
                          recording.axes() == 1 ? "axis" : "axes",
                          recording.geodetic() ? ", geodetic to local east-north-up" : "",
                          !recording.polar() ? ""
                          : converted        ? ", a radar's measurements converted"
                                             : ", a radar's measurements"));
    say(true, fmt::format("Taken for: {}", recording.taken()));
    say(!outcome.by_default.empty(),
        fmt::format("Sigmas that are the defaults: {}", fmt::join(outcome.by_default, ", ")));
    say(recording.has_only_velocities(),
        "There are no positions: without a given start a track starts at 0, a step before its first row, and positions "
        "are counted from there");
    say(recording.geodetic() && !truth_known,
        "σ assumes white measurement noise; GNSS errors are correlated, so true errors are larger");
    for (const auto& notes : {recording.notes(), outcome.places})
      for (const std::string& note : notes) say(true, note);
    say(recording.has_sensors() && !outcome.sensors.empty(), "Rows by sensor: " + numbered(outcome.sensors));
    for (const auto& [why, rows] : outcome.unused) say(true, fmt::format("Rows whose {}: {}", why, numbered(rows)));
    const std::size_t short_ones = outcome.never_started.size();
    say(recording.has_tracks(),
        fmt::format("{} track{} by {}{}", outcome.each.size(), outcome.each.size() == 1 ? "" : "s",
                    options.recording.track_id,
                    short_ones == 0 ? ""
                    : outcome.bearings == outcome.measurements
                        ? fmt::format(", {} of them without bearings that cross, from which every filter could start",
                                      short_ones)
                        : fmt::format(", {} of them too short for every filter to start", short_ones)));
    say(recording.skipped() > 0,
        fmt::format("Skipped {} rows whose time was not after that of the row before", recording.skipped()));
    say(outcome.unpredicted > 0,
        fmt::format("Nothing is predicted of {} of {} tracks, as restart_after_s goes by before that time",
                    outcome.unpredicted, outcome.predicted));
    say(options.predict_to && outcome.predicted == 0, "Nothing is predicted: every track ends at that time or later");
    const auto rejected = counted("rejected", &FilterOutcome::rejected);
    const auto restarts = counted("restarts", &FilterOutcome::restarts);
    say(!rejected.empty(), "Measurements that the gate turned away: " + numbered(rejected));
    say(outcome.refused_by_all.rows > 0, fmt::format("Turned away by every filter: {}, the first on line {}",
                                                     outcome.refused_by_all.rows, outcome.refused_by_all.first_line));
    say(!restarts.empty(), "Starts after a gap, or after rejections in a row: " + numbered(restarts));
    const auto sigma = options.radar.sigma.value_or(Position{});
    const auto at = options.radar.place();
    say(options.radar.sigma.has_value(),
        fmt::format("The recording is taken as the truth and measured by a simulated radar: {} m, {}°, {}° at ({}, {}, "
                    "{}) m, seed {}",
                    shortest(sigma[0]), shortest(sigma[1]), shortest(sigma[2]), shortest(at[0]), shortest(at[1]),
                    shortest(at[2]), options.seed));
  }

  /// The table of one part of the rows: a row for the measurement, if its error is known, and for each filter.
  void tabulate(std::size_t p) {
    ResultTable table;
    if (truth_known) table.row_of(row_of(p, outcome.raw[p], nullptr));
    for (std::size_t f = 0; f < filters.size(); ++f) table.row_of(row_of(p, outcome.filters[f].sums[p], &filters[f]));
    const std::string part(row_parts[p].name);
    result.add(table, {.summary = {"results", part}, .title = fmt::format("Rows: {}", part)});
  }

  /// A row for each track: what it is and how well the filters follow it.
  void list_tracks() {
    const bool gated = std::ranges::any_of(outcome.filters, [](const FilterOutcome& one) { return one.rejected > 0; });
    ResultTable table;
    for (const auto& [name, track] : outcome.each) {
      std::vector<Field> fields = {
          {of_words("track", "track"), name},
          {{.key = "rows", .header = "rows"}, track.rows},
          {{.key = "duration_s", .header = "lasts", .unit = "s", .digits = 0}, track.last_time - track.first_time},
          {{.key = "way_m", .header = "way", .unit = "km", .scale = 1e-3},
           track.estimates == 0 ? Cell(nan, "–") : Cell(track.way_m)}};
      for (std::size_t f = 0; f < filters.size(); ++f) {
        const auto& [nis, quantities, rejected] = track.nis[f];
        const std::string& filter = filters[f].name;
        fields.push_back({{.key = "nis_ratio_" + filter, .header = filter, .sized = true, .group = "NIS, right is 1:"},
                          quantities > 0 ? Cell(nis / static_cast<double>(quantities)) : Cell(nan, "–")});
      }
      for (std::size_t f = 0; gated && f < filters.size(); ++f)
        fields.push_back({{.key = "rejected_" + filters[f].name, .header = filters[f].name, .group = "turned away:"},
                          track.nis[f].rejected});
      fields.push_back({of_words("", "estimates"), track.estimates == 0 ? track.reason_without_estimates() : ""});
      table.row_of(fields);
    }
    result.add(table, {.printed = false, .summary = {"tracks", "each"}});
    result.page.panels.emplace_back(
        ReportTable{"The tracks", table, "A click on a name opens the track, one on a head sorts by it."});
  }

  /// Of a filter, or of the measurement.
  std::vector<Field> row_of(std::size_t p, const Sums& sums, const FilterSettings* filter) const {
    const std::size_t count = filter ? sums.count() : sums.error[0].count();
    const std::string name = filter ? filter->name : measurement_name;
    std::vector<Field> fields = {{of_words("filter", std::string(row_parts[p].name)), name},
                                 {{.key = "rows", .header = "rows"}, count}};
    const auto add = [&](std::string_view key, const std::string& group, const std::array<RootMeanSquare, 3>& values) {
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(recording.axes()); ++axis) {
        const std::string of(1, "xyz"[axis]);
        fields.push_back({{.key = fmt::format("{}_{}_m", key, of), .header = of, .sized = true, .group = group},
                          values[axis].count() > 0 ? Cell(values[axis].value())
                          : filter                 ? Cell("–")
                                                   : Cell()});
      }
    };
    if (truth_known) add("rmse", "RMSE, m:", sums.error);
    add("sigma", "σ, m:", sums.sigma);
    const InnovationTally& nis = sums.innovations;
    const bool judged = filter && nis.count() > 0;
    const double right = outcome.filters[0].sums[p].innovations.expected_nis();
    const std::string mean = right > 0.0 ? fmt::format("mean ({:.2g})", right) : "mean";
    fields.push_back(
        {{.key = "mean_nis", .header = mean, .sized = true, .group = "NIS:"}, judged ? Cell(nis.mean_nis()) : Cell()});
    fields.push_back({{.key = "median_nis", .header = "median", .sized = true, .group = "NIS:"},
                      judged ? Cell(nis.median_nis()) : Cell()});
    fields.push_back({{.key = "nis_inside_95", .header = "95 %", .digits = 1, .scale = 100.0, .group = "NIS:"},
                      judged ? Cell(nis.share_inside()) : Cell()});
    std::vector<std::string> weights;
    std::map<std::string, double> by_model;
    for (std::size_t j = 0; filter && count > 0 && j < filter->models.size(); ++j) {
      const double weight = by_model[filter->models[j]] = sums.weights[j] / static_cast<double>(count);
      weights.push_back(fmt::format("{} {:.3f}", filter->models[j], weight));
    }
    fields.push_back({of_words("", "mean weights"), list_of(weights)});
    for (const auto& model : model_names(filters)) {
      const auto weight = by_model.find(model);
      fields.push_back({{.key = "mean_weight_" + model}, weight == by_model.end() ? Cell() : Cell(weight->second)});
    }
    return fields;
  }

  /// When the modes changed; all of it in the data, the first changes in the text.
  void explain() {
    constexpr std::size_t shown = 12;
    for (std::size_t f = 0; f < filters.size(); ++f)
      for (const auto& [track, stays] : outcome.filters[f].histories) {
        if (stays.empty()) continue;
        std::vector<std::string> changes;
        for (std::size_t i = 0; i < stays.size(); ++i) {
          const std::string& mode = filters[f].models[stays[i].mode];
          result.facts_at({"histories", filters[f].name, track, i}, "since_s", stays[i].since, "mode", mode, "start",
                          stays[i].is_start);
          if (i < shown) changes.push_back(fmt::format("{} from {} s", mode, shortest(stays[i].since)));
        }
        result.text += "\n";
        result.say("Best history by {}{}: {}{}", filters[f].name, track.empty() ? "" : " of " + track,
                   fmt::join(changes, ", "),
                   stays.size() > shown ? fmt::format(", and {} changes more", stays.size() - shown) : "");
      }
  }
};

void track_and_report(TrackOptions options) {
  RecordingOptions what = options.recording;
  auto filters = filters_for(what, options.filters, options.radar.sigma);
  if (options.filters.print_config) {
    fmt::print("{}", as_toml(filters));
    return;
  }
  what.simulated = options.radar.sigma.has_value();
  RecordingReader recording(what);
  if (options.radar.at && !options.radar.sigma && !recording.polar() && !recording.bearings())
    throw UsageError("--radar-at is for --radar, for radar input and for bearings, but " + recording.file() +
                     " has no range_m and no azimuth_deg");
  refuse_radar(options.radar, recording);
  if (const std::string& text = options.predict_to_text; !text.empty()) {
    options.predict_to = recording.time_of(text, options.predict_to_time_of_day);
    if (!options.predict_to)
      throw UsageError({.what = "--predict-to", .found = in_quotes(text), .expected = "a time as in the file"});
  }
  if (recording.has_only_velocities()) start_at_zero(filters);
  refuse_to_overwrite(options.output, {options.recording.file, options.filters.config}, {"estimates.csv"});
  ResultFiles files(options.output);
  std::optional<TrackPage> tracks;
  if (files.report_wanted()) tracks.emplace(filters, recording, options.radar.sigma || recording.has_truth());
  RecordingChecks checks(recording);
  const auto see = [&](const Row& row, const LocalFrame* frame) { checks.see(row, frame); };
  TrackOutcome outcome = run_track(options, recording, filters, {&files, tracks ? &*tracks : nullptr, see});
  const auto findings = checks.findings();
  const auto gated = findings.empty() ? with_gate(options, what, filters, outcome) : std::nullopt;
  if (tracks) tracks->finish(outcome);
  Result result(options.output);
  Reporter{options, recording, filters, outcome, result}.make(checks, findings, gated ? &*gated : nullptr);
  if (tracks) tracks->add_to(result.page, outcome);
  result.publish(files);
}

}  // namespace

void add_track(CLI::App& program, const std::string& command) {
  Subcommand app(program, "track", "Tracks the targets of a recording, a headed CSV file.");
  const auto options = std::make_shared<TrackOptions>();
  app.option("file", options->recording.file, "A recording as below; - is the standard input").required();
  add_recording(app, options->recording, options->radar);
  app.option("--predict-to", options->predict_to_text, "A time up to which each target is predicted after its last row")
      .type("TIME");
  add_seed(app, options->seed);
  add_filter_options(app, options->filters);
  add_results(app, options->output, command);
  app.run([options] { track_and_report(*options); });
}

}  // namespace sigmax::apps
