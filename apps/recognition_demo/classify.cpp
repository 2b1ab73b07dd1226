#include "recognition_demo/classify.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sigmax/recognition/decision.hpp>
#include <sigmax/recognition/explanation.hpp>

#include "recognition_demo/contest_report.hpp"
#include "recognition_demo/learned_model.hpp"
#include "support/csv.hpp"
#include "support/input.hpp"
#include "support/progress.hpp"
#include "support/table.hpp"

namespace sigmax::apps {
namespace {

/// What a classifier decided over all rows.
struct Tally {
  std::vector<std::size_t> decided;  ///< by class
  std::size_t rejected = 0;
  std::size_t right = 0;     ///< of the decided rows whose class is known
  std::size_t judged = 0;    ///< decided rows whose class is known
  std::size_t excluded = 0;  ///< rows that excluded every class
};

/// One row that is shown.
struct ShownRow {
  std::size_t line;
  std::string truth;  ///< empty if it is not known
  Readings readings;
  std::vector<std::string> decisions;
};

/// Reads the rows of a file in the code of a model.
class RowReader {
 public:
  RowReader(const LearnedModel& model, const CsvReader& reader) : model_(model), label_(reader.find(model.label)) {
    for (const FeatureCode& feature : model.features) columns_.push_back(reader.column(feature.name));
  }

  bool has_truth() const { return label_.has_value(); }

  Readings readings(const CsvRow& row) const {
    Readings result;
    for (std::size_t i = 0; i < columns_.size(); ++i) result.push_back(reading(row, i));
    return result;
  }

  /// The class of a row, if it is given.
  std::optional<std::size_t> truth(const CsvRow& row) const {
    if (!label_ || is_missing(row[*label_])) return std::nullopt;
    const auto& pattern = model_.counts.pattern();
    const std::string_view cell = trimmed(row[*label_]);
    for (std::size_t c = 0; c < pattern.size(); ++c)
      if (pattern.label(c) == cell) return c;
    std::vector<std::string> names;
    for (std::size_t c = 0; c < pattern.size(); ++c) names.push_back(pattern.label(c));
    throw row.error(*label_, "a class of the model: " + shown(names), "leave the cell empty if the class is not known");
  }

 private:
  static std::string shown(const std::vector<std::string>& names) {
    constexpr std::size_t most = 12;
    const auto end = names.begin() + static_cast<std::ptrdiff_t>(std::min(most, names.size()));
    return fmt::format("{}{}", fmt::join(names.begin(), end, ", "), names.size() > most ? ", …" : "");
  }

  std::size_t reading(const CsvRow& row, std::size_t i) const {
    const FeatureCode& feature = model_.features[i];
    const std::string_view cell = trimmed(row[columns_[i]]);
    if (is_missing(cell)) return missing;
    if (feature.bins) return feature.bins->bin(row.number(columns_[i]));
    const auto found = std::find(feature.values.begin(), feature.values.end(), cell);
    if (found == feature.values.end())
      throw row.error(columns_[i], "a value that the model knows: " + shown(feature.values),
                      "leave the cell empty to have it counted as missing");
    return static_cast<std::size_t>(found - feature.values.begin());
  }

  const LearnedModel& model_;
  std::optional<std::size_t> label_;
  std::vector<std::size_t> columns_;
};

template <class Kind>
std::string described(const Belief<Kind>& belief, double least_margin) {
  const Decision decision = decide(belief);
  const std::string measure = SelectiveAlgebra<AlgebraOf<Kind>> ? "N" : "margin";
  if (decision.margin < least_margin) return fmt::format("rejected ({} {:.3f})", measure, decision.margin);
  return fmt::format("{} ({} {:.3f}{})", belief.variable().label(decision.pattern), measure, decision.margin,
                     decision.tied > 1 ? ", a tie" : "");
}

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : value > 0.0 ? "∞" : "-∞";
}

template <class Kind>
void print_explanation(const std::string& name, Classifier<Kind, Kind> classifier, const Readings& readings) {
  classifier.reset();
  try {
    classifier.observe(readings);
  } catch (const std::domain_error&) {
    fmt::print("\n{}: the readings exclude every class\n", name);
    return;
  }
  const auto best = best_patterns(classifier.log_belief(), 2);
  const auto& pattern = classifier.prior().variable();
  auto why = explain(classifier, std::span<const std::size_t>(readings), best[0], best[1]);
  std::stable_sort(why.contributions.begin(), why.contributions.end(),
                   [](const auto& a, const auto& b) { return std::abs(a.log_ratio) > std::abs(b.log_ratio); });
  TextTable table({{fmt::format("{}: {} rather than {}, because", name, pattern.label(best[0]), pattern.label(best[1])),
                    Align::left},
                   {"the same of " + pattern.label(best[1])},
                   {"log of the ratio"}});
  table.row({fmt::format("before any reading: {} = {:.4g}", pattern.label(best[0]), classifier.prior()[best[0]]),
             number(classifier.prior()[best[1]]), number(why.log_prior_ratio)});
  for (const Contribution& each : why.contributions)
    table.row({each.equation, number(std::exp(each.rival_log_likelihood)), number(each.log_ratio)});
  table.rule();
  table.row({fmt::format("{} = {:.4g}", pattern.label(best[0]), classifier.belief()[best[0]]),
             number(classifier.belief()[best[1]]), number(why.log_ratio())});
  fmt::print("\n");
  table.print();
}

}  // namespace

