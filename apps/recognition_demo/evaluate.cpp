#include <sigmax/recognition/decision.hpp>
#include <sigmax/recognition/evaluation.hpp>
#include <sigmax/recognition/reliability.hpp>

#include "recognition_demo/folding.hpp"
#include "recognition_demo/subcommands.hpp"
#include "support/parallel.hpp"
#include "support/progress.hpp"

namespace sigmax::apps {
namespace {

struct EvaluateOptions {
  std::string file;
  DataOptions data;
  LearningOptions learning;
  std::size_t folds = 10;
  std::size_t foldings = 20;  ///< divisions into folds
  std::uint64_t seed = 1;     ///< of the folds
  std::string groups;         ///< a column whose values stay whole in a fold; or empty
  int threads = 0;            ///< 0: as many as the machine has
  OutputOptions output;
};

/// The scores of one classifier.
struct Outcome {
  std::string name;
  std::variant<Evaluation<Random>, Evaluation<Fuzzy>> evaluation;
  std::size_t excluded = 0;  ///< rows that excluded every class
  Reliability reliability{};
  Surplus surplus{};

  const ConfusionMatrix& confusion() const {
    return of_kind(evaluation, [](const auto& e) -> const ConfusionMatrix& { return e.confusion(); });
  }
  Recognised recognised() const {
    const ConfusionMatrix& rows = confusion();
    return {name, each_below(rows.size(), [&](std::size_t c) { return rows(c, c); }), rows.accuracy()};
  }
  double ties() const {
    return of_kind(evaluation,
                   [](const auto& e) { return static_cast<double>(e.ties()) / static_cast<double>(e.size()); });
  }
};

std::string described_folds(const EvaluateOptions& options) {
  return fmt::format("{} folds of {}", options.folds,
                     options.groups.empty() ? "equal shares of every class" : "whole values of " + options.groups);
}

std::string paired_by(const EvaluateOptions& options) {
  return options.groups.empty() ? "rows" : "values of " + options.groups;
}

/// Divides the rows into folds.
using Deal = std::function<Folds(std::mt19937_64& generator)>;

/// The scores in one fold, by classifier; who was right is noted.
std::vector<Outcome> classify_fold(const DataTable& data, const Folds& folds, std::size_t fold,
                                   const LearningOptions& options, Right& right) {
  const TaughtFold taught_fold = taught(data, folds, fold, options);
  std::vector<Outcome> outcomes;
  for (const Contestant& contestant : taught_fold.contestants)
    of_kind(contestant.classifier, [&](const auto& by) {
      outcomes.push_back({contestant.name, Evaluation{by.prior().variable()}});
      outcomes.back().surplus.resize(by.prior().size());
    });
  unsigned bits = 0;
  classify_rows(data, folds, taught_fold, 0, outcomes.size(), [&](const DataRow& row, std::size_t i, const Judged& by) {
    of_kind(by.belief, [&]<class Kind>(const Belief<Kind>& belief) {
      const double is_right = std::get<Evaluation<Kind>>(outcomes[i].evaluation).add(row.label(), belief);
      if (is_right > 0.0) bits |= 1U << i;
      const std::size_t answer = decide(belief).pattern;
      outcomes[i].surplus[answer].add(belief[answer] - is_right);
      outcomes[i].reliability.add(row.label(), belief);
    });
    if (by.excluded) ++outcomes[i].excluded;
    if (i + 1 == outcomes.size()) right.set(row.index, static_cast<std::uint8_t>(std::exchange(bits, 0)));
  });
  return outcomes;
}

/// Adds up folds in their order, and foldings.
struct Results {
  using TimesRight = std::array<std::uint32_t, 5>;  ///< by classifier

  std::vector<Outcome> outcomes;
  ScratchArray<TimesRight> times_right;  ///< by row
  const Groups* groups = nullptr;        ///< that rows are of, if --groups tells

