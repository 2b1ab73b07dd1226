#include <map>

#include <sigmax/recognition/decision.hpp>
#include <sigmax/recognition/explanation.hpp>

#include "recognition_demo/row_reader.hpp"
#include "recognition_demo/subcommands.hpp"
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

/// What a classifier decided over all rows.
struct Tally {
  std::string name;
  std::vector<std::size_t> decided;  ///< by class
  std::vector<double> recognised;    ///< of the decided rows of a class
  std::size_t rejected = 0;
  std::size_t judged = 0;    ///< decided rows whose class is known
  std::size_t excluded = 0;  ///< rows that excluded every class

  std::optional<double> accuracy() const {
    if (judged == 0) return std::nullopt;
    return sum_of(recognised) / static_cast<double>(judged);
  }
};

/// One row that is shown.
struct ShownRow {
  std::size_t line;
  std::string truth;  ///< empty if it is not known
  Readings readings;
  std::vector<std::string> decisions;
};

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : value > 0.0 ? "∞" : "-∞";
}

/// Why the best class rather than the next one, with prior and belief of both; none if the readings exclude every
/// class.
std::optional<ResultTable> explanation(const Contestant& contestant, const Readings& readings) {
  const Judged by = judged(contestant, readings);
  if (by.excluded) return std::nullopt;
  return of_kind(by.belief, [&]<class Kind>(const Belief<Kind>& belief) {
    const auto& classifier = std::get<Classifier<Kind, Kind>>(contestant.classifier);
    const auto both = best_patterns(belief, 2);
    const std::string &best = belief.variable().label(both[0]), &next = belief.variable().label(both[1]);
    auto why = explain(classifier, std::span<const std::size_t>(readings), both[0], both[1]);
    std::ranges::stable_sort(
        why.contributions, [](const auto& a, const auto& b) { return std::abs(a.log_ratio) > std::abs(b.log_ratio); });
    ResultTable table({of_words("", fmt::format("{}: {} rather than {}, because", contestant.name, best, next)),
                       {.header = "the same of " + next},
                       {.header = "log of the ratio"}});
    table.row({fmt::format("before any reading: {} = {:.4g}", best, classifier.prior()[both[0]]),
               number(classifier.prior()[both[1]]), number(why.log_prior_ratio)});
    for (const Contribution& each : why.contributions)
      table.row({each.equation, number(std::exp(each.rival_log_likelihood)), number(each.log_ratio)});
    table.rule();
    table.row({fmt::format("{} = {:.4g}", best, belief[both[0]]), number(belief[both[1]]), number(why.log_ratio())});
    return table;
  });
}

/// The rows of a file, classified one after the other.
struct Classified {
  std::size_t rows = 0;
  std::vector<std::size_t> rows_of_class;  ///< of those whose class is known
  std::vector<Tally> tallies;
  std::vector<ShownRow> shown;
};

Classified classify_all(const ClassifyOptions& options, const LearnedModel& model, const std::vector<Contestant>& all,
                        CsvReader& reader, RowReader& rows, RowFile& file) {
  const auto& pattern = model.counts.pattern();
  // What a classifier says of a row: counted, shown, and written to the file if there is one.
  const auto take = [&]<class Kind>(const Belief<Kind>& belief, std::size_t line, std::optional<std::size_t> truth,
                                    Tally& tally, ShownRow* show) {
    const Decision decision = decide(belief);
    const bool rejected = decision.margin < options.least_margin;
    if (rejected) {
      ++tally.rejected;
    } else {
      ++tally.decided[decision.pattern];
      if (truth) ++tally.judged;
      if (truth == decision.pattern) ++tally.recognised[*truth];
    }
    if (show)
      show->decisions.push_back(fmt::format("{} ({} {:.3f}{})", rejected ? "rejected" : pattern.label(decision.pattern),
                                            SelectiveAlgebra<AlgebraOf<Kind>> ? "N" : "margin", decision.margin,
                                            !rejected && decision.tied > 1 ? ", a tie" : ""));
    if (!file) return;
    std::vector<Cell> cells = {line, tally.name, rejected ? Cell() : Cell(pattern.label(decision.pattern)),
                               decision.margin};
    if (rows.has_truth()) cells.insert(cells.begin() + 1, truth ? pattern.label(*truth) : "");
    for (std::size_t c = 0; c < belief.size(); ++c) cells.emplace_back(belief[c]);
    file.write(cells);
  };
  Classified result;
  result.rows_of_class.assign(pattern.size(), 0);
  for (const Contestant& one : all)
    result.tallies.push_back({one.name, result.rows_of_class, std::vector<double>(pattern.size(), 0.0)});
  Progress progress("classifying", reader.bytes_total().value_or(0), options.output.quiet || !reader.bytes_total());
  for (CsvRow row; reader.next(row); ++result.rows) {
    const Readings report = rows.readings(row);
    const auto truth = rows.truth(row);
    if (truth) ++result.rows_of_class[*truth];
    ShownRow* const show =
        result.rows < options.rows
            ? &result.shown.emplace_back(ShownRow{row.line(), truth ? pattern.label(*truth) : "", report, {}})
            : nullptr;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Judged by = judged(all[i], report);
      if (by.excluded) ++result.tallies[i].excluded;
      of_kind(by.belief, [&](const auto& belief) { take(belief, row.line(), truth, result.tallies[i], show); });
    }
    progress.advance(reader.bytes_read() - progress.done());
  }
  progress.finish();
  return result;
}

