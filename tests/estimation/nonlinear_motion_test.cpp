#include <sigmax/estimation/nonlinear_motion.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/unscented.hpp>

#include "support/matrices.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::near;
using support::near_matrix;
using support::throws;

/// A motion of one's own needs these expressions and no base class.
struct Pendulum {
  static constexpr int state_size = 2;
  static constexpr int max_state_size = 2;
  Eigen::Index size() const { return 2; }
  std::string_view name() const { return "pendulum"; }
  std::vector<std::string> components() const { return {"angle", "rate"}; }
  template <class Scalar>
  Eigen::Matrix<Scalar, 2, 1> propagate(const Eigen::Matrix<Scalar, 2, 1>& x, double dt) const {
    using std::sin;
    return {Scalar(x(0) + dt * x(1)), Scalar(x(1) - 9.81 * dt * sin(x(0)))};
  }
  SquareMatrix<2> process_covariance(double dt) const { return dt * SquareMatrix<2>::Identity(); }
};
static_assert(NonlinearMotion<Pendulum> && Motion<Pendulum> && !LinearMotion<Pendulum>);
static_assert(axes_of<Pendulum> == 0);
static_assert(!Motion<int>);

// A function of another size does not compile.
struct LongState : Pendulum {
  Vector<3> propagate(const Vector<2>&, double) const { return Vector<3>::Zero(); }
};
struct LongNoise : Pendulum {
  SquareMatrix<3> process_covariance(double) const { return SquareMatrix<3>::Identity(); }
};
struct WideJacobian : Pendulum {
  RectangularMatrix<2, 3> transition_jacobian(const Vector<2>&, double) const { return {}; }
};
static_assert(!NonlinearMotion<LongState>);
static_assert(!NonlinearMotion<LongNoise>);
static_assert(!NonlinearMotion<WideJacobian>);

/// Sees the angle itself, modulo a turn.
struct Angle {
  static constexpr int seen_size = 1;
  static constexpr int measurement_size = 1;
  Vector<1> measure(const Vector<1>& x) const { return Vector<1>(std::remainder(x(0), 2.0 * std::numbers::pi)); }
  SquareMatrix<1> measurement_jacobian(const Vector<1>&) const { return SquareMatrix<1>(1.0); }
  Vector<1> measurement_difference(const Vector<1>& z, const Vector<1>& predicted) const {
    return Vector<1>(std::remainder(z(0) - predicted(0), 2.0 * std::numbers::pi));
  }
};

// Neither does a measurement or an estimate of another size.
template <class Filter, class Estimate, class Measurement>
concept Updates = requires(const Filter& filter, Estimate& x, const Measurement& z) {
  update(filter, x, z, Angle{}, x);
};
static_assert(Updates<Extended<Pendulum>, Gaussian<2>, Gaussian<1>>);
static_assert(!Updates<Extended<Pendulum>, Gaussian<2>, Gaussian<2>>);
static_assert(!Updates<Extended<Pendulum>, Gaussian<3>, Gaussian<1>>);
static_assert(Updates<Unscented<Pendulum>, Gaussian<2>, Gaussian<1>>);
static_assert(!Updates<Unscented<Pendulum>, Gaussian<2>, Gaussian<2>>);
static_assert(!Updates<Unscented<Pendulum>, Gaussian<3>, Gaussian<1>>);

TEST(NonlinearMotion, AJacobianIsDifferentiatedWhereItIsNotGiven) {
  const Vector<2> x(0.3, -1.0);
  EXPECT_PRED_FORMAT3(near_matrix, transition_jacobian(Pendulum{}, x, 0.1),
                      (SquareMatrix<2>{{1.0, 0.1}, {-0.981 * std::cos(0.3), 1.0}}), 1e-15);
}

struct WithJacobian : Pendulum {
  SquareMatrix<2> transition_jacobian(const Vector<2>&, double dt) const { return dt * SquareMatrix<2>::Identity(); }
};

TEST(NonlinearMotion, AGivenJacobianIsTaken) {
  const Vector<2> x(0.3, -1.0);
  EXPECT_EQ(transition_jacobian(WithJacobian{}, x, 0.5), 0.5 * SquareMatrix<2>::Identity());
}

TEST(NonlinearMotion, ALinearMotionHasItsTransitionAsItsJacobian) {
  const auto motion = dwna<3>(2.0, Vector<3>(1.0, 2.0, 3.0));
  const Vector<6> x(1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
  EXPECT_EQ(transition_jacobian(motion, x, 0.5), motion.transition(0.5));
  EXPECT_PRED_FORMAT3(near_matrix, propagated(motion, x, 0.5), motion.transition(0.5) * x + motion.known_input(0.5),
                      1e-15);
}

/// Averages its angles as points of a circle.
struct OnACircle : Angle {
  template <class Points, class Weights>
  Vector<1> measurement_mean(const Points& points, const Weights& weights) const {
    double c = 0.0, s = 0.0;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      c += weights(i) * std::cos(points(0, i));
      s += weights(i) * std::sin(points(0, i));
    }
    return Vector<1>(std::atan2(s, c));
  }
};
/// Says that its mean is 1, whatever the points are.
struct OneAlways : Angle {
  template <class Points, class Weights>
  Vector<1> measurement_mean(const Points&, const Weights&) const {
    return Vector<1>(1.0);
  }
};

TEST(NonlinearMotion, AFilterUsesTheMeanOfItsSensor) {
  const Gaussian<2> prior{Vector<2>(3.1, 0.0), SquareMatrix<2>{{0.25, 0.0}, {0.0, 1.0}}};
  const Gaussian<1> z{Vector<1>(-3.1), SquareMatrix<1>(0.01)};
  const Unscented filter{Pendulum{}};
  Gaussian<2> x;
  // Points at 3.1 and 3.1 ± √2/2, ± 0: about 3.1 they are even, however they are averaged.
  for (const double residual :
       {update(filter, prior, z, Angle{}, x).residual(0), update(filter, prior, z, OnACircle{}, x).residual(0)})
    EXPECT_PRED_FORMAT3(near, residual, 2.0 * std::numbers::pi - 6.2, 1e-14);
  EXPECT_PRED_FORMAT3(near, update(filter, prior, z, OneAlways{}, x).residual(0), 2.0 * std::numbers::pi - 4.1, 1e-14);
}

struct Broken : Pendulum {
  Vector<2> propagate(const Vector<2>&, double dt) const { return Vector<2>(1.0 / dt, 0.0); }
  SquareMatrix<2> transition_jacobian(const Vector<2>&, double) const {
    return SquareMatrix<2>::Constant(std::nan(""));
  }
};

TEST(NonlinearMotion, RefusesWhatIsNotFiniteAndNamesTheState) {
  const Vector<2> x(-2.5, 4.0);
  EXPECT_TRUE(throws<std::domain_error>([&] { propagated(Broken{}, x, 0.0); },
                                        {"f(x)", "pendulum", "not finite", "x = (-2.5", "4.0"}));
  EXPECT_TRUE(throws<std::domain_error>([&] { transition_jacobian(Broken{}, x, 1.0); }, {"Jacobian of f", "pendulum"}));
}

}  // namespace
}  // namespace sigmax
