#include <sigmax/estimation/consistency.hpp>

#include "himm_demo/tune/tune.hpp"
#include "shell/command_line.hpp"
#include "shell/json.hpp"
#include "shell/progress.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

/// What one filter's innovations say of its settings.
struct Diagnosis {
  struct Part {
    std::string name;
    InnovationTally innovations{};
    double weight = 0.0;  ///< mean, of a mode
  };
  std::vector<Part> sensors;
  std::vector<Part> modes;                         ///< rows of which the mode is the most likely
  std::optional<double> rmse_m;                    ///< where the truth is known
  double told_m = 0.0;                             ///< what the filter takes that for
  std::vector<RowPlace> set_aside{};               ///< that the gate turned away
  std::map<std::string, InnovationTally> files{};  ///< of the rows of each
};

/// What tuning found for one filter, and its innovations before and, if that is better, with the best settings.
struct TuneFindings {
  Diagnosis before;
  std::optional<Diagnosis> after;
  TunedFilter tuned;
};

constexpr const char *before_name = "before", *best_name = "best", *simple_name = "simple";

const std::string& name_of(const TuneFindings& findings) { return findings.tuned.before().settings.name; }

const char* unit_of(Objective objective) { return objective == Objective::rmse ? "RMSE, m" : "nats a row"; }

/// What is wrong with a sensor, in words.
std::string_view verdict_of(const InnovationTally& sensor) {
  if (sensor.count() < 10) return "too few rows to say";
  const double nis = sensor.mean_square(), apart = sensor.autocorrelation();
  const bool high = nis > sensor.band().upper, low = nis < sensor.band().lower;
  const bool lags = apart > sensor.autocorrelation_band(), overshoots = apart < -sensor.autocorrelation_band();
  if (high) return lags ? "models too stiff" : "optimistic sensor";
  if (low) return overshoots ? "models too loose" : "pessimistic sensor";
  return lags ? "gain too low" : overshoots ? "gain too high" : "as it should be";
}

/// What to do: sentences.
std::vector<std::string> advice_of(const Diagnosis& diagnosis) {
  const std::map<std::string_view, std::string_view> remedies = {
      {"models too stiff", "errors are greater than believed, and last: raise sigma_w, or add a model that manoeuvres"},
      {"optimistic sensor",
       "errors are greater than believed, and do not last: raise its sigmas, by a factor of {:.3g} at most"},
      {"models too loose", "errors are smaller than believed, and alternate: lower sigma_w"},
      {"pessimistic sensor", "errors are smaller than believed: lower its sigmas, by a factor of {:.3g} at most"},
      {"gain too low", "errors last: raise sigma_w, or lower its sigmas"},
      {"gain too high", "errors alternate: lower sigma_w, or raise its sigmas"}};
  constexpr double much_the_same = 0.5;
  std::vector<std::string> sentences;
  for (const auto& [name, innovations, weight] : diagnosis.sensors)
    if (const auto found = remedies.find(verdict_of(innovations)); found != remedies.end())
      sentences.push_back(fmt::format("{}{}: {}.", name == "all rows" ? "" : "sensor ", name,
                                      fmt::format(fmt::runtime(found->second), std::sqrt(innovations.mean_square()))));
  for (const auto& [name, innovations, weight] : diagnosis.sensors)
    if (verdict_of(innovations) == "pessimistic sensor" && innovations.autocorrelation() > much_the_same)
      sentences.push_back(fmt::format(
          "{}{}: neighbouring innovations are alike: if rows were averaged, smoothed or interpolated, sigmas that fit "
          "them are of a curve, and the target is farther from the estimates than they say.",
          name == "all rows" ? "" : "sensor ", name));
  std::size_t rows = 0;
  for (const auto& mode : diagnosis.modes) rows += mode.innovations.count();
  for (const auto& mode : diagnosis.modes)
    if (diagnosis.modes.size() > 1 && 100 * mode.innovations.count() < rows)
      sentences.push_back(
          fmt::format("model {}: it is almost never the most likely: drop it, or let it differ more.", mode.name));
  constexpr std::size_t one_in = 20;
  if (const std::size_t aside = diagnosis.set_aside.size(); one_in * aside > rows + aside)
    sentences.push_back(fmt::format(
        "{} of {} rows are set aside, since no model expects them, and all this is said of the others "
        "alone: see what is their own; where they are flights or turns, a greater sigma_w expects them, and where "
        "velocities are measured beside positions, --models cwna,cwpa,cwna+cwpa may.",
        aside, rows + aside));
  std::map<double, std::string> by_nis;
  for (const auto& [file, innovations] : diagnosis.files)
    if (innovations.count() >= 40) by_nis.emplace(innovations.mean_square(), file);
  if (!by_nis.empty() && by_nis.rbegin()->first > 4.0 * by_nis.begin()->first)
    sentences.push_back(
        fmt::format("the NIS is {:.2g} in {} and {:.2g} in {}, which are not alike: where sensors differ, name them in "
                    "a column sensor; where targets do, tune each alone.",
                    by_nis.begin()->first, by_nis.begin()->second, by_nis.rbegin()->first, by_nis.rbegin()->second));
  if (sentences.empty())
    sentences.push_back("nothing: the innovations are as large and as independent as they should be.");
  return sentences;
}

