#include "support/sigmax.hpp"

namespace future_evidence_test {

using Matrix = Eigen::MatrixXd;
using Column = Eigen::VectorXd;

FutureEvidence evidence(const Matrix& R, const Column& r) {
  FutureEvidence result(static_cast<int>(R.cols()));
  result.add(R.data(), r.data(), static_cast<int>(R.rows()));
  return result;
}
Matrix R_of(const FutureEvidence& of) { return Eigen::Map<const Matrix>(of.R(), of.rows(), of.size()); }
Column r_of(const FutureEvidence& of) { return Eigen::Map<const Column>(of.r(), of.rows()); }

/// What it says as information: exp(yᵀu − uᵀYu/2) but for a factor.
Matrix Y_of(const FutureEvidence& of) { return R_of(of).transpose() * R_of(of); }
Column y_of(const FutureEvidence& of) { return R_of(of).transpose() * r_of(of); }

Matrix any(std::size_t rows, std::size_t columns) {
  const auto numbers = generated(rows, columns);
  return Matrix::NullaryExpr(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns),
                             [&](Eigen::Index i, Eigen::Index k) {
                               return numbers(static_cast<std::size_t>(i), static_cast<std::size_t>(k));
                             });
}

/// N(m, LLᵀ) and evidence about m make this, of which the mean is the distance from m.
struct Met {
  Column mean;
  Matrix covariance;
  double log = 0.0;
};
Met met(const FutureEvidence& told, const Matrix& L) {
  Met result{Column::Zero(L.rows()), Matrix::Zero(L.rows(), L.rows())};
  result.log = told.meet(L.data(), {result.mean.data(), result.covariance.data(), static_cast<int>(L.rows())});
  return result;
}

TEST(FutureEvidence, KnowsNothingWithoutARow) {
  const FutureEvidence nothing(2);
  EXPECT_EQ(nothing.rows(), 0);
  const Matrix L = Matrix::Identity(2, 2);
  EXPECT_CLOSE(met(nothing, L).covariance, L, 1e-15);
  EXPECT_EQ(met(nothing, L).log, 0.0);
  FutureEvidence before;
  EXPECT_EQ(nothing.carry_back(L.data(), L.data(), 2, L.data(), 2, before), 0.0);
  EXPECT_EQ(before.rows(), 0);
  EXPECT_EQ(before.size(), 2);
}

PROPERTY(FutureEvidence, AddsUpAsInformationDoesInNoMoreRowsThanComponents) {
  const Matrix A = any(2, 3), B = any(3, 3);
  const Column a = any(2, 1), b = any(3, 1);
  auto sum = evidence(A, a);
  require_near(Y_of(sum), A.transpose() * A, 1e-12);
  sum.add(evidence(B, b));
  RC_ASSERT(sum.rows() == 3);
  require_near(Y_of(sum), A.transpose() * A + B.transpose() * B, 1e-12);
  require_near(y_of(sum), A.transpose() * a + B.transpose() * b, 1e-12);
  const Matrix R = R_of(sum);
  RC_ASSERT(R(1, 0) == 0.0 && R(2, 0) == 0.0 && R(2, 1) == 0.0);
}

TEST(FutureEvidence, InOtherCoordinatesSaysTheSameOfTheSameState) {
  const Matrix R{{1.0, 2.0, 0.5, 0.0, 3.0}, {0.0, 1.0, -1.0, 2.0, 1.0}};
  auto told = evidence(R, Column::Ones(2));
  const Matrix before = R_of(told);
  const Eigen::Matrix2d A{{0.0, -2.0}, {1.0, 0.5}};  // the leading entry is no pivot
  told.transform(A.data(), 2);
  const Column u{{0.3, -0.7, 1.1, 0.2, 5.0}};
  Column moved = u;
  moved.head<2>() = A * u.head<2>();
  moved.segment<2>(2) = A * u.segment<2>(2);
  EXPECT_CLOSE(R_of(told) * moved, before * u, 1e-12);
}

