#include <set>

#include "recognition_demo/learning.hpp"

namespace sigmax::apps {
namespace {

/// Log-loss of who gives each class its share of the rows.
double log_loss_of_shares(const LabelledTable& data) {
  double loss = 0.0;
  for (const std::size_t rows : data.rows_of_class) {
    const double share = static_cast<double>(rows) / static_cast<double>(data.size());
    loss -= share * std::log(share);
  }
  return loss;
}

ResultTable outcomes_table(const LabelledTable& data, const Results& results) {
  ResultTable table;
  for (std::size_t i = 0; i < results.outcomes.size(); ++i) {
    const Outcome& outcome = results.outcomes[i];
    const auto* const random = std::get_if<Evaluation<Random>>(&outcome.evaluation);
    const auto* const fuzzy = std::get_if<Evaluation<Fuzzy>>(&outcome.evaluation);
    table.row_of(
        {{of_words("classifier", "classifier"), outcome.name},
         {{.key = "accuracy", .header = "right", .unit = "%", .scale = 100.0}, outcome.confusion().accuracy()},
         {of_points("accuracy_minus_that_of_sigma", "− sigma's"), i == 0 ? Cell() : Cell(results.minus_first(i))},
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
          outcome.excluded > 0 ? Cell(results.of_a_folding(outcome.excluded)) : Cell()}});
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
      for (const bool is_recall : {true, false}) {
        double of = 0.0;
        for (std::size_t other = 0; other < data.classes.size(); ++other)
          of += is_recall ? confusion(c, other) : confusion(other, c);
        const std::string what = is_recall ? "recall" : "precision";
        row.push_back({{.key = fmt::format("{}: {}", outcome.name, what),
                        .header = what,
                        .unit = "%",
                        .digits = 1,
                        .scale = 100.0,
                        .group = outcome.name + ":"},
                       of > 0.0 ? std::optional(confusion(c, c) / of) : std::nullopt});
      }
    }
    table.row_of(row);
  }
  return table;
}

ResultTable rows_of_confusion(const LabelledTable& data, const Results& results) {
  auto table = ResultTable::of_keys({"classifier", "truth", "decision", "rows"});
  for (const Outcome& outcome : results.outcomes)
    for (std::size_t truth = 0; truth < data.classes.size(); ++truth)
      for (std::size_t c = 0; c < data.classes.size(); ++c)
        table.row(
            {outcome.name, data.classes[truth], data.classes[c], results.of_a_folding(outcome.confusion()(truth, c))});
  return table;
}

/// predictions.csv: belief and decision for every row and classifier, fold after fold of the first folding.
void write_predictions(const LabelledTable& data, const EvaluateOptions& options, ResultFiles& files) {
  std::vector<std::string> keys = {"line", "fold", "truth", "classifier", "decision"};
  keys.insert(keys.end(), data.classes.begin(), data.classes.end());
  RowFile file(files, "predictions.csv", keys);
  std::mt19937_64 generator(options.seed);
  const Folds folds = divided(data, options.folds, generator);
  for (std::size_t fold = 0; fold < options.folds; ++fold)
    for (const TableClassifier& by : taught(data, folds, fold, options.learning))
      for (std::size_t row = 0; row < data.size(); ++row) {
        if (folds[row] != fold) continue;
        const TablePrediction found = by.predict(by.readings(data.columns, row));
        std::vector<Cell> cells = {data.lines[row], fold + 1, data.classes[data.labels[row]], std::string(by.name()),
                                   found.label};
        for (const double value : degrees_of(found.belief)) cells.emplace_back(value);
        file.write(cells);
      }
}

