#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace sigmax::detail {

/// Adds up rows of numbers by halves, as a binary counter carries. The rounding errors grow with the logarithm of the
/// number of rows, not with the number. Infinities are kept.
class PairwiseSum {
 public:
  explicit PairwiseSum(std::size_t size) : part_(size, 0.0) {}

  /// Where the caller adds the next row.
  std::span<double> next() {
    if (rows_ == rows_of_a_part) carry();
    ++rows_;
    return part_;
  }

  /// The sum of all rows so far.
  std::vector<double> total() const {
    std::vector<double> sum = part_;
    for (const auto& level : levels_) add(level, sum);
    return sum;
  }

 private:
  static constexpr std::size_t rows_of_a_part = 16;

  static void add(const std::vector<double>& from, std::vector<double>& to) {
    for (std::size_t i = 0; i < from.size(); ++i) to[i] += from[i];
  }

  /// Level k is empty, or the sum of 2ᵏ parts.
  void carry() {
    std::size_t level = 0;
    for (; level < levels_.size() && !levels_[level].empty(); ++level) {
      add(levels_[level], part_);
      levels_[level].clear();
    }
    if (level == levels_.size()) levels_.emplace_back();
    levels_[level] = std::exchange(part_, std::vector<double>(part_.size(), 0.0));
    rows_ = 0;
  }

  std::vector<double> part_;
  std::size_t rows_ = 0;  // of the part
  std::vector<std::vector<double>> levels_;
};

}  // namespace sigmax::detail
