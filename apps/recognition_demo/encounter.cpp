#include "recognition_demo/encounter.hpp"

#include <optional>

#include <fmt/format.h>

#include <sigmax/core/transform.hpp>
#include <sigmax/recognition/decision.hpp>

#include "recognition_demo/contest_report.hpp"
#include "recognition_demo/draws.hpp"
#include "recognition_demo/encounter_data.hpp"
#include "support/parallel.hpp"
#include "support/csv.hpp"
#include "support/progress.hpp"
#include "support/table.hpp"

namespace sigmax::apps {
namespace {

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

void print_counts(const EncounterOptions& options, const Counts& counts) {
  fmt::print(
      "{}: p(f|c) from counts of radar samples, and π(f|c) of them by three transforms; the classes are equally\n"
      "plausible before\n",
      options.file);
  for (std::size_t c = 0; c < counts.pattern().size(); ++c) {
    double samples = 0.0;
    for (const double count : counts.of(0, c)) samples += count;
    fmt::print("  {}: {:.1f} million samples\n", counts.pattern().label(c), samples * 1e-6);
  }
}

void draw_and_report(const EncounterOptions& options, const EncounterData& data,
                     const std::optional<OutputDirectory>& directory) {
  const auto all = contestants(data.counts);
  const auto relations = learned_relations(data.counts, 0.0);
  const auto trace = [&](std::size_t run) {
    RandomStream random(options.seed, run);
    RunTraces result{draw_index(random, data.counts.pattern().size()), {}};
    std::vector<Readings> reports(options.reports);
    for (Readings& report : reports)
      for (const auto& relation : relations) report.push_back(draw(random, relation.row(result.truth)));
    for (const Contestant& contestant : all) result.traces.push_back(follow(contestant, result.truth, reports));
    return result;
  };
  Progress progress("runs", options.runs, options.quiet);
  const auto scores = score(all, options.runs, threads_or_all(options.threads), trace,
                            [&](std::size_t, const RunTraces&) { progress.advance(); });
  progress.finish();

  fmt::print(
      "{} seeded draws from the counts themselves, every feature and report independent, as sigma inference assumes;\n"
      "seed {}\n\n",
      options.runs, options.seed);
  print_scores(scores);
  if (!directory) return;
  Json summary = summary_of(options.command);
  summary["file"] = options.file;
  summary["drawn_from"] = "the counts";
  summary["runs"] = options.runs;
  summary["reports"] = options.reports;
  summary["seed"] = options.seed;
  summary["classifiers"] = as_json(scores);
  AtomicFile curves = curves_file(scores, *directory), summary_json = summary_file(summary, *directory);
  commit_all(curves, summary_json);
  print_written({"curves.csv", "summary.json"}, options.out);
}

/// The share of single reports by which a classifier decides for each class, ties shared, and its belief after all.
struct TrackOutcome {
  std::vector<double> single;
  std::vector<double> belief;
};

template <class Kind>
TrackOutcome follow_track(Classifier<Kind, Kind> classifier, const std::vector<TrackReport>& reports) {
  TrackOutcome outcome{std::vector<double>(classifier.prior().size(), 0.0), {}};
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

void track_and_report(const EncounterOptions& options, const EncounterData& data,
                      const std::optional<OutputDirectory>& directory) {
  const TrackReports track = read_track(options.track, data, options.every_s, options.ground_ft);
  const auto all = contestants(data.counts);
  const auto& pattern = data.counts.pattern();

  fmt::print("{}: {} rows, {} of them below {} ft above the ground at {} ft; {} reports, {} s apart or more\n\n",
             options.track, track.rows, track.on_the_ground, data.lowest_ft, track.ground_ft, track.reports.size(),
             options.every_s);
  TextTable seen({{"feature", Align::left}, {"values seen, % of the reports", Align::left}});
  for (std::size_t i = 0; i < data.bins.size(); ++i) {
    std::vector<double> shares(data.bins[i].size(), 0.0);
    for (const TrackReport& report : track.reports)
      if (report.readings[i] != missing) shares[report.readings[i]] += 1.0 / static_cast<double>(track.reports.size());
    std::string text;
    for (std::size_t b = 0; b < shares.size(); ++b)
      if (shares[b] > 0.0)
        text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", data.bins[i].labels()[b], percent(shares[b]));
    seen.row({data.counts.features()[i].name(), text.empty() ? "none" : text});
  }
  seen.print();
  fmt::print("\n");

  std::vector<TextTable::Column> columns = {{"% of single reports that say", Align::left}};
  for (std::size_t c = 0; c < pattern.size(); ++c) columns.push_back({pattern.label(c)});
  for (std::size_t c = 0; c < pattern.size(); ++c)
    columns.push_back({(c == 0 ? "p or π after all: " : "") + pattern.label(c)});
  TextTable table(columns);
  Json summary = summary_of(options.command);
  summary["file"] = options.file;
  summary["track"] = options.track;
  summary["reports"] = track.reports.size();
  summary["ground_ft"] = track.ground_ft;
  for (const Contestant& contestant : all) {
    const TrackOutcome outcome = std::visit(
        [&](const auto& classifier) { return follow_track(classifier, track.reports); }, contestant.classifier);
    std::vector<std::string> cells = {contestant.name};
    for (const double share : outcome.single) cells.push_back(percent(share));
    for (const double value : outcome.belief) cells.push_back(fmt::format("{:.2g}", value));
    table.row(cells);
    for (std::size_t c = 0; c < pattern.size(); ++c) {
      summary["classifiers"][contestant.name]["share_of_single_reports"][pattern.label(c)] = outcome.single[c];
      summary["classifiers"][contestant.name]["belief_after_all"][pattern.label(c)] = outcome.belief[c];
    }
  }
  table.print();
  fmt::print(
      "(Ties share a report. Reports so close in time repeat each other, and every classifier takes them for "
      "independent:\n"
      "the belief after all of them is more certain than it should be.)\n");
  if (!directory) return;
  AtomicFile file = directory->file("reports.csv");
  file.write("time_s");
  for (const auto& feature : data.counts.features()) file.print(",{}", feature.name());
  file.write("\n");
  for (const TrackReport& report : track.reports) {
    file.print("{}", shortest(report.time_s));
    for (std::size_t i = 0; i < report.readings.size(); ++i)
      file.print(",{}", report.readings[i] == missing ? "" : csv_field(data.bins[i].labels()[report.readings[i]]));
    file.write("\n");
  }
  AtomicFile summary_json = summary_file(summary, *directory);
  commit_all(file, summary_json);
  print_written({"reports.csv", "summary.json"}, options.out);
}

}  // namespace

void encounter_and_report(const EncounterOptions& options) {
  std::optional<OutputDirectory> directory;  // made first, so that a bad one is known before the work
  if (!options.out.empty()) directory.emplace(options.out);
  const EncounterData data = read_encounter(options.file);
  print_counts(options, data.counts);
  if (options.track.empty())
    draw_and_report(options, data, directory);
  else
    track_and_report(options, data, directory);
}

}  // namespace sigmax::apps
