#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <sigmax/estimation/model.hpp>
#include <sigmax/estimation/motion_numbers.hpp>

namespace sigmax {

/// A horizontal turn at a rate that is estimated with the state; not linear, so for `Extended`, `Unscented` or
/// `Cubature`. States x, y, vx, vy, ω or x, y, z, vx, vy, vz, ω, where ω ("omega", rad/s, counter-clockwise) is a
/// Wiener process and z moves uniformly.
///
/// f turns the velocity by θ = ωT and moves the position along the arc (Bar-Shalom, Li, Kirubarajan 2001, 11.7.1), and
/// is smooth at ω = 0. The noise is that of CWNA on every axis, σ_w in m/s^1.5, its turning within the step neglected,
/// and of variance σ_ω² T for ω, σ_ω in rad/s^1.5.
template <int Axes>
class CoordinatedTurn {
  static_assert(Axes == 2 || Axes == 3, "a turn needs two axes, and may have an altitude");

 public:
  using ComputedBy = CoordinatedTurn;
  static constexpr int axes = Axes;
  static constexpr int state_size = 2 * Axes + 1;
  static constexpr int max_state_size = state_size;

  using State = Vector<state_size>;
  using Matrix = SquareMatrix<state_size>;

  /// Throws std::invalid_argument unless σ_w and σ_ω are finite and not negative.
  CoordinatedTurn(double sigma_w, double sigma_omega)
      : sigma_w_(detail::motion_parameter(sigma_w, "sigma_w", name())),
        sigma_omega_(detail::motion_parameter(sigma_omega, "sigma_omega", name())) {}

  double sigma_w() const { return sigma_w_; }
  double sigma_omega() const { return sigma_omega_; }
  Eigen::Index size() const { return state_size; }
  std::string_view name() const { return "coordinated_turn"; }
  std::vector<std::string> components() const {
    auto names = detail::motion_components(Axes, 2);
    names.push_back("omega");
    return names;
  }

  State propagate(const State& x, double dt) const {
    State image;
    compute(x.data(), dt, image.data(), nullptr, nullptr);
    return image;
  }
  Matrix transition_jacobian(const State& x, double dt) const {
    State image;
    Matrix F;
    compute(x.data(), dt, image.data(), F.data(), nullptr);
    return F;
  }
  Matrix process_covariance(double dt) const {
    State image = State::Zero();
    Matrix Q;
    compute(image.data(), dt, image.data(), nullptr, Q.data());
    return Q;
  }
  void compute(const double* x, double dt, double* image, double* F, double* Q) const {
    detail::coordinated_turn(Axes, sigma_w_ * sigma_w_, sigma_omega_ * sigma_omega_, x, dt, image, F, Q);
  }

 private:
  double sigma_w_;
  double sigma_omega_;
};

}  // namespace sigmax
