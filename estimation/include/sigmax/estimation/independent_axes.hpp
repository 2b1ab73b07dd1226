#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <sigmax/estimation/kalman.hpp>
#include <sigmax/estimation/motion.hpp>

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
    for (Eigen::Index a = 0; a < order; ++a) u.template segment<Axes>(a * Axes) = gain(a) * input_;
    return u;
  }

 private:
  static Matrix for_all_axes(const SquareMatrix<order>& law) {
    Matrix result = Matrix::Zero();
    for (Eigen::Index a = 0; a < order; ++a)
      for (Eigen::Index b = 0; b < order; ++b)
        result.template block<Axes, Axes>(a * Axes, b * Axes).diagonal().setConstant(law(a, b));
    return result;
  }

  Law law_;
  Vector<Axes> input_;
};

namespace detail {

/// Prediction (27), (28) that uses F = F_s ⊗ I with F_s upper triangular: blocks are added, nothing is multiplied by
/// zero or by one. The same for all laws of this order.
template <int Axes, int Order>
void predict_axes(const SquareMatrix<Order>& f, const SquareMatrix<Order>& q, const Vector<Axes * Order>& input,
                  Gaussian<Axes * Order>& result) {
  auto& x = result.mean;
  auto& P = result.covariance;
  Vector<Axes* Order> terms = P.diagonal();  // of the variances of F P Fᵀ, before they may cancel
  // Plain loops: Eigen's expressions of all these blocks are slow to compile. Row a becomes f(a, a) · row a + …, and
  // later rows are still unchanged; then the columns likewise.
  constexpr Eigen::Index size = Axes * Order;
  for (Eigen::Index row = 0; row < size; ++row) {
    const Eigen::Index a = row / Axes;
    if (const double scale = f(a, a); scale != 1.0) {
      terms(row) *= scale * scale;
      x(row) *= scale;
      for (Eigen::Index k = 0; k < size; ++k) P(row, k) *= scale;
    }
    for (Eigen::Index b = a + 1; b < Order; ++b) {
      const Eigen::Index other = row + (b - a) * Axes;
      terms(row) += f(a, b) * f(a, b) * terms(other);
      x(row) += f(a, b) * x(other);
      for (Eigen::Index k = 0; k < size; ++k) P(row, k) += f(a, b) * P(other, k);
    }
  }
  for (Eigen::Index column = 0; column < size; ++column) {
    const Eigen::Index a = column / Axes;
    if (const double scale = f(a, a); scale != 1.0)
      for (Eigen::Index k = 0; k < size; ++k) P(k, column) *= scale;
    for (Eigen::Index b = a + 1; b < Order; ++b)
      for (Eigen::Index k = 0; k < size; ++k) P(k, column) += f(a, b) * P(k, column + (b - a) * Axes);
  }
  for (Eigen::Index i = 0; i < size; ++i) {
    x(i) += input(i);
    for (Eigen::Index b = 0; b < Order; ++b) P(i, i % Axes + b * Axes) += q(i / Axes, b);
    P(i, i) += rounding * terms(i);
  }
  detail::mirror_lower(P);
}

}  // namespace detail

/// Prediction (27), (28) that uses the structure of F. `result` may be `prior`.
template <int Axes, class Law>
void predict(const IndependentAxes<Axes, Law>& model, const EstimateOf<IndependentAxes<Axes, Law>>& prior, double dt,
             EstimateOf<IndependentAxes<Axes, Law>>& result) {
  if (&result != &prior) result = prior;
  detail::predict_axes<Axes, Law::order>(model.law().transition(dt), model.law().process_covariance(dt),
                                         model.known_input(dt), result);
}

namespace detail {

/// F_s(a, b) = Tᵇ⁻ᵃ/(b−a)!: every derivative is the integral of the next.
template <int Order>
SquareMatrix<Order> taylor_transition(double dt) {
  SquareMatrix<Order> F = SquareMatrix<Order>::Identity();
  for (Eigen::Index a = 0; a + 1 < Order; ++a) F(a, a + 1) = dt;
  if constexpr (Order == 3) F(0, 2) = 0.5 * dt * dt;
  return F;
}

}  // namespace detail

}  // namespace sigmax
