#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <sigmax/core/rows.hpp>

#include "kernels/plain.hpp"

namespace sigmax::kernels {

/// A set of numbers below a bound that gives them back in ascending order, without sorting: a bit for each, and a bit
/// for every word of those that is not zero.
class AscendingSet {
 public:
  explicit AscendingSet(std::size_t bound) : words_(bound / 64 + 1, 0), filled_(words_.size() / 64 + 1, 0) {}

  void insert(std::size_t number) {
    words_[number / 64] |= std::uint64_t{1} << number % 64;
    filled_[number / 4096] |= std::uint64_t{1} << number / 64 % 64;
  }

  /// Writes the numbers, ascending, and returns how many they are; then the set is empty. There is room for one more.
  std::size_t drain(std::uint32_t* out) {
    std::uint32_t* const begin = out;
    for (std::size_t block = 0; block < filled_.size(); ++block) {
      for (std::uint64_t filled = std::exchange(filled_[block], 0); filled != 0; filled &= filled - 1) {
        const std::size_t word = 64 * block + static_cast<std::size_t>(std::countr_zero(filled));
        const auto first = static_cast<std::uint32_t>(64 * word);
        std::uint64_t bits = std::exchange(words_[word], 0);
        *out++ = first + lowest(bits);
        bits &= bits - 1;
        *out = first + lowest(bits);  // most words hold one or two, which of them no processor foresees
        out += bits != 0 ? 1 : 0;
        for (bits &= bits - 1; bits != 0; bits &= bits - 1) *out++ = first + lowest(bits);
      }
    }
    return static_cast<std::size_t>(out - begin);
  }

 private:
  /// The place of the lowest set bit; unspecified if none is set, so that the compiler need not branch.
  static std::uint32_t lowest(std::uint64_t bits) {
    return static_cast<std::uint32_t>(std::countr_zero(bits | std::uint64_t{1} << 63));
  }

  std::vector<std::uint64_t> words_, filled_;
};

/// One row of a sparse result while it grows, indexed by column. Touching a column adds it to the row with the value
/// zero.
class GrowingRow {
 public:
  GrowingRow(std::size_t columns, double zero) : zero_(zero), numbers_(columns, zero), touched_(columns) {}

  double& operator[](std::size_t column) {
    touched_.insert(column);
    return numbers_[column];
  }

  /// Writes the columns that were touched, ascending, and their numbers; returns how many they are, and ends the row.
  /// There is room for one more column.
  std::size_t drain(std::uint32_t* columns, double* numbers) {
    const std::size_t size = touched_.drain(columns);
    for (std::size_t k = 0; k < size; ++k) numbers[k] = std::exchange(numbers_[columns[k]], zero_);
    return size;
  }

 private:
  double zero_;
  std::vector<double> numbers_;
  AscendingSet touched_;
};

/// Asks for the beginning of rows that are read next, wherever memory has them.
inline void prefetch([[maybe_unused]] const ListOfEntries& row) {
#if defined(__GNUC__)
  constexpr std::size_t line = 64, ahead = 32;  // entries; what follows them processors foresee
  const std::size_t size = std::min(row.size(), ahead);
  for (std::size_t k = 0; k < size; k += line / sizeof(std::uint32_t)) __builtin_prefetch(row.columns.data() + k);
  for (std::size_t k = 0; k < size; k += line / sizeof(double)) __builtin_prefetch(row.values.data() + k);
#endif
}
inline void prefetch(const RunOfEntries&) {}

/// How many terms the row with these weights of a composition has; what they are made of is asked for.
template <class Left, class Weights>
std::size_t announce(const Left& left, const Weights& weights) {
  std::size_t terms = 0;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    const auto row = left.entries(weights.index(j));
    prefetch(row);
    terms += row.size();
  }
  return terms;
}

/// How many terms a composition has, if all rows of `left` are of one size: room for its result. But no more than a
/// multiple of what the parts take, for many terms may share a column.
template <class Left, class Right>
std::size_t expected_terms(const Left& left, const Right& right) {
  constexpr std::size_t multiple = 16;
  if (left.rows() == 0) return 0;
  const std::size_t of_a_row = left.stored() / left.rows() + 1;
  return std::min(of_a_row * right.stored(), multiple * (left.stored() + right.stored()));
}

/// result(i, k) = ⊕_j right(i, j) ⊗ left(j, k), storing only what some j leads to: Gustavson's merge of rows, in time
/// proportional to the products. Each number is added up in the order of j, as in a dense result, hence equal to the
/// last bit. Sums may differ by rounding from those of the tiled kernel for large tables. `result` is neither of the
/// parts, and its memory is used again.
template <class A, class Left, class Right>
void sparse_composition(A algebra, const Left& left, const Right& right, SparseRows& result) {
  result.clear(left.columns());
  result.reserve(right.rows(), expected_terms(left, right));
  GrowingRow row(left.columns(), algebra.zero());
  std::size_t terms = right.rows() > 0 ? announce(left, right.entries(0)) : 0;
  for (std::size_t i = 0; i < right.rows(); ++i) {
    const std::size_t room = std::min(terms, left.columns()) + 1;
    if (i + 1 < right.rows()) terms = announce(left, right.entries(i + 1));
    const auto weights = right.entries(i);
    for (std::size_t j = 0; j < weights.size(); ++j) {
      if (weights.value(j) == algebra.zero()) continue;
      accumulate(algebra, weights.value(j), left.entries(weights.index(j)), row);
    }
    const auto [columns, numbers] = result.room(room);
    result.end_row(row.drain(columns, numbers));
  }
}

/// The columns from the first to the last that row i of a banded composition reaches.
struct Reach {
  std::size_t first = std::numeric_limits<std::size_t>::max(), last = 0;  // one past it
  std::size_t size() const { return last > first ? last - first : 0; }
};
inline Reach reach(const BandedRows& left, const RunOfEntries& weights) {
  Reach reach;
  for (std::size_t j = 0; j < weights.size(); ++j)
    if (const RunOfEntries terms = left.entries(weights.index(j)); terms.size() > 0) {
      reach.first = std::min(reach.first, terms.first);
      reach.last = std::max(reach.last, terms.first + terms.size());
    }
  return reach;
}

/// The same of banded parts: again banded.
template <class A>
BandedRows banded_composition(A algebra, const BandedRows& left, const BandedRows& right) {
  BandedRows result(left.columns());
  for (std::size_t i = 0; i < right.rows(); ++i) {
    const RunOfEntries weights = right.entries(i);
    const Reach all = reach(left, weights);
    const std::size_t first = all.size() > 0 ? all.first : 0;
    result.append(first, all.size(), algebra.zero());
    double* const out = result.values(i).data();
    for (std::size_t j = 0; j < weights.size(); ++j) {
      RunOfEntries terms = left.entries(weights.index(j));
      if (terms.size() == 0) continue;
      terms.first -= first;
      accumulate(algebra, weights.value(j), terms, out);
    }
  }
  return result;
}

}  // namespace sigmax::kernels