  void add(std::vector<Outcome> fold) {
    if (outcomes.empty()) {
      outcomes = std::move(fold);
      return;
    }
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      outcomes[i].excluded += fold[i].excluded;
      outcomes[i].reliability.add(fold[i].reliability);
      for (std::size_t c = 0; c < outcomes[i].surplus.size(); ++c) outcomes[i].surplus[c].add(fold[i].surplus[c]);
      of_kind(outcomes[i].evaluation, [&]<class Kind>(Evaluation<Kind>& evaluation) {
        evaluation.add(std::get<Evaluation<Kind>>(fold[i].evaluation));
      });
    }
  }

  /// Who was right in a whole folding.
  void add(const Right& right) {
    ScratchCursor<std::uint8_t> bits(right);
    ScratchArray<TimesRight> sums;
    ScratchCursor<TimesRight> before(times_right);
    for (std::size_t row = 0; row < right.size(); ++row) {
      TimesRight times = before[row];
      for (std::size_t i = 0; i < times.size(); ++i) times[i] += bits[row] >> i & 1U;
      sums.push_back(times);
    }
    times_right = std::move(sums);
  }

  /// Right answers of a classifier less those of the first, paired by row; a row counts by its mean over the foldings.
  /// Of groups, if there are any, the rows do not depend on chance apart: the interval is that of sums over groups.
  Interval minus_first(std::size_t i, std::size_t foldings) const {
    RunningMean by_row, by_group;
    std::vector<std::pair<double, double>> sums;  // of a group's differences, and its rows
    ScratchCursor<TimesRight> of_row(times_right);
    std::optional<ScratchCursor<std::uint32_t>> group_of;
    if (groups) group_of.emplace(*groups);
    for (std::size_t row = 0; row < times_right.size(); ++row) {
      const TimesRight& times = of_row[row];
      const double difference =
          (static_cast<double>(times[i]) - static_cast<double>(times[0])) / static_cast<double>(foldings);
      by_row.add(difference);
      if (!groups) continue;
      const std::size_t group = (*group_of)[row];
      if (group >= sums.size()) sums.resize(group + 1);
      sums[group].first += difference;
      sums[group].second += 1.0;
    }
    const double groups_a_row = static_cast<double>(sums.size()) / static_cast<double>(times_right.size());
    for (const auto& [sum, rows] : sums) by_group.add(by_row.mean() + groups_a_row * (sum - rows * by_row.mean()));
    return groups ? by_group.interval() : by_row.interval();
  }
};

/// Rows that excluded every class, the mean over the foldings.
double excluded(const Outcome& outcome, std::size_t foldings) {
  return static_cast<double>(outcome.excluded) / static_cast<double>(foldings);
}

ResultTable outcomes_table(const Results& results, std::size_t foldings) {
  ResultTable table;
  for (std::size_t i = 0; i < results.outcomes.size(); ++i) {
    const Outcome& outcome = results.outcomes[i];
    const auto* const random = std::get_if<Evaluation<Random>>(&outcome.evaluation);
    const auto* const fuzzy = std::get_if<Evaluation<Fuzzy>>(&outcome.evaluation);
    table.row_of({{of_words("classifier", "classifier"), outcome.name},
                  {{.key = "accuracy", .header = "right", .unit = "%", .scale = 100.0}, outcome.confusion().accuracy()},
                  {of_points("accuracy_minus_that_of_sigma", "− sigma's"),
                   i == 0 ? Cell() : Cell(results.minus_first(i, foldings))},
                  {{.key = "macro_f1", .header = "macro F1", .digits = 3}, outcome.confusion().macro_f1()},
                  {{.key = "ties", .header = "ties", .unit = "%", .digits = 1, .scale = 100.0}, outcome.ties()},
                  {{.key = "log_loss", .header = "log-loss", .digits = 3}, random ? Cell(random->log_loss()) : Cell()},
                  {{.key = "brier", .header = "Brier", .digits = 3}, random ? Cell(random->brier()) : Cell()},
                  {{.key = "calibration_error"}, random ? Cell(outcome.reliability.calibration_error()) : Cell()},
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

ResultTable confusion_table(const DataTable& data, const Outcome& outcome, std::size_t foldings) {
  ResultTable table;
  for (std::size_t truth = 0; truth < data.classes.size(); ++truth) {
    std::vector<Field> row = {{of_words("", fmt::format("{}: true class", outcome.name)), data.classes[truth]}};
    for (std::size_t c = 0; c < data.classes.size(); ++c)
      row.push_back({{.header = data.classes[c], .digits = foldings == 1 ? 0 : 1},
                     outcome.confusion()(truth, c) / static_cast<double>(foldings)});
    table.row_of(row);
  }
  return table;
}

ResultTable rows_of_confusion(const DataTable& data, const Results& results, std::size_t foldings) {
  auto table = ResultTable::of_keys({"classifier", "truth", "decision", "rows"});
  for (const Outcome& outcome : results.outcomes)
    for (std::size_t truth = 0; truth < data.classes.size(); ++truth)
      for (std::size_t c = 0; c < data.classes.size(); ++c)
        table.row({outcome.name, data.classes[truth], data.classes[c],
                   outcome.confusion()(truth, c) / static_cast<double>(foldings)});
  return table;
}

/// predictions.csv: belief and decision for every row and classifier, fold after fold of the first folding.
void write_predictions(const DataTable& data, const Deal& deal, const EvaluateOptions& options, ResultFiles& files) {
  std::vector<std::string> keys = {"line", "fold", "truth", "classifier", "decision"};
  keys.insert(keys.end(), data.classes.begin(), data.classes.end());
  RowFile file(files, "predictions.csv", keys);
  std::mt19937_64 generator(options.seed);
  const Folds folds = deal(generator);
  for (std::size_t fold = 0; fold < options.folds; ++fold) {
    const TaughtFold taught_fold = taught(data, folds, fold, options.learning);
    for (std::size_t i = 0; i < taught_fold.contestants.size(); ++i)
      classify_rows(data, folds, taught_fold, i, i + 1, [&](const DataRow& row, std::size_t, const Judged& by) {
        of_kind(by.belief, [&](const auto& belief) {
          std::vector<Cell> cells = {row.line(), fold + 1, data.classes[row.label()], taught_fold.contestants[i].name,
                                     data.classes[decide(belief).pattern]};
          for (std::size_t c = 0; c < belief.size(); ++c) cells.emplace_back(belief[c]);
          file.write(cells);
        });
      });
  }
}

/// Throws unless every class can be learned whichever fold is left out.
void refuse_rare_classes(const DataTable& data) {
  std::map<std::size_t, std::string> rare;  // by class
  data.for_each([&](const DataRow& row) {
    const std::size_t c = row.label();
    if (data.rows_of_class[c] < 2) rare[c] = fmt::format("{} (line {})", in_quotes(data.classes[c]), row.line());
  });
  if (rare.empty()) return;
  throw InputError(
      "{}: column {}: found a single row of {}, expected at least two of every class: one to learn from, one to "
      "classify; add rows, or remove those of the class",
      data.file, in_quotes(data.label), listed(each(rare, [](const auto& one) { return one.second; }), 12));
}

Results evaluated(const DataTable& data, const Deal& deal, const EvaluateOptions& options) {
  Results results;
  Right right;
  for (std::size_t row = 0; row < data.size(); ++row) results.times_right.push_back({}), right.push_back(0);
  const int threads = threads_or_all(options.threads);
  Progress progress("folds", options.folds * options.foldings, options.output.quiet);
  std::mt19937_64 generator(options.seed);
  for (std::size_t folding = 0; folding < options.foldings; ++folding) {
    const Folds folds = deal(generator);
    for_each_run(
        options.folds, threads,
        [&](std::size_t fold) { return classify_fold(data, folds, fold, options.learning, right); },
        [&](std::size_t, std::vector<Outcome> fold) {
          progress.advance();
          results.add(std::move(fold));
        },
        2 * static_cast<std::size_t>(threads));
    results.add(right);
  }
  progress.finish();
  return results;
}

/// Says what makes the shares of right answers too good for other rows: columns that are known when the class is, and
/// rows of one thing.
void say_too_good(const DataTable& data, double accuracy, double most_often, const EvaluateOptions& options,
                  Result& result) {
  const auto say = [&]<class... Words>(fmt::format_string<Words...> format, Words&&... words) {
    result.page.verdict.push_back(fmt::format(format, std::forward<Words>(words)...));
    result.say(result.page.verdict.back());
  };
  constexpr double very_good = 0.9, much = 0.1, less = 0.03;
  if (accuracy > very_good && data.columns.size() > 1) {
    const auto relations = learned_relations(learn(data, options.learning).counts, options.learning.smoothing);
    const auto most = static_cast<std::size_t>(std::ranges::max_element(relations, {}, telling) - relations.begin());
    const auto shares = right_when_left_out(data, options.learning, options.seed, options.threads, {most});
    double without = 0.0;
    for (std::size_t c = 0; c < shares.size(); ++c)
      without += shares[c] * static_cast<double>(data.rows_of_class[c]) / static_cast<double>(data.size());
    const std::string& name = data.columns[most].name;
    if (!shares.empty() && accuracy - most_often > much && without - most_often < (accuracy - most_often) / 3.0)
      say("Without column {} {:.2f} % are right by sigma, not {:.2f}: if it is not known before the class is, leave it "
          "out by --ignore {}",
          in_quotes(name), 100.0 * without, 100.0 * accuracy, typed(name));
  }
  constexpr std::size_t few_rows_of_a_class = 100, many_classes = 8;
  if (data.classes.size() > many_classes && data.size() < few_rows_of_a_class * data.classes.size())
    if (const auto less_so = less_in_any_folds(data, options.learning, options.seed, options.threads);
        less_so && by_no_chance(*less_so, 0.02))
      say("{:.1f} % are right by sigma where folds are drawn whatever the class is: of {} classes with few rows some "
          "have more by chance, and so in each of the folds above; expect that of other rows",
          100.0 * (accuracy - less_so->mean), data.classes.size());
  bool any = false;
  for (const std::size_t column : columns_of_groups(data, options.learning)) {
    const auto by = by_column(data, options.learning, column, options.seed, options.threads);
    if (!by) continue;
    const auto names = each(by->hidden, [&](std::size_t one) { return in_quotes(data.columns[one].name); });
    const std::string& name = data.columns[column].name;
    const bool are_groups = by_no_chance(by->less, 0.05);
    any |= are_groups;
    if (are_groups)
      say("{:.1f} % are right by sigma without column{} {}, and {:.1f} % where rows of the same {} are in one fold: if "
          "other rows are of others, expect the latter; --groups {}{} keeps them together",
          100.0 * by->without_all, names.size() > 1 ? "s" : "", fmt::join(names, ", "),
          100.0 * (by->without_all - by->less.mean), name, typed(name),
          by->values < options.folds ? fmt::format(" --folds {}", by->values) : "");
    else if (by_no_chance(by->more, less))
      say("{:.1f} % are right by sigma without column {}, {:.1f} points more: leave it out by --ignore {}",
          100.0 * by->without, in_quotes(name), 100.0 * by->more.mean, typed(name));
  }
  const double by_chance = 0.5 / std::sqrt(static_cast<double>(data.size()));  // a standard error at ½
  if (any || accuracy < most_often + by_chance) return;
  const auto clumps = by_clumps(data, options.learning, options.seed, options.threads);
  if (are_in_clumps(clumps))
    say("{:.1f} % are right by sigma{}, and {:.1f} % where rows that are much alike are in one fold: if they are of "
        "one thing, as a person, a place or a session, or made of one another, the others are too good; keep those of "
        "one thing together by --groups, if a column names it",
        100.0 * clumps->accuracy, clumps->rows < data.size() ? fmt::format(" of {} rows", clumps->rows) : "",
        100.0 * (clumps->accuracy - clumps->less.mean));
}

void say_scores(const DataTable& data, const Results& results, const EvaluateOptions& options, Result& result) {
  result.say("{}: {}\n{}, {}seed {}; {}", data.file, described(data), described_folds(options),
             options.foldings == 1 ? "" : fmt::format("in {} foldings, ", options.foldings), options.seed,
             described(options.learning));
  result.add(outcomes_table(results, options.foldings), {.summary = {"classifiers"}});
  result.say(
      "(The class is the most likely one, the first of those that tie. Differences ± 95 % by paired {}. Necessity: 1 − "
      "the possibility of the best other class. A truth is covered if its possibility is at least ½.)",
      paired_by(options));
  const auto most = std::ranges::max_element(data.rows_of_class);
  const double most_often = static_cast<double>(*most) / static_cast<double>(data.size());
  const auto recognised = each(results.outcomes, &Outcome::recognised);
  say_beaten(data.classes, data.rows_of_class, recognised, result);
  for (const Outcome& outcome : results.outcomes)
    if (const auto* const random = std::get_if<Evaluation<Random>>(&outcome.evaluation))
      say_miscalibrated(outcome.name, random->log_loss(), outcome.surplus, data.classes, data.rows_of_class,
                        options.learning.equal_prior ? ", as --equal-prior leaves the classes' shares out"
                        : data.columns.size() > 1 ? ", as where several columns tell the same, or a value or bin has "
                                                    "few rows of a class (fewer --bins)"
                                                  : "",
                        result, options.foldings);
  for (const Outcome& outcome : results.outcomes)
    if (outcome.excluded > 0)
      result.say("{}: {:.3g} rows excluded every class and were judged by the prior", outcome.name,
                 excluded(outcome, options.foldings));
  say_unrecognised(data.classes, data.rows_of_class, recognised, result);
  if (options.groups.empty())
    say_too_good(data, results.outcomes.front().confusion().accuracy(), most_often, options, result);
  constexpr std::size_t most_classes = 10;
  result.say({{options.learning.misread == 0.0, std::string(sigma_max_is_max)}});
  if (data.classes.size() > most_classes) return;
  for (const std::size_t i : {0U, 1U}) result.add(confusion_table(data, results.outcomes[i], options.foldings), {});
}

/// Rows of the data by true and decided class.
HeatMap confusion_map(const DataTable& data, const Outcome& outcome, std::size_t foldings) {
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
      .note = "Above each point: how many classes of rows had such a degree.",
      .joined = true};
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
    add(bin.mean_degree, bin.share, bin.lower, bin.upper, fmt::format("{:.{}f}", bin.count, foldings == 1 ? 0 : 1));
  add(1.0, nan, nan, nan, "");
  return chart;
}

/// Confusion matrices and reliability side by side, and what was learned of all rows.
void fill(Report& page, const DataTable& data, const Results& results, const EvaluateOptions& options) {
  page.verdict.insert(page.verdict.begin(),
                      fmt::format("{}. {}, {} foldings, seed {}; {}.", described(data), described_folds(options),
                                  options.foldings, options.seed, described(options.learning)));
  page.panels.emplace_back(ReportTable{"Classifiers", outcomes_table(results, options.foldings),
                                       fmt::format("Differences ± 95 % by paired {}.", paired_by(options))});
  constexpr std::size_t most_classes = 30;
  if (data.classes.size() <= most_classes)
    for (const Outcome& outcome : results.outcomes)
      page.panels.emplace_back(confusion_map(data, outcome, options.foldings));
  for (const Outcome& outcome : results.outcomes)
    page.panels.emplace_back(reliability_chart(outcome, options.foldings));
  page.last = relation_maps(learned_relations(learn(data, options.learning).counts, options.learning.smoothing), 6);
}

void run_evaluate(const EvaluateOptions& options) {
  refuse_to_overwrite(options.output, {options.file}, {"predictions.csv", "confusion.csv"});
  ResultFiles files(options.output);
  const DataTable data = read_data(options.file, options.data, options.output.quiet);
  print_warnings(data, options.learning, options.data.grouped);
  if (options.folds > data.size())
    throw InputError("{}: found {} rows, expected at least as many as the {} folds", data.file, data.size(),
                     options.folds);
  refuse_rare_classes(data);
  const auto groups = options.groups.empty() ? std::nullopt : std::optional(groups_of(data, options.groups));
  const Deal deal = [&](std::mt19937_64& generator) {
    return groups ? folds_of(data, *groups, options.folds, generator) : folds_of(data, options.folds, generator);
  };
  Results results = evaluated(data, deal, options);
  results.groups = groups ? &*groups : nullptr;
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
  if (files.wanted()) write_predictions(data, deal, options, files);
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
    options->data.grouped = !options->groups.empty();
    if (options->data.grouped) options->data.ignore.push_back(options->groups);
    run_evaluate(*options);
  });
}

}  // namespace sigmax::apps
