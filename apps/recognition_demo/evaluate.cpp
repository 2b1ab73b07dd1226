#include <map>

#include "checks/table_checks.hpp"
#include "recognition_demo/contest.hpp"
#include "recognition_demo/cross_validation.hpp"
#include "recognition_demo/model_file.hpp"
#include "recognition_demo/subcommands.hpp"

namespace sigmax::apps {
namespace {

std::string described_folds(const EvaluateOptions& options) {
  return fmt::format("{} folds of {}", options.folds,
                     options.groups.empty() ? "equal shares of every class" : "whole values of " + options.groups);
}

std::string paired_by(const EvaluateOptions& options) {
  return options.groups.empty() ? "rows" : "values of " + options.groups;
}

/// Log-loss of who gives each class its share of the rows.
double log_loss_of_shares(const LabelledTable& data) {
  return sum_of(data.rows_of_class, [&](std::size_t rows) {
    const double share = static_cast<double>(rows) / static_cast<double>(data.size());
    return -share * std::log(share);
  });
}

/// Rows that excluded every class, the mean over the foldings.
double excluded(const Outcome& outcome, std::size_t foldings) {
  return static_cast<double>(outcome.excluded) / static_cast<double>(foldings);
}

ResultTable outcomes_table(const LabelledTable& data, const Results& results, std::size_t foldings) {
  ResultTable table;
  for (std::size_t i = 0; i < results.outcomes.size(); ++i) {
    const Outcome& outcome = results.outcomes[i];
    const auto* const random = std::get_if<Evaluation<Random>>(&outcome.evaluation);
    const auto* const fuzzy = std::get_if<Evaluation<Fuzzy>>(&outcome.evaluation);
    table.row_of(
        {{of_words("classifier", "classifier"), outcome.name},
         {{.key = "accuracy", .header = "right", .unit = "%", .scale = 100.0}, outcome.confusion().accuracy()},
         {of_points("accuracy_minus_that_of_sigma", "− sigma's"),
          i == 0 ? Cell() : Cell(results.minus_first(i, foldings))},
         {{.key = "macro_f1", .header = "macro F1", .digits = 3}, outcome.confusion().macro_f1()},
         {{.key = "ties", .header = "ties", .unit = "%", .digits = 1, .scale = 100.0}, outcome.ties()},
         {{.key = "log_loss", .header = "log-loss", .digits = 3}, random ? Cell(random->log_loss()) : Cell()},
         {{.key = "log_loss_of_the_shares", .header = "shares' log-loss", .digits = 3},
          i == 0 ? Cell(log_loss_of_shares(data)) : Cell()},
         {{.key = "brier", .header = "Brier", .digits = 3}, random ? Cell(random->brier()) : Cell()},
         {{.key = "calibration_error", .header = "calibration error", .unit = "%", .digits = 1, .scale = 100.0},
          random ? Cell(outcome.reliability.calibration_error()) : Cell()},
         {{.key = "mean_necessity_of_truth", .header = "necessity of truth", .digits = 3},
          fuzzy ? Cell(fuzzy->necessity()) : Cell()},
         {{.key = "coverage", .header = "covered", .unit = "%", .digits = 1, .scale = 100.0},
          fuzzy ? Cell(fuzzy->coverage()) : Cell()},
         {{.key = "mean_classes_in_the_cut", .header = "classes at ½ or more"},
          fuzzy ? Cell(fuzzy->cut_size()) : Cell()},
         {{.key = "rows_that_excluded_every_class"},
          outcome.excluded > 0 ? Cell(excluded(outcome, foldings)) : Cell()}});
  }
  return table;
}

/// Sigma, and max by the ratio scale.
constexpr std::array<std::size_t, 2> shown_in_full = {0, 1};

/// Recall and precision of each class, by the classifiers that are shown in full.
ResultTable classes_table(const LabelledTable& data, const Results& results) {
  ResultTable table;
  for (std::size_t c = 0; c < data.classes.size(); ++c) {
    std::vector<Field> row = {{of_words("class", "class"), data.classes[c]},
                              {{.key = "rows", .header = "rows"}, data.rows_of_class[c]}};
    for (const std::size_t i : shown_in_full) {
      const Outcome& outcome = results.outcomes[i];
      const auto& confusion = outcome.confusion();
      double truths = 0.0, decisions = 0.0;
      for (std::size_t other = 0; other < data.classes.size(); ++other)
        truths += confusion(c, other), decisions += confusion(other, c);
      const auto add = [&](const char* what, double of) {
        row.push_back({{.key = fmt::format("{}: {}", outcome.name, what),
                        .header = what,
                        .unit = "%",
                        .digits = 1,
                        .scale = 100.0,
                        .group = outcome.name + ":"},
                       of > 0.0 ? std::optional(confusion(c, c) / of) : std::nullopt});
      };
      add("recall", truths);
      add("precision", decisions);
    }
    table.row_of(row);
  }
  return table;
}

ResultTable rows_of_confusion(const LabelledTable& data, const Results& results, std::size_t foldings) {
  auto table = ResultTable::of_keys({"classifier", "truth", "decision", "rows"});
  for (const Outcome& outcome : results.outcomes)
    for (std::size_t truth = 0; truth < data.classes.size(); ++truth)
      for (std::size_t c = 0; c < data.classes.size(); ++c)
        table.row({outcome.name, data.classes[truth], data.classes[c],
                   outcome.confusion()(truth, c) / static_cast<double>(foldings)});
  return table;
}

/// predictions.csv: belief and decision for every row and classifier, fold after fold of the first folding.
void write_predictions(const LabelledTable& data, const Results& results, const EvaluateOptions& options,
                       ResultFiles& files) {
  std::vector<std::string> keys = {"line", "fold", "truth", "classifier", "decision"};
  keys.insert(keys.end(), data.classes.begin(), data.classes.end());
  RowFile file(files, "predictions.csv", keys);
  std::mt19937_64 generator(options.seed);
  const Folds folds = divided(data, results.groups, options.folds, generator);
  for (std::size_t fold = 0; fold < options.folds; ++fold)
    for (const TableClassifier& by : taught(data, folds, fold, options.learning))
      for (std::size_t row = 0; row < data.size(); ++row) {
        if (folds[row] != fold) continue;
        const TablePrediction found = by.predict(by.readings(data.columns, row));
        std::vector<Cell> cells = {data.lines[row], fold + 1, data.classes[data.labels[row]], std::string(by.name()),
                                   found.label};
        for (const double value : numbers_of(found.belief)) cells.emplace_back(value);
        file.write(cells);
      }
}

/// Throws unless every class can be learned whichever fold is left out.
void refuse_rare_classes(const LabelledTable& data) {
  std::map<std::size_t, std::string> rare;  // by class
  for (std::size_t row = 0; row < data.size(); ++row)
    if (const std::size_t c = data.labels[row]; data.rows_of_class[c] < 2)
      rare[c] = fmt::format("{} (line {})", in_quotes(data.classes[c]), data.lines[row]);
  if (rare.empty()) return;
  throw InputError(
      "{}: column {}: found a single row of {}, expected at least two of every class: one to learn from, one to "
      "classify; add rows, or remove those of the class",
      data.file, in_quotes(data.label), listed(each(rare, [](const auto& one) { return one.second; }), 12));
}

/// Which classifier to use: sigma, unless another one is right more often beyond its interval; none of them where the
/// most frequent class alone is, beyond chance.
std::string advice(const LabelledTable& data, const Results& results, const EvaluateOptions& options) {
  const auto rows = static_cast<double>(data.size());
  const auto most = std::ranges::max_element(data.rows_of_class);
  const double baseline = static_cast<double>(*most) / rows;
  std::size_t best = 0;
  Interval by;
  for (std::size_t i = 1; i < results.outcomes.size(); ++i)
    if (const Interval own = results.minus_first(i, options.foldings); own.above_zero() && own.mean > by.mean)
      best = i, by = own;
  const Outcome& chosen = results.outcomes[best];
  const double right = chosen.confusion().accuracy();
  if (!options.learning.equal_prior && baseline - right > 2.0 * std::sqrt(baseline * (1.0 - baseline) / rows))
    return fmt::format("Use none, because the majority-class baseline, {}, is right in {:.2f} %, {} in {:.2f} %.",
                       in_quotes(data.classes[static_cast<std::size_t>(most - data.rows_of_class.begin())]),
                       100.0 * baseline, chosen.name, 100.0 * right);
  if (best == 0) return "Use sigma, because no other classifier is right more often beyond its interval.";
  return fmt::format(
      "Use {}, because, trained on these rows, it is right {:.2f} ± {:.2f} points more often than sigma.", chosen.name,
      100.0 * by.mean, 100.0 * by.half_width);
}

void say_scores(const LabelledTable& data, const Results& results, const EvaluateOptions& options, Result& result) {
  result.say("{}: {}\n{}, {}seed {}; {}", data.file, described(data), described_folds(options),
             options.foldings == 1 ? "" : fmt::format("in {} foldings, ", options.foldings), options.seed,
             described(options.learning));
  result.add(outcomes_table(data, results, options.foldings), {.summary = {"classifiers"}});
  result.say(
      "(The class is the most likely one, the first of those that tie. Differences ± 95 % by paired {}; the intervals "
      "do not count that other training rows make other classifiers. The shares are those of the classes. Necessity: 1 "
      "− the possibility of the best other class. A truth is covered if its possibility is at least ½.)",
      paired_by(options));
  for (const Outcome& outcome : results.outcomes)
    if (outcome.excluded > 0)
      result.say("{}: {:.3g} rows excluded every class and were judged by the prior", outcome.name,
                 excluded(outcome, options.foldings));
  result.add(classes_table(data, results), {.summary = {"of_each_class"}});
  const std::string use = advice(data, results, options);
  result.page.verdict.push_back(use);
  result.fact({"advice"}, use);
  result.say("\n{}", use);
}

/// Rows of the data by true and decided class.
HeatMap confusion_map(const LabelledTable& data, const Outcome& outcome, std::size_t foldings) {
  HeatMap map{.title = outcome.name,
              .row_label = "true class",
              .column_label = "decided class",
              .rows = data.classes,
              .columns = data.classes,
              .value_label = foldings == 1 ? "rows" : "rows, mean of the foldings",
              .digits = foldings == 1 ? 0 : 1};
  map.fill([&](std::size_t truth, std::size_t c) {
    return HeatMap::Cell{outcome.confusion()(truth, c) / static_cast<double>(foldings)};
  });
  return map;
}

/// What was believed of the classes of rows against how often that was true. The diagonal is calibration, or the bound
/// that possibilities are.
LineChart reliability_chart(const Outcome& outcome, std::size_t foldings) {
  const bool fuzzy = std::holds_alternative<Evaluation<Fuzzy>>(outcome.evaluation);
  LineChart chart{
      .title = "Reliability of " + outcome.name,
      .x_label = fuzzy ? "possibility of a class" : "probability of a class",
      .y_label = "share of such classes that are the true one",
      .curves = {{.name = "share, ± 95 %"}, {.name = fuzzy ? "bound: not more often than possible" : "calibrated"}},
      .greatest_y = 1.15,
      .note = "Above each point: the number of rows and classes with such a degree.",
      .joined = 1.0};
  Curve& share = chart.curves[0];
  const auto add = [&](double degree, double value, double lower, double upper, std::string remark) {
    chart.x.push_back(degree);
    chart.curves[1].values.push_back(degree);
    share.values.push_back(value);
    share.lower.push_back(lower);
    share.upper.push_back(upper);
    chart.remarks.push_back(std::move(remark));
  };
  add(0.0, nan, nan, nan, "");
  for (const auto& bin : outcome.reliability.bins(static_cast<double>(foldings)))
    add(bin.mean_degree, bin.share, bin.lower, bin.upper, fmt::format("{:.0f}", bin.count));
  add(1.0, nan, nan, nan, "");
  return chart;
}

/// Confusion matrices and reliability side by side, and what was learned of all rows.
void fill(Report& page, const LabelledTable& data, const Results& results, const EvaluateOptions& options) {
  page.verdict.insert(page.verdict.begin(),
                      fmt::format("{}. {}, {} foldings, seed {}; {}.", described(data), described_folds(options),
                                  options.foldings, options.seed, described(options.learning)));
  page.panels.emplace_back(ReportTable{"Classifiers", outcomes_table(data, results, options.foldings),
                                       fmt::format("Differences ± 95 % by paired {}; they do not count that other "
                                                   "training rows make other classifiers.",
                                                   paired_by(options))});
  constexpr std::size_t most_classes = 30;
  if (data.classes.size() <= most_classes)
    for (const Outcome& outcome : results.outcomes)
      page.panels.emplace_back(confusion_map(data, outcome, options.foldings));
  page.panels.emplace_back(ReportTable{"Classes", classes_table(data, results)});
  for (const Outcome& outcome : results.outcomes)
    page.panels.emplace_back(reliability_chart(outcome, options.foldings));
  const auto model = TableModel::fit(data.columns, {data.label, data.classes}, data.labels, options.learning);
  page.last = relation_maps(learned_relations(model.counts, options.learning.smoothing), 6);
}

void run_evaluate(const EvaluateOptions& options) {
  refuse_to_overwrite(options.output, {options.file}, {"predictions.csv", "confusion.csv"});
  ResultFiles files(options.output);
  const LabelledTable data = read_table(options.file, options.data, options.output.quiet);
  print_findings(data);
  if (options.folds > data.size())
    throw InputError("{}: found {} rows, expected at least as many as the {} folds", data.file, data.size(),
                     options.folds);
  refuse_rare_classes(data);
  const auto groups = options.groups.empty() ? std::nullopt : std::optional(groups_of(data, options.groups));
  const Results results = cross_validated(data, groups, options);
  Result result = result_of_contest("Cross-validation of " + data.file, options.output);
  result.facts("file", data.file, "rows", data.size(), "classes", data.classes, "folds", options.folds, "foldings",
               options.foldings, "seed", options.seed, "smoothing", options.learning.smoothing, "misread",
               options.learning.misread, "bins", options.learning.bins);
  say_scores(data, results, options, result);
  for (const Outcome& outcome : results.outcomes)
    for (std::size_t i = 0; const auto& bin : outcome.reliability.bins(static_cast<double>(options.foldings)))
      result.facts_at({"reliability", outcome.name, i++}, "from", bin.from, "to", bin.to, "statements", bin.count,
                      "mean_degree", bin.mean_degree, "share_that_is_true", bin.share, "lower", bin.lower, "upper",
                      bin.upper);
  result.add(rows_of_confusion(data, results, options.foldings), {.printed = false, .csv = "confusion.csv"});
  if (!options.groups.empty()) result.fact({"groups"}, options.groups);
  if (files.wanted()) write_predictions(data, results, options, files);
  if (files.report_wanted()) fill(result.page, data, results, options);
  result.publish(files);
}

}  // namespace

void add_evaluate(CLI::App& program, const std::string& command) {
  const auto options = std::make_shared<EvaluateOptions>();
  Subcommand app(program, "evaluate", "Cross-validates every kind of classifier on labelled data.");
  add_learning(app, options->file, options->data, options->learning);
  app.option("--folds", options->folds, "Parts of the data, each classified by what the others teach").in(2, 1000000);
  app.option("--foldings", options->foldings, "Divisions into folds; one alone may be a lucky one").in(1, 100000);
  app.option("--groups", options->groups,
             "A column that names what rows are of, as a patient or a session: folds keep them together, and it is no "
             "feature")
      .type("COLUMN");
  add_seed(app, options->seed, "of the folds");
  add_threads(app, options->threads);
  add_results(app, options->output, command);
  app.run([options] {
    if (!options->groups.empty() && options->file == "-")
      throw UsageError("--groups reads the data twice: it takes no standard input");
    if (options->groups == options->data.label) throw UsageError("--groups: the label cannot be what rows are of, too");
    if (!options->groups.empty()) options->data.ignore.push_back(options->groups);
    run_evaluate(*options);
  });
}

}  // namespace sigmax::apps