ResultTable shown_table(const std::string& label, bool has_truth, const std::vector<Contestant>& all,
                        const std::vector<ShownRow>& shown) {
  ResultTable table;
  for (const ShownRow& row : shown) {
    std::vector<Field> fields = {{{.header = "line"}, row.line}};
    if (has_truth) fields.push_back({of_words("", label), row.truth});
    for (std::size_t i = 0; i < all.size(); ++i) fields.push_back({of_words("", all[i].name), row.decisions[i]});
    table.row_of(fields);
  }
  return table;
}

ResultTable totals_table(const RandomVariable& pattern, bool has_truth, const Classified& result) {
  constexpr std::size_t most_classes = 10;
  const std::size_t shown_classes = pattern.size() <= most_classes ? pattern.size() : 0;
  ResultTable table;
  for (const Tally& tally : result.tallies) {
    std::vector<Field> row = {{of_words("", fmt::format("all {} rows", result.rows)), tally.name}};
    for (std::size_t c = 0; c < shown_classes; ++c) row.push_back({{.header = pattern.label(c)}, tally.decided[c]});
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

void add_facts(const ClassifyOptions& options, const RandomVariable& pattern, const Classified& found,
               const RowReader& rows, Result& result) {
  result.facts("model", options.model, "file", options.file, "rows", found.rows, "least_margin", options.least_margin);
  if (rows.unseen_cells() > 0) result.fact({"unseen_cells_counted_as_missing"}, rows.unseen_cells());
  for (const Tally& tally : found.tallies) {
    for (std::size_t c = 0; c < pattern.size(); ++c)
      result.fact({"classifiers", tally.name, "decided", pattern.label(c)}, tally.decided[c]);
    result.fact({"classifiers", tally.name, "rejected"}, tally.rejected);
    if (tally.judged > 0) result.fact({"classifiers", tally.name, "accuracy_of_the_decided"}, *tally.accuracy());
  }
}

/// The support that a row gives to each class, and why.
View view_of(const ShownRow& row, const RandomVariable& pattern, const std::vector<Contestant>& all) {
  View view{fmt::format("line {}", row.line), {}};
  HeatMap support{
      .title = row.truth.empty() ? "Support of the classes" : "Support of the classes; true is " + row.truth,
      .row_label = "classifier",
      .column_label = pattern.name(),
      .rows = each(all, &Contestant::name),
      .columns = labels_of(pattern),
      .values = each(all, [&](const Contestant& one) { return follow(one, 0, {row.readings}).belief; }),
      .value_label = "probability or possibility"};
  view.panels.emplace_back(std::move(support));
  for (const Contestant& contestant : all)
    if (auto why = explanation(contestant, row.readings))
      view.panels.emplace_back(ReportTable{contestant.name, std::move(*why)});
    else
      view.panels.emplace_back(Words{contestant.name, "The readings exclude every class."});
  return view;
}

void fill(Report& page, const ClassifyOptions& options, const LearnedModel& model, const std::vector<Contestant>& all,
          const Classified& result, bool has_truth) {
  constexpr std::size_t most_views = 200;
  const auto& pattern = model.counts.pattern();
  page.chooser = "Row";
  page.verdict = {fmt::format("{} rows, classified by {}; {}.", result.rows, options.model, described(model.options))};
  page.panels.emplace_back(ReportTable{"All rows", totals_table(pattern, has_truth, result)});
  for (std::size_t i = 0; i < std::min(most_views, result.shown.size()); ++i)
    page.views.push_back(view_of(result.shown[i], pattern, all));
  if (page.views.size() < result.rows)
    page.verdict.push_back(fmt::format("The first {} rows can be chosen; --rows says how many.", page.views.size()));
  page.last = relation_maps(learned_relations(model.counts, model.options.smoothing), 6);
}

/// Says if the rows are right less often than those that were learned were when left out, class by class, since there
/// may be more rows of some.
void say_swapped(const LearnedModel& model, const Classified& found, Result& result) {
  constexpr double few = 5.0, few_learned = 10.0, errors = 3.5, less = 0.05;
  const auto sigma = std::ranges::find(found.tallies, kind_names.front(), &Tally::name);
  if (sigma == found.tallies.end() || model.right.empty() || sigma->rejected > 0) return;
  RunningMean here, there;
  double variance = 0.0;
  for (std::size_t c = 0; c < model.right.size(); ++c) {
    const auto rows = static_cast<double>(found.rows_of_class[c]), learned = model.counts.rows(c);
    if (rows < few || learned < few_learned) continue;
    here.add(sigma->recognised[c] / rows);
    there.add(model.right[c]);
    const double share = (sigma->recognised[c] + model.right[c] * learned + 1.0) / (rows + learned + 2.0);
    variance += share * (1.0 - share) * (1.0 / rows + 1.0 / learned);
  }
  if (here.count() == 0) return;
  const double lower = there.mean() - here.mean();
  if (lower > std::max(less, errors * std::sqrt(variance) / static_cast<double>(here.count())))
    result.say(
        "Sigma is right in {:.1f} % of the rows of a class on average, {:.1f} % when those learned from were left out: "
        "labels or columns are swapped, or the rows have drifted; compare them with those learned from",
        100.0 * here.mean(), 100.0 * there.mean());
}

void run_classify(const ClassifyOptions& options) {
  refuse_to_overwrite(options.output, {options.model, options.file}, {"predictions.csv"});
  ResultFiles files(options.output);
  const ModelFile model_file = read_model(options.model);
  const LearnedModel& model = model_file.model;
  const auto& pattern = model.counts.pattern();
  const auto all = classifiers(model, model_file.kinds);

  CsvReader reader = open_csv(options.file);
  RowReader rows(model, reader, options.unseen == "missing");
  std::vector<std::string> keys = {"line", "truth", "classifier", "decision", "margin"};
  if (!rows.has_truth()) keys.erase(keys.begin() + 1);
  for (std::size_t c = 0; c < pattern.size(); ++c) keys.push_back(pattern.label(c));
  RowFile file(files, "predictions.csv", keys);
  const Classified found = classify_all(options, model, all, reader, rows, file);
  if (found.rows == 0) throw InputError("{}: there is no row below the header", reader.file());

  Result result = result_of_contest("Classes of " + options.file, options.output);
  result.say("{}: {} rows, by {}", reader.file(), found.rows, options.model);
  const bool in_another_unit = rows.say_otherwise(result);
  if (!found.shown.empty()) result.add(shown_table(model.label, rows.has_truth(), all, found.shown), {});
  result.add(totals_table(pattern, rows.has_truth(), found), {});
  for (const Tally& tally : found.tallies)
    if (tally.excluded > 0)
      result.say("{}: {} rows excluded every class and were judged by the prior", tally.name, tally.excluded);
  if (!in_another_unit) say_swapped(model, found, result);  // else that is the cause
  if (options.explain)
    for (const ShownRow& row : found.shown) {
      result.text += fmt::format("\nline {}\n", row.line);
      for (const Contestant& contestant : all)
        if (const auto table = explanation(contestant, row.readings))
          result.add(*table, {});
        else
          result.text += fmt::format("\n{}: the readings exclude every class\n", contestant.name);
    }
  add_facts(options, pattern, found, rows, result);
  if (files.report_wanted()) fill(result.page, options, model, all, found, rows.has_truth());
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
