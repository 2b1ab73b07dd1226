#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <sigmax/core/algebra.hpp>
#include <sigmax/core/kernels/accumulate.hpp>
#include <sigmax/core/rows.hpp>

namespace sigmax::kernels {

/// One row of a sparse result while it grows, indexed by column. Touching a column adds it to the row with the value
/// zero().
template <Algebra A>
class GrowingRow {
  struct Slot {  // what is read together lies together
    double number;
    Winner winner, row;
  };

 public:
  explicit GrowingRow(std::size_t columns) : slots_(columns, Slot{0.0, 0, none}) {}

  void begin(Winner row) {
    row_ = row;
    touched_.clear();
  }

  double& operator[](std::size_t column) {
    Slot& slot = slots_[column];
    if (slot.row != row_) {
      slot = {A::zero(), 0, row_};
      touched_.push_back(column);
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
  Winner winner(std::size_t column) const { return slots_[column].winner; }

  /// The columns in ascending order.
  const std::vector<std::size_t>& columns() {
    if (touched_.size() < slots_.size() / 16) {
      std::sort(touched_.begin(), touched_.end());
    } else {
      touched_.clear();
      for (std::size_t column = 0; column < slots_.size(); ++column)
        if (slots_[column].row == row_) touched_.push_back(column);
    }
    return touched_;
  }

 private:
  static constexpr Winner none = std::numeric_limits<Winner>::max();
  std::vector<Slot> slots_;
  std::vector<std::size_t> touched_;
  Winner row_ = none;
};

/// result(i, k) = ⊕_j right(i, j) ⊗ left(j, k), storing only what some j leads to: Gustavson's merge of rows, in time
/// proportional to the products. Each number is added up in the order of j, as in a dense result, hence equal to the
/// last bit; where ⊕ adds, that of a dense result from a kernel for large tables is to rounding. `winners` is FirstWinners or NoWinners.
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
    for (const std::size_t column : row.columns()) {
      result.append_entry(column, row[column]);
      winners.append(row.winner(column));
    }
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
