#include <memory>
#include <optional>

#include <fmt/format.h>

#include <sigmax/core/transform.hpp>
#include <sigmax/recognition/decision.hpp>

#include "recognition_demo/contest_report.hpp"
#include "recognition_demo/draws.hpp"
#include "recognition_demo/encounter_data.hpp"
#include "recognition_demo/pages.hpp"
#include "recognition_demo/subcommands.hpp"
#include "support/command_line.hpp"
#include "support/thinned.hpp"

namespace sigmax::apps {
namespace {

struct EncounterOptions {
  std::string file;
  std::size_t reports = 10;
  DrawOptions draws;
  std::string track;  ///< a recording to classify instead of draws
  double every_s = 10.0;
  std::optional<double> ground_ft;  ///< nothing: the lowest altitude of the recording
};

template <PossibilityTransform Method>
Contestant max_by(const std::string& name, const Counts& counts, const Method& method) {
  return {name, MaxClassifier{uninformative(as_fuzzy(counts.pattern())), learned_relations(counts, 0.0, method)}};
}

std::vector<Contestant> contestants(const Counts& counts) {
  return {{"sigma", SigmaClassifier{uninformative(counts.pattern()), learned_relations(counts, 0.0)}},
          max_by("max, ratio scale", counts, RatioScale{}),
          max_by("max, Dubois-Prade", counts, DuboisPrade{}),
          max_by("max, Dubois-Prade-Sandri", counts, DuboisPradeSandri{})};
}

void say_counts(const EncounterOptions& options, const Counts& counts, Result& result) {
  result.say(
      fmt::format("{}: p(f|c) from counts of radar samples, and π(f|c) of them by three transforms; the classes are "
                  "equally plausible before",
                  options.file));
  for (std::size_t c = 0; c < counts.pattern().size(); ++c) {
    double samples = 0.0;
    for (const double count : counts.of(0, c)) samples += count;
    result.text += fmt::format("  {}: {:.1f} million samples\n", counts.pattern().label(c), samples * 1e-6);
  }
}

Result result_of_draws(const EncounterOptions& options, const EncounterData& data) {
  const DrawOptions& draws = options.draws;
  const auto all = contestants(data.counts);
  const auto relations = learned_relations(data.counts, 0.0);
  Scoreboard board(all);
  Progress progress("runs", draws.runs, draws.output.quiet);
  for_each_draw(
      draws, progress,
      [&](RandomStream& random) {
        const std::size_t truth = draw_index(random, data.counts.pattern().size());
        std::vector<Readings> reports(options.reports);
        for (Readings& report : reports)
          for (const auto& relation : relations) report.push_back(draw(random, relation.row(truth)));
        return follow_all(all, truth, reports);
      },
      [&](std::size_t, const RunTraces& traces) { board.add(traces); });
  progress.finish();

  const auto scores = board.scores();
  Result result = result_of_contest("What class of aircraft is it?", draws.output, all);
  say_counts(options, data.counts, result);
  result.say(
      fmt::format("{} seeded draws from the counts themselves, every feature and report independent, as sigma "
                  "inference assumes; seed {}",
                  draws.runs, draws.seed));
  result.fact({"file"}, options.file);
  result.fact({"drawn_from"}, "the counts");
  result.fact({"runs"}, draws.runs);
  result.fact({"reports"}, options.reports);
  result.fact({"seed"}, draws.seed);
  result.page.verdict = {fmt::format("{} seeded draws of {} reports from the counts of {}; seed {}.", draws.runs,
                                     options.reports, options.file, draws.seed)};
  result.page.panels = {accuracy_chart(scores)};
  result.page.last = relation_maps(relations, relations.size());
  add_scores(result, scores);
  return result;
}

/// The share of single reports by which a classifier decides for each class, ties shared, and its belief after all.
struct TrackOutcome {
  std::string name;
  std::vector<double> single;
  std::vector<double> belief;
};

template <class Kind>
TrackOutcome follow_track(const std::string& name, Classifier<Kind, Kind> classifier,
                          const std::vector<TrackReport>& reports) {
  TrackOutcome outcome{name, std::vector<double>(classifier.prior().size(), 0.0), {}};
  for (const TrackReport& report : reports) {
    classifier.reset();
    classifier.observe(report.readings);
    for (std::size_t c = 0; c < outcome.single.size(); ++c)
      outcome.single[c] += credit_of(classifier.log_belief().logs(), c) / static_cast<double>(reports.size());
  }
  classifier.reset();
  for (const TrackReport& report : reports) classifier.observe(report.readings);
  const auto belief = classifier.belief();
  outcome.belief.assign(belief.values().begin(), belief.values().end());
  return outcome;
}

/// What was seen of each feature.
ResultTable seen_table(const EncounterData& data, const TrackReports& track) {
  ResultTable table(
      {{.header = "feature", .align = Align::left}, {.header = "values seen, % of the reports", .align = Align::left}});
  for (std::size_t i = 0; i < data.bins.size(); ++i) {
    std::vector<double> shares(data.bins[i].size(), 0.0);
    for (const TrackReport& report : track.reports)
      if (report.readings[i] != missing) shares[report.readings[i]] += 1.0 / static_cast<double>(track.reports.size());
    std::string text;
    for (std::size_t b = 0; b < shares.size(); ++b)
      if (shares[b] > 0.0)
        text += fmt::format("{}{}: {:.1f}", text.empty() ? "" : ", ", data.bins[i].labels()[b], 100.0 * shares[b]);
    table.row({data.counts.features()[i].name(), text.empty() ? "none" : text});
  }
  return table;
}

/// What the classifiers make of a recording.
ResultTable decisions_table(const RandomVariable& pattern, const std::vector<TrackOutcome>& outcomes) {
  std::vector<ResultColumn> columns = {{.header = "classifier", .align = Align::left}};
  for (std::size_t c = 0; c < pattern.size(); ++c)
    columns.push_back(
        {.header = pattern.label(c), .digits = 1, .scale = 100.0, .group = "% of single reports that say"});
  for (std::size_t c = 0; c < pattern.size(); ++c)
    columns.push_back({.header = pattern.label(c), .group = "p or π after all:"});
  ResultTable table(std::move(columns));
  for (const TrackOutcome& outcome : outcomes) {
    std::vector<Cell> cells = {outcome.name};
    cells.insert(cells.end(), outcome.single.begin(), outcome.single.end());
    for (const double value : outcome.belief) cells.emplace_back(fmt::format("{:.2g}", value));
    table.row(std::move(cells));
  }
  return table;
}

/// What each classifier thinks of the classes along a recording.
View view_of(const EncounterData& data, const std::vector<Contestant>& contestants, const TrackReports& track) {
  const std::vector<std::string> classes = labels_of(data.counts.pattern());
  std::vector<Readings> reports;
  for (const TrackReport& report : track.reports) reports.push_back(report.readings);
  std::vector<Beliefs> beliefs;
  for (const Contestant& contestant : contestants) beliefs.push_back(beliefs_over(contestant, reports));
  const std::size_t columns = contestants.size() * classes.size();
  Thinned rows(columns, std::max<std::size_t>(1000, 4 * columns));
  for (std::size_t k = 0; k < reports.size(); ++k) {
    std::vector<double> row;
    for (const Beliefs& one : beliefs) row.insert(row.end(), one[k].begin(), one[k].end());
    rows.add(track.reports[k].time_s - track.reports.front().time_s, row);
  }
  std::vector<Beliefs> kept(contestants.size(), Beliefs(rows.kept(), std::vector<double>(classes.size())));
  for (std::size_t column = 0; column < columns; ++column) {
    const auto values = rows.column(column);
    for (std::size_t k = 0; k < values.size(); ++k)
      kept[column / classes.size()][k][column % classes.size()] = values[k];
  }
  View view{"all reports", support_charts(classes, contestants, kept, rows.times(), "time since the first report, s")};
  if (rows.thinned())
    for (Panel& panel : view.panels)
      std::get<LineChart>(panel).note = fmt::format(
          "Thinned: of {} reports {} are drawn, with the extremes of every stretch.", rows.taken(), rows.kept());
  return view;
}

ResultTable reports_table(const EncounterData& data, const TrackReports& track) {
  std::vector<ResultColumn> columns = {{.key = "time_s"}};
  for (const auto& feature : data.counts.features()) columns.push_back({.key = feature.name()});
  ResultTable table(std::move(columns));
  for (const TrackReport& report : track.reports) {
    std::vector<Cell> cells = {report.time_s};
    for (std::size_t i = 0; i < report.readings.size(); ++i)
      cells.push_back(report.readings[i] == missing ? Cell() : Cell(data.bins[i].labels()[report.readings[i]]));
    table.row(std::move(cells));
  }
  return table;
}

Result result_of_track(const EncounterOptions& options, const EncounterData& data) {
  const TrackReports track = read_track(options.track, data, options.every_s, options.ground_ft);
  const auto& pattern = data.counts.pattern();
  const auto all = contestants(data.counts);
  std::vector<TrackOutcome> outcomes;
  for (const Contestant& contestant : all)
    outcomes.push_back(
        std::visit([&](const auto& classifier) { return follow_track(contestant.name, classifier, track.reports); },
                   contestant.classifier));

  Result result = result_of_contest("What class of aircraft is " + options.track + "?", options.draws.output, all);
  say_counts(options, data.counts, result);
  result.say(fmt::format(
      "{}: {} rows, {} of them below {} ft above the ground at {} ft; {} reports, {} s apart or more", options.track,
      track.rows, track.on_the_ground, data.lowest_ft, track.ground_ft, track.reports.size(), options.every_s));
  result.page.verdict = {
      fmt::format("{} reports, {} s apart or more; what they say together is more certain than it should "
                  "be, for they repeat each other.",
                  track.reports.size(), options.every_s)};
  result.page.views = {view_of(data, all, track)};
  const auto decisions = decisions_table(pattern, outcomes);
  result.page.last = {ReportTable{"Decisions", decisions, "Ties share a report."}};
  result.add(seen_table(data, track), {.title = "What was seen"});
  result.add(decisions, {});
  result.say(
      "(Ties share a report. Reports so close in time repeat each other, and every classifier takes them for "
      "independent: the belief after all of them is more certain than it should be.)");
  result.add(reports_table(data, track), {.printed = false, .csv = "reports.csv"});
  result.fact({"file"}, options.file);
  result.fact({"track"}, options.track);
  result.fact({"reports"}, track.reports.size());
  result.fact({"ground_ft"}, track.ground_ft);
  for (const TrackOutcome& outcome : outcomes)
    for (std::size_t c = 0; c < pattern.size(); ++c) {
      result.fact({"classifiers", outcome.name, "share_of_single_reports", pattern.label(c)}, outcome.single[c]);
      result.fact({"classifiers", outcome.name, "belief_after_all", pattern.label(c)}, outcome.belief[c]);
    }
  return result;
}

void run_encounter(const EncounterOptions& options) {
  refuse_to_overwrite(options.draws.output, {options.file, options.track}, {"curves.csv", "reports.csv"});
  ResultFiles files(options.draws.output);
  const EncounterData data = read_encounter(options.file);
  (options.track.empty() ? result_of_draws : result_of_track)(options, data).publish(files);
}

}  // namespace

void add_encounter(CLI::App& program, const std::string& command) {
  const auto options = std::make_shared<EncounterOptions>();
  options->draws.output.command = command;
  options->draws.runs = 50000;
  Subcommand app(program, "encounter",
                 "What class of aircraft is it? From counts of altitude, airspeed, climb and turn rate.");
  app.option("counts", options->file,
             "Counts by class and feature: class,feature,bin,lower,upper,count; or - for the standard input")
      .required()
      .type("COUNTS.csv");
  app.option("--reports", options->reports, "Reports in a drawn run").in(1, 100000).shows_default();
  const Option track =
      app.option("--track", options->track,
                 "Instead of drawing, classify a recording: time_s, altitude_ft (or altitude_gnss_ft), "
                 "groundspeed_kt (or tas_kt), track_deg, vertical_rate_fpm (or roc_fpm)")
          .type("FILE.csv");
  app.option("--every", options->every_s, "Seconds between two reports of a recording")
      .number_in(0.001, 1e6)
      .needs(track)
      .shows_default();
  app.option("--ground", options->ground_ft, "Altitude of the ground, in ft [the recording's lowest]")
      .number_in(-2000.0, 30000.0)
      .needs(track)
      .type("FT");
  add_draws(app, options->draws);
  add_report(app, options->draws.output);
  app.footer(
      "Examples:\n"
      "  recognition_demo encounter encounter_features.csv\n"
      "  recognition_demo encounter encounter_features.csv --track helicopter.csv \\\n"
      "    --every 30");
  app.run([options] { run_encounter(*options); });
}

}  // namespace sigmax::apps
