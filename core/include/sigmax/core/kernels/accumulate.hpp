#pragma once

#include <cstddef>
#include <cstdint>

#include <sigmax/core/algebra.hpp>

namespace sigmax::kernels {

/// Which index won; 32 bits, because routes through long chains store many.
using Winner = std::uint32_t;

/// out(k) = out(k) ⊕ weight ⊗ row(k): what every composition consists of, whatever stores the row. `out` is a pointer,
/// or grows where it is indexed.
template <Algebra A, class Entries, class Out>
void accumulate(double weight, const Entries& row, Out& out) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    double& sum = out[row.index(k)];
    sum = A::plus(sum, A::times(weight, row.value(k)));
  }
}

/// The same, and winner(k) = `index` where the new term is what ⊕ selects; on a tie what was there stays.
template <SelectiveAlgebra A, class Entries, class Out, class Winners>
void accumulate(double weight, const Entries& row, Out& out, Winner index, Winners& winners) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    double& sum = out[row.index(k)];
    Winner& winner = winners[row.index(k)];
    const double next = A::plus(sum, A::times(weight, row.value(k)));
    winner = next != sum ? index : winner;
    sum = next;
  }
}

}  // namespace sigmax::kernels
