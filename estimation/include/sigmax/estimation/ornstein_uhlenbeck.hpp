#pragma once

#include <string_view>

#include <sigmax/estimation/independent_axes.hpp>

namespace sigmax {

/// A motion whose highest derivative is an Ornstein–Uhlenbeck process, that is first-order Gauss–Markov. It has the
/// stationary standard deviation σ and forgets at the rate θ (1/s), d = −θ (d − m) dt + √(2θ) σ dW. Order 1: the
/// position wanders about a point (σ in m). Order 2: the velocity (σ in m/s) does, as of ships (Millefiori et al.
/// 2016). Order 3: the acceleration (σ in m/s²), the model of Singer (1970), whose α is θ.
///
/// With u = θT, F_s and Q_s are the exact integrals (Bar-Shalom, Li, Kirubarajan 2001, 8.2.3), for any u ≥ 0:
/// F_s(a, last) = Tᵖ (1, (1 − e⁻ᵘ)/u, (u − 1 + e⁻ᵘ)/u²) for p = order − 1 − a = 0 … with e⁻ᵘ for p = 0. A known input
/// is the level m about which the highest derivative wanders.
template <int Order>
class OrnsteinUhlenbeck : public detail::ComputedLaw<OrnsteinUhlenbeck<Order>, Order> {
 public:
  /// Throws std::invalid_argument unless θ and σ are finite and not negative.
  OrnsteinUhlenbeck(double theta, double sigma)
      : theta_(detail::motion_parameter(theta, "the rate", name())),
        sigma_(detail::motion_parameter(sigma, "sigma", name())) {}

  double theta() const { return theta_; }
  double sigma() const { return sigma_; }
  std::string_view name() const { return Order == 1 ? "ou_position" : Order == 2 ? "ou_velocity" : "singer"; }
  void compute(double dt, double* F, double* Q, double* gain) const {
    detail::ornstein_uhlenbeck(Order, theta_, sigma_, dt, F, Q, gain);
  }

 private:
  double theta_;
  double sigma_;
};

/// The position wanders about a point: θ in 1/s, σ in m.
template <int Axes>
IndependentAxes<Axes, OrnsteinUhlenbeck<1>> ou_position(double theta, double sigma,
                                                        const Vector<Axes>& point = Vector<Axes>::Zero()) {
  return IndependentAxes<Axes, OrnsteinUhlenbeck<1>>(OrnsteinUhlenbeck<1>(theta, sigma), point);
}

/// The velocity wanders about a cruising velocity: θ in 1/s, σ in m/s.
template <int Axes>
IndependentAxes<Axes, OrnsteinUhlenbeck<2>> ou_velocity(double theta, double sigma,
                                                        const Vector<Axes>& cruise = Vector<Axes>::Zero()) {
  return IndependentAxes<Axes, OrnsteinUhlenbeck<2>>(OrnsteinUhlenbeck<2>(theta, sigma), cruise);
}

/// Singer's model: the acceleration has the standard deviation σ_m (m/s²) and forgets at the rate α (1/s).
template <int Axes>
IndependentAxes<Axes, OrnsteinUhlenbeck<3>> singer(double alpha, double sigma_m) {
  return IndependentAxes<Axes, OrnsteinUhlenbeck<3>>(OrnsteinUhlenbeck<3>(alpha, sigma_m));
}

}  // namespace sigmax