/// A table of sensors or of modes.
ResultTable innovations_table(const std::vector<Diagnosis::Part>& parts, bool modes) {
  const auto fields_of = [=](const Diagnosis::Part& part) {
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
    if (modes) {
      fields.push_back({{.key = "mean_weight", .header = "mean weight", .digits = 3}, part.weight});
      return fields;
    }
    fields.push_back({{.key = "neighbours", .header = "neighbours", .sign = true},
                      right > 0.0 ? Cell(tally.autocorrelation()) : Cell(nan)});
    fields.push_back({{.key = "neighbours_right", .header = "right"}, Cell(right, fmt::format("±{:.2f}", right))});
    fields.push_back({of_words("verdict", "verdict"), verdict_of(tally)});
    return fields;
  };
  ResultTable table(each(fields_of({}), &Field::column));
  for (const Diagnosis::Part& part : parts) table.row(each(fields_of(part), &Field::cell));
  return table;
}

/// The fitted numbers of the best settings.
ResultTable numbers_table(const TunedFilter& tuned) {
  ResultTable table;
  for (const auto& [name, value, error, at_rounding, sensor] : tuned.best().numbers) {
    const bool told = !at_rounding && std::isfinite(error);
    const std::string remark = at_rounding ? "no less: its column is rounded"
                               : told      ? fmt::format(fmt::runtime(error < 100.0 ? "± {:.2g}" : "± {:.0f}"), error)
                                           : "not determined by these rows";
    table.row_of({{of_words("number", "fitted number"), name},
                  {{.key = "value", .header = "fitted"}, Cell(value, fmt::format("{:.4g}", value))},
                  {{.key = "error"}, told ? error : nan},
                  {of_words("remark", "standard error"), remark}});
  }
  return table;
}

ResultTable candidates_table(const TunedFilter& tuned, Objective objective) {
  ResultTable table;
  const auto figure = [&](double loss) {
    const double value = figure_of(loss, objective);
    return Cell(value, fmt::format("{:.4g}", value));
  };
  for (std::size_t c = 0; c < tuned.candidates.size(); ++c) {
    const Candidate& candidate = tuned.candidates[c];
    const auto& [gain, error] = candidate.gain;
    std::string remark = c == tuned.selected.best ? best_name : "";
    if (c == tuned.selected.simple) remark += remark.empty() ? simple_name : ", simple";
    table.row_of(
        {{of_words("models", "models"), candidate.name},
         {{.key = "remark"}, remark},
         {{.key = "numbers", .header = "fitted numbers"}, tuned.numbers[c]},
         {{.key = "fitted", .header = fmt::format("fitted, {}", unit_of(objective))}, figure(candidate.fitted)},
         {{.key = "held_out", .header = fmt::format("held out, {}", unit_of(objective))}, figure(candidate.held_out)},
         {{.key = "gain", .header = objective == Objective::rmse ? "gain, m²" : "gain held out"},
          c == 0 ? Cell() : Cell(gain, fmt::format("{:+.3g} ± {:.2g}", gain, error))},
         {{.key = "gain_error"}, c == 0 ? Cell() : Cell(error)},
         {of_words("", " "), remark}});
  }
  return table;
}

