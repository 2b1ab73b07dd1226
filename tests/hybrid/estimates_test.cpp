#include "support/sigmax.hpp"

namespace estimates_test {

const Gaussian<2> narrow{Vector<2>(1.0, 2.0), SquareMatrix<2>{{3.0, 0.5}, {0.5, 4.0}}};
const Gaussian<3> wide{Vector<3>(5.0, 6.0, 7.0), SquareMatrix<3>{{8.0, 1.0, 2.0}, {1.0, 9.0, 3.0}, {2.0, 3.0, 10.0}}};

TEST(Estimates, OfSeveralSizesLieInOneRow) {
  Estimates estimates;
  estimates.add(narrow);
  estimates.add(wide);
  estimates.add(1);
  EXPECT_EQ(estimates.size(), 3U);
  EXPECT_EQ(estimates[0].mean, narrow.mean);
  EXPECT_EQ(estimates[0].covariance, narrow.covariance);
  EXPECT_EQ(estimates[1].covariance, wide.covariance);
  EXPECT_EQ(estimates[2].mean(0), 0.0);
  EXPECT_EQ(estimates.view(1).mean, estimates.view(0).covariance + 4);
}

TEST(Estimates, AreShownWhereTheyLie) {
  Estimates estimates(std::vector{narrow, narrow});
  auto second = estimates[1];
  second.mean(1) = 20.0;
  second.covariance(0, 1) = 0.25;
  EXPECT_EQ(estimates[1].mean(1), 20.0);
  EXPECT_EQ(estimates.view(1).covariance[2], 0.25) << "by columns";
  EXPECT_EQ(estimates[0].mean(1), 2.0);
  const Estimates& constant = estimates;
  static_assert(std::is_same_v<decltype(constant[0].mean), Eigen::Map<const Eigen::VectorXd>>);
  EXPECT_EQ(constant[1].mean(1), 20.0);
}

TEST(Estimates, BecomeTypedOnesOfTheirSizeOnly) {
  const Estimates estimates(std::vector{wide});
  const Gaussian<3> fixed = estimates[0];
  EXPECT_EQ(fixed.covariance, wide.covariance);
  const Gaussian<Eigen::Dynamic, 6> bounded = estimates[0];
  EXPECT_EQ(bounded.mean, wide.mean);
  using support::throws;
  EXPECT_INVALID(("3 components", "expected 4"), return Gaussian<4>(estimates[0]));
  EXPECT_INVALID(("3 components", "2"), return Gaussian<Eigen::Dynamic, 2>(estimates[0]));
}

}  // namespace estimates_test
