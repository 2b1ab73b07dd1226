#include <sigmax/recognition/folds.hpp>

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

std::vector<std::size_t> stratified_folds(std::span<const std::size_t> labels, std::size_t folds,
                                          std::mt19937_64& generator) {
  if (folds < 2 || folds > labels.size())
    throw std::invalid_argument("the number of folds is at least 2 and at most that of the rows, " +
                                std::to_string(labels.size()) + ", not " + std::to_string(folds));
  std::map<std::size_t, std::vector<std::size_t>> rows_of_label;
  for (std::size_t row = 0; row < labels.size(); ++row) rows_of_label[labels[row]].push_back(row);
  std::vector<std::size_t> result(labels.size());
  std::size_t dealt = 0;
  for (auto& [label, rows] : rows_of_label) {
    for (std::size_t i = rows.size(); i > 1; --i) std::swap(rows[i - 1], rows[below(i, generator)]);
    // Like cards, on from label to label: so the folds stay level over all.
    for (const std::size_t row : rows) result[row] = dealt++ % folds;
  }
  return result;
}

}  // namespace sigmax
