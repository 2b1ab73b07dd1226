#include <sigmax/hybrid/cross_validation.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace sigmax {

RowFolds folds_of(std::span<const std::size_t> rows, std::size_t folds) {
  const bool whole = rows.size() >= 2 * folds;
  RowFolds result;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    auto& own = result.emplace_back(rows[r]);
    for (std::size_t k = 0; k < rows[r]; ++k) own[k] = whole ? r % folds : k * folds / rows[r];
  }
  return result;
}

RowLosses held_out(const RowFolds& folds, std::span<const RowLosses> without) {
  RowLosses result;
  for (std::size_t r = 0; r < folds.size(); ++r) {
    auto& own = result.emplace_back(folds[r].size());
    for (std::size_t k = 0; k < own.size(); ++k) own[k] = without[folds[r][k]][r][k];
  }
  return result;
}

double mean_loss(const RowLosses& losses, const RowCounts& counts) {
  double sum = 0.0;
  std::size_t rows = 0;
  for (std::size_t r = 0; r < losses.size(); ++r)
    for (std::size_t k = 0; k < losses[r].size(); ++k) {
      if (std::isnan(losses[r][k]) || (counts && !counts(r, k))) continue;
      sum += losses[r][k];
      ++rows;
    }
  return sum / static_cast<double>(rows);
}

MeanDifference mean_difference(const RowLosses& a, const RowLosses& b) {
  constexpr std::size_t most_blocks = 20;
  std::vector<double> differences;
  for (std::size_t r = 0; r < a.size(); ++r)
    for (std::size_t k = 0; k < a[r].size(); ++k)
      if (!std::isnan(a[r][k]) && !std::isnan(b[r][k])) differences.push_back(a[r][k] - b[r][k]);
  const std::size_t rows = differences.size(), blocks = std::min(most_blocks, rows);
  MeanDifference result;
  if (rows == 0) return result;
  result.mean = std::accumulate(differences.begin(), differences.end(), 0.0) / static_cast<double>(rows);
  double squares = 0.0;
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t from = block * rows / blocks, to = (block + 1) * rows / blocks;
    double sum = 0.0;
    for (std::size_t k = from; k < to; ++k) sum += differences[k] - result.mean;
    squares += sum * sum;
  }
  if (blocks > 1)
    result.error =
        std::sqrt(squares * static_cast<double>(blocks) / static_cast<double>(blocks - 1)) / static_cast<double>(rows);
  return result;
}

Selected select_settings(std::span<const RowLosses> held_out, std::span<const std::size_t> numbers) {
  if (held_out.empty() || held_out.size() != numbers.size())
    throw std::invalid_argument(std::to_string(numbers.size()) + " numbers of fitted numbers for " +
                                std::to_string(held_out.size()) + " settings; expected one each, and some");
  std::vector<double> means;
  for (const RowLosses& losses : held_out) means.push_back(mean_loss(losses));
  Selected selected;
  for (std::size_t i = 1; i < means.size(); ++i)
    if (means[i] < means[selected.best]) selected.best = i;
  selected.simple = selected.best;
  for (std::size_t i = 0; i < means.size(); ++i) {
    const MeanDifference worse = mean_difference(held_out[i], held_out[selected.best]);
    if (numbers[i] < numbers[selected.simple] && worse.mean <= worse.error) selected.simple = i;
  }
  return selected;
}

}  // namespace sigmax