/// The settings that differ; "–" where there is none.
ResultTable changes_table(const TunedFilter& tuned) {
  const FilterSettings &before = tuned.before().settings, &best = tuned.best().settings,
                       &simple = tuned.simple().settings;
  const bool two = tuned.selected.simple != tuned.selected.best;
  ResultTable table({of_words("key", "key"), of_words(before_name, before_name), of_words(best_name, best_name),
                     of_words(simple_name, two ? simple_name : "")});
  const auto add = [&](const std::string& name, const auto& value) {
    std::vector<Cell> cells = {name};
    std::set<std::string> different;
    for (const FilterSettings* settings : {&before, &best, &simple}) {
      const std::string text = value(*settings);
      different.insert(text);
      cells.emplace_back(text.empty() ? "–" : text);
    }
    if (different.size() > 1) table.row(std::move(cells));
  };
  for (const auto& key : filter_keys())
    add(key.name, [&](const FilterSettings& settings) { return key.applies(settings) ? key.write(settings) : ""; });
  std::set<std::string> sensors;
  for (const auto* settings : {&before, &best, &simple})
    for (const auto& [name, accuracy] : settings->sensors) sensors.insert(name);
  for (const auto& key : accuracy_keys()) {
    add(key.name, [&](const FilterSettings& settings) { return key.write(settings.accuracy); });
    for (const auto& sensor : sensors)
      add(fmt::format("sensor.{}.{}", sensor, key.name),
          [&](const FilterSettings& settings) { return key.write(settings.accuracy_of(sensor)); });
  }
  return table;
}

/// What settings lose in each fold, held out, and in all of them.
using FoldFigures = std::pair<const char*, std::vector<double>>;

/// Of the settings before, the best and the simple ones, as far as they differ.
std::vector<FoldFigures> by_fold(const TunedFilter& tuned, const TuneOptions& options, const TuneData& data) {
  const RowFolds folds = data.folds(options.folds);
  const auto& [best, simple] = tuned.selected;
  std::vector<FoldFigures> all;
  const auto add = [&](const char* name, std::size_t candidate) {
    auto& figures = all.emplace_back(name, std::vector<double>()).second;
    for (std::size_t fold = 0; fold <= options.folds; ++fold)
      figures.push_back(figure_of(
          objective_of(tuned.held_out[candidate], options.objective,
                       [&](std::size_t t, std::size_t k) { return fold == options.folds || folds[t][k] == fold; }),
          options.objective));
  };
  add(before_name, 0);
  if (best != 0) add(best_name, best);
  if (simple != best && simple != 0) add(simple_name, simple);
  return all;
}

std::string name_of_fold(std::size_t fold, const TuneOptions& options) {
  return fold == options.folds ? "all folds" : fmt::format("fold {}", fold + 1);
}

/// The innovations before, and with the best settings.
std::vector<std::pair<const char*, const Diagnosis*>> diagnoses(const TuneFindings& findings) {
  std::vector<std::pair<const char*, const Diagnosis*>> all = {{before_name, &findings.before}};
  if (findings.after) all.emplace_back(best_name, &*findings.after);
  return all;
}

/// NIS or correlation of neighbours, before and after, in their bands. `figure(tally)` is the number and its band.
template <class Figure>
IntervalChart innovation_chart(IntervalChart chart, const TuneFindings& findings, bool modes, const Figure& figure) {
  chart.wanted_label = "95 % of right filters";
  for (const auto& [when, diagnosis] : diagnoses(findings)) {
    IntervalSeries& series = chart.series.emplace_back(IntervalSeries{.name = when, .group = when});
    const auto add = [&](const std::string& row, const InnovationTally& tally) {
      const auto place = static_cast<std::size_t>(std::ranges::find(chart.rows, row) - chart.rows.begin());
      if (place == chart.rows.size()) chart.rows.push_back(row);
      if (tally.count() == 0) return;
      const auto [value, band] = figure(tally);
      series.values.resize(chart.rows.size(), {nan, 0.0});
      series.wanted.resize(chart.rows.size(), {nan, nan});
      series.values[place].mean = value;
      series.wanted[place] = {band.lower, band.upper};
    };
    for (const auto& sensor : diagnosis->sensors) add(sensor.name, sensor.innovations);
    for (const auto& mode : diagnosis->modes)
      if (modes) add("mode " + mode.name, mode.innovations);
  }
  for (IntervalSeries& series : chart.series) {  // of sensors and modes that one of them has
    series.values.resize(chart.rows.size(), {nan, 0.0});
    series.wanted.resize(chart.rows.size(), {nan, nan});
  }
  return chart;
}

