#include "support/sigmax.hpp"

namespace coordinated_turn_test {

static_assert(NonlinearMotion<CoordinatedTurn<2>> && axes_of<CoordinatedTurn<2>> == 2);
static_assert(NonlinearMotion<CoordinatedTurn<3>> && axes_of<CoordinatedTurn<3>> == 3);
static_assert(!LinearMotion<CoordinatedTurn<2>>);

/// Positions and velocities of some metres, and a rate of any size and sign, or none.
template <int Axes>
Vector<2 * Axes + 1> generated_state() {
  Vector<2 * Axes + 1> x = 10.0 * generated_matrix<2 * Axes + 1, 1>();
  x(2 * Axes) = number_between(0.0, 1.0) < 0.1
                    ? 0.0
                    : std::copysign(std::pow(10.0, number_between(-12.0, 0.5)), number_between(-1.0, 1.0));
  return x;
}

PROPERTY(CoordinatedTurn, GivenItsRateItIsTheKnownTurn) {
  const auto x = generated_state<3>();
  const double dt = number_between(0.0, 3.0);
  Vector<7> expected = x;
  expected.head<6>() = KnownTurn<3>{x(6), 1.0}.transition(dt) * x.head<6>();
  require_near((CoordinatedTurn<3>{1.0, 1.0}.propagate(x, dt)), expected, 1e-13);
}

/// Bar-Shalom, Li, Kirubarajan 2001, (11.7.2-4) and (11.7.2-5), states in our order, in long double; z apart.
TEST(CoordinatedTurn, ItsJacobianIsThePrintedOneAndDoesNotCancel) {
  const double T = 2.0, vx = 7.0, vy = -4.0;
  for (const double size : {1e-4, 0.00999999, 0.0100001, 0.02, 0.3, 1.5})
    for (const double w : {size, -size}) {
      const long double r = w, c = std::cos(r * T), s = std::sin(r * T);
      const auto number = [](long double value) { return static_cast<double>(value); };
      SquareMatrix<7> F = SquareMatrix<7>::Identity();
      F(0, 3) = F(1, 4) = number(s / r);
      F(1, 3) = number((1 - c) / r);
      F(0, 4) = -F(1, 3);
      F(3, 3) = F(4, 4) = number(c);
      F(4, 3) = number(s);
      F(3, 4) = -F(4, 3);
      F(2, 5) = T;
      F(0, 6) = number((c * T * vx - s * vx / r) / r - (s * T * vy + (c - 1) * vy / r) / r);
      F(1, 6) = number((s * T * vx - (1 - c) * vx / r) / r + (c * T * vy - s * vy / r) / r);
      F(3, 6) = number(-s * T * vx - c * T * vy);
      F(4, 6) = number(c * T * vx - s * T * vy);
      EXPECT_CLOSE((CoordinatedTurn<3>{1.0, 1.0}.transition_jacobian(Vector<7>(1.0, 2.0, 3.0, vx, vy, 5.0, w), T)), F,
                   1e-11)
          << w;
      const std::array<int, 5> places{0, 1, 3, 4, 6};
      const SquareMatrix<5> plane = F(places, places);
      EXPECT_CLOSE((CoordinatedTurn<2>{1.0, 1.0}.transition_jacobian(Vector<5>(1.0, 2.0, vx, vy, w), T)), plane, 1e-11)
          << w;
    }
}

TEST(CoordinatedTurn, TheNoiseIsWhiteAccelerationAndAWienerRate) {
  SquareMatrix<7> Q = SquareMatrix<7>::Zero();
  Q.topLeftCorner<6, 6>() = cwna<3>(3.0).process_covariance(2.0);
  Q(6, 6) = 0.5;
  EXPECT_EQ((CoordinatedTurn<3>{3.0, 0.5}.process_covariance(2.0)), Q);
}

}  // namespace coordinated_turn_test
