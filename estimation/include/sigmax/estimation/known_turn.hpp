#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <sigmax/estimation/model.hpp>
#include <sigmax/estimation/motion_numbers.hpp>

namespace sigmax {

/// A horizontal turn at a known rate ω (rad/s, counter-clockwise), driven by continuous white-noise acceleration of
/// power spectral density q = σ_w², σ_w in m/s^1.5, on every axis; linear. States x, y, vx, vy or x, y, z, vx, vy, vz,
/// where z moves as in CWNA. With θ = ωT (Bar-Shalom, Li, Kirubarajan 2001, 4.2.2 and 11.7.1; Q is the exact integral)
///
///   F = [I  T(sin θ/θ I + (1−cos θ)/θ J); 0  cos θ I + sin θ J],  J a quarter turn,
///   Q = q [2T³ s I, T² (c I − θ s J); ·, T I],  s = (θ − sin θ)/θ³,  c = (1 − cos θ)/θ².
///
/// ω = 0 is CWNA.
template <int Axes>
class KnownTurn {
  static_assert(Axes == 2 || Axes == 3, "a turn needs two axes, and may have an altitude");

 public:
  using ComputedBy = KnownTurn;
  static constexpr int axes = Axes;
  static constexpr int state_size = 2 * Axes;
  static constexpr int max_state_size = state_size;

  using State = Vector<state_size>;
  using Matrix = SquareMatrix<state_size>;

  /// Throws std::invalid_argument unless ω is finite, and σ_w finite and not negative.
  KnownTurn(double omega, double sigma_w)
      : omega_(detail::finite_rate(omega)), sigma_w_(detail::motion_parameter(sigma_w, "sigma_w", name())) {}

  double omega() const { return omega_; }
  double sigma_w() const { return sigma_w_; }
  Eigen::Index size() const { return state_size; }
  std::string_view name() const { return "known_turn"; }
  std::vector<std::string> components() const { return detail::motion_components(Axes, 2); }

  Matrix transition(double dt) const {
    Matrix F, Q;
    compute(dt, F.data(), Q.data());
    return F;
  }
  Matrix process_covariance(double dt) const {
    Matrix F, Q;
    compute(dt, F.data(), Q.data());
    return Q;
  }
  State known_input(double) const { return State::Zero(); }
  void compute(double dt, double* F, double* Q) const {
    detail::known_turn(Axes, omega_, sigma_w_ * sigma_w_, dt, F, Q);
  }

 private:
  double omega_;
  double sigma_w_;
};

}  // namespace sigmax
