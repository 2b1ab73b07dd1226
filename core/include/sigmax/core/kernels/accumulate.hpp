#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <sigmax/core/algebra.hpp>
#include <sigmax/core/scaled_number.hpp>

namespace sigmax::kernels {

/// Which index won; 32 bits, because routes through long chains store many.
using Winner = std::uint32_t;

/// What takes note of winners where nobody asks for them.
struct NoWinners {
  static constexpr bool wanted = false;
  void assign(std::size_t) {}
  void resize(std::size_t) {}
  void reserve(std::size_t) {}
  void merge(std::size_t, ScaledNumber, ScaledNumber, const NoWinners&) {}
  NoWinners from(std::size_t) const { return {}; }
  void note(std::size_t, bool, Winner, double) const {}
};

/// For every number that a result stores, in its order, the first index that attains it; 0 if none does.
struct FirstWinners {
  static constexpr bool wanted = true;
  std::vector<Winner> all;

  void assign(std::size_t size) { all.assign(size, 0); }
  void resize(std::size_t size) { all.resize(size, 0); }
  void reserve(std::size_t size) { all.reserve(size); }

  /// Where a term from another band, with winners of its own, joins number k.
  void merge(std::size_t k, ScaledNumber number, ScaledNumber term, const FirstWinners& of_term) {
    if (term.is_zero()) return;
    if (term == number)
      all[k] = std::min(all[k], of_term.all[k]);
    else if (number < term)
      all[k] = of_term.all[k];
  }

  /// The notes of one row, whose numbers begin at `offset`.
  struct OfRow {
    static constexpr bool wanted = true;
    Winner* first;
    void note(std::size_t k, bool better, Winner index, double) const { first[k] = better ? index : first[k]; }
  };
  OfRow from(std::size_t offset) { return {all.data() + offset}; }

  Winner first(std::size_t k, double) const { return all[k]; }
};

/// out(k) = out(k) ⊕ weight ⊗ row(k): what every composition consists of, whatever stores the row. `out` is a pointer
/// or a GrowingRow. `winners` notes `index` where the new term is what ⊕ selects; on a tie what was there stays.
template <Algebra A, class Entries, class Out, class Winners>
  requires(SelectiveAlgebra<A> || !Winners::wanted)
void accumulate(double weight, const Entries& row, Out& out, std::size_t index, const Winners& winners) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    double& sum = out[row.index(k)];
    const double next = A::plus(sum, A::times(weight, row.value(k)));
    winners.note(row.index(k), next != sum, static_cast<Winner>(index), next);
    sum = next;
  }
}

}  // namespace sigmax::kernels
