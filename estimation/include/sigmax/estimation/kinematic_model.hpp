#pragma once

#include <array>
#include <cassert>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <sigmax/estimation/kalman.hpp>
#include <sigmax/estimation/model.hpp>
#include <sigmax/estimation/motion.hpp>

namespace sigmax {

/// Motion along `Axes` independent axes driven by discrete white noise, section VI.B: position and velocity (order 2,
/// DWNA), and acceleration (order 3, DWPA). `Order` may be Eigen::Dynamic: the run-time model of programs.
///
/// States are ordered by derivative: x, y, z, vx, vy, vz, ax, ay, az. So F = F_s ⊗ I, and a model of lower order has
/// the leading states of one of higher order. SI units. For each axis
///
///   F_s(a, b) = Tᵇ⁻ᵃ/(b−a)!,   G_s = [T²/2, T, 1] cut to the order,   Q = G_s G_sᵀ σ_w²,   H_s = [1, 0, …].
///
/// σ_w is an acceleration (m/s²) for DWNA, but an acceleration *increment per step* for DWPA: equal numbers do not mean
/// equal noise. A known input u (same units) enters as w does: x += (G_s ⊗ I) u.
template <int Axes, int Order>
class KinematicModel {
  static_assert(Axes >= 1 && Axes <= 3, "one to three axes");
  static_assert(Order == 2 || Order == 3 || Order == Eigen::Dynamic, "position and velocity, or also acceleration");

 public:
  static constexpr int axes = Axes;
  static constexpr int state_size = Order == Eigen::Dynamic ? Eigen::Dynamic : Axes * Order;
  static constexpr int max_state_size = Axes * (Order == Eigen::Dynamic ? 3 : Order);
  static constexpr int measurement_size = Axes;
  static constexpr bool measures_leading_components = true;

  using State = Vector<state_size, max_state_size>;
  using Matrix = SquareMatrix<state_size, max_state_size>;

  /// Throws std::invalid_argument unless σ_w is finite and not negative, and the order is 2 or 3.
  explicit KinematicModel(double sigma_w, const Vector<Axes>& known_input = Vector<Axes>::Zero(), int order = Order)
      : sigma_w_(sigma_w), input_(known_input), order_(order) {
    if (order != 2 && order != 3) throw std::invalid_argument("a kinematic model is of order 2 or 3");
    if (!(sigma_w >= 0.0 && sigma_w <= 1e150))
      throw std::invalid_argument("sigma_w of model '" + std::string(name()) + "' is " + std::to_string(sigma_w) +
                                  "; expected a finite number that is not negative");
  }

  /// The run-time model that behaves as `model`.
  template <int FixedOrder>
    requires(Order == Eigen::Dynamic && FixedOrder != Eigen::Dynamic)
  explicit KinematicModel(const KinematicModel<Axes, FixedOrder>& model)
      : KinematicModel(model.sigma_w(), model.input(), FixedOrder) {}

  Eigen::Index size() const { return Axes * order(); }
  Eigen::Index order() const {
    if constexpr (Order == Eigen::Dynamic)
      return order_;
    else
      return Order;
  }
  double sigma_w() const { return sigma_w_; }
  const Vector<Axes>& input() const { return input_; }
  std::string_view name() const { return order() == 2 ? "dwna" : "dwpa"; }

  std::vector<std::string> components() const { return motion_components(Axes, static_cast<int>(order())); }

  /// G_s(a) and F_s(a, b) = taylor(dt)[b − a], for one axis.
  static std::array<double, 3> gain(double dt) { return {0.5 * dt * dt, dt, 1.0}; }
  static std::array<double, 3> taylor(double dt) { return {1.0, dt, 0.5 * dt * dt}; }

