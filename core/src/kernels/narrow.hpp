#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "kernels/tiled.hpp"

namespace sigmax::kernels {

template <class A, std::size_t Columns>
void compose_columns(const DenseParts& parts) {
  double* out = parts.result;
  const double* weights = parts.right;
  for (std::size_t i = 0; i < parts.rows; ++i, weights += parts.inner, out += Columns) {
    std::array<double, Columns> sums{};
    const double* values = parts.left;
    for (std::size_t j = 0; j < parts.inner; ++j, values += Columns)
      for (std::size_t k = 0; k < Columns; ++k) sums[k] = A::plus(sums[k], A::times(weights[j], values[k]));
    std::copy(sums.begin(), sums.end(), out);
  }
}

template <class A, std::size_t... Columns>
constexpr std::array<void (*)(const DenseParts&), sizeof...(Columns)> by_columns(std::index_sequence<Columns...>) {
  return {compose_columns<A, Columns>...};
}

constexpr std::size_t narrow_columns = 8;
template <class A>
constexpr auto narrow_kernels = by_columns<A>(std::make_index_sequence<narrow_columns + 1>{});

/// Composes tables of up to `narrow_columns` columns with a row of the result in registers; as the plain loops, to the
/// bit. False, and nothing is done, for more columns or a user's own algebra.
inline bool compose_narrow(const AnyAlgebra& algebra, const DenseParts& parts) {
  static constexpr std::array kernels{narrow_kernels<Sigma>, narrow_kernels<Max>, narrow_kernels<MaxMin>};
  if (parts.columns > narrow_columns || algebra.name == AnyAlgebra::other) return false;
  kernels[algebra.name][parts.columns](parts);
  return true;
}

}  // namespace sigmax::kernels
