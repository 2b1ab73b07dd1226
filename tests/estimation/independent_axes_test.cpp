#include "support/sigmax.hpp"

namespace independent_axes_test {

using restatement::kronecker;

/// A law of one's own: any upper triangular matrix.
struct Law {
  static constexpr int order = 3;
  SquareMatrix<3> F, Q;
  std::string_view name() const { return "own"; }
  SquareMatrix<3> transition(double) const { return F; }
  SquareMatrix<3> process_covariance(double) const { return Q; }
  Vector<3> input_gain(double dt) const { return Vector<3>(dt, 3.0, 1.0); }
};
static_assert(MotionLaw<Law>);
static_assert(LinearMotion<IndependentAxes<2, Law>>);
static_assert(axes_of<IndependentAxes<2, Law>> == 2);

struct OtherSize : Law {
  SquareMatrix<2> process_covariance(double) const { return SquareMatrix<2>::Identity(); }
};
static_assert(!MotionLaw<OtherSize>);

PROPERTY(IndependentAxes, EveryAxisFollowsTheLaw) {
  const Law law{fixed<3, 3>(generated(3, 3)).triangularView<Eigen::Upper>(), fixed<3, 3>(generated_covariance(3))};
  const IndependentAxes<2, Law> model{law, Vector<2>(3.0, -5.0)};
  const auto identity = restatement::identity(2);
  const auto F = kronecker(dense(law.F), identity), Q = kronecker(dense(law.Q), identity);
  require_near(model.transition(1.0), F, 0.0);
  require_near(model.process_covariance(1.0), Q, 0.0);
  const Vector<6> input(6, -10, 9, -15, 3, -5);
  RC_ASSERT(model.known_input(2.0) == input);
}

TEST(IndependentAxes, OrdersItsStatesByDerivative) {
  const IndependentAxes<3, Law> model{Law{}};
  EXPECT_EQ(model.components(), (std::vector<std::string>{"x", "y", "z", "vx", "vy", "vz", "ax", "ay", "az"}));
  EXPECT_EQ(dwna<2>(3.0).components(), (std::vector<std::string>{"x", "y", "vx", "vy"}));
  EXPECT_EQ(model.name(), "own");
  EXPECT_EQ(model.size(), 9);
  EXPECT_EQ(model.input(), (Vector<3>::Zero()));
}

}  // namespace independent_axes_test
