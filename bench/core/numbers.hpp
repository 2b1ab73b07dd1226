#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <sigmax/core/compose.hpp>

namespace sigmax::bench {

/// Numbers in (0, 1], or for each of them with the given chance a subnormal one; the same for the same seed.
inline std::vector<double> numbers(std::size_t n, std::uint64_t seed, double chance_of_subnormal = 0.0) {
  std::mt19937_64 generator(seed);
  const auto uniform = [&] { return static_cast<double>((generator() >> 11) + 1) * 0x1p-53; };
  std::vector<double> result(n);
  for (double& number : result) {
    number = uniform();
    if (uniform() <= chance_of_subnormal) number = number * 0x1p-1030;
  }
  return result;
}

/// A transition of a variable with n outcomes; every row has one number that is not subnormal, its first.
template <Uncertainty Kind>
Relation<Kind, Kind> transition(std::size_t n, std::uint64_t seed, double chance_of_subnormal = 0.0) {
  const Variable<Kind> x{"x", n};
  Table rows(n, n);
  for (std::size_t i = 0; i < n; ++i) {
    auto row = numbers(n, seed + i, chance_of_subnormal);
    row[0] = 1.0;
    condition<AlgebraOf<Kind>>(row);
    std::copy(row.begin(), row.end(), rows.row(i).begin());
  }
  return {x, x, std::move(rows), detail::ByLaw{}};
}

/// Ten equal numbers a row, or fewer where two of the columns drawn at random are the same.
inline constexpr std::size_t entries_of_a_row = 10;
template <Uncertainty Kind>
Relation<Kind, Kind> sparse_transition(std::size_t n, std::uint64_t seed) {
  const Variable<Kind> x{"x", n};
  std::mt19937_64 generator(seed);
  SparseRows rows(n);
  std::vector<std::size_t> columns(entries_of_a_row);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t& column : columns) column = generator() % n;
    std::sort(columns.begin(), columns.end());
    const auto end = std::unique(columns.begin(), columns.end());
    const auto share = equal_share<AlgebraOf<Kind>>(static_cast<std::size_t>(end - columns.begin()));
    for (auto column = columns.begin(); column != end; ++column) rows.append_entry(*column, share);
    rows.end_row();
  }
  return {x, x, std::move(rows)};
}

}  // namespace sigmax::bench
