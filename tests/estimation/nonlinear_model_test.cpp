#include <sigmax/estimation/nonlinear_model.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/unscented.hpp>

#include "support/matrices.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::near;
using support::near_matrix;
using support::throws;

/// A model of one's own needs these expressions and no base class: a pendulum whose sideways deflection is seen.
struct Pendulum {
  static constexpr int state_size = 2;
  static constexpr int max_state_size = 2;
  static constexpr int measurement_size = 1;
  Eigen::Index size() const { return 2; }
  std::string_view name() const { return "pendulum"; }
  std::vector<std::string> components() const { return {"angle", "rate"}; }
  template <class Scalar>
  Eigen::Matrix<Scalar, 2, 1> propagate(const Eigen::Matrix<Scalar, 2, 1>& x, double dt) const {
    using std::sin;
    return {Scalar(x(0) + dt * x(1)), Scalar(x(1) - 9.81 * dt * sin(x(0)))};
  }
  SquareMatrix<2> process_covariance(double dt) const { return dt * SquareMatrix<2>::Identity(); }
  template <class Scalar>
  Eigen::Matrix<Scalar, 1, 1> measure(const Eigen::Matrix<Scalar, 2, 1>& x) const {
    using std::sin;
    return Eigen::Matrix<Scalar, 1, 1>(Scalar(sin(x(0))));
  }
};
static_assert(NonlinearMotion<Pendulum>);
static_assert(NonlinearModel<Pendulum>);
static_assert(!LinearMotion<Pendulum>);
static_assert(!NonlinearModel<int>);

// A function of another size does not compile.
struct LongState : Pendulum {
  Vector<3> propagate(const Vector<2>&, double) const { return Vector<3>::Zero(); }
};
struct LongNoise : Pendulum {
  SquareMatrix<3> process_covariance(double) const { return SquareMatrix<3>::Identity(); }
};
struct LongMeasurement : Pendulum {
  Vector<2> measure(const Vector<2>&) const { return Vector<2>::Zero(); }
};
struct WideJacobian : Pendulum {
  RectangularMatrix<2, 3> transition_jacobian(const Vector<2>&, double) const { return {}; }
};
struct TallJacobian : Pendulum {
  SquareMatrix<2> measurement_jacobian(const Vector<2>&) const { return {}; }
};
struct LongDifference : Pendulum {
  Vector<2> measurement_difference(const Vector<1>&, const Vector<1>&) const { return Vector<2>::Zero(); }
};
static_assert(!NonlinearMotion<LongState>);
static_assert(!NonlinearMotion<LongNoise>);
static_assert(NonlinearMotion<LongMeasurement> && !NonlinearModel<LongMeasurement>);
static_assert(!NonlinearMotion<WideJacobian>);
static_assert(!NonlinearModel<TallJacobian>);
static_assert(!NonlinearModel<LongDifference>);

// Neither does a measurement or an estimate of another size.
template <class Filter, class Estimate, class Measurement>
concept Updates = requires(const Filter& filter, Estimate& x, const Measurement& z) {
  update(filter, x, z, x);
};
static_assert(Updates<Extended<Pendulum>, Gaussian<2>, Gaussian<1>>);
static_assert(!Updates<Extended<Pendulum>, Gaussian<2>, Gaussian<2>>);
static_assert(!Updates<Extended<Pendulum>, Gaussian<3>, Gaussian<1>>);
static_assert(Updates<Unscented<Pendulum>, Gaussian<2>, Gaussian<1>>);
static_assert(!Updates<Unscented<Pendulum>, Gaussian<2>, Gaussian<2>>);
static_assert(!Updates<Unscented<Pendulum>, Gaussian<3>, Gaussian<1>>);

TEST(NonlinearModel, JacobiansAreDifferentiatedWhereTheyAreNotGiven) {
  const Vector<2> x(0.3, -1.0);
  EXPECT_PRED_FORMAT3(near_matrix, transition_jacobian(Pendulum{}, x, 0.1),
                      (SquareMatrix<2>{{1.0, 0.1}, {-0.981 * std::cos(0.3), 1.0}}), 1e-15);
  EXPECT_PRED_FORMAT3(near_matrix, measurement_jacobian(Pendulum{}, x), (Eigen::RowVector2d(std::cos(0.3), 0.0)),
                      1e-15);
}

struct WithJacobians : Pendulum {
  SquareMatrix<2> transition_jacobian(const Vector<2>&, double dt) const { return dt * SquareMatrix<2>::Identity(); }
  Eigen::RowVector2d measurement_jacobian(const Vector<2>& x) const { return x.transpose(); }
};

