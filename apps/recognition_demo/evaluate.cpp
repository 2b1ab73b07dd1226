#include "recognition_demo/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <variant>

#include <fmt/format.h>

#include <sigmax/core/transform.hpp>
#include <sigmax/recognition/decision.hpp>
#include <sigmax/recognition/evaluation.hpp>
#include <sigmax/recognition/folds.hpp>

#include "recognition_demo/contest_report.hpp"
#include "support/parallel.hpp"
#include "recognition_demo/train.hpp"
#include "support/csv.hpp"
#include "support/progress.hpp"
#include "support/table.hpp"

namespace sigmax::apps {
namespace {

/// What one classifier believes of one row.
using AnyBelief = std::variant<Belief<Random>, Belief<Fuzzy>>;

/// The rows of one fold, classified by what was learned from the others.
struct FoldResult {
  std::vector<std::size_t> rows;
  std::vector<std::vector<AnyBelief>> beliefs;  ///< by classifier, then by row
  std::vector<std::size_t> excluded;            ///< by classifier: rows that excluded every class
};

/// One classifier over all rows.
struct Outcome {
  std::string name;
  std::vector<std::optional<AnyBelief>> beliefs;  ///< by row
  std::variant<Evaluation<Random>, Evaluation<Fuzzy>> evaluation;
  std::size_t ties = 0;
  std::size_t excluded = 0;
};

FoldResult classify_fold(const DataTable& data, std::span<const std::size_t> fold_of_row, std::size_t fold,
                         const EvaluateOptions& options) {
  std::vector<std::size_t> training;
  FoldResult result;
  for (std::size_t row = 0; row < fold_of_row.size(); ++row)
    (fold_of_row[row] == fold ? result.rows : training).push_back(row);
  const LearnedModel model = learn(data, training, options.learning);
  const std::vector<std::string> kinds(std::begin(kind_names), std::end(kind_names));
  for (Contestant& contestant : classifiers(model, kinds)) {
    auto& beliefs = result.beliefs.emplace_back();
    auto& excluded = result.excluded.emplace_back(0);
    std::visit(
        [&](auto& classifier) {
          for (const std::size_t row : result.rows) {
            classifier.reset();
            try {
              classifier.observe(readings(model, data, row));
            } catch (const std::domain_error&) {
              ++excluded;  // the prior is what is left to say
            }
            beliefs.emplace_back(classifier.log_belief());
          }
        },
        contestant.classifier);
  }
  return result;
}

std::vector<Outcome> outcomes(const DataTable& data) {
  std::vector<Outcome> result;
  std::vector<std::size_t> all_rows(data.labels.size());
  const RandomVariable pattern{data.label, data.classes};
  for (const char* name :
       {"sigma", "max, ratio scale", "max, Dubois-Prade", "sigma-max, ratio scale", "sigma-max, Dubois-Prade"}) {
    const bool fuzzy = result.size() > 0;
    Outcome outcome{name, std::vector<std::optional<AnyBelief>>(data.labels.size()), Evaluation<Random>{pattern}};
    if (fuzzy) outcome.evaluation = Evaluation<Fuzzy>{as_fuzzy(pattern)};
    result.push_back(std::move(outcome));
  }
  return result;
}

std::span<const double> correct(const Outcome& outcome) {
  return std::visit([](const auto& e) { return e.correct(); }, outcome.evaluation);
}

const ConfusionMatrix& confusion(const Outcome& outcome) {
  return std::visit([](const auto& e) -> const ConfusionMatrix& { return e.confusion(); }, outcome.evaluation);
}

std::string fixed(double value) { return fmt::format("{:.3f}", value); }

void print_outcomes(const std::vector<Outcome>& all) {
  TextTable table({{"classifier", Align::left},
                   {"right, %"},
                   {"− sigma's, points"},
                   {"macro F1"},
                   {"ties, %"},
                   {"log-loss"},
                   {"Brier"},
                   {"N of truth"},
                   {"covered, %"},
                   {"classes in the cut"}});
  for (const Outcome& outcome : all) {
    const auto n = static_cast<double>(correct(outcome).size());
    std::vector<std::string> cells = {
        outcome.name, fmt::format("{:.2f}", 100.0 * confusion(outcome).accuracy()),
        &outcome == &all.front() ? "" : points(paired_interval(correct(outcome), correct(all.front()))),
        fixed(confusion(outcome).macro_f1()), percent(static_cast<double>(outcome.ties) / n)};
    if (const auto* random = std::get_if<Evaluation<Random>>(&outcome.evaluation)) {
      for (const double value : {mean(random->log_losses()), mean(random->briers())}) cells.push_back(fixed(value));
      cells.insert(cells.end(), 3, "");
    } else {
      const auto& fuzzy = std::get<Evaluation<Fuzzy>>(outcome.evaluation);
      cells.insert(cells.end(), 2, "");
      cells.push_back(fixed(mean(fuzzy.necessities())));
      cells.push_back(percent(mean(fuzzy.covered())));
      cells.push_back(fmt::format("{:.2f}", mean(fuzzy.cut_sizes())));
    }
    table.row(cells);
  }
  table.print();
  fmt::print(
      "(The class is the most likely one, the first of those that tie. Differences ± 95 % by paired rows. A truth is\n"
      "covered if its possibility is at least ½: the cut holds as many classes on average.)\n");
}

void print_confusion(const DataTable& data, const Outcome& outcome) {
  constexpr std::size_t most_classes = 10;
  if (data.classes.size() > most_classes) return;
  std::vector<TextTable::Column> columns = {{fmt::format("{}: true class", outcome.name), Align::left}};
  for (const auto& name : data.classes) columns.push_back({name});
  TextTable table(columns);
  const auto& matrix = confusion(outcome);
  for (std::size_t truth = 0; truth < data.classes.size(); ++truth) {
    std::vector<std::string> cells = {data.classes[truth]};
    for (std::size_t c = 0; c < data.classes.size(); ++c) cells.push_back(fmt::format("{}", matrix(truth, c)));
    table.row(cells);
  }
  fmt::print("\n");
  table.print();
}

AtomicFile predictions_file(const DataTable& data, std::span<const std::size_t> fold_of_row,
                            const std::vector<Outcome>& all, const OutputDirectory& directory) {
  AtomicFile file = directory.file("predictions.csv");
  file.write("line,fold,truth,classifier,decision");
  for (const auto& name : data.classes) file.print(",{}", csv_field(name));
  file.write("\n");
  for (std::size_t row = 0; row < data.labels.size(); ++row)
    for (const Outcome& outcome : all)
      std::visit(
          [&](const auto& belief) {
            file.print("{},{},{},{},{}", data.lines[row], fold_of_row[row] + 1,
                       csv_field(data.classes[data.labels[row]]), csv_field(outcome.name),
                       csv_field(data.classes[decide(belief).pattern]));
            for (std::size_t c = 0; c < belief.size(); ++c) file.print(",{}", shortest(belief[c]));
            file.write("\n");
          },
          *outcome.beliefs[row]);
  return file;
}

AtomicFile confusion_file(const DataTable& data, const std::vector<Outcome>& all, const OutputDirectory& directory) {
  AtomicFile file = directory.file("confusion.csv");
  file.write("classifier,truth,decision,rows\n");
  for (const Outcome& outcome : all)
    for (std::size_t truth = 0; truth < data.classes.size(); ++truth)
      for (std::size_t c = 0; c < data.classes.size(); ++c)
        file.print("{},{},{},{}\n", csv_field(outcome.name), csv_field(data.classes[truth]), csv_field(data.classes[c]),
                   confusion(outcome)(truth, c));
  return file;
}

Json as_json(const Outcome& outcome, const Outcome& first) {
  Json json = {
      {"accuracy", confusion(outcome).accuracy()}, {"macro_f1", confusion(outcome).macro_f1()}, {"ties", outcome.ties}};
  if (&outcome != &first)
    json["accuracy_minus_that_of_sigma"] = apps::as_json(paired_interval(correct(outcome), correct(first)));
  if (const auto* random = std::get_if<Evaluation<Random>>(&outcome.evaluation)) {
    json["log_loss"] = mean(random->log_losses());
    json["brier"] = mean(random->briers());
  } else {
    const auto& fuzzy = std::get<Evaluation<Fuzzy>>(outcome.evaluation);
    json["mean_necessity_of_truth"] = mean(fuzzy.necessities());
    json["coverage"] = mean(fuzzy.covered());
    json["mean_classes_in_the_cut"] = mean(fuzzy.cut_sizes());
  }
  if (outcome.excluded > 0) json["rows_that_excluded_every_class"] = outcome.excluded;
  return json;
}

}  // namespace

void evaluate_and_report(const EvaluateOptions& options) {
  std::optional<OutputDirectory> directory;  // made first, so that a bad one is known before the work
  if (!options.out.empty()) directory.emplace(options.out);
  const DataTable data = read_data(options.file, options.data);
  if (options.folds > data.labels.size())
    throw InputError(message({.where = data.file,
                              .found = fmt::format("{} rows", data.labels.size()),
                              .expected = fmt::format("at least as many as the {} folds", options.folds)}));
  std::mt19937_64 generator(options.seed);
  const auto fold_of_row = stratified_folds(data.labels, options.folds, generator);

  auto all = outcomes(data);
  Progress progress("folds", options.folds, options.quiet);
  for_each_run(
      options.folds, threads_or_all(options.threads),
      [&](std::size_t fold) { return classify_fold(data, fold_of_row, fold, options); },
      [&](std::size_t, FoldResult result) {
        progress.advance();
        for (std::size_t i = 0; i < all.size(); ++i) {
          all[i].excluded += result.excluded[i];
          for (std::size_t k = 0; k < result.rows.size(); ++k)
            all[i].beliefs[result.rows[k]] = std::move(result.beliefs[i][k]);
        }
      });
  progress.finish();
  for (Outcome& outcome : all)
    for (std::size_t row = 0; row < data.labels.size(); ++row)
      std::visit(
          [&](const auto& belief) {
            using Kind = typename std::decay_t<decltype(belief)>::kind;
            std::get<Evaluation<Kind>>(outcome.evaluation).add(data.labels[row], belief);
            if (decide(belief).tied > 1) ++outcome.ties;
          },
          *outcome.beliefs[row]);

  fmt::print("{}: {}\n{} folds of equal shares of every class, seed {}; {}\n\n", data.file, described(data),
             options.folds, options.seed, described(options.learning));
  print_outcomes(all);
  for (const Outcome& outcome : all)
    if (outcome.excluded > 0)
      fmt::print("{}: {} rows excluded every class and were judged by the prior\n", outcome.name, outcome.excluded);
  if (options.learning.misread == 0.0)
    fmt::print(
        "(Without --misread a reading is the feature itself, so that sigma-max inference, (17), is max inference.)\n");
  print_confusion(data, all[0]);
  print_confusion(data, all[1]);

  if (!directory) return;
  Json summary = summary_of(options.command);
  summary["file"] = data.file;
  summary["rows"] = data.labels.size();
  summary["classes"] = data.classes;
  summary["folds"] = options.folds;
  summary["seed"] = options.seed;
  summary["smoothing"] = options.learning.smoothing;
  summary["misread"] = options.learning.misread;
  summary["bins"] = options.learning.bins;
  for (const Outcome& outcome : all) summary["classifiers"][outcome.name] = as_json(outcome, all.front());
  AtomicFile predictions = predictions_file(data, fold_of_row, all, *directory);
  AtomicFile confusion_csv = confusion_file(data, all, *directory), summary_json = summary_file(summary, *directory);
  commit_all(predictions, confusion_csv, summary_json);
  print_written({"predictions.csv", "confusion.csv", "summary.json"}, options.out);
}

}  // namespace sigmax::apps
