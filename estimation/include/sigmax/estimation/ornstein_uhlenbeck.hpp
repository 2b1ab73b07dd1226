#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include <sigmax/estimation/independent_axes.hpp>

namespace sigmax {

namespace detail {

/// Σ_{n ≥ k} (−1)ⁿ uⁿ⁻ᵏ/n! (a 2ⁿ + b n + c): what is left of a e⁻²ᵘ − b u e⁻ᵘ + c e⁻ᵘ after its first k powers, over
/// uᵏ. Summed as a series for small u, so that nothing cancels and u = 0 is a number like another.
inline double exponential_tail(double u, int k, double a, double b, double c) {
  double power = 1.0;  // (−1)ⁿ uⁿ/n!, or uⁿ⁻ᵏ instead of uⁿ
  double double_power = 1.0;
  double head = 0.0;
  for (int n = 0; n < k; ++n) {
    head += power * (a * double_power + b * n + c);
    power *= -(u < 1.0 ? 1.0 : u) / (n + 1);
    double_power *= 2.0;
  }
  if (u >= 1.0) return (a * std::exp(-2.0 * u) + (c - b * u) * std::exp(-u) - head) / std::pow(u, k);
  double tail = 0.0;
  for (int n = k; n < k + 30; ++n) {
    tail += power * (a * double_power + b * n + c);
    power *= -u / (n + 1);
    double_power *= 2.0;
  }
  return tail;
}

}  // namespace detail

/// The highest derivative is an Ornstein–Uhlenbeck process, that is first-order Gauss–Markov: it has the stationary
/// standard deviation σ and forgets at the rate θ (1/s), d = −θ (d − m) dt + √(2θ) σ dW. Order 1: the position wanders
/// about a point (σ in m). Order 2: the velocity (σ in m/s) does, as of ships (Millefiori et al. 2016). Order 3: the
/// acceleration (σ in m/s²), the model of Singer (1970), whose α is θ.
///
/// With u = θT, F_s and Q_s are the exact integrals (Bar-Shalom, Li, Kirubarajan 2001, 8.2.3), for any u ≥ 0:
/// F_s(a, last) = Tᵖ (1, (1 − e⁻ᵘ)/u, (u − 1 + e⁻ᵘ)/u²) for p = order − 1 − a = 0 … with e⁻ᵘ for p = 0. A known input
/// is the level m about which the highest derivative wanders.
template <int Order>
class OrnsteinUhlenbeck {
  static_assert(Order >= 1 && Order <= 3, "position, velocity or acceleration wanders");

 public:
  static constexpr int order = Order;

  /// Throws std::invalid_argument unless θ and σ are finite and not negative.
  OrnsteinUhlenbeck(double theta, double sigma)
      : theta_(detail::motion_parameter(theta, "the rate", name())),
        sigma_(detail::motion_parameter(sigma, "sigma", name())) {}

  double theta() const { return theta_; }
  double sigma() const { return sigma_; }
  std::string_view name() const { return Order == 1 ? "ou_position" : Order == 2 ? "ou_velocity" : "singer"; }

  SquareMatrix<Order> transition(double dt) const {
    const double u = theta_ * dt;
    SquareMatrix<Order> F = SquareMatrix<Order>::Identity();
    for (Eigen::Index a = 0; a + 1 < Order; ++a)
      for (Eigen::Index b = a + 1; b + 1 < Order; ++b) F(a, b) = dt;
    for (int p = 0; p < Order; ++p)
      F(Order - 1 - p, Order - 1) = std::pow(-dt, p) * detail::exponential_tail(u, p, 0.0, 0.0, 1.0);
    return F;
  }
  SquareMatrix<Order> process_covariance(double dt) const {
    struct Coefficients {
      double a, b, c;
    };
    // 2 ∫ of the products of the last column of F_s, as combinations of e⁻²ᵘ, u e⁻ᵘ and e⁻ᵘ: (p, r) = 00; 10, 11; 20, …
    constexpr std::array<Coefficients, 6> table{
        {{-1, 0, 0}, {1, 0, -2}, {-1, 0, 4}, {-1, 2, 0}, {1, -2, -2}, {-1, 4, 0}}};
    const double u = theta_ * dt;
    SquareMatrix<Order> Q;
    for (int p = 0; p < Order; ++p)
      for (int r = 0; r <= p; ++r) {
        const int index = p * (p + 1) / 2 + r;
        const auto& [a, b, c] = table[static_cast<std::size_t>(index)];
        Q(Order - 1 - p, Order - 1 - r) = Q(Order - 1 - r, Order - 1 - p) =
            sigma_ * sigma_ * std::pow(dt, p + r) * u * detail::exponential_tail(u, p + r + 1, a, b, c);
      }
    return Q;
  }
  Vector<Order> input_gain(double dt) const {
    const double u = theta_ * dt;
    Vector<Order> gain;
    for (int p = 0; p < Order; ++p)
      gain(Order - 1 - p) = -std::pow(-dt, p) * u * detail::exponential_tail(u, p + 1, 0.0, 0.0, 1.0);
    return gain;
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
