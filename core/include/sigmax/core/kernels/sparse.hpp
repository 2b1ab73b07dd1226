#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include <sigmax/core/algebra.hpp>
#include <sigmax/core/kernels/accumulate.hpp>
#include <sigmax/core/rows.hpp>

namespace sigmax::kernels {

/// In place of the winners where none are asked for.
struct NoWinners {};
template <class Winners>
inline constexpr bool wants_winners = !std::is_same_v<Winners, NoWinners>;

/// One row of a sparse result while it grows: indexed by column, a column becomes one of the row, its number ⊕ of
/// nothing.
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

  /// The winners, by column.
  struct Winners {
    std::vector<Slot>& slots;
    Winner& operator[](std::size_t column) { return slots[column].winner; }
  };
  Winners winners() { return {slots_}; }

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
/// last bit. `winners` gets the first j for every number stored, or is NoWinners.
template <Algebra A, class Left, class Right, class Winners>
SparseRows sparse_composition(const Left& left, const Right& right, Winners& winners) {
  SparseRows result(left.columns());
  GrowingRow<A> row(left.columns());
  auto row_winners = row.winners();
  if constexpr (wants_winners<Winners>) winners.clear();
  for (std::size_t i = 0; i < right.rows(); ++i) {
    row.begin(static_cast<Winner>(i));
    const auto weights = right.entries(i);
    for (std::size_t j = 0; j < weights.size(); ++j) {
      if (weights.value(j) == A::zero()) continue;
      const auto terms = left.entries(weights.index(j));
      if constexpr (wants_winners<Winners>)
        accumulate<A>(weights.value(j), terms, row, static_cast<Winner>(weights.index(j)), row_winners);
      else
        accumulate<A>(weights.value(j), terms, row);
    }
    for (const std::size_t column : row.columns()) {
      result.append_entry(column, row[column]);
      if constexpr (wants_winners<Winners>) winners.push_back(row_winners[column]);
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
  if constexpr (wants_winners<Winners>) winners.clear();
  for (std::size_t i = 0; i < right.rows(); ++i) {
    const RunOfEntries weights = right.entries(i);
    const Reach all = reach(left, weights);
    const std::size_t first = all.size() > 0 ? all.first : 0;
    result.append(first, all.size(), A::zero());
    if constexpr (wants_winners<Winners>) winners.resize(result.stored(), 0);
    double* const out = result.values(i).data();
    for (std::size_t j = 0; j < weights.size(); ++j) {
      RunOfEntries terms = left.entries(weights.index(j));
      if (terms.size() == 0) continue;
      terms.first -= first;
      if constexpr (wants_winners<Winners>) {
        Winner* const won = winners.data() + result.offset(i);
        accumulate<A>(weights.value(j), terms, out, static_cast<Winner>(weights.index(j)), won);
      } else {
        accumulate<A>(weights.value(j), terms, out);
      }
    }
  }
  return result;
}

}  // namespace sigmax::kernels
