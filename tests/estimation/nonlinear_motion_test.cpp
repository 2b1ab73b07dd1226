#include "support/linearised.hpp"

namespace nonlinear_motion_test {

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

/// Of two states, with functions of these sizes: what is of another does not compile.
template <int Moved, int Noise, int Columns>
struct Shaped : Pendulum {
  Vector<Moved> propagate(const Vector<2>&, double) const { return {}; }
  SquareMatrix<Noise> process_covariance(double) const { return {}; }
  RectangularMatrix<2, Columns> transition_jacobian(const Vector<2>&, double) const { return {}; }
};
static_assert(NonlinearMotion<Shaped<2, 2, 2>> && !NonlinearMotion<Shaped<3, 2, 2>>);
static_assert(!NonlinearMotion<Shaped<2, 3, 2>> && !NonlinearMotion<Shaped<2, 2, 3>>);

// Neither does a measurement or an estimate of another size.
template <class Estimate, class Measurement>
concept Updates = requires(const Extended<Pendulum>& filter, Estimate& x, const Measurement& z) {
  predict(filter, x, 1.0, x);
  update(filter, x, z, PositionSensor<1>{}, x);
};
static_assert(Updates<Gaussian<2>, Gaussian<1>>);
static_assert(!Updates<Gaussian<2>, Gaussian<2>>);
static_assert(!Updates<Gaussian<3>, Gaussian<1>>);

const Gaussian<2> start{Vector<2>(0.3, -1.0), SquareMatrix<2>::Identity()};

struct WithJacobian : Pendulum {
  SquareMatrix<2> transition_jacobian(const Vector<2>&, double dt) const { return dt * SquareMatrix<2>::Identity(); }
};

TEST(NonlinearMotion, AGivenJacobianIsTaken) {
  EXPECT_EQ(linearised_step(Extended{WithJacobian{}}, start, 0.5).F, 0.5 * SquareMatrix<2>::Identity());
}

}  // namespace nonlinear_motion_test
