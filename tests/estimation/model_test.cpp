#include "support/sigmax.hpp"

namespace model_test {

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

/// Of one state, with functions of these sizes: what is of another does not compile.
template <int Columns, int Rows, int Input>
struct Shaped : RandomWalk {
  RectangularMatrix<1, Columns> transition(double) const { return {}; }
  RectangularMatrix<Rows, 1> process_covariance(double) const { return {}; }
  Vector<Input> known_input(double) const { return {}; }
};
static_assert(LinearMotion<Shaped<1, 1, 1>> && !LinearMotion<Shaped<2, 1, 1>>);
static_assert(!LinearMotion<Shaped<1, 2, 1>> && !LinearMotion<Shaped<1, 1, 2>>);

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

}  // namespace model_test
