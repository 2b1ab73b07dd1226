#pragma once

#include <cstdint>
#include <vector>

#include <sigmax/core/rows.hpp>
#include <sigmax/core/uncertainty.hpp>

namespace sigmax::kernels {

using sigmax::detail::AnyAlgebra;

/// Which index won; 32 bits, because routes through long chains store many.
using Winner = std::uint32_t;

/// For every number that a result stores, in its order, the first index that attains it; 0 if none does.
using FirstWinners = std::vector<Winner>;

/// The winners of one relation of a chain. Where ⊗ selects it takes, for every number, all indices that attained more
/// than those before them, and what they attained: a later minimum may make any of them a tie.
struct Winners {
  struct Attempt {
    Winner index;
    double value;
  };
  FirstWinners first;
  std::vector<std::vector<Attempt>> attempts;
};

/// result(i, k) = ⊕_j right(i, j) ⊗ left(j, k), stored as fits: dense if a part must be, banded if both parts are, else
/// sparse. `result` is neither of the parts. Where ⊕ selects, `winners` may be asked for.
void compose(const AnyAlgebra& algebra, const AnyRows& left, const AnyRows& right, AnyRows& result,
             FirstWinners* winners = nullptr);

/// The same of tables, into one of the shape that it needs.
void compose_shaped(const AnyAlgebra& algebra, const Table& left, const Table& right, Table& result,
                    FirstWinners* winners);

/// The same where `right` is dense: so is the result. If that has room, only large tables allocate: once a thread for
/// tiles, and for scaled copies where products underflow.
void compose(const AnyAlgebra& algebra, const AnyRows& left, const Table& right, Table& result,
             FirstWinners* winners = nullptr);
inline void compose(const AnyAlgebra& algebra, const Table& left, const Table& right, Table& result,
                    FirstWinners* winners = nullptr) {
  result.reshape(right.rows(), left.columns());
  compose_shaped(algebra, left, right, result, winners);
}

template <Algebra A, class Left, class Right, class Result>
void compose(const Left& left, const Right& right, Result& result, FirstWinners* winners = nullptr) {
  compose(sigmax::detail::any_algebra<A>(), left, right, result, winners);
}

}  // namespace sigmax::kernels
