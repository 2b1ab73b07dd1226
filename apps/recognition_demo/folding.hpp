#pragma once

#include <random>

#include "recognition_demo/learned_model.hpp"

namespace sigmax::apps {

/// The fold of each row.
using Folds = ScratchArray<std::uint32_t>;
inline constexpr std::uint32_t no_fold = 0xFFFFFFFF;

/// The fold of every row, by `stratified_folds`; of longer tables part by part.
Folds folds_of(const DataTable& data, std::size_t folds, std::mt19937_64& generator);

/// A number of each row, the same where a column of the file that the data is of holds the same word. Throws InputError
/// for an empty cell, or a column that there is not.
using Groups = ScratchArray<std::uint32_t>;
Groups groups_of(const DataTable& data, const std::string& column);

/// The fold of every row, that of its group: groups go by chance, each into one of the folds with the fewest rows.
/// Throws InputError if there are fewer groups than folds, or if the rows of a class cannot be parted so.
Folds folds_of(const DataTable& data, const Groups& groups, std::size_t folds, std::mt19937_64& generator);

/// One fold, and the classifiers that the rows of the others teach.
struct TaughtFold {
  std::size_t fold;
  LearnedModel model;
  std::vector<Contestant> contestants;
  std::vector<std::vector<bool>> known;  ///< of each column of words those that the rows have
};
TaughtFold taught(const DataTable& data, const Folds& folds, std::size_t fold, const LearningOptions& options,
                  std::span<const std::string> kinds = kind_names);

/// Calls see(row, contestant's index, what it judges) for the rows of a fold, and for each of them for the contestants
/// from `first` on up to `end`. They are not told words that none of the rows had that taught them, which they would
/// take for those of the class with the fewest rows; and not the columns that are hidden.
template <class See>
void classify_rows(const DataTable& data, const Folds& folds, const TaughtFold& taught, std::size_t first,
                   std::size_t end, const See& see, const std::vector<std::size_t>& hidden = {}) {
  ScratchCursor<std::uint32_t> fold_of(folds);
  Readings readings;
  data.for_each([&](const DataRow& row) {
    if (fold_of[row.index] != taught.fold) return;
    read(taught.model, row, readings);
    for (std::size_t i = 0; i < readings.size(); ++i)
      if (!taught.known[i].empty() && readings[i] != missing && !taught.known[i][readings[i]]) readings[i] = missing;
    for (const std::size_t column : hidden) readings[column] = missing;
    for (std::size_t i = first; i < end; ++i) see(row, i, judged(taught.contestants[i], readings));
  });
}

/// Of every row the classifiers that were right, a bit for each.
using Right = ScratchArray<std::uint8_t>;

/// Of each class the share of its rows that sigma is right about, each by what the rows of other folds teach, of ten
/// (of long tables three), and without the hidden columns; nothing if there is a single row of a class, or
/// where part of the rows might teach nothing, without smoothing or with readings that are mostly wrong.
std::vector<double> right_when_left_out(const DataTable& data, const LearningOptions& options, std::uint64_t seed,
                                        int threads, const std::vector<std::size_t>& hidden = {});

/// Prints the warnings of a table to standard error, and where rows that are left out are right more often by more
/// bins, unless these are grouped.
void print_warnings(const DataTable& data, const LearningOptions& options, bool grouped = false);

/// Columns whose values may be what rows are of, as a patient or a session: words, or whole numbers one after the
/// other, that tell hardly anything of the class.
std::vector<std::size_t> columns_of_groups(const DataTable& data, const LearningOptions& options);

/// How many of the rows sigma is right about without a column, and how many more that is; and without those that are
/// nested in it, too, and how many less that is where the rows of each of its values stay in one fold. By pairs of
/// rows; nothing where a class cannot be parted so.
struct ByColumn {
  std::vector<std::size_t> hidden{};  ///< the column, and those in it
  std::size_t values = 0;             ///< of the column
  double without = 0.0, without_all = 0.0;
  Interval more{}, less{};
};
std::optional<ByColumn> by_column(const DataTable& data, const LearningOptions& options, std::size_t column,
                                  std::uint64_t seed, int threads);

/// How many less of the rows sigma is right about where folds are drawn without regard to the class, by pairs of rows:
/// where classes have few rows, those that by chance have more have more in each of the folds, too. Nothing where
/// a class cannot be parted so.
std::optional<Interval> less_in_any_folds(const DataTable& data, const LearningOptions& options, std::uint64_t seed,
                                          int threads);

/// How many of some rows sigma is right about, and how many less where rows that are much alike stay in one fold, by
/// pairs of rows; none where a class has too few rows for it, or none are much nearer to each other than to the next.
/// Of long tables some rows are asked, chosen by chance.
struct ByClumps {
  std::size_t rows;
  double accuracy;
  Interval less;
};
std::optional<ByClumps> by_clumps(const DataTable& data, const LearningOptions& options, std::uint64_t seed,
                                  int threads);

/// Whether a share is greater than this by no chance, but three standard errors.
inline bool by_no_chance(const Interval& share, double least) {
  return share.mean > least && share.mean > 1.5 * share.half_width;
}
inline bool are_in_clumps(const std::optional<ByClumps>& clumps) {
  constexpr double much = 0.03;
  return clumps && by_no_chance(clumps->less, much);
}

}  // namespace sigmax::apps
