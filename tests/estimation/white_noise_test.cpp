#include "estimation/motion_laws.hpp"

namespace {

TEST(WhiteNoise, AccelerationIsThatOfTheBook) {
  const auto model = cwna<1>(3.0);
  EXPECT_EQ(model.transition(2.0), (SquareMatrix<2>{{1, 2}, {0, 1}}));
  EXPECT_EQ(model.process_covariance(2.0), (SquareMatrix<2>{{8, 6}, {6, 6}}));  // q [T³/3 T²/2; T²/2 T]
}

TEST(WhiteNoise, JerkIsThatOfTheBook) {
  const auto model = cwpa<1>(60.0);
  EXPECT_EQ(model.transition(2.0), (SquareMatrix<3>{{1, 2, 2}, {0, 1, 2}, {0, 0, 1}}));
  EXPECT_PRED_FORMAT3(near_matrix, model.process_covariance(2.0),  // q [T⁵/20 T⁴/8 T³/6; · T³/3 T²/2; · · T]
                      (SquareMatrix<3>{{96, 120, 80}, {120, 160, 120}, {80, 120, 120}}), 1e-15);
}

PROPERTY(WhiteNoise, IsTheIntegral) {
  const double q = number_between(0.1, 5.0), dt = number_between(0.1, 3.0);
  require_integral({2, 2, {0, 1, 0, 0}}, {2, 2, {0, 0, 0, q}}, cwna<1>(q), dt);
  require_integral({3, 3, {0, 1, 0, 0, 0, 1, 0, 0, 0}}, {3, 3, {0, 0, 0, 0, 0, 0, 0, 0, q}}, cwpa<1>(q), dt);
}

PROPERTY(WhiteNoise, StepsAddUp) {
  const double q = number_between(0.1, 5.0), s = generated_step(), t = generated_step();
  require_steps_to_add_up(cwna<2>(q, Vector<2>(3.0, -1.0)), s, t);
  require_steps_to_add_up(IndependentAxes<2, WhiteNoise<3>>{WhiteNoise<3>{q}, Vector<2>(3.0, -1.0)}, s, t);
}

TEST(WhiteNoise, AStepOfNoTimeIsNone) {
  EXPECT_EQ(cwpa<3>(2.0).transition(0.0), SquareMatrix<9>::Identity());
  EXPECT_EQ(cwpa<3>(2.0).process_covariance(0.0), SquareMatrix<9>::Zero());
}

TEST(WhiteNoise, AKnownAccelerationMovesAsInTheDiscreteModel) {
  const Vector<3> a(1.0, -2.0, 3.0);
  EXPECT_EQ(cwna<3>(1.0, a).known_input(2.0), dwna<3>(1.0, a).known_input(2.0));
}

TEST(WhiteNoise, ShowsItsParameters) { EXPECT_EQ(cwpa<2>(1.5).law().q(), 1.5); }

TEST(WhiteNoise, RefusesANoiseThatIsNone) {
  EXPECT_INVALID(("q", "cwna", "-1"), cwna<3>(-1.0));
  EXPECT_INVALID(("q", "cwpa", "nan"), cwpa<3>(std::nan("")));
}

}  // namespace
