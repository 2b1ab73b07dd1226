#include <sigmax/estimation/gaussian.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace sigmax {
namespace {

TEST(Gaussian, IsAsLargeAsItsMean) {
  EXPECT_EQ((Gaussian<3>{Vector<3>::Zero(), SquareMatrix<3>::Identity()}.size()), 3);
  EXPECT_EQ(
      (Gaussian<Eigen::Dynamic, 9>{Vector<Eigen::Dynamic, 9>::Zero(6), SquareMatrix<Eigen::Dynamic, 9>::Identity(6, 6)}
           .size()),
      6);
}

TEST(Gaussian, IsFiniteOnlyIfEveryEntryIs) {
  const Gaussian<2> finite{Vector<2>{1.0, -2.0}, SquareMatrix<2>::Identity()};
  EXPECT_TRUE(detail::all_finite(finite));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    Gaussian<2> in_mean = finite;
    in_mean.mean(1) = bad;
    EXPECT_FALSE(detail::all_finite(in_mean));
    Gaussian<2> in_covariance = finite;
    in_covariance.covariance(0, 1) = bad;
    EXPECT_FALSE(detail::all_finite(in_covariance));
  }
}

TEST(Gaussian, MirroringKeepsTheLowerTriangle) {
  SquareMatrix<3> matrix{{1, 20, 30}, {4, 5, 60}, {7, 8, 9}};
  detail::mirror_lower(matrix);
  EXPECT_EQ(matrix, (SquareMatrix<3>{{1, 4, 7}, {4, 5, 8}, {7, 8, 9}}));
}

}  // namespace
}  // namespace sigmax
