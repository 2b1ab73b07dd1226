#pragma once

#include <random>

#include "recognition_demo/learned_model.hpp"

namespace sigmax::apps {

/// The fold of each row, and the group.
using Folds = std::vector<std::size_t>;
using Groups = std::vector<std::uint32_t>;

/// A number of each row, the same where a column of the file that the data is of holds the same word. Throws InputError
/// for an empty cell, or a column that there is not.
Groups groups_of(const DataTable& data, const std::string& column);

/// The fold of every row, that of its group: groups go by chance, each into one of the folds with the fewest rows.
/// Throws InputError if there are fewer groups than folds, or if the rows of a class cannot be parted so.
Folds grouped_folds(const DataTable& data, const Groups& groups, std::size_t folds, std::mt19937_64& generator);

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
/// take for those of the class with the fewest rows.
template <class See>
void classify_rows(const DataTable& data, const Folds& folds, const TaughtFold& taught, std::size_t first,
                   std::size_t end, const See& see) {
  Readings readings;
  for (std::size_t row = 0; row < data.size(); ++row) {
    if (folds[row] != taught.fold) continue;
    read(taught.model, data, row, readings);
    for (std::size_t i = 0; i < readings.size(); ++i)
      if (!taught.known[i].empty() && readings[i] != missing && !taught.known[i][readings[i]]) readings[i] = missing;
    for (std::size_t i = first; i < end; ++i) see(row, i, judged(taught.contestants[i], readings));
  }
}

/// Of each class the share of its rows that sigma is right about, each by what the rows of other folds teach, of ten
/// (of long tables three); nothing if there is a single row of a class, or where part of the rows might teach nothing,
/// without smoothing or with readings that are mostly wrong.
std::vector<double> right_when_left_out(const DataTable& data, const LearningOptions& options);

}  // namespace sigmax::apps
