#pragma once

#include <string_view>

#include <sigmax/estimation/independent_axes.hpp>

namespace sigmax {

/// The highest derivative is driven by continuous white noise of power spectral density q: order 2 is white-noise
/// acceleration (CWNA, q in m²/s³), order 3 white-noise jerk (CWPA, q in m²/s⁵); Bar-Shalom, Li, Kirubarajan 2001, 6.2.
/// With p = order − 1 − a and r = order − 1 − b
///
///   F_s(a, b) = Tᵇ⁻ᵃ/(b−a)!,   Q_s(a, b) = q Tᵖ⁺ʳ⁺¹ / (p! r! (p+r+1)).
///
/// A known input is a constant acceleration (m/s²) or jerk (m/s³).
template <int Order>
class WhiteNoise : public detail::ComputedLaw<WhiteNoise<Order>, Order> {
  static_assert(Order == 2 || Order == 3, "white-noise acceleration or jerk");

 public:
  /// Throws std::invalid_argument unless q is finite and not negative.
  explicit WhiteNoise(double q) : q_(detail::motion_parameter(q, "q", name())) {}

  double q() const { return q_; }
  std::string_view name() const { return Order == 2 ? "cwna" : "cwpa"; }
  void compute(double dt, double* F, double* Q, double* gain) const { detail::white_noise(Order, q_, dt, F, Q, gain); }

 private:
  double q_;
};

/// Continuous white-noise acceleration: position and velocity; q in m²/s³.
template <int Axes>
IndependentAxes<Axes, WhiteNoise<2>> cwna(double q, const Vector<Axes>& known_acceleration = Vector<Axes>::Zero()) {
  return IndependentAxes<Axes, WhiteNoise<2>>(WhiteNoise<2>(q), known_acceleration);
}

/// Continuous white-noise jerk (Wiener process acceleration): position, velocity and acceleration; q in m²/s⁵.
template <int Axes>
IndependentAxes<Axes, WhiteNoise<3>> cwpa(double q) {
  return IndependentAxes<Axes, WhiteNoise<3>>(WhiteNoise<3>(q));
}

}  // namespace sigmax