IntervalChart fold_chart(const TunedFilter& tuned, const TuneOptions& options, const TuneData& data) {
  IntervalChart chart{.title = "Held out, by fold",
                      .x_label = fmt::format("{}; less is better", unit_of(options.objective)),
                      .digits = 4};
  for (std::size_t fold = 0; fold <= options.folds; ++fold) chart.rows.push_back(name_of_fold(fold, options));
  for (const auto& [name, figures] : by_fold(tuned, options, data)) {
    auto& series = chart.series.emplace_back(IntervalSeries{.name = name, .group = name});
    for (const double figure : figures) series.values.push_back({figure, 0.0});
  }
  return chart;
}

/// Where the truth is known, else nothing.
std::string text_of_truth(const Diagnosis& before, const Diagnosis& after) {
  if (!before.rmse_m || !after.rmse_m) return {};
  std::string text =
      fmt::format("RMSE against the truth: {:.4g} m before, {:.4g} m now{}.", *before.rmse_m, *after.rmse_m,
                  *after.rmse_m > 1.2 * *before.rmse_m ? ", which is worse: see the rows set aside, and gaps, after "
                                                         "which restart_after_s begins anew; --truth fits to the truth"
                                                       : "");
  if (*after.rmse_m > 2.0 * after.told_m)
    text += fmt::format(
        " The filter takes it for {:.3g} m: errors that last from row to row, as of GNSS or of a clock, are no noise "
        "that innovations show; --truth=density fits the sigmas to the truth.",
        after.told_m);
  return text;
}

/// What came of it.
std::string sentence_of(const TuneFindings& findings, Objective objective) {
  const TunedFilter& tuned = findings.tuned;
  const Candidate& best = tuned.best();
  if (tuned.selected.best == 0) return fmt::format("{}: no settings are better than those before.", name_of(findings));
  std::string text =
      fmt::format("{}: {} with {} fitted numbers is best; held out it has {:.4g} {} rather than {:.4g}.",
                  name_of(findings), best.name, tuned.numbers[tuned.selected.best], figure_of(best.held_out, objective),
                  unit_of(objective), figure_of(tuned.before().held_out, objective));
  const std::string truth = text_of_truth(findings.before, *findings.after);
  return truth.empty() ? text : text + " " + truth;
}

/// When the gate turned rows away, and of which track they are.
LineChart set_aside_chart(const Diagnosis& diagnosis, const TuneData& data) {
  LineChart chart{
      .title = "Rows set aside", .x_label = "time since the first row, s", .y_label = "number of the track"};
  const auto row_at = [&](const RowPlace& place) -> const Row& { return data.tracks[place.track].rows[place.row]; };
  double first = infinity;
  for (const TuneTrack& track : data.tracks) first = std::min(first, track.rows.front().plot.time);
  auto places = diagnosis.set_aside;
  std::ranges::stable_sort(places, {}, [&](const RowPlace& place) { return row_at(place).plot.time; });
  Curve curve{.name = best_name, .group = best_name, .dots = true};
  for (const RowPlace& place : places) {
    chart.x.push_back(row_at(place).plot.time - first);
    curve.values.push_back(static_cast<double>(place.track + 1));
    chart.remarks.push_back(fmt::format("{}:{}", data.tracks[place.track].file, row_at(place).line));
  }
  chart.curves.push_back(std::move(curve));
  return chart;
}

