#include "estimation/motion_laws.hpp"

namespace white_noise_test {

PROPERTY(WhiteNoise, IsTheIntegral) {
  const double sigma = number_between(0.1, 5.0), dt = number_between(0.1, 3.0);
  require_integral({2, 2, {0, 1, 0, 0}}, {2, 2, {0, 0, 0, sigma * sigma}}, cwna<1>(sigma), dt);
  require_integral({3, 3, {0, 1, 0, 0, 0, 1, 0, 0, 0}}, {3, 3, {0, 0, 0, 0, 0, 0, 0, 0, sigma * sigma}}, cwpa<1>(sigma),
                   dt);
}

TEST(WhiteNoise, AStepOfNoTimeIsNone) {
  EXPECT_EQ(cwpa<3>(2.0).transition(0.0), SquareMatrix<9>::Identity());
  EXPECT_EQ(cwpa<3>(2.0).process_covariance(0.0), SquareMatrix<9>::Zero());
}

TEST(WhiteNoise, AKnownAccelerationMovesAsInTheDiscreteModel) {
  const Vector<3> a(1.0, -2.0, 3.0);
  EXPECT_EQ(cwna<3>(1.0, a).known_input(2.0), dwna<3>(1.0, a).known_input(2.0));
  EXPECT_CLOSE(WhiteNoise<3>{1.0}.input_gain(3.0), (Vector<3>(4.5, 4.5, 3.0)), 1e-15);
}

}  // namespace white_noise_test