/// u = offset + B x + A η: the mean of the likelihood over η.
PROPERTY(FutureEvidence, CarriedBackIsAveragedOverTheNoise) {
  const Matrix R = any(3, 3), B = any(3, 2), A = any(3, 2);
  const Column r = any(3, 1), offset = any(3, 1);
  const auto told = evidence(R, r);
  FutureEvidence before;
  const double log = told.carry_back(offset.data(), B.data(), 2, A.data(), 2, before);
  const Matrix S = Matrix::Identity(3, 3) + R * A * A.transpose() * R.transpose();
  require_near(Y_of(before), B.transpose() * R.transpose() * S.llt().solve(R * B), 1e-10);
  require_near(y_of(before), B.transpose() * R.transpose() * S.llt().solve(r - R * offset), 1e-10);
  require_near(log, -0.5 * std::log(S.determinant()), 1e-10);
}

PROPERTY(FutureEvidence, MeetsAnEstimateAsAMeasurementDoes) {
  const Matrix R = any(2, 3), L = any(3, 3).triangularView<Eigen::Lower>();
  const Column r = any(2, 1);
  const Met found = met(evidence(R, r), L);
  const Matrix P = L * L.transpose(), S = R * P * R.transpose() + Matrix::Identity(2, 2);
  const Matrix W = P * R.transpose() * S.inverse();
  require_near(found.mean, W * r, 1e-10);
  require_near(found.covariance, P - W * S * W.transpose(), 1e-10);
  require_near(found.log, -0.5 * (std::log(S.determinant()) + r.dot(S.inverse() * r)), 1e-10);
}

/// Of parts that nowhere make a wider mixture than the estimate: what their collapse makes of it has its moments.
PROPERTY(FutureEvidence, CollapsedGivesTheEstimateTheMomentsOfTheMixture) {
  const Matrix L = any(3, 3).triangularView<Eigen::Lower>();
  std::vector<FutureEvidence> parts;
  std::vector<double> weights{0.5, 0.0, 0.3, 0.2};
  for (int j = 0; j < 4; ++j) parts.push_back(evidence(Matrix::Identity(3, 3) + 0.3 * any(3, 3), 0.2 * any(3, 1)));
  Column mean = Column::Zero(3);
  Matrix square = Matrix::Zero(3, 3);
  for (std::size_t j = 0; j < 4; ++j) {
    const Met each = met(parts[j], L);
    mean += weights[j] * each.mean;
    square += weights[j] * (each.covariance + each.mean * each.mean.transpose());
  }
  FutureEvidence one, with_more;
  detail::collapse(parts, weights, L.data(), FutureEvidence(3), one);
  const Met found = met(one, L);
  require_near(found.mean, mean, 1e-9);
  require_near(found.covariance, square - mean * mean.transpose(), 1e-9);

  const auto seen = evidence(any(2, 3), any(2, 1));
  detail::collapse(parts, weights, L.data(), seen, with_more);
  require_near(Y_of(with_more), Y_of(one) + Y_of(seen), 1e-9);
  require_near(y_of(with_more), y_of(one) + y_of(seen), 1e-9);
}

TEST(FutureEvidence, SaysNothingAlongADirectionInWhichTheMixtureIsWider) {
  const Matrix L = Matrix::Identity(2, 2);
  const std::vector parts{evidence(Matrix{{2.0, 0.0}, {0.0, 1.0}}, Column{{20.0, 0.5}}),
                          evidence(Matrix{{2.0, 0.0}, {0.0, 1.0}}, Column{{-20.0, 0.5}})};
  FutureEvidence one;
  detail::collapse(parts, {0.5, 0.5}, L.data(), FutureEvidence(2), one);
  EXPECT_EQ(one.rows(), 1);
  EXPECT_CLOSE(Y_of(one), (Matrix{{0.0, 0.0}, {0.0, 1.0}}), 1e-12);
  EXPECT_CLOSE(y_of(one), (Column{{0.0, 0.5}}), 1e-12);
  detail::collapse({FutureEvidence(2), FutureEvidence(2)}, {0.5, 0.5}, L.data(), FutureEvidence(2), one);
  EXPECT_EQ(Y_of(one), Matrix::Zero(2, 2)) << "nothing was told";
}

}  // namespace future_evidence_test
