#include <sigmax/estimation/cholesky.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

namespace sigmax {
namespace {

/// A matrix of numbers with no pattern.
template <int N, int MaxN = N>
SquareMatrix<N, MaxN> positive(Eigen::Index n) {
  SquareMatrix<N, MaxN> A(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k) A(i, k) = std::sin(1.7 * static_cast<double>(3 * i + 5 * k) + 0.3);
  const SquareMatrix<N, MaxN> square = A * A.transpose();
  return square + 0.1 * SquareMatrix<N, MaxN>::Identity(n, n);
}

template <int N, int MaxN = N>
void is_eigens(Eigen::Index n) {
  const auto S = positive<N, MaxN>(n);
  const Eigen::MatrixXd expected = Eigen::MatrixXd(S).llt().matrixL();
  const auto L = detail::cholesky_factor(S);
  ASSERT_TRUE(L);
  EXPECT_LE((*L - expected).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LE((detail::lower_inverse(*L) * expected - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(), 1e-13);
  const Vector<N, MaxN> z = S.col(0);
  EXPECT_LE((expected * detail::lower_solve(*L, z) - z).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Cholesky, FactorInverseAndSolutionAreEigens) {
  is_eigens<1>(1);
  is_eigens<2>(2);
  is_eigens<3>(3);
  is_eigens<6>(6);
  is_eigens<Eigen::Dynamic, 15>(11);
}

TEST(Cholesky, OfWhatIsNotPositiveDefiniteIsNothing) {
  EXPECT_FALSE(detail::cholesky_factor(SquareMatrix<2>{{1.0, 2.0}, {2.0, 1.0}}));
  EXPECT_FALSE(detail::cholesky_factor(SquareMatrix<2>{{1.0, 1.0}, {1.0, 1.0}}));
  EXPECT_FALSE(detail::cholesky_factor(SquareMatrix<1>(0.0)));
}

TEST(Cholesky, OfNaNIsNaN) {
  const auto L = detail::cholesky_factor(SquareMatrix<1>(std::numeric_limits<double>::quiet_NaN()));
  ASSERT_TRUE(L);
  EXPECT_TRUE(std::isnan((*L)(0, 0)));
}

}  // namespace
}  // namespace sigmax
