#include "support/sigmax.hpp"

namespace metrics_test {

TEST(Metrics, TheRootMeanSquareIsThat) {
  RootMeanSquare rms;
  EXPECT_EQ(rms.count(), 0U);
  EXPECT_EQ(rms.value(), 0.0);
  rms.add(3.0);
  rms.add(-4.0);
  EXPECT_CLOSE(rms.value(), std::sqrt(12.5), 1e-15);
  rms.add_square(11.0);
  EXPECT_EQ(rms.count(), 3U);
  EXPECT_CLOSE(rms.value(), std::sqrt(12.0), 1e-15);
}

TEST(Metrics, TheNormalizedErrorByHand) {
  const SquareMatrix<2> P{{4.0, 0.0}, {0.0, 9.0}};
  EXPECT_CLOSE((normalized_error_squared<2, 2>(Vector<2>{2.0, 6.0}, P)), 1.0 + 4.0, 1e-15);
  EXPECT_CLOSE(nees(Gaussian<2>{Vector<2>{3.0, 3.0}, P}, Vector<2>{1.0, -3.0}), 5.0, 1e-15);
}

TEST(Metrics, RefusesACovarianceThatIsNotPositiveDefinite) {
  const Gaussian<2> estimate{Vector<2>{1.0, 1.0}, SquareMatrix<2>{{1.0, 2.0}, {2.0, 1.0}}};
  EXPECT_REFUSED(std::domain_error, ("positive definite"), nees(estimate, Vector<2>(0.0, 0.0)));
}

}  // namespace metrics_test
