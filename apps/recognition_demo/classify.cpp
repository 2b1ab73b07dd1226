#include "recognition_demo/learning.hpp"
#include "shell/progress.hpp"

namespace sigmax::apps {
namespace {

struct ClassifyOptions {
  std::string model, file;
  bool explain = false;
  std::size_t rows = 5;       ///< how many rows to show
  double least_margin = 0.0;  ///< decisions with a smaller margin are rejected
  std::string unseen = "refuse";
  OutputOptions output;
};

/// Reads the rows of a file in the code of a model.
class RowReader {
 public:
  /// The model must outlive the reader. What it does not know is missing, or else an InputError. Throws InputError for
  /// a column of the model that the file does not have.
  RowReader(const SavedModel& saved, const CsvReader& reader, bool unseen_is_missing)
      : features_(saved.model.features),
        missing_(saved.missing),
        unseen_is_missing_(unseen_is_missing),
        label_(reader.find(saved.model.counts.pattern().name())),
        classes_{.name = "", .words = labels_of(saved.model.counts.pattern())},
        columns_(each(features_, [&](const TableFeature& feature) { return reader.column(feature.name); })) {}

  bool has_truth() const { return label_.has_value(); }

  Readings readings(const CsvRow& row) {
    return each_below(columns_.size(), [&](std::size_t i) { return reading(row, columns_[i], features_[i]); });
  }

  /// The class of a row, or `missing` if it is not given.
  std::size_t truth(const CsvRow& row) {
    return !label_ || missing_(row[*label_]) ? missing : place(row, *label_, classes_, "a class of the model: ");
  }

  std::size_t unseen_cells = 0;  ///< that held what the model does not know
  std::string first_unseen;

 private:
  std::size_t reading(const CsvRow& row, std::size_t column, const TableFeature& feature) {
    const std::string_view cell = trimmed(row[column]);
    if (feature.bins ? missing_.among_numbers(cell) : missing_(cell)) return feature.reading(nan);
    if (!feature.bins) return place(row, column, feature, "a value that the model knows: ");
    if (const auto number = parse_number(cell)) return feature.reading(*number);
    return unseen(row, column, "a finite number with a decimal point",
                  has_decimal_comma(cell) ? "write a decimal comma as a point" : remedy);
  }

  /// Where a cell is among the words of a feature.
  std::size_t place(const CsvRow& row, std::size_t column, const TableFeature& feature, const char* what) {
    const std::string_view cell = trimmed(row[column]);
    if (const auto found = feature.find(cell)) return *found;
    const std::string nearest = nearest_word(cell, feature.words);
    return unseen(row, column, what + listed(feature.words, 12), nearest.empty() ? remedy : nearest);
  }

  /// Counts what is to be taken as missing, or throws.
  std::size_t unseen(const CsvRow& row, std::size_t column, const std::string& expected, const std::string& advice) {
    if (!unseen_is_missing_) throw row.error(column, expected, advice);
    if (unseen_cells++ == 0) first_unseen = row.error(column, expected).what();
    return missing;
  }

  static constexpr const char* remedy =
      "leave the cell empty, or have all such cells counted as missing by --unseen missing";

  const std::vector<TableFeature>& features_;
  MissingWords missing_;
  bool unseen_is_missing_;
  std::optional<std::size_t> label_;
  TableFeature classes_;
  std::vector<std::size_t> columns_;
};

/// What a classifier decided over all rows.
struct Tally {
  std::string name;
  std::vector<std::size_t> decided;  ///< by class
  std::size_t rejected = 0;
  std::size_t judged = 0, right = 0;  ///< decided rows whose class is known
  std::size_t excluded = 0;           ///< rows that excluded every class

