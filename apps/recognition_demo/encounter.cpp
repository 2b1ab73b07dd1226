#include <map>

#include <sigmax/core/transform.hpp>
#include <sigmax/recognition/counts.hpp>
#include <sigmax/recognition/discretization.hpp>

#include "recognition_demo/subcommands.hpp"
#include "recognition_demo/world.hpp"
#include "support/csv.hpp"
#include "support/numbers.hpp"
#include "support/thinned.hpp"

namespace sigmax::apps {
namespace {

constexpr std::array<const char*, 4> feature_names = {"altitude_layer_ft_agl", "airspeed_kt",
                                                      "vertical_rate_ft_per_min", "turn_rate_deg_per_s"};

/// Where the bins of one feature begin and end, and how often one class was seen in each.
struct Layers {
  std::vector<double> edges, count;
};

std::size_t column_of(const CsvReader& reader, std::initializer_list<std::string_view> names) {
  for (const auto name : names)
    if (const auto found = reader.find(name)) return *found;
  return reader.column(*names.begin());  // throws
}

/// How often aircraft of each class were seen in each bin of four features: altitude above ground (ft), airspeed (kt),
/// vertical rate (ft/min) and turn rate (°/s).
struct EncounterData {
  Counts counts;
  std::vector<Discretization> bins;  ///< of each feature
  double lowest_ft;                  ///< where the first layer of altitude begins
};

/// Reads class,feature,bin,lower,upper,count; other features are ignored. Throws InputError with file, line, column and
/// value where bins leave a gap, and for a class or a feature without counts.
EncounterData read_encounter(const std::string& file) {
  CsvReader reader = open_csv(file);
  const std::size_t klass = reader.column("class"), feature = reader.column("feature");
  const std::size_t lower = reader.column("lower"), upper = reader.column("upper"), count = reader.column("count");
  std::vector<std::string> classes;
  std::map<std::pair<std::string, std::size_t>, Layers> all;
  for (CsvRow row; reader.next(row);) {
    const std::string name{trimmed(row[klass])};
    if (name.empty()) throw row.error(klass, "the name of a class");
    if (std::ranges::find(classes, name) == classes.end()) classes.push_back(name);
    const auto known = std::ranges::find(feature_names, trimmed(row[feature]));
    if (known == feature_names.end()) continue;
    Layers& layers = all[{name, static_cast<std::size_t>(known - feature_names.begin())}];
    const double begin = row.number(lower), end = row.number(upper), times = row.number(count);
    if (layers.edges.empty()) layers.edges.push_back(begin);
    if (layers.edges.back() != begin)
      throw row.error(lower, fmt::format("{}, where the bin before ends", layers.edges.back()));
    if (!(end > begin)) throw row.error(upper, fmt::format("a number above {}", begin));
    if (times < 0.0) throw row.error(count, "a count that is not negative");
    layers.edges.push_back(end);
    layers.count.push_back(times);
  }
  if (classes.size() < 2)
    throw InputError("{}: found {} classes, expected at least two", reader.file(), classes.size());

  std::vector<Discretization> bins;
  std::vector<RandomVariable> variables;
  for (std::size_t i = 0; i < feature_names.size(); ++i) {
    const Layers& first = all[{classes.front(), i}];
    for (const auto& name : classes) {
      const Layers& own = all[{name, i}];
      if (own.edges != first.edges || !(sum_of(own.count) > 0.0))
        throw InputError({.where = reader.file(),
                          .what = fmt::format("class {}, feature {}", in_quotes(name), in_quotes(feature_names[i])),
                          .expected = "counts, in the same bins for every class"});
    }
    bins.emplace_back(std::vector<double>(first.edges.begin() + 1, first.edges.end() - 1));
    variables.push_back(bins.back().variable<Random>(feature_names[i]));
  }
  Counts counts{RandomVariable{"class", classes}, variables};
  for (std::size_t c = 0; c < classes.size(); ++c)
    for (std::size_t i = 0; i < feature_names.size(); ++i) {
      const Layers& own = all[{classes[c], i}];
      for (std::size_t b = 0; b < own.count.size(); ++b) counts.observe_value(c, i, b, own.count[b]);
    }
  return {std::move(counts), std::move(bins), all[{classes.front(), 0}].edges.front()};
}

/// The reports of a recording.
struct TrackReports {
  std::vector<double> times_s{};
  std::vector<Readings> readings{};
  std::size_t rows = 0;           ///< of the recording
  std::size_t on_the_ground = 0;  ///< rows below the first layer of altitude
  double ground_ft = 0.0;
};

/// Reads a recording and reports every so many seconds while it flies; the turn rate is that between the row and the
/// one before, if that is at most 15 s earlier. Throws InputError with file, line, column and value.
TrackReports read_track(const std::string& file, const EncounterData& data, double every_s,
                        std::optional<double> ground_ft) {
  constexpr double longest_step_s = 15.0;
  CsvReader reader = open_csv(file);
  const std::size_t time = reader.column("time_s");
  const std::size_t altitude = column_of(reader, {"altitude_ft", "altitude_gnss_ft"});
  const std::size_t speed = column_of(reader, {"tas_kt", "groundspeed_kt"});
  const std::size_t track = reader.column("track_deg");
  const std::size_t climb = column_of(reader, {"vertical_rate_fpm", "roc_fpm"});

  struct Row {
    double time, altitude, speed, track, climb;
  };
  std::optional<std::size_t> name;  // of the aircraft
  for (const char* header : {"icao24", "hex", "track_id", "id"})
    if (!name) name = reader.find(header);
  std::string first;
  std::vector<Row> rows;
  const auto value = [&](const CsvRow& row, std::size_t column) { return row.optional_number(column).value_or(nan); };
  double lowest = std::numeric_limits<double>::infinity();
  for (CsvRow row; reader.next(row);) {
    if (name && rows.empty()) first = row[*name];
    if (name && row[*name] != first)
      throw row.error(*name, fmt::format("{}, as in the rows before: one aircraft", in_quotes(first)),
                      "write each aircraft to a file of its own");
    rows.push_back({row.number(time), value(row, altitude), value(row, speed), value(row, track), value(row, climb)});
    if (rows.size() > 1 && rows.back().time < rows[rows.size() - 2].time)
      throw row.error(time, fmt::format("a time not before {}", rows[rows.size() - 2].time));
    if (!std::isnan(rows.back().altitude)) lowest = std::min(lowest, rows.back().altitude);
  }
  if (!std::isfinite(lowest)) throw InputError("{}: no row has an altitude", reader.file());

  TrackReports result{.rows = rows.size(), .ground_ft = ground_ft.value_or(lowest)};
  double next = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row& row = rows[k];
    const double above_ground = row.altitude - result.ground_ft;
    if (above_ground < data.lowest_ft) ++result.on_the_ground;
    if (row.time < next || !(above_ground >= data.lowest_ft)) continue;
    double turn_rate = nan;
    if (k > 0 && row.time > rows[k - 1].time && row.time - rows[k - 1].time <= longest_step_s)
      turn_rate = std::remainder(row.track - rows[k - 1].track, 360.0) / (row.time - rows[k - 1].time);
    const std::array<double, 4> values = {above_ground, row.speed, row.climb, turn_rate};
    result.times_s.push_back(row.time);
    result.readings.push_back(each_below(values.size(), [&](std::size_t i) { return data.bins[i].bin(values[i]); }));
    next = row.time + every_s;
  }
  if (result.readings.empty())
    throw InputError(
        "{}: no row is {} ft or more above the ground at {} ft; give the altitude of the ground by --ground",
        reader.file(), data.lowest_ft, result.ground_ft);
  return result;
}

struct EncounterOptions {
  std::string file;
  std::size_t reports = 10;
  DrawOptions draws;
  std::string track;  ///< a recording to classify instead of draws
  double every_s = 10.0;
  std::optional<double> ground_ft;  ///< nothing: the lowest altitude of the recording
};

std::vector<Contestant> contestants(const Counts& counts) {
  const auto prior = uninformative(as_fuzzy(counts.pattern()));
  return {{"sigma", SigmaClassifier{uninformative(counts.pattern()), learned_relations(counts, 0.0)}},
          {"max, ratio scale", MaxClassifier{prior, learned_relations(counts, 0.0, RatioScale{})}},
          {"max, Dubois-Prade", MaxClassifier{prior, learned_relations(counts, 0.0, DuboisPrade{})}},
          {"max, Dubois-Prade-Sandri", MaxClassifier{prior, learned_relations(counts, 0.0, DuboisPradeSandri{})}}};
}

void say_counts(const EncounterOptions& options, const Counts& counts, Result& result) {
  result.say(
      "{}: p(f|c) from counts of radar samples, and π(f|c) of them by three transforms; the classes are equally "
      "plausible before",
      options.file);
  for (std::size_t c = 0; c < counts.pattern().size(); ++c)
    result.text +=
        fmt::format("  {}: {:.1f} million samples\n", counts.pattern().label(c), sum_of(counts.of(0, c)) * 1e-6);
}

void publish_draws(const EncounterOptions& options, const EncounterData& data, ResultFiles& files) {
  const DrawOptions& draws = options.draws;
  const auto relations = learned_relations(data.counts, 0.0);
  const auto draw_run = [&](std::size_t run) {
    RandomStream random(draws.seed, run);
    const std::size_t truth = draw_index(random, data.counts.pattern().size());
    std::vector<AnyReport> reports;
    for (std::size_t k = 0; k < options.reports; ++k)
      reports.emplace_back(each(relations, [&](const auto& relation) { return draw(random, relation.row(truth)); }));
    return Drawn{truth, {std::move(reports)}};
  };
  World world{"What class of aircraft is it?", {{contestants(data.counts), draw_run}}};
  world.tell = [&](const std::vector<Scores>& scores, Result& result) {
    say_counts(options, data.counts, result);
    result.say(
        "{} seeded draws from the counts themselves, every feature and report independent, as sigma inference assumes; "
        "seed {}",
        draws.runs, draws.seed);
    result.facts("file", options.file, "drawn_from", "the counts", "runs", draws.runs, "reports", options.reports,
                 "seed", draws.seed);
    result.page.verdict = {fmt::format("{} seeded draws of {} reports from the counts of {}; seed {}.", draws.runs,
                                       options.reports, options.file, draws.seed)};
    result.page.panels.emplace_back(accuracy_chart(scores.front()));
    result.page.last = relation_maps(relations, relations.size());
    add_scores(result, scores.front());
  };
  run_world(world, draws, files);
}

/// What a classifier makes of a recording: the share of single reports by which it decides for each class, ties shared,
/// and what it believes after each of them.
struct TrackOutcome {
  std::string name;
  std::vector<double> single;
  Beliefs beliefs;
};

TrackOutcome follow_track(const Contestant& contestant, const std::vector<Readings>& reports) {
  TrackOutcome outcome{contestant.name, {}, beliefs_over(contestant, {reports.begin(), reports.end()})};
  outcome.single.resize(outcome.beliefs.front().size());
  for (const Readings& report : reports)
    of_kind(judged(contestant, report).belief, [&](const auto& belief) {
      for (std::size_t c = 0; c < belief.size(); ++c)
        outcome.single[c] += credit_of(belief.logs(), c) / static_cast<double>(reports.size());
    });
  return outcome;
}

/// What was seen of each feature.
ResultTable seen_table(const EncounterData& data, const TrackReports& track) {
  ResultTable table({of_words("", "feature"), of_words("", "values seen, % of the reports")});
  for (std::size_t i = 0; i < data.bins.size(); ++i) {
    std::vector<double> shares(data.bins[i].size(), 0.0);
    for (const Readings& report : track.readings)
      if (report[i] != missing) shares[report[i]] += 1.0 / static_cast<double>(track.readings.size());
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
  ResultTable table;
  for (const TrackOutcome& outcome : outcomes) {
    std::vector<Field> row = {{of_words("", "classifier"), outcome.name}};
    for (std::size_t c = 0; c < pattern.size(); ++c)
      row.push_back({{.header = pattern.label(c), .digits = 1, .scale = 100.0, .group = "% of single reports that say"},
                     outcome.single[c]});
    for (std::size_t c = 0; c < pattern.size(); ++c)
      row.push_back({{.header = pattern.label(c), .group = "p or π after all:"},
                     fmt::format("{:.2g}", outcome.beliefs.back()[c])});
    table.row_of(row);
  }
  return table;
}

/// What each classifier thinks of the classes along a recording.
View view_of(const EncounterData& data, const std::vector<Contestant>& contestants, const TrackReports& track,
             const std::vector<TrackOutcome>& outcomes) {
  const std::vector<std::string> classes = labels_of(data.counts.pattern());
  const std::size_t columns = contestants.size() * classes.size();
  Thinned rows(columns, std::max<std::size_t>(1000, 4 * columns));
  for (std::size_t k = 0; k < track.times_s.size(); ++k) {
    std::vector<double> row;
    for (const auto& [name, single, beliefs] : outcomes) row.insert(row.end(), beliefs[k].begin(), beliefs[k].end());
    rows.add(track.times_s[k] - track.times_s.front(), row);
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
  std::vector<std::string> keys = {"time_s"};
  for (const auto& feature : data.counts.features()) keys.push_back(feature.name());
  auto table = ResultTable::of_keys(keys);
  for (std::size_t k = 0; k < track.times_s.size(); ++k) {
    std::vector<Cell> cells = {track.times_s[k]};
    for (std::size_t i = 0; const std::size_t reading : track.readings[k]) {
      const auto& bins = data.bins[i++];
      cells.push_back(reading == missing ? Cell() : Cell(bins.labels()[reading]));
    }
    table.row(std::move(cells));
  }
  return table;
}

void publish_track(const EncounterOptions& options, const EncounterData& data, ResultFiles& files) {
  const TrackReports track = read_track(options.track, data, options.every_s, options.ground_ft);
  const auto& pattern = data.counts.pattern();
  const auto all = contestants(data.counts);
  const auto outcomes = each(all, [&](const Contestant& one) { return follow_track(one, track.readings); });

  Result result = result_of_contest("What class of aircraft is " + options.track + "?", options.draws.output, all);
  say_counts(options, data.counts, result);
  result.say("{}: {} rows, {} of them below {} ft above the ground at {} ft; {} reports, {} s apart or more",
             options.track, track.rows, track.on_the_ground, data.lowest_ft, track.ground_ft, track.readings.size(),
             options.every_s);
  result.page.verdict = {
      fmt::format("{} reports, {} s apart or more; what they say together is more certain than it should be, for they "
                  "repeat each other.",
                  track.readings.size(), options.every_s)};
  result.page.views.push_back(view_of(data, all, track, outcomes));
  const auto decisions = decisions_table(pattern, outcomes);
  result.page.last.emplace_back(ReportTable{"Decisions", decisions, "Ties share a report."});
  result.add(seen_table(data, track), {.title = "What was seen"});
  result.add(decisions, {});
  result.say(
      "(Ties share a report. Reports so close in time repeat each other, and every classifier takes them for "
      "independent: the belief after all of them is more certain than it should be.)");
  result.add(reports_table(data, track), {.printed = false, .csv = "reports.csv"});
  result.facts("file", options.file, "track", options.track, "reports", track.readings.size(), "ground_ft",
               track.ground_ft);
  for (const TrackOutcome& outcome : outcomes)
    for (std::size_t c = 0; c < pattern.size(); ++c) {
      result.fact({"classifiers", outcome.name, "share_of_single_reports", pattern.label(c)}, outcome.single[c]);
      result.fact({"classifiers", outcome.name, "belief_after_all", pattern.label(c)}, outcome.beliefs.back()[c]);
    }
  result.publish(files);
}

void run_encounter(const EncounterOptions& options) {
  refuse_to_overwrite(options.draws.output, {options.file, options.track}, {"curves.csv", "reports.csv"});
  ResultFiles files(options.draws.output);
  const EncounterData data = read_encounter(options.file);
  (options.track.empty() ? publish_draws : publish_track)(options, data, files);
}

}  // namespace

void add_encounter(CLI::App& program, const std::string& command) {
  const auto options = std::make_shared<EncounterOptions>();
  Subcommand app(program, "encounter",
                 "What class of aircraft is it? From counts of altitude, airspeed, climb and turn rate.");
  app.option("counts", options->file,
             "Counts by class and feature: class,feature,bin,lower,upper,count; or - for the standard input")
      .required()
      .type("COUNTS.csv");
  app.option("--reports", options->reports, "Reports in a drawn run").in(1, 100000);
  const Option track =
      app.option("--track", options->track,
                 "Instead of drawing, classify a recording: time_s, altitude_ft (or altitude_gnss_ft), groundspeed_kt "
                 "(or tas_kt), track_deg, vertical_rate_fpm (or roc_fpm)")
          .type("FILE.csv");
  app.option("--every", options->every_s, "Seconds between two reports of a recording")
      .number_in(0.001, 1e6)
      .needs(track);
  app.option("--ground", options->ground_ft, "Altitude of the ground, in ft [the recording's lowest]")
      .number_in(-2000.0, 30000.0)
      .needs(track)
      .type("FT");
  add_draws(app, options->draws, command, 50000);
  app.run([options] { run_encounter(*options); });
}

}  // namespace sigmax::apps