  Matrix transition(double dt) const {
    const auto f = taylor(dt);
    Matrix F = Matrix::Zero(size(), size());
    for (Eigen::Index row = 0; row < size(); ++row)
      for (Eigen::Index column = row; column < size(); column += Axes)
        F(row, column) = f[static_cast<std::size_t>((column - row) / Axes)];
    return F;
  }
  Matrix process_covariance(double dt) const {
    Matrix Q = Matrix::Zero(size(), size());
    add_process_covariance(dt, Q);
    return Q;
  }
  State known_input(double dt) const {
    State u = State::Zero(size());
    add_known_input(dt, u);
    return u;
  }
  RectangularMatrix<Axes, state_size, Axes, max_state_size> measurement_matrix() const {
    return RectangularMatrix<Axes, state_size, Axes, max_state_size>::Identity(Axes, size());
  }

  void add_process_covariance(double dt, Matrix& covariance) const {
    const auto g = gain(dt);
    for (Eigen::Index a = 0; a < order(); ++a)
      for (Eigen::Index b = 0; b < order(); ++b)
        covariance.template block<Axes, Axes>(a * Axes, b * Axes).diagonal().array() +=
            g[static_cast<std::size_t>(a)] * g[static_cast<std::size_t>(b)] * sigma_w_ * sigma_w_;
  }
  void add_known_input(double dt, State& state) const {
    const auto g = gain(dt);
    for (Eigen::Index a = 0; a < order(); ++a)
      state.template segment<Axes>(a * Axes) += g[static_cast<std::size_t>(a)] * input_;
  }

 private:
  double sigma_w_;
  Vector<Axes> input_;
  int order_;
};

/// Prediction (27), (28) that uses F = F_s ⊗ I: blocks are added, nothing is multiplied by zero. `result` may be
/// `prior`.
template <int Axes, int Order>
void predict(const KinematicModel<Axes, Order>& model, const EstimateOf<KinematicModel<Axes, Order>>& prior, double dt,
             EstimateOf<KinematicModel<Axes, Order>>& result) {
  const auto f = model.taylor(dt);
  const Eigen::Index order = model.order();
  if (&result != &prior) result = prior;
  auto& x = result.mean;
  auto& P = result.covariance;
  const auto for_each_term = [&](auto&& add) {  // block a += f(b − a) · block b; later blocks are still unchanged
    for (Eigen::Index a = 0; a < order; ++a)
      for (Eigen::Index b = a + 1; b < order; ++b) add(a * Axes, f[static_cast<std::size_t>(b - a)], b * Axes);
  };
  auto terms = P.diagonal().eval();  // of the variances of F P Fᵀ, before they may cancel
  for_each_term([&](Eigen::Index a, double factor, Eigen::Index b) {
    terms.template segment<Axes>(a) += factor * factor * terms.template segment<Axes>(b);
  });
  for_each_term([&](Eigen::Index a, double factor, Eigen::Index b) {
    x.template segment<Axes>(a) += factor * x.template segment<Axes>(b);
    P.template middleRows<Axes>(a) += factor * P.template middleRows<Axes>(b);
  });
  for_each_term([&](Eigen::Index a, double factor, Eigen::Index b) {
    P.template middleCols<Axes>(a) += factor * P.template middleCols<Axes>(b);
  });
  model.add_known_input(dt, x);
  model.add_process_covariance(dt, P);
  P.diagonal() += detail::rounding * terms;
  mirror_lower(P);
}

/// Discrete white noise acceleration: position and velocity; σ_w in m/s².
template <int Axes>
KinematicModel<Axes, 2> dwna(double sigma_w, const Vector<Axes>& known_acceleration = Vector<Axes>::Zero()) {
  return KinematicModel<Axes, 2>(sigma_w, known_acceleration);
}

/// Discrete Wiener process acceleration: position, velocity and acceleration; σ_w in m/s² *per step*.
template <int Axes>
KinematicModel<Axes, 3> dwpa(double sigma_w) {
  return KinematicModel<Axes, 3>(sigma_w);
}

}  // namespace sigmax