  std::optional<double> accuracy() const {
    if (judged == 0) return std::nullopt;
    return static_cast<double>(right) / static_cast<double>(judged);
  }
};

/// One row that is shown.
struct ShownRow {
  std::size_t line;
  std::string truth;  ///< empty if it is not known
  Readings readings;
};

/// The rows of a file, classified one after the other.
struct Classified {
  std::size_t rows = 0;
  std::vector<Tally> tallies;
  std::vector<ShownRow> shown;
  ResultTable decisions;  ///< of the rows that are shown
};

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : value > 0.0 ? "∞" : "-∞";
}

/// Why the best class rather than the next one, with prior and belief of both.
ResultTable explanation(const TableClassifier& by, const Readings& readings) {
  const TablePrediction prediction = by.predict(readings);
  if (prediction.excluded)
    return ResultTable({of_words("", fmt::format("{}: the readings exclude every class", by.name()))});
  const auto belief = degrees_of(prediction.belief);
  auto why = by.explain(readings);
  std::ranges::stable_sort(why.contributions, std::greater{},
                           [](const Contribution& one) { return std::abs(one.log_ratio); });
  const auto& pattern = by.model().counts.pattern();
  const std::string best = pattern.label(why.pattern), next = pattern.label(why.rival);
  ResultTable table({of_words("", fmt::format("{}: {} rather than {}, because", by.name(), best, next)),
                     {.header = "the same of " + next},
                     {.header = "log of the ratio"}});
  table.row({fmt::format("before any reading: {} = {:.4g}", best, std::exp(why.log_prior)),
             number(std::exp(why.rival_log_prior)), number(why.log_prior_ratio)});
  for (const Contribution& each : why.contributions)
    table.row({each.equation, number(std::exp(each.rival_log_likelihood)), number(each.log_ratio)});
  table.rule();
  table.row(
      {fmt::format("{} = {:.4g}", best, belief[why.pattern]), number(belief[why.rival]), number(why.log_ratio())});
  return table;
}

Classified classify_all(const ClassifyOptions& options, const std::vector<TableClassifier>& all, CsvReader& reader,
                        RowReader& rows, RowFile& file) {
  const auto& pattern = all.front().model().counts.pattern();
  Classified result;
  for (const TableClassifier& one : all)
    result.tallies.push_back({std::string(one.name()), std::vector<std::size_t>(pattern.size())});
  Progress progress("classifying", reader.bytes_total().value_or(0), options.output.quiet || !reader.bytes_total());
  for (CsvRow row; reader.next(row); ++result.rows) {
    const Readings readings = rows.readings(row);
    const std::size_t truth = rows.truth(row);
    const std::string its_class = truth == missing ? "" : pattern.label(truth);
    std::vector<Field> fields = {{{.header = "line"}, row.line()}};
    if (rows.has_truth()) fields.push_back({of_words("", pattern.name()), its_class});
    for (std::size_t i = 0; i < all.size(); ++i) {
      Tally& tally = result.tallies[i];
      const TablePrediction prediction = all[i].predict(readings);
      const bool decided = prediction.margin >= options.least_margin;
      tally.excluded += prediction.excluded ? 1U : 0U;
      tally.rejected += decided ? 0U : 1U;
      tally.decided[prediction.pattern] += decided ? 1U : 0U;
      tally.judged += decided && truth != missing ? 1U : 0U;
      tally.right += decided && truth == prediction.pattern ? 1U : 0U;
      fields.push_back({of_words("", tally.name),
                        fmt::format("{} ({} {:.3f}{})", decided ? prediction.label : "rejected",
                                    std::holds_alternative<Belief<Fuzzy>>(prediction.belief) ? "N" : "margin",
                                    prediction.margin, decided && prediction.tied > 1 ? ", a tie" : "")});
      if (!file) continue;
      std::vector<Cell> cells = {row.line(), tally.name, decided ? Cell(prediction.label) : Cell(), prediction.margin};
      if (rows.has_truth()) cells.insert(cells.begin() + 1, its_class);
      for (const double degree : degrees_of(prediction.belief)) cells.emplace_back(degree);
      file.write(cells);
    }
    if (result.rows < options.rows) {
      result.decisions.row_of(fields);
      result.shown.push_back({row.line(), its_class, readings});
    }
    progress.advance(reader.bytes_read() - progress.done());
  }
  progress.finish();
  if (result.rows == 0) throw InputError("{}: there is no row below the header", reader.file());
  return result;
}

ResultTable totals_table(const RandomVariable& pattern, bool has_truth, const Classified& result) {
  constexpr std::size_t most_classes = 10;
  ResultTable table;
  for (const Tally& tally : result.tallies) {
    std::vector<Field> row = {{of_words("", fmt::format("all {} rows", result.rows)), tally.name}};
    for (std::size_t c = 0; c < pattern.size() && pattern.size() <= most_classes; ++c)
      row.push_back({{.header = pattern.label(c)}, tally.decided[c]});
    row.push_back({{.header = "rejected"}, tally.rejected});
    const bool all_known = tally.judged + tally.rejected == result.rows;
    if (has_truth)
      row.push_back({{.header = all_known ? "right, % of the decided" : "right, % of the decided whose class is known",
                      .scale = 100.0},
                     tally.accuracy()});
    table.row_of(row);
  }
  return table;
}

/// The support that a row gives to each class, and why.
View view_of(const ShownRow& row, const RandomVariable& pattern, const std::vector<TableClassifier>& all) {
  View view{fmt::format("line {}", row.line), {}};
  view.panels.emplace_back(HeatMap{
      .title = row.truth.empty() ? "Support of the classes" : "Support of the classes; true is " + row.truth,
      .row_label = "classifier",
      .column_label = pattern.name(),
      .rows = each(all, [](const TableClassifier& one) { return std::string(one.name()); }),
      .columns = labels_of(pattern),
      .values = each(all, [&](const TableClassifier& one) { return degrees_of(one.predict(row.readings).belief); }),
      .value_label = "probability or possibility"});
  for (const TableClassifier& one : all)
    view.panels.emplace_back(ReportTable{std::string(one.name()), explanation(one, row.readings)});
  return view;
}

void run_classify(const ClassifyOptions& options) {
  constexpr std::size_t most_views = 200;
  refuse_to_overwrite(options.output, {options.model, options.file}, {"predictions.csv"});
  ResultFiles files(options.output);
  const SavedModel saved = read_model(options.model);
  const auto& pattern = saved.model.counts.pattern();
  const auto all = classifiers(saved.model, saved.kinds);

  CsvReader reader = open_csv(options.file);
  RowReader rows(saved, reader, options.unseen == "missing");
  std::vector<std::string> keys = {"line", "truth", "classifier", "decision", "margin"};
  if (!rows.has_truth()) keys.erase(keys.begin() + 1);
  for (std::size_t c = 0; c < pattern.size(); ++c) keys.push_back(pattern.label(c));
  RowFile file(files, "predictions.csv", keys);
  const Classified found = classify_all(options, all, reader, rows, file);

  Result result = comparison_result("Classes of " + options.file, options.output);
  result.say("{}: {} rows, by {}", reader.file(), found.rows, options.model);
  if (rows.unseen_cells > 0)
    result.say("\n{} as missing, since the model does not know {}: {}",
               rows.unseen_cells == 1 ? "1 cell counts" : fmt::format("{} cells count", rows.unseen_cells),
               rows.unseen_cells == 1 ? "it" : "them; the first", rows.first_unseen);
  if (!found.shown.empty()) result.add(found.decisions, {});
  const ResultTable totals = totals_table(pattern, rows.has_truth(), found);
  result.add(totals, {});
  result.facts("model", options.model, "file", options.file, "rows", found.rows, "least_margin", options.least_margin);
  if (rows.unseen_cells > 0) result.fact({"unseen_cells_counted_as_missing"}, rows.unseen_cells);
  for (const Tally& tally : found.tallies) {
    if (tally.excluded > 0)
      result.say("{}: {} rows excluded every class and were judged by the prior", tally.name, tally.excluded);
    for (std::size_t c = 0; c < pattern.size(); ++c)
      result.fact({"classifiers", tally.name, "decided", pattern.label(c)}, tally.decided[c]);
    result.fact({"classifiers", tally.name, "rejected"}, tally.rejected);
    if (tally.judged > 0) result.fact({"classifiers", tally.name, "accuracy_of_the_decided"}, *tally.accuracy());
  }
  for (std::size_t k = 0; options.explain && k < found.shown.size(); ++k) {
    result.text += fmt::format("\nline {}\n", found.shown[k].line);
    for (const TableClassifier& one : all) result.add(explanation(one, found.shown[k].readings), {});
  }
  if (files.report_wanted()) {
    Report& page = result.page;
    page.chooser = "Row";
    page.panels.emplace_back(ReportTable{"All rows", totals});
    for (std::size_t k = 0; k < std::min(most_views, found.shown.size()); ++k)
      page.views.push_back(view_of(found.shown[k], pattern, all));
    page.verdict = {
        fmt::format("{} rows, classified by {}; {}.", found.rows, options.model, described(saved.model.options))};
    if (page.views.size() < found.rows)
      page.verdict.push_back(fmt::format("The first {} rows can be chosen; --rows says how many.", page.views.size()));
    page.last = relation_maps(saved.model);
  }
  result.publish(files);
}

}  // namespace

void add_classify(CLI::App& program, const std::string& command) {
  const auto options = std::make_shared<ClassifyOptions>();
  Subcommand app(program, "classify", "Classifies the rows of a file by a model.");
  app.option("model", options->model, "A model that `train` wrote").required().type("MODEL.json");
  app.option("data", options->file, "A headed CSV file with the model's columns, or - for the standard input")
      .required()
      .type("DATA");
  app.flag("--explain", options->explain, "Say why, for the rows that are shown");
  app.option("--rows", options->rows, "How many rows to show").in(0, 1000000);
  app.option("--least-margin", options->least_margin,
             "Reject decisions whose lead in probability, or necessity, is smaller")
      .number_in(0.0, 1.0);
  app.option("--unseen", options->unseen, "What to do with values and classes that the model does not know")
      .one_of({"refuse", "missing"});
  add_results(app, options->output, command);
  app.run([options] { run_classify(*options); });
}

}  // namespace sigmax::apps
