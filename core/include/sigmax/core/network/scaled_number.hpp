#pragma once

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <numbers>

#include <sigmax/core/algebra.hpp>

namespace sigmax {

/// A number that is not negative and never underflows: significand · 2^(512 · exponent), the significand zero or
/// between 2^−256 and 2^256. Products and sums round as those of doubles do and are otherwise exact.
class ScaledNumber {
 public:
  constexpr ScaledNumber() = default;  ///< zero

  /// `value` is finite and not negative; a subnormal one loses nothing.
  constexpr explicit ScaledNumber(double value) : ScaledNumber(value, 0) {}

  /// The number with this logarithm, −∞ for zero; a finite one beyond ±10¹⁵ counts as that.
  static ScaledNumber exp(double log) {
    if (log == -std::numeric_limits<double>::infinity()) return {};
    log = std::clamp(log, -1e15, 1e15);
    const double exponent = std::round(log / log_radix);
    return {std::exp(log - exponent * log_radix), static_cast<std::int64_t>(exponent)};
  }

  double log() const { return std::log(significand_) + (is_zero() ? 0.0 : static_cast<double>(exponent_) * log_radix); }
  constexpr bool is_zero() const { return significand_ == 0.0; }

  /// This number as a double: zero or infinity where a double cannot say better.
  double value() const { return over(ScaledNumber{1.0}); }

  /// This number divided by another that is not zero, as a double.
  double over(ScaledNumber divisor) const {
    if (is_zero()) return 0.0;
    double quotient = significand_ / divisor.significand_;  // between 2^−512 and 2^512
    std::int64_t left = exponent_ - divisor.exponent_;
    for (; left > 0 && quotient < std::numeric_limits<double>::infinity(); --left) quotient *= radix;
    for (; left < 0 && quotient > 0.0; ++left) quotient /= radix;
    return quotient;
  }

  /// The ⊗ of every algebra that scales: it is the product.
  friend constexpr ScaledNumber operator*(ScaledNumber a, ScaledNumber b) {
    return {a.significand_ * b.significand_, a.exponent_ + b.exponent_};
  }

  /// The ⊕ of an algebra, through which scaling passes.
  template <ScalingAlgebra A>
  static constexpr ScaledNumber plus(ScaledNumber a, ScaledNumber b) {
    if (a.exponent_ == b.exponent_) return {A::plus(a.significand_, b.significand_), a.exponent_};
    if (a.exponent_ < b.exponent_) return plus<A>(b, a);
    // Two exponents or more below, b is less than a rounding of a.
    return {A::plus(a.significand_, a.exponent_ - b.exponent_ == 1 ? b.significand_ / radix : 0.0), a.exponent_};
  }

  friend constexpr bool operator==(ScaledNumber, ScaledNumber) = default;
  friend constexpr std::partial_ordering operator<=>(ScaledNumber a, ScaledNumber b) {
    if (a.exponent_ != b.exponent_) return a.exponent_ <=> b.exponent_;
    return a.significand_ <=> b.significand_;
  }

 private:
  static constexpr double radix = 0x1p512;
  static constexpr double greatest_significand = 0x1p256;
  static constexpr double log_radix = 512 * std::numbers::ln2;
  static constexpr std::int64_t exponent_of_zero = std::numeric_limits<std::int64_t>::min() / 4;  // below all others

  constexpr ScaledNumber(double significand, std::int64_t exponent) : significand_(significand), exponent_(exponent) {
    if (significand_ == 0.0) {
      exponent_ = exponent_of_zero;
      return;
    }
    for (; significand_ >= greatest_significand; ++exponent_) significand_ /= radix;
    for (; significand_ < 1.0 / greatest_significand; --exponent_) significand_ *= radix;
  }

  double significand_ = 0.0;
  std::int64_t exponent_ = exponent_of_zero;
};

}  // namespace sigmax
