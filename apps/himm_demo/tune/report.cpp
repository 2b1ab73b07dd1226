#include "himm_demo/tune/tune.hpp"
#include "shell/progress.hpp"

namespace sigmax::apps {
namespace {

/// What tuning found for one filter, and its innovations before and, if that is better, with the best settings.
struct Findings {
  TunedFilter tuned;
  std::vector<std::pair<std::string, Diagnosis>> diagnoses;
  const std::string& name() const { return tuned.before().settings.name; }
};

const char* unit_of(bool by_truth) { return by_truth ? "RMSE, m" : "nats a row"; }

/// The mean loss as people read it: nats a row, or the RMSE in m.
double figure_of(const RowLosses& losses, bool by_truth, const RowCounts& counts = {}) {
  const double mean = mean_loss(losses, counts);
  return by_truth ? std::sqrt(mean) : mean;
}

/// A number with four digits that count.
Cell four(double value) { return {value, fmt::format("{:.4g}", value)}; }

/// A table of sensors or of modes.
ResultTable innovations_table(const std::vector<Diagnosis::Part>& parts, bool modes) {
  ResultTable table;
  for (const Diagnosis::Part& part : parts) {
    const InnovationTally& tally = part.innovations;
    const bool any = tally.count() > 0;
    const Band band = any ? tally.band() : Band{nan, nan};
    const double nis = any ? tally.mean_square() : nan, right = tally.autocorrelation_band();
    std::vector<Field> fields = {
        {of_words("part", modes ? "mode" : "sensor"), part.name},
        {{.key = "rows", .header = "rows"}, tally.count()},
        {{.key = "nis", .header = "NIS"}, any ? Cell(nis, fmt::format("{:.3g}", nis)) : Cell(nan)},
        {{.header = "right"}, any ? fmt::format("{:.2f}–{:.2f}", band.lower, band.upper) : "–"},
        {{.key = "nis_lower"}, band.lower},
        {{.key = "nis_upper"}, band.upper}};
    if (modes)
      fields.push_back({{.key = "mean_weight", .header = "mean weight", .digits = 3}, part.weight});
    else
      fields.insert(fields.end(),
                    {{{.key = "neighbours", .header = "neighbours", .sign = true},
                      right > 0.0 ? Cell(tally.autocorrelation()) : Cell(nan)},
                     {{.key = "neighbours_right", .header = "right"}, Cell(right, fmt::format("±{:.2f}", right))},
                     {of_words("verdict", "verdict"), verdict_of(tally)}});
    table.row_of(fields);
  }
  return table;
}

ResultTable candidates_table(const TunedFilter& tuned, bool by_truth) {
  ResultTable table;
  for (std::size_t c = 0; c < tuned.candidates.size(); ++c) {
    const Candidate& candidate = tuned.candidates[c];
    const auto& [gain, error] = candidate.gain;
    const bool best = c == tuned.selected.best, simple = c == tuned.selected.simple;
    const std::string remark = best && simple ? "best, simple" : best ? "best" : simple ? "simple" : "";
    table.row_of({{of_words("models", "models"), candidate.name},
                  {{.key = "remark"}, remark},
                  {{.key = "numbers", .header = "fitted numbers"}, candidate.fitted_numbers},
                  {{.key = "fitted", .header = fmt::format("fitted, {}", unit_of(by_truth))},
                   four(figure_of(candidate.losses, by_truth))},
                  {{.key = "held_out", .header = fmt::format("held out, {}", unit_of(by_truth))},
                   four(figure_of(candidate.held_out, by_truth))},
                  {{.key = "gain", .header = by_truth ? "gain, m²" : "gain held out"},
                   c == 0 ? Cell() : Cell(gain, fmt::format("{:+.3g} ± {:.2g}", gain, error))},
                  {{.key = "gain_error"}, c == 0 ? Cell() : Cell(error)},
                  {of_words("", " "), remark}});
  }
  return table;
}

/// The settings that differ; "–" where there is none.
ResultTable changes_table(const TunedFilter& tuned) {
  const FilterSettings &before = tuned.before().settings, &best = tuned.best().settings;
  ResultTable table({of_words("key", "key"), of_words("before", "before"), of_words("best", "best")});
  const auto add = [&](const std::string& name, const std::string& was, const std::string& is) {
    if (was != is) table.row({name, was.empty() ? "–" : was, is.empty() ? "–" : is});
  };
  const auto written = [](const auto& key, const auto& owner) { return key.applies(owner) ? key.write(owner) : ""; };
  for (const auto& key : filter_keys()) add(key.name, written(key, before), written(key, best));
  for (const auto& key : accuracy_keys()) {
    add(key.name, written(key, before.accuracy), written(key, best.accuracy));
    for (const auto& [sensor, accuracy] : best.sensors)
      add(fmt::format("sensor.{}.{}", sensor, key.name), written(key, before.accuracy_of(sensor)),
          written(key, accuracy));
  }
  return table;
}

/// The fitted numbers of the best settings.
ResultTable numbers_table(const TunedFilter& tuned) {
  ResultTable table;
  for (const auto& [name, value, error, at_rounding] : tuned.best().numbers) {
    const bool known = !at_rounding && std::isfinite(error);
    const std::string remark = at_rounding ? "no less: its column is rounded"
                               : known     ? fmt::format(fmt::runtime(error < 100.0 ? "± {:.2g}" : "± {:.0f}"), error)
                                           : "not identifiable from these rows";
    table.row_of({{of_words("number", "fitted number"), name},
                  {{.key = "value", .header = "fitted"}, four(value)},
                  {{.key = "error"}, known ? error : nan},
                  {of_words("remark", "standard error"), remark}});
  }
  return table;
}

/// The mean loss held out in each fold, and in all of them: of the settings before and the best ones.
ResultTable folds_table(const TunedFilter& tuned, const TuneOptions& options, const TuneData& data) {
  const RowFolds folds = data.folds(options.folds);
  ResultTable table;
  for (std::size_t fold = 0; fold <= options.folds; ++fold) {
    const auto figure = [&](const Candidate& of) {
      return four(figure_of(of.held_out, options.truth, [&](std::size_t t, std::size_t k) {
        return fold == options.folds || folds[t][k] == fold;
      }));
    };
    table.row_of(
        {{of_words("fold", "held out"), fold == options.folds ? "all folds" : fmt::format("fold {}", fold + 1)},
         {{.key = "before", .header = "before"}, figure(tuned.before())},
         {{.key = "best", .header = "best"}, figure(tuned.best())}});
  }
  return table;
}

/// NIS of sensors and modes, before and after, in its band.
View view_of(const Findings& findings) {
  IntervalChart chart{.title = "NIS a measured quantity", .x_label = "NIS; right is 1", .reference = 1.0, .digits = 3};
  chart.wanted_label = "95 % of right filters";
  std::map<std::string, std::map<std::string, InnovationTally>> tallies;  // by part, and when
  for (const auto& [when, diagnosis] : findings.diagnoses)
    for (const auto* parts : {&diagnosis.sensors, &diagnosis.modes})
      for (const auto& part : *parts) tallies[part.name][when] = part.innovations;
  for (const auto& [when, diagnosis] : findings.diagnoses) {
    IntervalSeries& series = chart.series.emplace_back(IntervalSeries{.name = when, .group = when});
    for (auto& [name, own] : tallies) {
      const InnovationTally& tally = own[when];
      const bool any = tally.count() > 0;
      const Band band = any ? tally.band() : Band{nan, nan};
      series.values.push_back({any ? tally.mean_square() : nan, 0.0});
      series.wanted.push_back({band.lower, band.upper});
    }
  }
  for (const auto& [name, own] : tallies) chart.rows.push_back(name);
  return {findings.name(), {std::move(chart)}};
}

void add_diagnosis(Result& result, const Findings& findings) {
  const auto& [when, diagnosis] = findings.diagnoses.back();
  const std::string& name = findings.name();
  result.text += fmt::format("\nfilter {}: {}\n", printable(name), when == "best" ? "with the best settings" : when);
  const std::string title = fmt::format("{}, {}: ", name, when);
  result.add(innovations_table(diagnosis.sensors, false),
             {.summary = {"filters", name, when, "sensors"}, .title = title + "innovations of each sensor"});
  result.add(innovations_table(diagnosis.modes, true),
             {.summary = {"filters", name, when, "modes"}, .title = title + "rows by their most likely mode"});
  if (diagnosis.rmse_m) result.fact({"filters", name, when, "rmse_m"}, *diagnosis.rmse_m);
}

/// What came of it.
std::string verdict_of(const Findings& findings, bool by_truth) {
  const TunedFilter& tuned = findings.tuned;
  const Candidate& best = tuned.best();
  if (tuned.selected.best == 0)
    return fmt::format("{}: no settings are better than those before, which are written.", findings.name());
  std::string text = fmt::format("{}: {} with {} fitted numbers is best; held out it has {:.4g} {} rather than {:.4g}.",
                                 findings.name(), best.name, best.fitted_numbers, figure_of(best.held_out, by_truth),
                                 unit_of(by_truth), figure_of(tuned.before().held_out, by_truth));
  const auto &before = findings.diagnoses.front().second.rmse_m, &now = findings.diagnoses.back().second.rmse_m;
  if (before && now) text += fmt::format(" RMSE against the truth: {:.4g} m before, {:.4g} m now.", *before, *now);
  return text;
}

/// Tunes one filter, and adds what was found, and what is to be written.
void tune_and_add(Result& result, const FilterSettings& filter, TuneData& data, const TuneOptions& options,
                  std::vector<FilterSettings>& written) {
  Findings findings;
  Diagnosis before = diagnose(data, filter, options.truth);
  findings.tuned = tune(filter, data, options);
  const TunedFilter& tuned = findings.tuned;
  const auto add = [&](const ResultTable& table, const char* key, const std::string& title) {
    if (!table.empty())
      result.add(table, {.printed = key != std::string_view("held_out"),
                         .summary = {"filters", filter.name, key},
                         .title = filter.name + ": " + title});
  };
  findings.diagnoses.emplace_back("before", std::move(before));
  add_diagnosis(result, findings);
  const ResultTable changes = changes_table(tuned);
  add(candidates_table(tuned, options.truth), "candidates", "sets of models");
  add(changes, "settings", "settings that change");
  if (changes.empty()) result.text += "\nNo setting changes.\n";
  add(numbers_table(tuned), "numbers", "fitted numbers");
  add(folds_table(tuned, options, data), "held_out", "held out, by fold");
  if (tuned.selected.best > 0) {
    findings.diagnoses.emplace_back("best", diagnose(data, tuned.best().settings, options.truth));
    add_diagnosis(result, findings);
  }
  result.page.verdict.push_back(verdict_of(findings, options.truth));
  result.say("\n" + result.page.verdict.back());
  result.page.views.push_back(view_of(findings));
  written.push_back(tuned.best().settings);
  if (tuned.selected.simple != tuned.selected.best) {
    written.push_back(tuned.simple().settings);
    written.back().name += "_simple";
  }
}

std::string heading(const TuneData& data, const TuneOptions& options) {
  const std::array by = {"how well each measurement was predicted (nats a row; less is better)",
                         "the RMSE of the position against the truth"};
  const std::string short_ones = data.too_short > 0 ? fmt::format(" ({} too short)", data.too_short) : "";
  return fmt::format("{} measurements of {} track{}{}, judged by {}. Held out: {} folds {}.", data.measurements,
                     data.tracks.size(), data.tracks.size() == 1 ? "" : "s", short_ones, by[options.truth ? 1 : 0],
                     options.folds, data.tracks.size() >= 2 * options.folds ? "of tracks" : "in time");
}

}  // namespace

void run_tune(TuneOptions options) {
  auto filters = filters_for(options.recording, options.filters, options.radar.sigma);
  if (options.filters.print_config) {
    fmt::print("{}", as_toml(filters));
    return;
  }
  for (const auto& filter : filters) {
    // The likelihood that has no determinant finds any measurement possible where the noise is great enough.
    if (!options.truth && filter.likelihood == LikelihoodForm::possibility)
      throw InputError(
          "filter '{}': likelihood = \"possibility\": expected \"density\", since a possibility never blames noise "
          "that is too great; tune with --truth, or with likelihood=density",
          filter.name);
    model_sets(filter, options, nullptr);  // refuses what is none
  }
  options.threads = threads_or_all(options.threads);
  auto inputs = options.files;
  inputs.push_back(options.filters.config);
  refuse_to_overwrite("--out", options.out, inputs);
  refuse_to_overwrite(options.output, inputs);
  std::optional<AtomicFile> settings;  // made first, so that a bad name is known before the work
  if (!options.out.empty()) settings.emplace(options.out);
  ResultFiles files(options.output);
  TuneData data = read_tune_data(options, filters.front());
  if (data.has_only_velocities) start_at_zero(filters);
  Result result(options.output);
  result.page.title = fmt::format("Settings for {}", fmt::join(options.files, ", "));
  result.page.chooser = "Filter";
  result.page.groups = {{"before"}, {"best"}};
  result.page.verdict = {heading(data, options)};
  result.facts("measurements", data.measurements, "objective", std::string(unit_of(options.truth)), "folds",
               options.folds, "seed", options.seed);
  result.say(heading(data, options));
  for (const std::string& note : data.notes) result.say(note);
  std::vector<FilterSettings> written;
  for (const auto& filter : filters) tune_and_add(result, filter, data, options, written);
  result.page.last.emplace_back(Words{"Settings", as_toml(written), true});
  result.publish(files);
  if (!settings) return;
  settings->write(as_toml(written));
  settings->commit();
  fmt::print("\nWrote {}, which track --config takes\n", printable(options.out));
}

}  // namespace sigmax::apps
