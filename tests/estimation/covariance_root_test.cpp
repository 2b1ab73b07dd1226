#include "support/sigmax.hpp"

namespace covariance_root_test {

using Matrix = Eigen::MatrixXd;

/// Of what is one.
Matrix root_of(const Matrix& P) {
  Matrix L = Matrix::Constant(P.rows(), P.cols(), 7.0);
  const Matrix lower = P.triangularView<Eigen::Lower>();
  EXPECT_EQ(detail::covariance_root(lower.data(), static_cast<int>(P.rows()), L.data()), 0);
  return L;
}

TEST(CovarianceRoot, IsCholeskys) {
  EXPECT_EQ(root_of(Matrix{{4, 2}, {2, 10}}), (Matrix{{2, 0}, {1, 3}}));
  EXPECT_EQ(root_of(Matrix{{0, 0}, {0, 9}}), (Matrix{{0, 0}, {0, 3}}));
  EXPECT_EQ(root_of(Matrix::Zero(3, 3)), Matrix::Zero(3, 3));
}

PROPERTY(CovarianceRoot, ItsSquareIsTheCovarianceAndSolvesWithIt) {
  const Matrix P = matrix_of(generated_covariance(5)), L = root_of(P);
  require_near(L, Matrix(L.triangularView<Eigen::Lower>()), 0.0);
  require_near(L * L.transpose(), P, 1e-13);
  const Eigen::VectorXd z = matrix_of(generated(5, 1));
  Eigen::VectorXd x = z;
  detail::solve_by_root(L.data(), 5, x.data());
  require_near(P * x, z, 1e-11);
}

/// What does not vary does not take part: of rank 2 of 4, a solution of P x = z for z in the range of P.
TEST(CovarianceRoot, OfASingularCovarianceExists) {
  holds([] {
    const Matrix A = matrix_of(generated(4, 2)), P = A * A.transpose(), L = root_of(P);
    require_near(L * L.transpose(), P, 1e-6);
  });
  const Matrix L = root_of(Matrix{{4, 0, 2}, {0, 0, 0}, {2, 0, 10}});
  Eigen::Vector3d x(10.0, 5.0, 32.0);
  detail::solve_by_root(L.data(), 3, x.data());
  EXPECT_EQ(x, Eigen::Vector3d(1.0, 0.0, 3.0));
}

/// The component that shows it, from one, and zero for what is one.
int verdict(const Matrix& P) {
  Matrix L(P.rows(), P.cols());
  return detail::covariance_root(P.data(), static_cast<int>(P.rows()), L.data());
}

TEST(CovarianceRoot, KnowsRoundingFromWhatIsNoCovariance) {
  EXPECT_EQ(verdict(Matrix{{1, 2}, {2, 1}}), 2);
  EXPECT_EQ(verdict(Matrix{{0, 1}, {1, 1}}), 2);
  EXPECT_EQ(verdict(Matrix{{1, 0}, {0, -1e-9}}), 2);
  EXPECT_EQ(verdict(Matrix{{not_a_number, 0}, {0, 1}}), 1);
  EXPECT_EQ(verdict(Matrix{{1, 0}, {0, infinity}}), 2);
  // A variance may be 1e-10 of itself too small, and a covariance with what does not vary 1e-5 of the deviations.
  EXPECT_EQ(verdict(Matrix{{1, 1}, {1, 1 - 0.9e-10}}), 0);
  EXPECT_EQ(verdict(Matrix{{1, 1}, {1, 1 - 1.1e-10}}), 2);
  const auto beside_a_copy = [](double covariance) {
    return verdict(Matrix{{1, 1, 0}, {1, 1, covariance}, {0, covariance, 4}});
  };
  EXPECT_EQ(beside_a_copy(1.9e-5), 0);
  EXPECT_EQ(beside_a_copy(2.1e-5), 3);
  // A pivot of 4n ε is rounding; what is left of a larger one is taken.
  EXPECT_EQ(root_of(Matrix{{1, 1}, {1, 1 + 1.5e-15}})(1, 1), 0.0);
  EXPECT_GT(root_of(Matrix{{1, 1}, {1, 1 + 2.5e-15}})(1, 1), 0.0);
}

TEST(CovarianceRoot, IsRefusedByName) {
  EXPECT_REFUSED(std::domain_error, ("covariance", "'dwna'", "not positive semi-definite", "component 2"),
                 detail::refuse_covariance("dwna", 2));
}

}  // namespace covariance_root_test
