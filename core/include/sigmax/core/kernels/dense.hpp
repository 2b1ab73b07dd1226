#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include <sigmax/core/algebra.hpp>
#include <sigmax/core/kernels/accumulate.hpp>
#include <sigmax/core/kernels/tiled.hpp>
#include <sigmax/core/table.hpp>

namespace sigmax::kernels {

/// result(i, k) = ⊕_j right(i, j) ⊗ left(j, k) by plain loops: what every kernel for dense tables is tested against.
/// `result` has its shape already.
template <Algebra A, class Left, class Right, class Winners>
void compose_plainly(const Left& left, const Right& right, Table& result, Winners& winners) {
  winners.assign(result.size());
  for (std::size_t i = 0; i < right.rows(); ++i) {
    const auto weights = right.entries(i);
    double* const out = result.row(i).data();
    std::fill_n(out, left.columns(), A::zero());
    for (std::size_t j = 0; j < weights.size(); ++j)
      accumulate<A>(weights.value(j), left.entries(weights.index(j)), out, weights.index(j),
                    winners.from(result.offset(i)));
  }
}

/// The same by a compiled kernel, if there is one for such tables.
template <Algebra A, class Winners>
bool compose_by_tiles(const Table& left, const Table& right, Table& result, Winners& winners) {
  const DenseParts parts{right.data(), left.data(), result.data(), right.rows(), left.rows(), left.columns()};
  if constexpr (std::same_as<Winners, NoWinners> && requires { compose_tiled(A{}, parts); }) {
    if (worth_tiling(parts)) return compose_tiled(A{}, parts);
    if (parts.columns > narrow_columns) return false;
    compose_narrow(A{}, parts);
    return true;
  } else if constexpr (std::same_as<Winners, FirstWinners> && requires { compose_tiled(A{}, parts, nullptr); }) {
    if (!worth_tiling(parts)) return false;
    winners.all.resize(result.size());
    return compose_tiled(A{}, parts, winners.all.data());
  } else {
    return false;
  }
}

/// result(i, k) = ⊕_j right(i, j) ⊗ left(j, k) of parts stored in any way, neither of them `result`. If that has room,
/// only large tables allocate: once a thread for tiles, and for scaled copies where products underflow.
template <Algebra A, class Left, class Right, class Winners>
void compose(const Left& left, const Right& right, Table& result, Winners& winners) {
  result.reshape(right.rows(), left.columns());
  if constexpr (std::same_as<Left, Table> && std::same_as<Right, Table>)
    if (compose_by_tiles<A>(left, right, result, winners)) return;
  compose_plainly<A>(left, right, result, winners);
}
template <Algebra A, class Left, class Right>
void compose(const Left& left, const Right& right, Table& result) {
  NoWinners none;
  compose<A>(left, right, result, none);
}

}  // namespace sigmax::kernels
