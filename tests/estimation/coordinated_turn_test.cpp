#include <sigmax/estimation/coordinated_turn.hpp>

#include <gtest/gtest.h>

#include <numbers>

#include <sigmax/estimation/known_turn.hpp>

#include "estimation/motion_laws.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::generated_matrix;
using support::holds;
using support::near_matrix;
using support::number_between;
using support::require_near_matrix;
using support::throws;

static_assert(NonlinearMotion<CoordinatedTurn<2>> && axes_of<CoordinatedTurn<2>> == 2);
static_assert(NonlinearMotion<CoordinatedTurn<3>> && axes_of<CoordinatedTurn<3>> == 3);
static_assert(!LinearMotion<CoordinatedTurn<2>>);

double generated_omega() {
  return std::pow(10.0, number_between(-12.0, 0.5)) * (number_between(-1.0, 1.0) < 0.0 ? -1.0 : 1.0);
}
template <int Axes>
Vector<2 * Axes + 1> generated_state() {
  Vector<2 * Axes + 1> x = 10.0 * generated_matrix<2 * Axes + 1, 1>();
  x(2 * Axes) = number_between(0.0, 1.0) < 0.1 ? 0.0 : generated_omega();
  return x;
}

TEST(CoordinatedTurn, GivenItsRateItIsTheKnownTurn) {
  holds([] {
    const auto x = generated_state<3>();
    const double dt = number_between(0.0, 3.0);
    Vector<7> expected = x;
    expected.head<6>() = KnownTurn<3>{x(6), 1.0}.transition(dt) * x.head<6>();
    require_near_matrix((CoordinatedTurn<3>{1.0, 1.0}.propagate(x, dt)), expected, 1e-13);
  });
}

TEST(CoordinatedTurn, FliesACircle) {
  const CoordinatedTurn<2> model{0.0, 0.0};
  Vector<5> x(1000.0, 0.0, 0.0, 100.0, 0.1);  // about the origin
  const Vector<5> start = x;
  for (int k = 0; k < 10; ++k) x = model.propagate(x, 2.0 * std::numbers::pi);
  EXPECT_PRED_FORMAT3(near_matrix, x, start, 1e-11);
}

TEST(CoordinatedTurn, TwoStepsAreOne) {
  holds([] {
    const auto x = generated_state<2>();
    const double s = number_between(0.0, 2.0), t = number_between(0.0, 2.0);
    const CoordinatedTurn<2> model{1.0, 1.0};
    require_near_matrix(model.propagate(model.propagate(x, s), t), model.propagate(x, s + t), 1e-12);
  });
}

template <int Axes>
void jacobian_is_the_derivative() {
  holds([] {
    const auto x = generated_state<Axes>();
    const double dt = number_between(0.0, 3.0);
    const CoordinatedTurn<Axes> model{1.0, 1.0};
    constexpr int N = 2 * Axes + 1;
    const auto derivative =
        jacobian<N, N, N, N>([&](const DifferentiableVector<N>& state) { return model.propagate(state, dt); }, x);
    require_near_matrix(model.transition_jacobian(x, dt), derivative, 1e-10);
  });
}
TEST(CoordinatedTurn, ItsJacobianIsTheDerivativeInThePlane) { jacobian_is_the_derivative<2>(); }
TEST(CoordinatedTurn, ItsJacobianIsTheDerivativeInSpace) { jacobian_is_the_derivative<3>(); }

TEST(CoordinatedTurn, ItsJacobianIsThePrintedOne) {
  // Bar-Shalom, Li, Kirubarajan 2001, (11.7.2-4) and (11.7.2-5), states in our order.
  const double w = 0.3, T = 2.0, vx = 7.0, vy = -4.0, c = std::cos(w * T), s = std::sin(w * T);
  const double fx = (c * T * vx - s * vx / w) / w - (s * T * vy + (c - 1.0) * vy / w) / w;
  const double fy = (s * T * vx - (1.0 - c) * vx / w) / w + (c * T * vy - s * vy / w) / w;
  const SquareMatrix<5> F{{1, 0, s / w, -(1 - c) / w, fx},
                          {0, 1, (1 - c) / w, s / w, fy},
                          {0, 0, c, -s, -s * T * vx - c * T * vy},
                          {0, 0, s, c, c * T * vx - s * T * vy},
                          {0, 0, 0, 0, 1}};
  EXPECT_PRED_FORMAT3(near_matrix,
                      (CoordinatedTurn<2>{1.0, 1.0}.transition_jacobian(Vector<5>(1.0, 2.0, vx, vy, w), T)), F, 1e-13);
}

TEST(CoordinatedTurn, TheNoiseIsWhiteAccelerationAndAWienerRate) {
  const CoordinatedTurn<3> model{3.0, 0.5};
  SquareMatrix<7> Q = SquareMatrix<7>::Zero();
  Q.topLeftCorner<6, 6>() = cwna<3>(3.0).process_covariance(2.0);
  Q(6, 6) = 1.0;
  EXPECT_EQ(model.process_covariance(2.0), Q);
}

TEST(CoordinatedTurn, NamesItselfAndItsComponents) {
  const CoordinatedTurn<3> model{3.0, 0.5};
  EXPECT_EQ(model.name(), "coordinated_turn");
  EXPECT_EQ(model.components(), (std::vector<std::string>{"x", "y", "z", "vx", "vy", "vz", "omega"}));
  EXPECT_EQ(model.q(), 3.0);
  EXPECT_EQ(model.q_omega(), 0.5);
}

TEST(CoordinatedTurn, RefusesANoiseThatIsNone) {
  EXPECT_TRUE(throws<std::invalid_argument>([] { CoordinatedTurn<2>(-1.0, 1.0); }, {"q", "coordinated_turn", "-1"}));
  EXPECT_TRUE(
      throws<std::invalid_argument>([] { CoordinatedTurn<2>(1.0, -2.0); }, {"q_omega", "coordinated_turn", "-2"}));
}

}  // namespace
}  // namespace sigmax