TEST(NonlinearModel, AGivenJacobianIsTaken) {
  const Vector<2> x(0.3, -1.0);
  EXPECT_EQ(transition_jacobian(WithJacobians{}, x, 0.5), 0.5 * SquareMatrix<2>::Identity());
  EXPECT_EQ(measurement_jacobian(WithJacobians{}, x), x.transpose());
}

/// Sees the angle itself, modulo a turn.
struct Circular : Pendulum {
  Vector<1> measure(const Vector<2>& x) const { return Vector<1>(std::remainder(x(0), 2.0 * std::numbers::pi)); }
  Eigen::RowVector2d measurement_jacobian(const Vector<2>&) const { return {1.0, 0.0}; }
  Vector<1> measurement_difference(const Vector<1>& z, const Vector<1>& predicted) const {
    return Vector<1>(std::remainder(z(0) - predicted(0), 2.0 * std::numbers::pi));
  }
};
/// Averages its angles as points of a circle.
struct OnACircle : Circular {
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

TEST(NonlinearModel, DifferencesAndMeansAreItsOwn) {
  const double pi = std::numbers::pi;
  const Vector<1> a(3.0), b(-3.0);
  EXPECT_EQ(measurement_difference(Pendulum{}, a, b), Vector<1>(6.0));
  EXPECT_PRED_FORMAT3(near, measurement_difference(Circular{}, a, b)(0), 6.0 - 2.0 * pi, 1e-15);

  const Eigen::RowVector2d points(3.0, -3.0);
  const Vector<2> halves(0.5, 0.5), uneven(0.25, 0.75);
  EXPECT_PRED_FORMAT3(near, measurement_mean(Pendulum{}, points, uneven)(0), -1.5, 1e-15);
  EXPECT_PRED_FORMAT3(near, measurement_mean(Circular{}, points, halves)(0), pi, 1e-15);
  EXPECT_PRED_FORMAT3(near, measurement_mean(Circular{}, points, uneven)(0), 3.0 + 0.75 * (2.0 * pi - 6.0), 1e-15);
  EXPECT_PRED_FORMAT3(near, measurement_mean(OnACircle{}, points, uneven)(0),
                      std::atan2(-0.5 * std::sin(3.0), std::cos(3.0)), 1e-15);
}

TEST(NonlinearModel, AFilterUsesItsMean) {
  const Gaussian<2> prior{Vector<2>(3.1, 0.0), SquareMatrix<2>{{0.25, 0.0}, {0.0, 1.0}}};
  const Gaussian<1> z{Vector<1>(-3.1), SquareMatrix<1>(0.01)};
  Gaussian<2> x;
  // Points at 3.1 and 3.1 ± √2/2, ± 0: about 3.1 they are even, however they are averaged.
  for (const double residual : {update(Unscented{Circular{}}, prior, z, x).residual(0),
                                update(Unscented{OnACircle{}}, prior, z, x).residual(0)})
    EXPECT_PRED_FORMAT3(near, residual, 2.0 * std::numbers::pi - 6.2, 1e-14);
}

struct Broken : Pendulum {
  Vector<2> propagate(const Vector<2>&, double dt) const { return Vector<2>(1.0 / dt, 0.0); }
  Vector<1> measure(const Vector<2>& x) const { return Vector<1>(std::log(x(0))); }
  SquareMatrix<2> transition_jacobian(const Vector<2>&, double) const {
    return SquareMatrix<2>::Constant(std::nan(""));
  }
  Eigen::RowVector2d measurement_jacobian(const Vector<2>&) const { return {std::nan(""), 0.0}; }
};

TEST(NonlinearModel, RefusesWhatIsNotFiniteAndNamesTheState) {
  const Vector<2> x(-2.5, 4.0);
  EXPECT_TRUE(throws<std::domain_error>([&] { propagated(Broken{}, x, 0.0); },
                                        {"f(x)", "pendulum", "not finite", "x = (-2.5", "4.0"}));
  EXPECT_TRUE(throws<std::domain_error>([&] { predicted_measurement(Broken{}, x); }, {"h(x)", "pendulum", "-2.5"}));
  EXPECT_TRUE(throws<std::domain_error>([&] { transition_jacobian(Broken{}, x, 1.0); }, {"Jacobian of f", "pendulum"}));
  EXPECT_TRUE(throws<std::domain_error>([&] { measurement_jacobian(Broken{}, x); }, {"Jacobian of h", "pendulum"}));
}

}  // namespace
}  // namespace sigmax
