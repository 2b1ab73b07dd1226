#pragma once

#include <cmath>

#include <sigmax/estimation/gaussian.hpp>

namespace sigmax::detail {

/// sin x / x for any scalar type; smooth at 0, also for automatic differentiation.
template <class Scalar>
Scalar sinc(const Scalar& x) {
  using std::sin;
  if (x < 1e-2 && x > -1e-2) {
    const Scalar square = x * x;
    return Scalar(1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0)));
  }
  return Scalar(sin(x) / x);
}

/// The derivative of sin x / x.
inline double sinc_derivative(double x) {
  if (std::abs(x) < 1e-2) return -x / 3.0 * (1.0 - x * x / 10.0 * (1.0 - x * x / 28.0));
  return (std::cos(x) - sinc(x)) / x;
}

/// (x − sin x)/x³, by its series where that would cancel.
inline double cubic_remainder_of_sine(double x) {
  const double square = x * x;
  if (square > 1.0) return (x - std::sin(x)) / (square * x);
  double term = 1.0 / 6.0;
  double sum = 0.0;
  for (int n = 0; n < 10; ++n) {
    sum += term;
    term *= -square / ((2 * n + 4) * (2 * n + 5));
  }
  return sum;
}

/// What a turn at the rate ω does to a horizontal position and velocity in T seconds, with θ = ωT: the velocity turns
/// by θ, and the position moves by T (along · v + across · v turned by 90°).
template <class Scalar>
struct Turn {
  Scalar along;   ///< sin θ / θ
  Scalar across;  ///< (1 − cos θ)/θ
  Scalar cosine;
  Scalar sine;

  explicit Turn(const Scalar& theta) {
    using std::cos, std::sin;
    const Scalar half = theta / 2.0;  // by which one sine and one cosine are enough
    const Scalar half_sine = sin(half), half_cosine = cos(half), ratio = sinc(half);
    along = Scalar(ratio * half_cosine);
    across = Scalar(ratio * half_sine);
    cosine = Scalar(1.0 - 2.0 * half_sine * half_sine);
    sine = Scalar(2.0 * half_sine * half_cosine);
  }
};

/// F of a turn at a known rate for dt seconds, over x, y, vx, vy or x, y, z, vx, vy, vz; z moves uniformly.
template <int Axes>
SquareMatrix<2 * Axes> turn_transition(const Turn<double>& turn, double dt) {
  SquareMatrix<2 * Axes> F = SquareMatrix<2 * Axes>::Identity();
  const Eigen::Matrix2d position{{turn.along, -turn.across}, {turn.across, turn.along}};
  F.template block<2, 2>(0, Axes) = dt * position;
  F.template block<2, 2>(Axes, Axes) << turn.cosine, -turn.sine, turn.sine, turn.cosine;
  if constexpr (Axes == 3) F(2, 5) = dt;
  return F;
}
template <int Axes>
SquareMatrix<2 * Axes> turn_transition(double omega, double dt) {
  return turn_transition<Axes>(Turn<double>(omega * dt), dt);
}

}  // namespace sigmax::detail
