#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <sigmax/core/algebra.hpp>
#include <sigmax/core/logarithm.hpp>

namespace sigmax::kernels {

/// A number that is not negative: significand · 2^exponent, the significand zero or in [½, 1). Its operations round as
/// those of doubles would, had they exponents without bounds.
struct LongNumber {
  double significand = 0.0;
  std::int64_t exponent = 0;

  static constexpr std::uint64_t sign = std::uint64_t{1} << 63;  // that zero may have

  static LongNumber of(double value, std::int64_t exponent = 0) {
    const auto bits = std::bit_cast<std::uint64_t>(value) & ~sign;
    if (const auto field = static_cast<std::int64_t>(bits >> 52); field > 0)  // a normal number: std::frexp is slower
      return {std::bit_cast<double>((bits & 0x000f'ffff'ffff'ffff) | 0x3fe0'0000'0000'0000), exponent + field - 1022};
    if (bits == 0) return {};
    int own = 0;
    const double significand = std::frexp(value, &own);
    return {significand, exponent + own};
  }

  /// The number in units of 2^unit: exponents apart no more than normal doubles reach.
  double over_power(std::int64_t unit) const {
    if (significand == 0.0) return 0.0;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(significand) +
                                 (static_cast<std::uint64_t>(exponent - unit) << 52));
  }

  /// e^log.
  static LongNumber exp(double log) {
    if (log == log_zero) return {};
    // Without a power of two split off where a normal double holds it: then it is std::exp to the last bit.
    const double power = std::abs(log) < 700.0 ? 0.0 : std::round(log / std::numbers::ln2);
    return of(std::exp(log - power * std::numbers::ln2), static_cast<std::int64_t>(power));
  }

  /// As a double: zero or infinity where that has no such exponent.
  double value() const {
    return std::ldexp(significand, static_cast<int>(std::clamp<std::int64_t>(exponent, -3000, 3000)));
  }

  double log() const {
    if (significand == 0.0) return log_zero;
    return std::log(significand) + static_cast<double>(exponent) * std::numbers::ln2;
  }

  friend LongNumber operator*(LongNumber a, LongNumber b) {
    return of(a.significand * b.significand, a.exponent + b.exponent);
  }

  /// The ⊕ of an algebra through which scaling passes.
  template <ScalingAlgebra A>
  static LongNumber plus(LongNumber a, LongNumber b) {
    if (a.significand == 0.0) return b;
    if (b.significand == 0.0) return a;
    if (a.exponent < b.exponent) std::swap(a, b);
    const std::int64_t below = a.exponent - b.exponent;
    // So far below, it is less than any rounding of the sum.
    return of(A::plus(a.significand, below > 1000 ? 0.0 : b.over_power(a.exponent)), a.exponent);
  }

  friend bool operator==(const LongNumber&, const LongNumber&) = default;
  friend bool operator<(LongNumber a, LongNumber b) {
    if (a.significand == 0.0 || b.significand == 0.0) return a.significand < b.significand;
    return a.exponent != b.exponent ? a.exponent < b.exponent : a.significand < b.significand;
  }
};

}  // namespace sigmax::kernels
