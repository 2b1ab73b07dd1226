#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include <sigmax/core/scaled_number.hpp>

namespace sigmax::detail {

/// The exponent of the greatest of some numbers, and how far below it that of the least one is that is not zero.
struct Exponents {
  std::int64_t top = 0, depth = 0;
};

/// Subnormal numbers count as the least normal one.
inline Exponents exponents_of(std::span<const double> numbers) {
  std::uint64_t most = 0, least = ~std::uint64_t{0};
  for (const double number : numbers) {
    const auto bits = std::bit_cast<std::uint64_t>(number) << 1 >> 1;  // without the sign that zero may have
    most = std::max(most, bits);
    least = std::min(least, bits - 1);  // that of zero is the greatest there is
  }
  if (most == 0) return {};
  const auto exponent = [](std::uint64_t bits) { return static_cast<std::int64_t>(bits >> 52) - 1022; };
  return {exponent(most), exponent(most) - exponent(least + 1)};
}

inline Exponents exponents_of(std::span<const ScaledNumber> numbers) {
  constexpr auto beyond = std::numeric_limits<std::int64_t>::max() / 4;
  std::int64_t most = -beyond, least = beyond;
  for (const ScaledNumber number : numbers) {
    most = std::max(most, number.exponent());
    least = std::min(least, number.is_zero() ? least : number.exponent());
  }
  return least == beyond ? Exponents{} : Exponents{most, most - least};
}

}  // namespace sigmax::detail
