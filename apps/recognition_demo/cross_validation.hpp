#pragma once

#include <array>

#include <sigmax/recognition/evaluation.hpp>
#include <sigmax/recognition/reliability.hpp>

#include "recognition_demo/folding.hpp"

namespace sigmax::apps {

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

  const ConfusionMatrix& confusion() const {
    return of_kind(evaluation, [](const auto& e) -> const ConfusionMatrix& { return e.confusion(); });
  }
  double ties() const {
    return of_kind(evaluation,
                   [](const auto& e) { return static_cast<double>(e.ties()) / static_cast<double>(e.size()); });
  }
};

/// Divides the rows into folds.
using Deal = std::function<Folds(std::mt19937_64& generator)>;

/// Of every row the classifiers that were right, a bit for each.
using Right = std::vector<std::uint8_t>;

/// Adds up folds in their order, and foldings.
struct Results {
  using TimesRight = std::array<std::uint32_t, 5>;  ///< by classifier

  std::vector<Outcome> outcomes;
  std::vector<TimesRight> times_right;  ///< by row
  std::optional<Groups> groups;         ///< that rows are of, if --groups tells

  void add(std::vector<Outcome> fold);

  /// Who was right in a whole folding.
  void add(const Right& right);

  /// Right answers of a classifier less those of the first, paired by row; a row counts by its mean over the foldings.
  /// Of groups, if there are any, the rows do not depend on chance apart: the interval is that of sums over groups.
  Interval minus_first(std::size_t i, std::size_t foldings) const;
};

/// Classifies every row by what the rows of other folds teach, in each folding.
Results cross_validated(const DataTable& data, const Deal& deal, const EvaluateOptions& options);

}  // namespace sigmax::apps
