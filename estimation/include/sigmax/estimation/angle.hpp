#pragma once

#include <numbers>

namespace sigmax {

/// An angle, made with its unit: degrees(45.0) or radians(0.785). A bare number is none.
class Angle {
 public:
  constexpr Angle() = default;
  constexpr double radians() const { return radians_; }
  constexpr double degrees() const { return radians_ * (180.0 / std::numbers::pi); }
  constexpr bool operator==(const Angle&) const = default;
  constexpr Angle& operator+=(Angle other) { return *this = Angle(radians_ + other.radians_); }
  friend constexpr Angle operator+(Angle a, Angle b) { return a += b; }
  friend constexpr Angle operator*(double factor, Angle angle) { return Angle(factor * angle.radians_); }

  friend constexpr Angle radians(double value) { return Angle(value); }
  friend constexpr Angle degrees(double value) { return Angle(value * (std::numbers::pi / 180.0)); }

 private:
  constexpr explicit Angle(double value) : radians_(value) {}
  double radians_ = 0.0;
};

constexpr Angle radians(double value);
constexpr Angle degrees(double value);

}  // namespace sigmax
