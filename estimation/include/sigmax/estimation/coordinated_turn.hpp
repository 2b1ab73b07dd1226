#pragma once

#include <cmath>
#include <string_view>
#include <vector>

#include <sigmax/estimation/nonlinear_motion.hpp>
#include <sigmax/estimation/turn.hpp>
#include <sigmax/estimation/white_noise.hpp>

namespace sigmax {

/// A horizontal turn at a rate that is estimated with the state; not linear, so for `Extended`, `Unscented` or
/// `Cubature`. States x, y, vx, vy, ω or x, y, z, vx, vy, vz, ω, where ω ("omega", rad/s, counter-clockwise) is a
/// Wiener process and z moves uniformly.
///
/// f turns the velocity by θ = ωT and moves the position along the arc (Bar-Shalom, Li, Kirubarajan 2001, 11.7.1), and
/// is smooth at ω = 0. The noise is that of CWNA on every axis, q in m²/s³, its turning within the step neglected, and
/// q_ω T for ω, q_ω in rad²/s³.
template <int Axes>
class CoordinatedTurn {
  static_assert(Axes == 2 || Axes == 3, "a turn needs two axes, and may have an altitude");

 public:
  static constexpr int axes = Axes;
  static constexpr int state_size = 2 * Axes + 1;
  static constexpr int max_state_size = state_size;

  using State = Vector<state_size>;
  using Matrix = SquareMatrix<state_size>;

  /// Throws std::invalid_argument unless q and q_ω are finite and not negative.
  CoordinatedTurn(double q, double q_omega)
      : noise_(detail::motion_parameter(q, "q", name())),
        q_omega_(detail::motion_parameter(q_omega, "q_omega", name())) {}

  double q() const { return noise_.q(); }
  double q_omega() const { return q_omega_; }
  Eigen::Index size() const { return state_size; }
  std::string_view name() const { return "coordinated_turn"; }
  std::vector<std::string> components() const {
    auto names = detail::motion_components(Axes, 2);
    names.push_back("omega");
    return names;
  }

  template <class Scalar>
  Eigen::Matrix<Scalar, state_size, 1> propagate(const Eigen::Matrix<Scalar, state_size, 1>& x, double dt) const {
    const detail::Turn<Scalar> turn(Scalar(x(2 * Axes) * dt));
    const Scalar &vx = x(Axes), &vy = x(Axes + 1);
    Eigen::Matrix<Scalar, state_size, 1> result = x;
    result(0) += dt * (turn.along * vx - turn.across * vy);
    result(1) += dt * (turn.across * vx + turn.along * vy);
    result(Axes) = turn.cosine * vx - turn.sine * vy;
    result(Axes + 1) = turn.sine * vx + turn.cosine * vy;
    if constexpr (Axes == 3) result(2) += dt * x(5);
    return result;
  }
  Matrix transition_jacobian(const State& x, double dt) const {
    const double theta = x(2 * Axes) * dt;
    const detail::Turn<double> turn(theta);
    const double half = 0.5 * theta, ratio = detail::sinc(half), slope = detail::sinc_derivative(half);
    const double along = 0.5 * (slope * std::cos(half) - ratio * std::sin(half));  // derivatives by θ
    const double across = 0.5 * ratio * (ratio + theta * slope);
    const double vx = x(Axes), vy = x(Axes + 1);
    Matrix F = Matrix::Identity();
    F.template topLeftCorner<2 * Axes, 2 * Axes>() = detail::turn_transition<Axes>(turn, dt);
    F(0, 2 * Axes) = dt * dt * (along * vx - across * vy);
    F(1, 2 * Axes) = dt * dt * (across * vx + along * vy);
    F(Axes, 2 * Axes) = -dt * (turn.sine * vx + turn.cosine * vy);
    F(Axes + 1, 2 * Axes) = dt * (turn.cosine * vx - turn.sine * vy);
    return F;
  }
  Matrix process_covariance(double dt) const {
    Matrix Q = Matrix::Zero();
    const SquareMatrix<2> along_axis = noise_.process_covariance(dt);
    for (Eigen::Index a = 0; a < 2; ++a)
      for (Eigen::Index b = 0; b < 2; ++b)
        Q.template block<Axes, Axes>(a * Axes, b * Axes).diagonal().setConstant(along_axis(a, b));
    Q(2 * Axes, 2 * Axes) = q_omega_ * dt;
    return Q;
  }

 private:
  WhiteNoise<2> noise_;
  double q_omega_;
};

}  // namespace sigmax
