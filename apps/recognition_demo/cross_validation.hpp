#pragma once

#include <array>
#include <random>

#include <sigmax/recognition/evaluation.hpp>
#include <sigmax/recognition/reliability.hpp>
#include <sigmax/recognition/table_classifier.hpp>

#include "records/labelled_table.hpp"
#include "report/result.hpp"

namespace sigmax::apps {

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
