#include "support/sigmax.hpp"

namespace dense_test {

using Matrix = Eigen::MatrixXd;

/// Numbers with no pattern.
Matrix numbers(int rows, int columns) {
  return Matrix::NullaryExpr(rows, columns, [](Eigen::Index i, Eigen::Index k) {
    return std::sin(1.7 * static_cast<double>(3 * i + 5 * k) + 0.3);
  });
}

/// In columns that are longer than they need be, of which the rest is not touched.
TEST(Dense, TransposedProductsAreEigens) {
  for (const int rows : {1, 2, 9}) {
    const Matrix left = numbers(8, rows), right = numbers(10, 3), before = numbers(rows + 2, 3);
    Matrix result = before;
    detail::multiply_transposed(left.data(), 8, right.data(), 10, result.data(), rows + 2, rows, 7, 3);
    EXPECT_CLOSE(result.topRows(rows), left.topRows(7).transpose() * right.topRows(7), 1e-14);
    EXPECT_EQ(result.bottomRows(2), before.bottomRows(2));
  }
}

TEST(Dense, FactorAndSolutionAreEigens) {
  for (const int n : {1, 2, 3, 6, 11}) {
    const Matrix S = numbers(n, n) * numbers(n, n).transpose() + 0.1 * Matrix::Identity(n, n);
    const Matrix expected = S.llt().matrixL(), lower = S.triangularView<Eigen::Lower>();
    Matrix L(n, n);
    ASSERT_TRUE(detail::cholesky_factor(lower.data(), n, L.data()));
    EXPECT_CLOSE(L, expected, 1e-13);
    Eigen::VectorXd x = S.col(0);
    const Eigen::VectorXd z = x;
    detail::lower_solve(L.data(), n, x.data());
    EXPECT_CLOSE(expected * x, z, 1e-13);
    EXPECT_CLOSE(detail::normalized_error_squared(z.data(), S.data(), n), z.dot(S.llt().solve(z)), 1e-9);
  }
}

TEST(Dense, WhatIsNotPositiveDefiniteHasNoFactor) {
  Eigen::Matrix2d L;
  for (const Eigen::Matrix2d& S : {Eigen::Matrix2d{{1.0, 2.0}, {2.0, 1.0}}, Eigen::Matrix2d{{1.0, 1.0}, {1.0, 1.0}},
                                   Eigen::Matrix2d::Zero().eval()}) {
    EXPECT_FALSE(detail::cholesky_factor(S.data(), 2, L.data()));
    EXPECT_REFUSED(std::domain_error, ("not positive definite"),
                   detail::normalized_error_squared(L.data(), S.data(), 2));
  }
}

TEST(Dense, TheFactorOfNaNIsNaN) {
  const double S = not_a_number;
  double L = 0.0;
  EXPECT_TRUE(detail::cholesky_factor(&S, 1, &L));
  EXPECT_TRUE(std::isnan(L));
}

TEST(Dense, MirroringKeepsTheLowerTriangle) {
  Eigen::Matrix3d matrix{{1, 20, 30}, {4, 5, 60}, {7, 8, 9}};
  detail::mirror_lower(matrix.data(), 3);
  EXPECT_EQ(matrix, (Eigen::Matrix3d{{1, 4, 7}, {4, 5, 8}, {7, 8, 9}}));
}

TEST(Dense, ScratchHasRoomForFewAndForMany) {
  for (const int size : {0, 4, 5, 1000}) {
    detail::Scratch<4, int> room(size);
    for (int i = 0; i < size; ++i) room[i] = i;
    EXPECT_EQ(room.data(), static_cast<int*>(room));
    for (int i = 0; i < size; ++i) EXPECT_EQ(room[i], i);
  }
}

}  // namespace dense_test
