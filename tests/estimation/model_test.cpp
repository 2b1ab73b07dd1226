#include <sigmax/estimation/model.hpp>

#include <gtest/gtest.h>

#include <type_traits>

#include <sigmax/estimation/any_model.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/fixed_step_motion.hpp>

namespace sigmax {
namespace {

/// A motion of one's own needs these expressions and no base class.
struct RandomWalk {
  static constexpr int state_size = 1;
  static constexpr int max_state_size = 1;
  Eigen::Index size() const { return 1; }
  std::string_view name() const { return "random walk"; }
  std::vector<std::string> components() const { return {"x"}; }
  SquareMatrix<1> transition(double) const { return SquareMatrix<1>::Identity(); }
  SquareMatrix<1> process_covariance(double dt) const { return dt * SquareMatrix<1>::Identity(); }
  Vector<1> known_input(double) const { return Vector<1>::Zero(); }
};

struct Nameless : RandomWalk {
  void name() const {}
};

// A matrix of another size does not compile.
struct WideTransition : RandomWalk {
  RectangularMatrix<1, 2> transition(double) const { return RectangularMatrix<1, 2>::Zero(); }
};
struct TallNoise : RandomWalk {
  RectangularMatrix<2, 1> process_covariance(double) const { return RectangularMatrix<2, 1>::Zero(); }
};
struct LongInput : RandomWalk {
  Vector<2> known_input(double) const { return Vector<2>::Zero(); }
};
static_assert(!LinearMotion<WideTransition>);
static_assert(!LinearMotion<TallNoise>);
static_assert(!LinearMotion<LongInput>);

using Dwna = IndependentAxes<3, DiscreteWhiteNoise<2>>;

static_assert(LinearMotion<RandomWalk>);
static_assert(LinearMotion<FixedStepMotion<4>>);
static_assert(LinearMotion<Dwna>);
static_assert(StateModel<AnyModel> && !LinearMotion<AnyModel>);
static_assert(!StateModel<int> && !LinearMotion<int>);
static_assert(!StateModel<Nameless> && !LinearMotion<Nameless>);

static_assert(std::is_same_v<EstimateOf<Dwna>, Gaussian<6>>);
static_assert(std::is_same_v<StateOf<Dwna>, Vector<6>>);
static_assert(std::is_same_v<StateMatrixOf<Dwna>, SquareMatrix<6>>);
static_assert(std::is_same_v<EstimateOf<AnyModel>, Gaussian<Eigen::Dynamic, 32>>);

TEST(Model, SaysAlongHowManyAxesItKnowsItsPositionOrNothing) {
  EXPECT_EQ(axes_of<Dwna>, 3);
  EXPECT_EQ(axes_of<RandomWalk>, 0);
  EXPECT_EQ(axes_of<FixedStepMotion<4>>, 0);
}

}  // namespace
}  // namespace sigmax