View view_of(const TuneFindings& findings, const TuneOptions& options, const TuneData& data) {
  View view{name_of(findings), {}};
  const auto all = diagnoses(findings);
  const auto when = [&](std::size_t i) { return i == 0 ? "before" : "with the best settings"; };
  for (std::size_t i = 0; i < all.size(); ++i)
    view.panels.emplace_back(Words{fmt::format("What the innovations say, {}", when(i)),
                                   fmt::format("{}", fmt::join(advice_of(*all[i].second), "\n"))});
  IntervalChart nis{.title = "NIS a measured quantity", .x_label = "NIS; right is 1", .reference = 1.0, .digits = 3};
  view.panels.emplace_back(innovation_chart(
      nis, findings, true, [](const InnovationTally& tally) { return std::pair(tally.mean_square(), tally.band()); }));
  nis.title = "Correlation of neighbouring innovations";
  nis.x_label = "correlation; right is 0";
  nis.reference = 0.0;
  view.panels.emplace_back(innovation_chart(nis, findings, false, [](const InnovationTally& tally) {
    const double band = tally.autocorrelation_band();
    return std::pair(tally.autocorrelation(), Band{-band, band});
  }));
  if (findings.after && !findings.after->set_aside.empty())
    view.panels.emplace_back(set_aside_chart(*findings.after, data));
  view.panels.emplace_back(fold_chart(findings.tuned, options, data));
  view.panels.emplace_back(ReportTable{"Sets of models", candidates_table(findings.tuned, options.objective)});
  for (std::size_t i = 0; i < all.size(); ++i) {
    view.panels.emplace_back(ReportTable{fmt::format("Innovations of each sensor, {}", when(i)),
                                         innovations_table(all[i].second->sensors, false)});
    view.panels.emplace_back(ReportTable{fmt::format("Rows by their most likely mode, {}", when(i)),
                                         innovations_table(all[i].second->modes, true)});
  }
  if (const ResultTable numbers = numbers_table(findings.tuned); !numbers.empty())
    view.panels.emplace_back(ReportTable{"Fitted numbers", numbers});
  if (const ResultTable settings = changes_table(findings.tuned); !settings.empty())
    view.panels.emplace_back(ReportTable{"Settings that change", settings});
  return view;
}

Diagnosis diagnose(const TuneData& data, const FilterSettings& settings, Objective objective) {
  Diagnosis diagnosis;
  std::map<std::string, InnovationTally, std::less<>> sensors;
  for (const auto& model : settings.models) diagnosis.modes.push_back({model});
  std::map<std::string, std::vector<double>, std::less<>> last;  // by sensor, of the track at hand
  std::size_t track = 0, rows = 0, judged = 0;
  double squares = 0.0, variances = 0.0;
  const auto look = [&](std::size_t t, const TargetPoint& now) {
    if (t != track) last.clear();
    track = t;
    const Row& row = data.tracks[t].rows[now.tag];
    if (row.truth) {
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(data.axes); ++axis) {
        squares += std::pow(now.mean[axis] - (*row.truth)[axis], 2);
        variances += now.covariance[axis * (now.mean.size() + 1)];
      }
      ++judged;
    }
    if (!now.nis) return;
    sensors[row.sensor].add(now.normalized_innovation, last[row.sensor]);
    diagnosis.modes[now.most_likely_mode].innovations.add(now.normalized_innovation);
    diagnosis.files[data.tracks[t].file].add(now.normalized_innovation);
    last[row.sensor] = now.normalized_innovation;
    for (std::size_t j = 0; j < now.weights.size(); ++j) diagnosis.modes[j].weight += now.weights[j];
    ++rows;
  };
  RowLosses lost;
  try {
    lost = losses(data, settings, objective, look, &diagnosis.set_aside);
  } catch (const std::exception& error) {
    const TuneTrack& its = data.tracks[track];
    throw InputError({.where = fmt::format("{}:{}", its.file, its.rows.front().line),
                      .what = fmt::format("filter '{}' on the track that begins here: {}", settings.name, error.what()),
                      .remedy = "begin with settings that track takes, see --config and --set"});
  }
  if (std::isnan(mean_loss(lost)))
    throw InputError(
        {.where = data.tracks.front().file,
         .what = fmt::format("filter '{}' makes no estimate that could be judged: its start may want positions, or "
                             "fewer rows at one time",
                             settings.name),
         .remedy = fmt::format("{}, or give a start, --set start=given; see himm_demo keys",
                               std::ranges::any_of(data.sensors, [](const auto& named) { return named.second.bearing; })
                                   ? "say where each station of bearings stands, as --set sensor.NAME.at=[E,N]"
                                   : "drop a column that is always empty, as a track starts from whole positions")});
  for (auto& mode : diagnosis.modes) mode.weight /= static_cast<double>(std::max<std::size_t>(rows, 1));
  for (auto& [name, tally] : sensors) diagnosis.sensors.push_back({name.empty() ? "all rows" : name, tally});
  if (judged > 0) {
    diagnosis.rmse_m = std::sqrt(squares / static_cast<double>(judged));
    diagnosis.told_m = std::sqrt(variances / static_cast<double>(judged));
  }
  return diagnosis;
}

