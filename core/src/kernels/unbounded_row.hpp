#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <sigmax/core/kernels/unbounded_row.hpp>

namespace sigmax::kernels {

/// One number of a likelihood whose ⊗ scales, exactly as it was given unless that was a logarithm.
inline ScaledNumber number_of(const Evidence& evidence, std::size_t i) {
  return evidence.numbers.empty() ? ScaledNumber::exp(evidence.logs_or_plain[i]) : evidence.numbers[i];
}

/// x · 2^512, for x in [0, 2^511), without arithmetic on subnormal numbers, which is slow on some processors.
inline double raised(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x) << 1 >> 1;  // without the sign that zero may have
  const std::uint64_t subnormal = ((bits >> 52) - 1) >> 63;     // 1 or 0, without a comparison: it vectorises
  // A subnormal number gets the exponent of the least normal one and, raised, is rid of the leading bit that implies.
  const auto up = std::bit_cast<double>(bits + ((512 + subnormal) << 52));
  return up - std::bit_cast<double>((0 - subnormal) & std::bit_cast<std::uint64_t>(0x1p-510));
}

}  // namespace sigmax::kernels
