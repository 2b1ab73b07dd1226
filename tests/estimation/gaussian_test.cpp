#include "support/sigmax.hpp"

namespace gaussian_test {

TEST(Gaussian, IsAsLargeAsItsMean) {
  EXPECT_EQ((Gaussian<3>{Vector<3>::Zero(), SquareMatrix<3>::Identity()}.size()), 3);
  EXPECT_EQ(
      (Gaussian<Eigen::Dynamic, 9>{Vector<Eigen::Dynamic, 9>::Zero(6), SquareMatrix<Eigen::Dynamic, 9>::Identity(6, 6)}
           .size()),
      6);
}

}  // namespace gaussian_test
