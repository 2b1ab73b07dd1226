#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <sigmax/core/algebra.hpp>
#include <sigmax/core/kernels/accumulate.hpp>
#include <sigmax/core/rows.hpp>

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

  /// action(number) for each, ascending; then the set is empty.
  template <class Action>
  void drain(const Action& action) {
    for (std::size_t block = 0; block < filled_.size(); ++block)
      for (; filled_[block] != 0; filled_[block] &= filled_[block] - 1) {
        const std::size_t word = 64 * block + static_cast<std::size_t>(std::countr_zero(filled_[block]));
        for (; words_[word] != 0; words_[word] &= words_[word] - 1)
          action(64 * word + static_cast<std::size_t>(std::countr_zero(words_[word])));
      }
  }

 private:
  std::vector<std::uint64_t> words_, filled_;
};

/// One row of a sparse result while it grows, indexed by column. Touching a column adds it to the row with the value
/// zero().
template <Algebra A>
class GrowingRow {
  struct Slot {  // what is read together lies together
    double number;
    Winner winner, row;
  };

 public:
  explicit GrowingRow(std::size_t columns) : slots_(columns, Slot{0.0, 0, none}), touched_(columns) {}

  void begin(Winner row) { row_ = row; }

  double& operator[](std::size_t column) {
    Slot& slot = slots_[column];
    if (slot.row != row_) {
      slot = {A::zero(), 0, row_};
      touched_.insert(column);
    }
    return slot.number;
  }

  /// What takes note of the winners, by column, if `winners` wants them.
  struct Notes {
    static constexpr bool wanted = true;
    Slot* slots;
    void note(std::size_t column, bool better, Winner index, double) const {
      slots[column].winner = better ? index : slots[column].winner;
    }
  };
  template <class Winners>
  auto notes_for(const Winners& winners) {
    if constexpr (Winners::wanted)
      return Notes{slots_.data()};
    else
      return winners;
  }

  /// action(column, number, winner) for every column that was touched, ascending; ends the row.
  template <class Action>
  void drain(const Action& action) {
    touched_.drain([&](std::size_t column) { action(column, slots_[column].number, slots_[column].winner); });
  }

 private:
  static constexpr Winner none = std::numeric_limits<Winner>::max();
  std::vector<Slot> slots_;
  AscendingSet touched_;
  Winner row_ = none;
};

/// result(i, k) = ⊕_j right(i, j) ⊗ left(j, k), storing only what some j leads to: Gustavson's merge of rows, in time
/// proportional to the products. Each number is added up in the order of j, as in a dense result, hence equal to the
/// last bit; where ⊕ adds, that of a dense result from a kernel for large tables is to rounding. `winners` is
/// FirstWinners or NoWinners.
template <Algebra A, class Left, class Right, class Winners>
SparseRows sparse_composition(const Left& left, const Right& right, Winners& winners) {
  SparseRows result(left.columns());
  GrowingRow<A> row(left.columns());
  const auto notes = row.notes_for(winners);
  winners.assign(0);
  for (std::size_t i = 0; i < right.rows(); ++i) {
    row.begin(static_cast<Winner>(i));
    const auto weights = right.entries(i);
    for (std::size_t j = 0; j < weights.size(); ++j) {
      if (weights.value(j) == A::zero()) continue;
      accumulate<A>(weights.value(j), left.entries(weights.index(j)), row, weights.index(j), notes);
    }
    row.drain([&](std::size_t column, double number, Winner winner) {
      result.append_entry(column, number);
      winners.append(winner);
    });
    result.end_row();
  }
  return result;
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
template <Algebra A, class Winners>
BandedRows banded_composition(const BandedRows& left, const BandedRows& right, Winners& winners) {
  BandedRows result(left.columns());
  winners.assign(0);
  for (std::size_t i = 0; i < right.rows(); ++i) {
    const RunOfEntries weights = right.entries(i);
    const Reach all = reach(left, weights);
    const std::size_t first = all.size() > 0 ? all.first : 0;
    result.append(first, all.size(), A::zero());
    winners.resize(result.stored());
    double* const out = result.values(i).data();
    for (std::size_t j = 0; j < weights.size(); ++j) {
      RunOfEntries terms = left.entries(weights.index(j));
      if (terms.size() == 0) continue;
      terms.first -= first;
      accumulate<A>(weights.value(j), terms, out, weights.index(j), winners.from(result.offset(i)));
    }
  }
  return result;
}

}  // namespace sigmax::kernels
