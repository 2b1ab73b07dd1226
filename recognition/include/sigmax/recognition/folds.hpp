#pragma once

#include <cstddef>
#include <random>
#include <span>
#include <vector>

namespace sigmax {

/// The fold, from 0, to which each row belongs: within every label the folds' sizes differ by at most one, and so do
/// the folds' sizes over all. Train on the rows of the other folds, test on those of one.
///
/// Rows are shuffled within their label by the generator alone (Fisher–Yates by its raw draws), so a seed gives the
/// same folds everywhere. Throws std::invalid_argument unless 2 ≤ folds ≤ number of rows.
std::vector<std::size_t> stratified_folds(std::span<const std::size_t> labels, std::size_t folds,
                                          std::mt19937_64& generator);

/// The same for tables that come in parts: rows are shuffled within their label and their part, and dealt on from part
/// to part, so that the folds are as level. One part alone gives `stratified_folds`.
///
///     FoldDealer dealer(rows_of_label, 10);
///     for (const auto& labels : parts) folds = dealer.deal(labels, generator);
class FoldDealer {
 public:
  /// The labels are 0, 1, …; `rows_of_label` says how many rows of each there will be in all. Throws
  /// std::invalid_argument unless 2 ≤ folds ≤ number of rows.
  FoldDealer(std::span<const std::size_t> rows_of_label, std::size_t folds);

  /// The folds of the next rows. Throws std::invalid_argument, before anything is dealt, for a label that does not
  /// exist, or more rows of one than were said.
  std::vector<std::size_t> deal(std::span<const std::size_t> labels, std::mt19937_64& generator);

 private:
  std::size_t folds_;
  std::vector<std::size_t> next_;  // of each label, the number of its next row among all rows, label after label
  std::vector<std::size_t> end_;   // and of the first row that is not of the label
};

}  // namespace sigmax
