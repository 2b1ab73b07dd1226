#include <sigmax/estimation/independent_axes.hpp>

#include <gtest/gtest.h>

#include <sigmax/estimation/discrete_white_noise.hpp>

#include "estimation/motion_laws.hpp"

namespace sigmax {
namespace {

using support::fixed;
using support::generated;
using support::generated_covariance;
using support::generated_matrix;
using support::holds;
using support::number_between;
using support::require_dense_prediction;
using support::require_near_matrix;

/// A law of one's own: any upper triangular matrix.
struct Law {
  static constexpr int order = 3;
  SquareMatrix<3> F, Q;
  std::string_view name() const { return "own"; }
  SquareMatrix<3> transition(double) const { return F; }
  SquareMatrix<3> process_covariance(double) const { return Q; }
  Vector<3> input_gain(double dt) const { return Vector<3>::Constant(dt); }
};
static_assert(MotionLaw<Law>);
static_assert(LinearMotion<IndependentAxes<2, Law>>);
static_assert(axes_of<IndependentAxes<2, Law>> == 2);

struct OtherSize : Law {
  SquareMatrix<2> process_covariance(double) const { return SquareMatrix<2>::Identity(); }
};
static_assert(!MotionLaw<OtherSize>);

Law generated_law() {
  return {fixed<3, 3>(generated(3, 3)).triangularView<Eigen::Upper>(), fixed<3, 3>(generated_covariance(3))};
}

TEST(IndependentAxes, EveryAxisFollowsTheLaw) {
  holds([] {
    const Law law = generated_law();
    const auto identity = restatement::identity(2);
    const IndependentAxes<2, Law> model{law, Vector<2>(3.0, -5.0)};
    require_near_matrix(model.transition(1.0), restatement::kronecker(support::dense(law.F), identity), 0.0);
    require_near_matrix(model.process_covariance(1.0), restatement::kronecker(support::dense(law.Q), identity), 0.0);
    RC_ASSERT(model.known_input(2.0) == (Vector<6>{6, -10, 6, -10, 6, -10}));
  });
}

TEST(IndependentAxes, PredictionIsTheFormula) {
  holds([] {
    require_dense_prediction(IndependentAxes<1, Law>{generated_law(), generated_matrix<1, 1>()}, 0.7);
    require_dense_prediction(IndependentAxes<3, Law>{generated_law(), generated_matrix<3, 1>()}, 0.7);
  });
}

TEST(IndependentAxes, SharesTheNamesOfOthersOfItsOrder) {
  EXPECT_EQ((IndependentAxes<3, Law>{Law{}}.components()), dwpa<3>(1.0).components());
  EXPECT_EQ((IndependentAxes<3, Law>{Law{}}.name()), "own");
}

}  // namespace
}  // namespace sigmax
