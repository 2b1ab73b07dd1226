#include "support/sigmax.hpp"

namespace discrete_white_noise_test {

TEST(DiscreteWhiteNoise, IsThatOfThePaperAtFiveHertz) {
  EXPECT_CLOSE(dwna<1>(3.0).transition(0.2), (SquareMatrix<2>{{1, 0.2}, {0, 1}}), 1e-15);
  EXPECT_CLOSE(dwna<1>(3.0).process_covariance(0.2), (SquareMatrix<2>{{0.0036, 0.036}, {0.036, 0.36}}), 1e-15);
  EXPECT_CLOSE(dwpa<1>(3.0).transition(0.2), (SquareMatrix<3>{{1, 0.2, 0.02}, {0, 1, 0.2}, {0, 0, 1}}), 1e-15);
  EXPECT_CLOSE(dwpa<1>(3.0).process_covariance(0.2),
               (SquareMatrix<3>{{0.0036, 0.036, 0.18}, {0.036, 0.36, 1.8}, {0.18, 1.8, 9}}), 1e-15);
}

TEST(DiscreteWhiteNoise, AKnownAccelerationEntersAsTheNoiseDoes) {
  const auto model = dwna<2>(0.0, Vector<2>{3.0, -5.0});
  EXPECT_EQ(model.known_input(2.0), (Vector<4>{6.0, -10.0, 6.0, -10.0}));
  const Gaussian<4> start{Vector<4>{1.0, 2.0, 10.0, 20.0}, SquareMatrix<4>::Identity()};
  EXPECT_EQ(predict(model, start, 2.0).mean, (Vector<4>{27.0, 32.0, 16.0, 10.0}));
}

}  // namespace discrete_white_noise_test