/// Throws unless every class can be learned whichever fold is left out: it needs two rows, of two groups.
void refuse_rare_classes(const LabelledTable& data) {
  std::vector<std::set<std::size_t>> of(data.classes.size());  // of each class two groups, or rows, at most
  for (std::size_t row = 0; row < data.size(); ++row)
    if (auto& its = of[data.labels[row]]; its.size() < 2) its.insert(data.groups.empty() ? row : data.groups[row]);
  for (std::size_t row = 0; row < data.size(); ++row)
    if (of[data.labels[row]].size() < 2)
      throw InputError(
          "{}:{}: column {}: found {} in a single {}, expected at least two of every class, one to learn from and one "
          "to classify; add rows, or remove this class",
          data.file, data.lines[row], in_quotes(data.label), in_quotes(data.classes[data.labels[row]]),
          data.groups.empty() ? "row" : "group");
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
    if (const Interval own = results.minus_first(i); own.above_zero() && own.mean > by.mean) best = i, by = own;
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

/// Rows of the data by true and decided class.
HeatMap confusion_map(const LabelledTable& data, const Outcome& outcome, const Results& results) {
  HeatMap map{.title = outcome.name,
              .row_label = "true class",
              .column_label = "decided class",
              .rows = data.classes,
              .columns = data.classes,
              .value_label = "rows, mean of the foldings",
              .digits = results.foldings == 1 ? 0 : 1};
  map.fill([&](std::size_t truth, std::size_t c) {
    return HeatMap::Cell{results.of_a_folding(outcome.confusion()(truth, c))};
  });
  return map;
}

/// What was believed of the classes of rows against how often that was true. The diagonal is calibration, or the bound
/// that possibilities are.
LineChart reliability_chart(const std::string& name, bool fuzzy, const std::vector<Reliability::Bin>& bins) {
  using Bin = Reliability::Bin;
  const auto degrees = each(bins, &Bin::mean_degree);
  return {.title = "Reliability of " + name,
          .x_label = fuzzy ? "possibility of a class" : "probability of a class",
          .y_label = "share of such classes that are the true one",
          .x = degrees,
          .curves = {{.name = "share, ± 95 %",
                      .values = each(bins, &Bin::share),
                      .lower = each(bins, &Bin::lower),
                      .upper = each(bins, &Bin::upper)},
                     {.name = fuzzy ? "bound: not more often than possible" : "calibrated", .values = degrees}},
          .greatest_y = 1.15,
          .note = "Above each point: the number of rows and classes with such a degree.",
          .remarks = each(bins, [](const Bin& bin) { return fmt::format("{:.0f}", bin.count); }),
          .joined = 1.0};
}

void run_evaluate(const EvaluateOptions& options) {
  refuse_to_overwrite(options.output, {options.file}, {"predictions.csv", "confusion.csv"});
  ResultFiles files(options.output);
  const LabelledTable data = read_table(options.file, options.data, options.output.quiet);
  print_findings(data);
  refuse_rare_classes(data);
  const std::string& groups = options.data.groups;
  const Results results = cross_validated(data, options);
  Result result = comparison_result("Cross-validation of " + data.file, options.output);
  result.facts("file", data.file, "rows", data.size(), "classes", data.classes, "folds", options.folds, "foldings",
               options.foldings, "seed", options.seed, "smoothing", options.learning.smoothing, "misread",
               options.learning.misread, "bins", options.learning.bins);
  const std::string how = fmt::format("{} folds of {}, {}seed {}; {}", options.folds,
                                      groups.empty() ? "equal shares of every class" : "whole values of " + groups,
                                      options.foldings == 1 ? "" : fmt::format("in {} foldings, ", options.foldings),
                                      options.seed, described(options.learning));
  const std::string note = fmt::format(
      "The answer is the most likely class; of tied classes, the first. Differences ± 95 % by paired {}, without the "
      "variation of the training rows. Shares' log-loss: each row gets the classes' shares as probabilities. "
      "Necessity: 1 − the possibility of the best other class. A truth is covered if its possibility is at least ½.",
      groups.empty() ? "rows" : "values of " + groups);
  const std::string use = advice(data, results, options);
  result.say("{}: {}\n{}", data.file, described(data), how);
  result.add(outcomes_table(data, results), {.summary = {"classifiers"}, .title = "Classifiers", .note = note});
  result.say("({})", note);
  for (const Outcome& outcome : results.outcomes)
    if (outcome.excluded > 0)
      result.say("{}: {:.3g} rows excluded every class and were judged by the prior", outcome.name,
                 results.of_a_folding(outcome.excluded));
  result.add(classes_table(data, results), {.summary = {"of_each_class"}, .title = "Classes"});
  result.fact({"advice"}, use);
  result.say("\n{}", use);
  std::vector<Panel> charts;
  for (const Outcome& outcome : results.outcomes) {
    const auto bins = outcome.reliability.bins(static_cast<double>(options.foldings));
    for (std::size_t i = 0; const auto& bin : bins)
      result.facts_at({"reliability", outcome.name, i++}, "from", bin.from, "to", bin.to, "statements", bin.count,
                      "mean_degree", bin.mean_degree, "share_that_is_true", bin.share, "lower", bin.lower, "upper",
                      bin.upper);
    constexpr std::size_t most_classes = 30;
    if (data.classes.size() <= most_classes) result.page.panels.emplace_back(confusion_map(data, outcome, results));
    const bool fuzzy = std::holds_alternative<Evaluation<Fuzzy>>(outcome.evaluation);
    charts.emplace_back(reliability_chart(outcome.name, fuzzy, bins));
  }
  std::ranges::move(charts, std::back_inserter(result.page.panels));
  if (!groups.empty()) result.fact({"groups"}, groups);
  result.page.verdict = {fmt::format("{}. {}.", described(data), how), use};
  result.add(rows_of_confusion(data, results), {.printed = false, .csv = "confusion.csv"});
  if (files.wanted()) write_predictions(data, options, files);
  if (files.report_wanted())
    for (Panel& map :
         relation_maps(TableModel::fit(data.columns, {data.label, data.classes}, data.labels, options.learning)))
      result.page.last.push_back(std::move(map));
  result.publish(files);
}

}  // namespace

void add_evaluate(CLI::App& program, const std::string& command) {
  const auto options = std::make_shared<EvaluateOptions>();
  Subcommand app(program, "evaluate", "Cross-validates every kind of classifier on labelled data.");
  add_learning(app, options->file, options->data, options->learning);
  app.option("--folds", options->folds, "Parts of the data, each classified by what the others teach").in(2, 1000000);
  app.option("--foldings", options->foldings, "Divisions into folds; one alone may be a lucky one").in(1, 100000);
  app.option("--groups", options->data.groups,
             "A column of groups, as a patient or a session: folds keep the rows of a group together, and it is no "
             "feature")
      .type("COLUMN");
  add_seed(app, options->seed, "of the folds");
  add_threads(app, options->threads);
  add_results(app, options->output, command);
  app.run([options] {
    if (options->data.groups == options->data.label)
      throw UsageError("--groups: the label cannot be what rows are of, too");
    run_evaluate(*options);
  });
}

}  // namespace sigmax::apps