/// How many rows these are, what was done with them, and the first lines of them; empty without any.
std::string rows_text(const std::vector<RowPlace>& rows, std::string_view done, const TuneData& data) {
  constexpr std::size_t most_lines = 8;
  std::string text, file;
  for (std::size_t i = 0; i < std::min(rows.size(), most_lines); ++i) {
    const TuneTrack& track = data.tracks[rows[i].track];
    text += i == 0 ? "" : ", ";
    if (track.file != file) text += fmt::format("{}:", track.file);
    file = track.file;
    text += fmt::format("{}", track.rows[rows[i].row].line);
  }
  const char* const s = rows.size() == 1 ? "" : "s";
  if (rows.empty()) return {};
  return wrapped(
      fmt::format("{} row{} {}: line{} {}{}.", rows.size(), s, done, s, text, rows.size() > most_lines ? ", …" : ""));
}

Json rows_json(const std::vector<RowPlace>& rows, const TuneData& data) {
  Json lines = Json::array();
  for (const auto& [track, row] : rows)
    lines.push_back({{"file", data.tracks[track].file}, {"line", data.tracks[track].rows[row].line}});
  return lines;
}

std::string text_of(const Diagnosis& diagnosis, std::size_t width) {
  std::string text = innovations_table(diagnosis.sensors, false).text(width) + "\n" +
                     innovations_table(diagnosis.modes, true).text(width);
  for (const auto& sentence : advice_of(diagnosis))
    for (std::size_t line = 0;
         const auto& each : lines_of(printable(sentence), width == any_width ? any_width : width - 2))
      text += (line++ == 0 ? "- " : "  ") + each + "\n";
  return text;
}

std::string text_of(const TunedFilter& tuned, Objective objective, std::size_t width) {
  const ResultTable changes = changes_table(tuned), numbers = numbers_table(tuned);
  return candidates_table(tuned, objective).text(width) + "\n" +
         (changes.empty() ? "No setting changes.\n" : changes.text(width)) +
         (numbers.empty() ? "" : "\n" + numbers.text(width));
}

Json summary_of(const TuneOptions& options, const TuneData& data, const std::vector<TuneFindings>& all) {
  Json summary = {{"version", version},
                  {"command", options.page.command},
                  {"measurements", data.measurements},
                  {"objective", unit_of(options.objective)},
                  {"folds", options.folds},
                  {"seed", options.seed}};
  for (const TuneFindings& findings : all) {
    Json& filter = summary["filters"][name_of(findings)];
    for (const auto& [when, diagnosis] : diagnoses(findings)) {
      filter[when]["sensors"] = innovations_table(diagnosis->sensors, false).json();
      filter[when]["modes"] = innovations_table(diagnosis->modes, true).json();
      filter[when]["advice"] = advice_of(*diagnosis);
      filter[when]["set_aside"] = rows_json(diagnosis->set_aside, data);
      if (diagnosis->rmse_m) filter[when]["rmse_m"] = *diagnosis->rmse_m;
    }
    for (std::size_t fold = 0; fold <= options.folds; ++fold)
      for (const auto& [name, figures] : by_fold(findings.tuned, options, data))
        filter["held_out"][name_of_fold(fold, options)][name] = figures[fold];
    filter["left_out"] = rows_json(findings.tuned.strays, data);
    filter["candidates"] = candidates_table(findings.tuned, options.objective).json();
    filter["numbers"] = numbers_table(findings.tuned).json();
    filter["settings"] = changes_table(findings.tuned).json();
  }
  return summary;
}

Report page_of(const std::string& heading, const TuneOptions& options, const TuneData& data,
               const std::vector<TuneFindings>& all) {
  Report page{.title = fmt::format("Settings for {}", fmt::join(options.files, ", ")),
              .verdict = {heading},
              .command = options.page.command,
              .chooser = "Filter"};
  std::set<std::string> names;
  for (const TuneFindings& findings : all) {
    page.verdict.push_back(sentence_of(findings, options.objective));
    page.views.push_back(view_of(findings, options, data));
    for (const auto& [name, figures] : by_fold(findings.tuned, options, data))
      if (names.insert(name).second) page.groups.push_back({name});
    page.last.emplace_back(
        Words{"The best settings of " + name_of(findings), as_toml({findings.tuned.best().settings}), true});
  }
  return page;
}

