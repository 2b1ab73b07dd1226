#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace sigmax {

/// How close logarithms are equal wherever one of them is to be chosen: a tie.
inline constexpr double tie_tolerance = 1e-9;

/// Whether a logarithm ties with the greatest one.
inline bool ties(double log, double greatest) { return log >= greatest - tie_tolerance; }

/// Index of the first logarithm that ties with the greatest. There is at least one.
inline std::size_t first_of_tied(std::span<const double> logs) {
  const double greatest = *std::max_element(logs.begin(), logs.end());
  const auto first = std::find_if(logs.begin(), logs.end(), [greatest](double log) { return ties(log, greatest); });
  return static_cast<std::size_t>(first - logs.begin());
}

namespace detail {

/// The same of numbers: whether one is equal to a greater one but for rounding.
inline bool numbers_tie(double number, double greater) { return number >= greater * (1.0 - tie_tolerance); }

}  // namespace detail

}  // namespace sigmax
