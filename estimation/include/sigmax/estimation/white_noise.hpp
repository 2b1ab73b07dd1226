#pragma once

#include <string_view>

#include <sigmax/estimation/independent_axes.hpp>

namespace sigmax {

/// A motion whose highest derivative is driven by continuous white noise of power spectral density q = σ_w². Order 2 is
/// white-noise acceleration (CWNA), order 3 white-noise jerk (CWPA); Bar-Shalom, Li, Kirubarajan 2001, 6.2. With p =
/// order − 1 − a and r = order − 1 − b
///
///   F_s(a, b) = Tᵇ⁻ᵃ/(b−a)!,   Q_s(a, b) = q Tᵖ⁺ʳ⁺¹ / (p! r! (p+r+1)).
///
/// A known input is a constant acceleration (m/s²) or jerk (m/s³).
template <int Order>
class WhiteNoise : public detail::ComputedLaw<WhiteNoise<Order>, Order> {
  static_assert(Order == 2 || Order == 3, "white-noise acceleration or jerk");

 public:
  /// Throws std::invalid_argument unless σ_w is finite and not negative.
  explicit WhiteNoise(double sigma_w) : sigma_w_(detail::motion_parameter(sigma_w, "sigma_w", name())) {}

  double sigma_w() const { return sigma_w_; }
  std::string_view name() const { return Order == 2 ? "cwna" : "cwpa"; }
  void compute(double dt, double* F, double* Q, double* gain) const {
    detail::white_noise(Order, sigma_w_ * sigma_w_, dt, F, Q, gain);
  }

 private:
  double sigma_w_;
};

/// Continuous white-noise acceleration: position and velocity. σ_w in m/s^1.5: what √q is, where q
/// in m²/s³ is the power spectral density that other libraries ask for.
template <int Axes>
IndependentAxes<Axes, WhiteNoise<2>> cwna(double sigma_w,
                                          const Vector<Axes>& known_acceleration = Vector<Axes>::Zero()) {
  return IndependentAxes<Axes, WhiteNoise<2>>(WhiteNoise<2>(sigma_w), known_acceleration);
}

/// Continuous white-noise jerk (Wiener process acceleration): position, velocity and acceleration. σ_w = √q in
/// m/s^2.5.
template <int Axes>
IndependentAxes<Axes, WhiteNoise<3>> cwpa(double sigma_w) {
  return IndependentAxes<Axes, WhiteNoise<3>>(WhiteNoise<3>(sigma_w));
}

}  // namespace sigmax