std::string heading(const TuneData& data, const TuneOptions& options) {
  const std::map<Objective, std::string_view> by = {
      {Objective::prequential, "how well each measurement was predicted (nats a row; less is better)"},
      {Objective::rmse, "the RMSE of the position against the truth"},
      {Objective::density, "the density of the true position (nats a row; less is better)"}};
  std::string text = fmt::format("{} measurements of {} track{}", data.measurements, data.tracks.size(),
                                 data.tracks.size() == 1 ? "" : "s");
  if (data.too_short > 0) text += fmt::format(" ({} too short)", data.too_short);
  const bool by_track = data.tracks.size() >= 2 * options.folds;
  return fmt::format("{}, judged by {}. Held out: {} folds {}.", text, by.at(options.objective), options.folds,
                     by_track ? "of tracks" : "in time");
}

/// Tunes one filter, prints what was found, and adds what is to be written.
TuneFindings tune_and_report(const FilterSettings& filter, const TuneData& data, const TuneOptions& options,
                             const TunedFilter* similar, std::vector<FilterSettings>& written) {
  Diagnosis before = diagnose(data, filter, options.objective);
  fmt::print("\nfilter {}: before\n\n{}\n", printable(filter.name), text_of(before, options.page.width()));
  Progress progress(filter.name, work_of(filter, data, options), options.page.quiet);
  TunedFilter tuned = tune(filter, data, options, similar, progress);
  progress.finish();
  fmt::print("{}", text_of(tuned, options.objective, options.page.width()));

  const auto say = [&](const std::string& text) { fmt::print("{}", wrapped(text, options.page.width())); };
  std::optional<Diagnosis> after;
  if (tuned.selected.best > 0) {
    after = diagnose(data, tuned.best().settings, options.objective);
    fmt::print("\nfilter {}: with the best settings\n\n{}", printable(filter.name),
               text_of(*after, options.page.width()));
    fmt::print("{}{}", rows_text(after->set_aside, "set aside, as the gate will in track", data),
               rows_text(tuned.strays, "left out of the fit, since those after tell that they are stray", data));
    if (const double widened = tuned.best().widened; std::abs(std::log(widened)) > std::log(2.0))
      say(
          fmt::format("\nWhat is written are {:.2g} times the sigmas that were fitted, so that the regions stated hold "
                      "95 % of the rows. So great a factor says that the recording is not what the filter takes it "
                      "for, as where a clock or a place jumps once, or values are held or limited: look at its rows.\n",
                      widened));
    if (const FilterSettings& best = tuned.best().settings; best.fuzzy && best.models.size() > 1)
      say("\nThe numbers of a fuzzy mode are those by which its best mode alone predicts best: of a target whose mode "
          "is random they may be farther off than their standard errors say.\n");
    if (const std::string truth = text_of_truth(before, *after); !truth.empty()) say(truth);
    constexpr double much = 10.0;
    if (options.objective == Objective::prequential && tuned.by_unscented > much)
      say(
          fmt::format("\nA UKF in place of the EKF predicts {:.0f} nats better by the same settings, as where a start "
                      "from rows of a radar that are close to each other is far off: fit with --set member=ukf.\n",
                      tuned.by_unscented));
    if (std::ranges::any_of(tuned.best().numbers, [](const FittedNumber& number) {
          return number.sensor && !number.at_rounding && std::isinf(number.error);
        }))
      say("\nWhere rows do not determine a sensor's sigma, much of what they scatter may be its errors or the target's "
          "way, and what is stated of estimates depends on which: if its accuracy is known, keep it by --keep "
          "sensors.\n");
  }
  const double strays =
      options.objective == Objective::prequential ? data.share_of_strays(tuned.held_out[tuned.selected.best]) : 0.0;
  if (strays > 0.5)
    say(fmt::format(
        "\n{:.0f} % of the rows are predicted no better than stray ones, so that these settings say next to nothing: "
        "look at the rows, or begin nearer to what they are, with --set sigma_w=… and --set sigma_position_m=…\n",
        100.0 * strays));
  written.push_back(tuned.best().settings);
  if (tuned.selected.simple != tuned.selected.best) {
    written.push_back(tuned.simple().settings);
    written.back().name += "_simple";
  }
  return {std::move(before), std::move(after), std::move(tuned)};
}

