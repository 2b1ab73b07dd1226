#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <compare>
#include <cstdint>
#include <iosfwd>
#include <limits>
#include <numbers>
#include <utility>

#include <sigmax/core/algebra.hpp>
#include <sigmax/core/logarithm.hpp>

namespace sigmax {

/// A number that is not negative and never underflows: significand · 2^exponent, the significand zero or in [½, 1).
///
/// Its operations round as those of doubles would, had they exponents without bounds.
class ScaledNumber {
 public:
  constexpr ScaledNumber() = default;  ///< zero

  /// value · 2^exponent; `value` is finite and not negative, and a subnormal one loses nothing.
  constexpr explicit ScaledNumber(double value, std::int64_t exponent = 0) {
    assert(value >= 0.0);
    auto bits = std::bit_cast<std::uint64_t>(value) & ~sign;
    if (bits == 0) return;
    if (bits >> 52 == 0) {  // subnormal
      bits = std::bit_cast<std::uint64_t>(value * 0x1p64) & ~sign;
      exponent -= 64;
    }
    significand_ = std::bit_cast<double>((bits & 0x000f'ffff'ffff'ffff) | 0x3fe0'0000'0000'0000);
    exponent_ = exponent + static_cast<std::int64_t>(bits >> 52) - 1022;
  }

  /// The number with this logarithm, −∞ for zero; a finite one beyond ±10¹⁵ counts as that.
  static ScaledNumber exp(double log) {
    if (log == log_zero) return {};
    log = std::clamp(log, -1e15, 1e15);
    // Without a power of two split off where a normal double holds it: then it is std::exp to the last bit.
    const double power = std::abs(log) < 700.0 ? 0.0 : std::round(log / std::numbers::ln2);
    constexpr double rest_of_ln2 = 2.3190468138462996e-17;  // beyond the double, or a large power would show it
    const double fraction = std::fma(-power, rest_of_ln2, std::fma(-power, std::numbers::ln2, log));
    return ScaledNumber(std::exp(fraction), static_cast<std::int64_t>(power));
  }

  /// Its logarithm: where a normal double holds the number, that of the double to the last bit.
  double log() const {
    if (is_zero()) return log_zero;
    if (is_normal(exponent_)) return std::log(normal_value_in_units_of(0));
    return std::log(significand_) + static_cast<double>(exponent_) * std::numbers::ln2;
  }
  constexpr bool is_zero() const { return significand_ == 0.0; }
  constexpr std::int64_t exponent() const { return exponent_; }

  /// As a double: zero or infinity where a double cannot say better.
  double value() const { return value_in_units_of(0); }

  /// Divided by 2^unit, as a double: zero or infinity where a double cannot say better.
  double value_in_units_of(std::int64_t unit) const {
    const std::int64_t exponent = exponent_ - unit;
    if (is_normal(exponent)) return normal_value_in_units_of(unit);
    return std::ldexp(significand_, static_cast<int>(std::clamp<std::int64_t>(exponent, -3000, 3000)));
  }

  /// The same, faster, where the result is zero or a normal double.
  constexpr double normal_value_in_units_of(std::int64_t unit) const {
    if (is_zero()) return 0.0;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(significand_) +
                                 (static_cast<std::uint64_t>(exponent_ - unit) << 52));
  }

  /// Divided by another that is not zero, as a double.
  double over(ScaledNumber divisor) const {
    if (is_zero()) return 0.0;
    return ScaledNumber(significand_ / divisor.significand_, exponent_ - divisor.exponent_).value();
  }

  /// The ⊗ of every algebra that scales: it is the product.
  friend constexpr ScaledNumber operator*(ScaledNumber a, ScaledNumber b) {
    return ScaledNumber(a.significand_ * b.significand_, a.exponent_ + b.exponent_);
  }

  /// The ⊕ of an algebra, through which scaling passes; the second form takes it as a function of doubles.
  template <ScalingAlgebra A>
  static constexpr ScaledNumber plus(ScaledNumber a, ScaledNumber b) {
    return plus(a, b, [](double x, double y) { return A::plus(x, y); });
  }
  template <class Plus>
  static constexpr ScaledNumber plus(ScaledNumber a, ScaledNumber b, const Plus& plus) {
    if (a.is_zero()) return b;
    if (b.is_zero()) return a;
    if (a.exponent_ < b.exponent_) std::swap(a, b);
    const bool negligible = a.exponent_ - b.exponent_ > 1000;  // less than any rounding of the result
    return ScaledNumber(plus(a.significand_, negligible ? 0.0 : b.normal_value_in_units_of(a.exponent_)), a.exponent_);
  }

  friend constexpr bool operator==(ScaledNumber, ScaledNumber) = default;
  friend constexpr std::partial_ordering operator<=>(ScaledNumber a, ScaledNumber b) {
    if (a.exponent_ != b.exponent_) return a.exponent_ <=> b.exponent_;
    return a.significand_ <=> b.significand_;
  }

 private:
  static constexpr bool is_normal(std::int64_t exponent) { return exponent > -1022 && exponent < 1024; }
  static constexpr std::uint64_t sign = std::uint64_t{1} << 63;                                   // that zero may have
  static constexpr std::int64_t exponent_of_zero = std::numeric_limits<std::int64_t>::min() / 4;  // below all others

  double significand_ = 0.0;
  std::int64_t exponent_ = exponent_of_zero;
};

/// As a double with the digits that the stream shows; beyond the doubles as "3.2e-5000".
std::ostream& operator<<(std::ostream& out, ScaledNumber number);

}  // namespace sigmax