void classify_and_report(const ClassifyOptions& options) {
  std::optional<OutputDirectory> directory;  // made first, so that a bad one is known before the work
  if (!options.out.empty()) directory.emplace(options.out);
  const ModelFile model_file = read_model(options.model);
  const LearnedModel& model = model_file.model;
  const auto& pattern = model.counts.pattern();
  auto all = classifiers(model, model_file.kinds);

  CsvReader reader{options.file};
  const RowReader rows(model, reader);
  std::optional<AtomicFile> file;
  if (directory) {
    file.emplace(directory->file("predictions.csv"));
    file->print("line{},classifier,decision,margin", rows.has_truth() ? ",truth" : "");
    for (std::size_t c = 0; c < pattern.size(); ++c) file->print(",{}", csv_field(pattern.label(c)));
    file->write("\n");
  }

  std::vector<Tally> tallies(all.size(), Tally{std::vector<std::size_t>(pattern.size(), 0)});
  std::vector<ShownRow> shown;
  std::size_t count = 0;
  Progress progress("classifying", reader.bytes_total().value_or(0), options.quiet || !reader.bytes_total());
  for (CsvRow row; reader.next(row); ++count) {
    const Readings report = rows.readings(row);
    const auto truth = rows.truth(row);
    const std::string truth_label = truth ? pattern.label(*truth) : "";
    ShownRow* const show =
        count < options.rows ? &shown.emplace_back(ShownRow{row.line(), truth_label, report, {}}) : nullptr;
    for (std::size_t i = 0; i < all.size(); ++i) {
      Tally& tally = tallies[i];
      std::visit(
          [&](auto& classifier) {
            classifier.reset();
            try {
              classifier.observe(report);
            } catch (const std::domain_error&) {
              ++tally.excluded;  // the prior is what is left to say
            }
            const auto& belief = classifier.log_belief();
            const Decision decision = decide(belief);
            const bool rejected = decision.margin < options.least_margin;
            if (rejected) {
              ++tally.rejected;
            } else {
              ++tally.decided[decision.pattern];
              if (truth) ++tally.judged;
              if (truth == decision.pattern) ++tally.right;
            }
            if (show) show->decisions.push_back(described(belief, options.least_margin));
            if (!file) return;
            file->print("{}", row.line());
            if (rows.has_truth()) file->print(",{}", csv_field(truth_label));
            file->print(",{},{},{}", csv_field(all[i].name), rejected ? "" : csv_field(pattern.label(decision.pattern)),
                        shortest(decision.margin));
            for (std::size_t c = 0; c < belief.size(); ++c) file->print(",{}", shortest(belief[c]));
            file->write("\n");
          },
          all[i].classifier);
    }
    progress.advance(reader.bytes_read() - progress.done());
  }
  progress.finish();
  if (count == 0) throw InputError(message({.where = options.file, .what = "there is no row below the header"}));

  fmt::print("{}: {} rows, by {}\n\n", options.file, count, options.model);
  std::vector<TextTable::Column> columns = {{"line", Align::right}};
  if (rows.has_truth()) columns.push_back({model.label, Align::left});
  for (const Contestant& contestant : all) columns.push_back({contestant.name, Align::left});
  if (!shown.empty()) {
    TextTable table(columns);
    for (const ShownRow& row : shown) {
      std::vector<std::string> cells = {fmt::format("{}", row.line)};
      if (rows.has_truth()) cells.push_back(row.truth);
      cells.insert(cells.end(), row.decisions.begin(), row.decisions.end());
      table.row(cells);
    }
    table.print();
    fmt::print("\n");
  }

  std::vector<TextTable::Column> totals = {{fmt::format("all {} rows", count), Align::left}};
  constexpr std::size_t most_classes = 10;
  const bool by_class = pattern.size() <= most_classes;
  if (by_class)
    for (std::size_t c = 0; c < pattern.size(); ++c) totals.push_back({pattern.label(c)});
  totals.push_back({"rejected"});
  if (rows.has_truth()) totals.push_back({"right, % of the decided"});
  TextTable table(totals);
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<std::string> cells = {all[i].name};
    if (by_class)
      for (const std::size_t decided : tallies[i].decided) cells.push_back(fmt::format("{}", decided));
    cells.push_back(fmt::format("{}", tallies[i].rejected));
    if (rows.has_truth())
      cells.push_back(tallies[i].judged == 0 ? "–"
                                             : fmt::format("{:.2f}", 100.0 * static_cast<double>(tallies[i].right) /
                                                                         static_cast<double>(tallies[i].judged)));
    table.row(cells);
  }
  table.print();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (tallies[i].excluded > 0)
      fmt::print("{}: {} rows excluded every class and were judged by the prior\n", all[i].name, tallies[i].excluded);

  if (options.explain)
    for (const ShownRow& row : shown) {
      fmt::print("\nline {}\n", row.line);
      for (const Contestant& contestant : all)
        std::visit([&](const auto& classifier) { print_explanation(contestant.name, classifier, row.readings); },
                   contestant.classifier);
    }

  if (!directory) return;
  Json summary = summary_of(options.command);
  summary["model"] = options.model;
  summary["file"] = options.file;
  summary["rows"] = count;
  summary["least_margin"] = options.least_margin;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Json one;
    for (std::size_t c = 0; c < pattern.size(); ++c) one["decided"][pattern.label(c)] = tallies[i].decided[c];
    one["rejected"] = tallies[i].rejected;
    if (tallies[i].judged > 0)
      one["accuracy_of_the_decided"] = static_cast<double>(tallies[i].right) / static_cast<double>(tallies[i].judged);
    summary["classifiers"][all[i].name] = one;
  }
  AtomicFile summary_json = summary_file(summary, *directory);
  commit_all(*file, summary_json);
  print_written({"predictions.csv", "summary.json"}, options.out);
}

}  // namespace sigmax::apps
