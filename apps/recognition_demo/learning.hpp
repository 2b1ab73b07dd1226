#pragma once

#include <array>
#include <filesystem>
#include <random>

#include <sigmax/recognition/evaluation.hpp>
#include <sigmax/recognition/reliability.hpp>
#include <sigmax/recognition/table_classifier.hpp>

#include "records/labelled_table.hpp"
#include "report/result.hpp"

namespace sigmax::apps {

/// For every feature the index of what was read, or `missing`.
using Readings = std::vector<std::size_t>;

/// A column of differences between shares of right decisions, in points.
inline ResultColumn of_points(std::string key, std::string header) {
  return {.key = std::move(key),
          .header = std::move(header),
          .unit = "points",
          .scale = 100.0,
          .sign = true,
          .interval = true};
}

/// A result begun: the page has its title, and the contestants are what it switches on and off.
Result comparison_result(std::string title, const OutputOptions& output,
                         const std::vector<std::string>& contestants = {});

template <class Variable>
std::vector<std::string> labels_of(const Variable& variable) {
  return each_below(variable.size(), [&](std::size_t i) { return variable.label(i); });
}

/// What `train` learned, and how `classify` reads rows.
struct SavedModel {
  TableModel model;
  std::vector<std::string> kinds;    ///< of classifiers
  std::vector<std::string> missing;  ///< words that stand for nothing, beside the usual ones
};

/// A model as a JSON file, which appears whole or not at all, and back. `read_model` throws InputError with the file
/// and the place for what is no model, is truncated or of another version, or contradicts itself.
void write_model(const SavedModel& saved, const std::filesystem::path& path);
SavedModel read_model(const std::filesystem::path& path);

/// The kinds of classifiers: "sigma", "max", "sigma-max".
inline const std::vector<std::string> kind_names = {"sigma", "max", "sigma-max"};

/// The classifiers of the named kinds, in the order of `kind_names`; those with possibilities for the ratio scale and
/// for Dubois and Prade's transform. Sigma-max classifiers that are max classifiers are left out beside these: all
/// where nothing is misread, (17), and else that of the ratio scale, since the rows of the sensor have equal maxima.
/// Throws UsageError where a feature would be misread more often than read.
std::vector<TableClassifier> classifiers(TableModel model, std::span<const std::string> kinds = kind_names);

/// Prints what was left out of a table, and what is probably wrong with it, to standard error: a sentence for each
/// cause with a remedy. Each holds by the table alone, so that nothing is trained for it. Docs: recognition_demo.md.
void print_findings(const LabelledTable& table);

/// The options of learning, and those of the data that are learned from.
void add_learning(Subcommand app, std::string& file, TableReading& data, TableOptions& learning);

/// "101 rows, 7 classes, 16 features (15 categorical, 1 numeric)".
std::string described(const LabelledTable& data);

/// "counts smoothed by Laplace's rule; prior by the classes' shares of the rows", and what else was chosen.
std::string described(const TableOptions& options);

/// What was learned of features: p(value|class), and the possibility that it is turned into. Of many values none are
/// shown; the most telling features come first, and no more than six.
std::vector<Panel> relation_maps(const TableModel& model);

struct EvaluateOptions {
  std::string file;
  TableReading data;
  TableOptions learning;
  std::size_t folds = 10;
  std::size_t foldings = 20;  ///< divisions into folds
  std::uint64_t seed = 1;     ///< of the folds
  int threads = 0;            ///< 0: as many as the machine has
  OutputOptions output;
};

/// The fold of each row.
using Folds = std::vector<std::size_t>;

/// Divides the rows into folds of equal shares of every class, or of whole groups. Throws InputError where that cannot
/// be.
Folds divided(const LabelledTable& data, std::size_t folds, std::mt19937_64& generator);

/// The scores of one classifier.
struct Outcome {
  std::string name;
  std::variant<Evaluation<Random>, Evaluation<Fuzzy>> evaluation;
  std::size_t excluded = 0;  ///< rows that excluded every class
  Reliability reliability{};

  const ConfusionMatrix& confusion() const {
    return std::visit([](const auto& e) -> const ConfusionMatrix& { return e.confusion(); }, evaluation);
  }
  double ties() const {
    return std::visit([](const auto& e) { return static_cast<double>(e.ties()) / static_cast<double>(e.size()); },
                      evaluation);
  }
};

/// Adds up folds in their order, and foldings.
struct Results {
  using TimesRight = std::array<std::uint32_t, 5>;  ///< by classifier

  std::vector<Outcome> outcomes;
  std::vector<TimesRight> times_right;  ///< by row
  std::vector<std::size_t> groups;      ///< that rows are of, if any
  std::size_t foldings;

  /// Of a sum over the foldings the mean.
  double of_a_folding(double sum) const { return sum / static_cast<double>(foldings); }
  double of_a_folding(std::size_t sum) const { return of_a_folding(static_cast<double>(sum)); }

  /// Right answers of a classifier less those of the first, paired by row; a row counts by its mean over the foldings.
  /// Of groups, if there are any, the rows do not depend on chance apart: the interval is that of sums over groups.
  Interval minus_first(std::size_t i) const;
};

/// The classifiers that the rows of the other folds teach.
std::vector<TableClassifier> taught(const LabelledTable& data, const Folds& folds, std::size_t fold,
                                    const TableOptions& options);

/// Classifies every row by what the rows of other folds teach, in each folding.
Results cross_validated(const LabelledTable& data, const EvaluateOptions& options);

}  // namespace sigmax::apps
