#include <sigmax/recognition/folds.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace sigmax {
namespace {

/// Uniform over 0 … n−1, without bias and the same everywhere.
std::size_t below(std::size_t n, std::mt19937_64& generator) {
  const std::uint64_t count = n;
  const std::uint64_t whole = std::numeric_limits<std::uint64_t>::max() / count * count;
  std::uint64_t draw = generator();
  while (draw >= whole) draw = generator();
  return draw % count;
}

}  // namespace

FoldDealer::FoldDealer(std::span<const std::size_t> rows_of_label, std::size_t folds) : folds_(folds) {
  std::size_t rows = 0;
  for (const std::size_t of_label : rows_of_label) {
    next_.push_back(rows);
    rows += of_label;
    end_.push_back(rows);
  }
  if (folds < 2 || folds > rows)
    throw std::invalid_argument("the number of folds is at least 2 and at most that of the rows, " +
                                std::to_string(rows) + ", not " + std::to_string(folds));
}

std::vector<std::size_t> FoldDealer::deal(std::span<const std::size_t> labels, std::mt19937_64& generator) {
  std::vector<std::vector<std::size_t>> rows_of_label(next_.size());
  for (std::size_t row = 0; row < labels.size(); ++row) {
    if (labels[row] >= next_.size())
      throw std::invalid_argument("there are " + std::to_string(next_.size()) + " labels, no number " +
                                  std::to_string(labels[row]));
    rows_of_label[labels[row]].push_back(row);
  }
  for (std::size_t label = 0; label < next_.size(); ++label)
    if (rows_of_label[label].size() > end_[label] - next_[label])
      throw std::invalid_argument("there are more rows of label " + std::to_string(label) + " than were said");
  std::vector<std::size_t> result(labels.size());
  for (std::size_t label = 0; label < next_.size(); ++label) {
    auto& rows = rows_of_label[label];
    for (std::size_t i = rows.size(); i > 1; --i) std::swap(rows[i - 1], rows[below(i, generator)]);
    // Like cards, on from label to label: so the folds stay level over all.
    for (const std::size_t row : rows) result[row] = next_[label]++ % folds_;
  }
  return result;
}

std::vector<std::size_t> stratified_folds(std::span<const std::size_t> labels, std::size_t folds,
                                          std::mt19937_64& generator) {
  std::map<std::size_t, std::size_t> rows_of_label;
  for (const std::size_t label : labels) ++rows_of_label[label];
  std::vector<std::size_t> counts;
  for (auto& [label, rows] : rows_of_label) {
    counts.push_back(rows);
    rows = counts.size() - 1;  // from here on, the label's place in their order
  }
  std::vector<std::size_t> places;
  for (const std::size_t label : labels) places.push_back(rows_of_label.at(label));
  return FoldDealer(counts, folds).deal(places, generator);
}

}  // namespace sigmax
