#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <sigmax/estimation/computed_law.hpp>

namespace sigmax {

/// How a coordinate moves, by its valid expressions; matrices are over its derivatives: position, velocity, …
///
///   Law::order                 number of derivatives, position included, 1 to 3
///   law.name()                 for people
///   law.transition(dt)         F_s, upper triangular
///   law.process_covariance(dt) Q_s
///   law.input_gain(dt)         what a known input of one adds to the derivatives
template <class Law>
concept MotionLaw = requires(const Law& law, double dt) {
  { law.name() } -> std::convertible_to<std::string_view>;
  { law.transition(dt) } -> MatrixOf<Law::order, Law::order>;
  { law.process_covariance(dt) } -> MatrixOf<Law::order, Law::order>;
  { law.input_gain(dt) } -> MatrixOf<Law::order>;
};

/// Motion along `Axes` independent axes that follow one law. States are ordered by derivative: x, y, z, vx, vy, vz, ax,
/// ay, az, in SI units. So F = F_s ⊗ I, Q = Q_s ⊗ I, and a motion of lower order has the leading states of one of
/// higher order.
template <int Axes, MotionLaw Law>
class IndependentAxes {
  static_assert(Axes >= 1 && Axes <= 3, "one to three axes");

 public:
  static constexpr int axes = Axes;
  static constexpr int order = Law::order;
  static constexpr int state_size = Axes * order;
  static constexpr int max_state_size = state_size;

  using State = Vector<state_size>;
  using Matrix = SquareMatrix<state_size>;

  explicit IndependentAxes(const Law& law, const Vector<Axes>& known_input = Vector<Axes>::Zero())
      : law_(law), input_(known_input) {}

  const Law& law() const { return law_; }
  const Vector<Axes>& input() const { return input_; }
  Eigen::Index size() const { return state_size; }
  std::string_view name() const { return law_.name(); }
  std::vector<std::string> components() const { return detail::motion_components(Axes, order); }

  Matrix transition(double dt) const { return for_all_axes(law_.transition(dt)); }
  Matrix process_covariance(double dt) const { return for_all_axes(law_.process_covariance(dt)); }
  State known_input(double dt) const {
    const Vector<order> gain = law_.input_gain(dt);
    State u;
    for (int i = 0; i < state_size; ++i) u(i) = gain(i / Axes) * input_(i % Axes);
    return u;
  }

 private:
  static Matrix for_all_axes(const SquareMatrix<order>& law) {
    Matrix result;
    detail::spread_over_axes(law.data(), order, Axes, result.data());
    return result;
  }

  Law law_;
  Vector<Axes> input_;
};

}  // namespace sigmax
