#pragma once

#include <algorithm>
#include <cstddef>

#include <sigmax/core/kernels/compose.hpp>
#include <sigmax/core/table.hpp>

namespace sigmax::kernels {

/// A function, for g++ 12 makes a slower loop of it where it is used.
inline void note(Winner* first, std::size_t k, bool better, Winner index) { first[k] = better ? index : first[k]; }

/// out(k) = out(k) ⊕ weight ⊗ row(k): what every composition consists of, whatever stores the row. `out` is a pointer
/// or a GrowingRow. If asked, first(k) becomes `index` where the new term is what ⊕ selects; on a tie it stays.
template <bool WithWinners, class A, class Entries, class Out>
void accumulate(A algebra, double weight, const Entries& row, Out& out, std::size_t index, Winner* first) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    double& sum = out[row.index(k)];
    const double next = algebra.plus(sum, algebra.times(weight, row.value(k)));
    if constexpr (WithWinners) note(first, row.index(k), next != sum, static_cast<Winner>(index));
    sum = next;
  }
}

/// result(i, k) = ⊕_j right(i, j) ⊗ left(j, k) by plain loops: what every kernel for dense tables is
/// tested against. `result` has its shape already.
template <bool WithWinners, class A, class Left, class Right>
void compose_plainly(A algebra, const Left& left, const Right& right, Table& result, FirstWinners* winners) {
  if constexpr (WithWinners) winners->assign(result.size(), 0);
  for (std::size_t i = 0; i < right.rows(); ++i) {
    const auto weights = right.entries(i);
    double* const out = result.row(i).data();
    std::fill_n(out, left.columns(), algebra.zero());
    for (std::size_t j = 0; j < weights.size(); ++j)
      accumulate<WithWinners>(algebra, weights.value(j), left.entries(weights.index(j)), out, weights.index(j),
                              WithWinners ? winners->data() + result.offset(i) : nullptr);
  }
}

}  // namespace sigmax::kernels
