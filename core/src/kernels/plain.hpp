#pragma once

#include <algorithm>
#include <cstddef>

#include <sigmax/core/kernels/compose.hpp>
#include <sigmax/core/table.hpp>

namespace sigmax::kernels {

/// Takes no note of what ⊕ selects.
struct Unnoted {
  void operator()(std::size_t, bool, double) const {}
};

/// out(k) = out(k) ⊕ weight ⊗ row(k): what every composition consists of, whatever stores the row. `out` is a pointer
/// or a GrowingRow. note(k, whether out(k) changed, out(k)) is called for each k: on a tie it does not change.
template <class A, class Entries, class Out, class Note = Unnoted>
void accumulate(A algebra, double weight, const Entries& row, Out& out, const Note& note = {}) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    double& sum = out[row.index(k)];
    const double next = algebra.plus(sum, algebra.times(weight, row.value(k)));
    note(row.index(k), next != sum, next);
    sum = next;
  }
}

/// result(i, k) = ⊕_j right(i, j) ⊗ left(j, k) by plain loops: what every kernel for dense tables is
/// tested against. `result` has its shape already.
template <class A, class Left, class Right>
void compose_plainly(A algebra, const Left& left, const Right& right, Table& result) {
  for (std::size_t i = 0; i < right.rows(); ++i) {
    const auto weights = right.entries(i);
    double* const out = result.row(i).data();
    std::fill_n(out, left.columns(), algebra.zero());
    for (std::size_t j = 0; j < weights.size(); ++j)
      accumulate(algebra, weights.value(j), left.entries(weights.index(j)), out);
  }
}

}  // namespace sigmax::kernels
