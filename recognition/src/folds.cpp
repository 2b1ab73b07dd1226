#include <sigmax/recognition/folds.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>
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
    throw std::invalid_argument("found " + std::to_string(labels.size()) + " rows, expected at least as many as the " +
                                std::to_string(folds) + " folds, and two folds at least");
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

std::vector<std::size_t> grouped_folds(std::span<const std::size_t> labels, std::span<const std::size_t> groups,
                                       std::size_t folds, std::mt19937_64& generator) {
  std::vector<std::size_t> rows;                           // of each group
  std::map<std::size_t, std::set<std::size_t>> of_labels;  // the groups of each label
  for (std::size_t row = 0; row < groups.size(); ++row) {
    rows.resize(std::max(rows.size(), groups[row] + 1));
    ++rows[groups[row]];
    of_labels[labels[row]].insert(groups[row]);
  }
  if (rows.size() < folds)
    throw std::invalid_argument("found " + std::to_string(rows.size()) + " groups, expected at least as many as the " +
                                std::to_string(folds) + " folds");
  std::vector<std::size_t> order(rows.size()), fold(rows.size()), result;
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto is_parted = [&](const auto& of_label) {
    const auto& its = of_label.second;
    return std::any_of(its.begin(), its.end(), [&](std::size_t one) { return fold[one] != fold[*its.begin()]; });
  };
  for (int tries = 100; tries > 0; --tries) {
    for (std::size_t left = order.size(); left > 1; --left) std::swap(order[left - 1], order[below(left, generator)]);
    std::vector<std::size_t> sizes(folds);
    for (const std::size_t one : order) {
      fold[one] = static_cast<std::size_t>(std::min_element(sizes.begin(), sizes.end()) - sizes.begin());
      sizes[fold[one]] += rows[one];
    }
    if (!std::all_of(of_labels.begin(), of_labels.end(), is_parted)) continue;
    for (const std::size_t group : groups) result.push_back(fold[group]);
    return result;
  }
  throw std::invalid_argument("the rows of a label are of so few groups that these came into one fold");
}

}  // namespace sigmax
