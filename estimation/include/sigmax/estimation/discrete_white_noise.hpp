#pragma once

#include <string_view>

#include <sigmax/estimation/independent_axes.hpp>

namespace sigmax {

/// The highest derivative is driven by discrete white noise, one draw a step, section VI.B: order 2 is position and
/// velocity (DWNA), order 3 has an acceleration beside them (DWPA). For each axis
///
///   F_s(a, b) = Tᵇ⁻ᵃ/(b−a)!,   G_s = [T²/2, T, 1] cut to the order,   Q_s = G_s G_sᵀ σ_w².
///
/// σ_w is an acceleration (m/s²) for DWNA, but an acceleration *increment per step* for DWPA: equal numbers do not mean
/// equal noise. A known input (same units) enters as w does: x += G_s u.
template <int Order>
class DiscreteWhiteNoise : public detail::ComputedLaw<DiscreteWhiteNoise<Order>, Order> {
  static_assert(Order == 2 || Order == 3, "position and velocity, or also acceleration");

 public:
  /// Throws std::invalid_argument unless σ_w is finite and not negative.
  explicit DiscreteWhiteNoise(double sigma_w) : sigma_w_(detail::motion_parameter(sigma_w, "sigma_w", name())) {}

  double sigma_w() const { return sigma_w_; }
  std::string_view name() const { return Order == 2 ? "dwna" : "dwpa"; }
  void compute(double dt, double* F, double* Q, double* gain) const {
    detail::discrete_white_noise(Order, sigma_w_, dt, F, Q, gain);
  }

 private:
  double sigma_w_;
};

/// Discrete white noise acceleration: position and velocity; σ_w in m/s².
template <int Axes>
IndependentAxes<Axes, DiscreteWhiteNoise<2>> dwna(double sigma_w,
                                                  const Vector<Axes>& known_acceleration = Vector<Axes>::Zero()) {
  return IndependentAxes<Axes, DiscreteWhiteNoise<2>>(DiscreteWhiteNoise<2>(sigma_w), known_acceleration);
}

/// Discrete Wiener process acceleration: position, velocity and acceleration; σ_w in m/s² *per step*.
template <int Axes>
IndependentAxes<Axes, DiscreteWhiteNoise<3>> dwpa(double sigma_w) {
  return IndependentAxes<Axes, DiscreteWhiteNoise<3>>(DiscreteWhiteNoise<3>(sigma_w));
}

}  // namespace sigmax
