#pragma once

#include <array>
#include <cstddef>
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
class WhiteNoise {
  static_assert(Order == 2 || Order == 3, "white-noise acceleration or jerk");

 public:
  static constexpr int order = Order;

  /// Throws std::invalid_argument unless q is finite and not negative.
  explicit WhiteNoise(double q) : q_(detail::motion_parameter(q, "q", name())) {}

  double q() const { return q_; }
  std::string_view name() const { return Order == 2 ? "cwna" : "cwpa"; }

  SquareMatrix<Order> transition(double dt) const { return detail::taylor_transition<Order>(dt); }
  SquareMatrix<Order> process_covariance(double dt) const {
    const auto taylor = powers(dt);
    SquareMatrix<Order> Q;
    for (Eigen::Index a = 0; a < Order; ++a)
      for (Eigen::Index b = 0; b < Order; ++b) {
        const Eigen::Index p = Order - 1 - a, r = Order - 1 - b;
        Q(a, b) = q_ * taylor[static_cast<std::size_t>(p)] * taylor[static_cast<std::size_t>(r)] * dt /
                  static_cast<double>(p + r + 1);
      }
    return Q;
  }
  Vector<Order> input_gain(double dt) const {
    const auto taylor = powers(dt);
    Vector<Order> gain;
    for (Eigen::Index a = 0; a < Order; ++a) gain(a) = taylor[static_cast<std::size_t>(Order - a)];
    return gain;
  }

 private:
  /// Tⁿ/n!.
  static std::array<double, 4> powers(double dt) { return {1.0, dt, dt * dt / 2.0, dt * dt * dt / 6.0}; }

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