Objective objective_of(const std::string& truth) {
  if (truth.empty() || truth == "false") return Objective::prequential;
  if (truth == "rmse" || truth == "true") return Objective::rmse;
  if (truth == "density") return Objective::density;
  throw UsageError(
      {.what = "--truth", .found = in_quotes(truth), .expected = "--truth, --truth=rmse or --truth=density"});
}

void tune_and_write(TuneOptions options) {
  options.objective = objective_of(options.truth);
  auto filters = filters_for(options.recording, options.filters, options.radar.sigma);
  if (options.filters.print_config) {
    fmt::print("{}", as_toml(filters));
    return;
  }
  if (!can_search())
    throw InputError(
        "this himm_demo was built without an optimiser; install libnlopt-cxx-dev, run cmake again and build it");
  for (const auto& filter : filters) {
    // The likelihood that has no determinant finds any measurement possible where the noise is great enough.
    if (options.objective == Objective::prequential && filter.likelihood == LikelihoodForm::possibility)
      throw InputError(
          "filter '{}': likelihood = \"possibility\": expected \"density\", since a possibility never blames noise "
          "that is too great; tune with --truth, or with likelihood=density",
          filter.name);
    model_sets(filter, options, {});  // refuses what is none
  }
  options.threads = threads_or_all(options.threads);
  auto inputs = options.files;
  inputs.push_back(options.filters.config);
  refuse_to_overwrite("--out", options.out, inputs);
  refuse_to_overwrite("--summary", options.summary, inputs);
  refuse_to_overwrite(options.page, inputs);
  std::optional<AtomicFile> file, summary;  // made first, so that a bad name is known before the work
  if (!options.out.empty()) file.emplace(options.out);
  if (!options.summary.empty()) summary.emplace(options.summary);
  ResultFiles page(options.page);
  const TuneData data = read_tune_data(options, filters.front());
  if (data.moves_alone) start_at_zero(filters);
  fmt::print("{}", wrapped(heading(data, options)));
  for (const std::string& note : data.notes) fmt::print("{}", wrapped(note));
  std::vector<FilterSettings> written;
  std::vector<TuneFindings> found;
  for (const auto& filter : filters)
    found.push_back(tune_and_report(filter, data, options, found.empty() ? nullptr : &found.front().tuned, written));
  if (page.report_wanted()) page.write_report(page_of(heading(data, options), options, data, found));
  if (summary) summary->write(dumped(summary_of(options, data, found), 2) + "\n");
  if (file) file->write(as_toml(written));
  page.commit();
  if (summary) {
    summary->commit();
    fmt::print("\nWrote {}\n", printable(options.summary));
  }
  if (!file) return;
  file->commit();
  fmt::print("\nWrote {}, which track --config takes\n", printable(options.out));
}

}  // namespace

void add_tune(CLI::App& program, const std::string& command) {
  Subcommand app(program, "tune", "Fits the settings of filters to recordings.");
  const auto options = std::make_shared<TuneOptions>();
  options->page.command = command;
  app.option("file", options->files, "Recordings, as track reads them").required().type("FILE.csv");
  add_recording(app, options->recording, options->radar);
  app.flag("--truth{rmse}", options->truth,
           "Judge by the truth that the recording has: by its RMSE, or by its density with --truth=density");
  app.option("--models", options->models,
             "Sets of models to choose from, as dwna,dwna+dwpa [the filter's, and each of them alone]")
      .list_alone()
      .type("SET,…");
  app.option("--keep", options->fixed, "What is left as it is: models, sensors, transition, lift")
      .list_alone()
      .one_of({"models", "sensors", "transition", "lift"})
      .type("WHAT,…");
  app.option("--folds", options->folds, "Parts of the rows, or of the tracks, each held out once").in(2, 20);
  app.option("--starts", options->starts, "Searches from different places").in(1, 100);
  add_threads(app, options->threads);
  add_seed(app, options->seed, "of the starts, and of a simulated radar");
  add_filter_options(app, options->filters);
  app.option("--out", options->out, "Write the settings found, for track --config").type("FILE.toml");
  app.option("--summary", options->summary, "Write what was found as data").type("FILE.json");
  app.option("--report", options->page.report, "Write it as a page of charts for a browser").type("FILE.html");
  add_quiet(app, options->page.quiet);
  add_wide(app, options->page.wide);
  app.run([options] { tune_and_write(*options); });
}

}  // namespace sigmax::apps
