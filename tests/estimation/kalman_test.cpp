#include "support/sigmax.hpp"

namespace kalman_test {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Measures the first of four components.
const LinearSensor<1, 4> first{RectangularMatrix<1, 4>(1.0, 0.0, 0.0, 0.0)};
FixedStepMotion<4> model_of(const SquareMatrix<4>& F, double q) {
  return {"model", {"a", "b", "c", "d"}, 1.0, F, q * SquareMatrix<4>::Identity()};
}
const auto still = model_of(SquareMatrix<4>::Identity(), 1.0);

TEST(Kalman, TheFormsThatReturnAreThoseThatWrite) {
  const auto model = dwpa<2>(1.5);
  const Gaussian<6> prior{Vector<6>{1, 2, 3, 4, 5, 6}, 2.0 * SquareMatrix<6>::Identity()};
  const Gaussian<2> z{Vector<2>{-1, 4}, SquareMatrix<2>{{2, 0.5}, {0.5, 1}}};
  Gaussian<6> predicted, updated;
  predict(model, prior, 0.7, predicted);
  update(model, predicted, z, updated);
  EXPECT_EQ(predict(model, prior, 0.7).covariance, predicted.covariance);
  EXPECT_EQ(predict(Extended{model}, prior, 0.7).mean, predicted.mean);
  EXPECT_EQ(update(model, predicted, z).mean, updated.mean);
  EXPECT_EQ(update(model, predicted, z, PositionSensor<2>{}).covariance, updated.covariance);
  EXPECT_EQ(update(Extended{model}, predicted, z, PositionSensor<2>{}).covariance, updated.covariance);

  EstimateOf<AnyModel> of_any_size;  // which the verbs choose
  predict(AnyModel{model}, {prior.mean, prior.covariance}, 0.7, of_any_size);
  EXPECT_EQ(of_any_size.covariance, predicted.covariance);
}

/// Whether a covariance is positive semi-definite, scaled to a unit diagonal, so that a small variance counts as much
/// as a large one.
testing::AssertionResult positive_semi_definite(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  restatement::Matrix P = dense(scale.asDiagonal() * covariance * scale.asDiagonal());
  for (std::size_t k = 0; k < P.rows; ++k) {  // elimination: the pivots of a positive definite matrix are positive
    P(k, k) += 1e-12;
    if (!(P(k, k) > 0.0)) return testing::AssertionFailure() << "pivot " << k << " is " << P(k, k);
    for (std::size_t i = k + 1; i < P.rows; ++i)
      for (std::size_t j = P.rows; j-- > k;) P(i, j) -= P(i, k) / P(k, k) * P(k, j);
  }
  return testing::AssertionSuccess();
}

/// Ten thousand steps with R between 1e-10 and 1e10 and steps between 1 ms and 10 s.
void stress(const AnyModel& model, const std::vector<double>& steps, const AnySensor& sensor) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> exponent(-10.0, 10.0);
  const auto n = model.size();
  EstimateOf<AnyModel> estimate{StateOf<AnyModel>::Zero(n), 1e6 * StateMatrixOf<AnyModel>::Identity(n, n)};
  MeasurementOf<AnySensor> z{Vector<2>::Zero(), SquareMatrix<2>::Zero()};
  for (std::size_t k = 0; k < 10000; ++k) {
    predict(model, estimate, steps[k % steps.size()], estimate);
    z.mean(0) = z.mean(1) = std::sin(0.01 * static_cast<double>(k));
    for (Eigen::Index i = 0; i < 2; ++i) z.covariance(i, i) = std::pow(10.0, exponent(generator));
    update(model, estimate, z, sensor, estimate);
    ASSERT_EQ(estimate.covariance, estimate.covariance.transpose()) << "at step " << k;
    ASSERT_TRUE(estimate.mean.allFinite() && estimate.covariance.allFinite()) << "at step " << k;
    if (k % 100 != 99) continue;
    ASSERT_TRUE(positive_semi_definite(estimate.covariance)) << "at step " << k;
  }
}

TEST(Kalman, CovariancesStaySymmetricAndPositiveUnderStress) {
  stress(dwpa<2>(3.0), {0.001, 10.0, 0.2}, PositionSensor<2>{});
  stress(dwna<2>(0.01), {0.001, 10.0, 0.2}, PositionSensor<2>{});
  stress(model_of(SquareMatrix<4>{{1, 1, 0.5, 0}, {0, 1, 1, 0}, {0, 0, 1, 0.2}, {0.1, 0, 0, 0.9}}, 1e-6), {1.0},
         LinearSensor<2, 4>{RectangularMatrix<2, 4>{{1, 1, 0, 0}, {0, 1, -1, 1}}});
}

/// Two positions, and velocities of the same spread, of which the sum of the positions is known as well as nothing and
/// their difference is known.
Gaussian<4> spread_along_the_diagonal(double variance) {
  SquareMatrix<4> P = SquareMatrix<4>::Zero();
  P.topLeftCorner<2, 2>().setConstant(variance);
  P.bottomRightCorner<2, 2>().setIdentity();
  return {Vector<4>::Zero(), P};
}

/// 1e16 + 1e-3 is 1e16: R has drowned in S, which is singular, and so has its second pivot of 4 if R is 2. Their
/// diagonal is raised by 128 ε.
TEST(Kalman, APivotThatDrownedInRoundingIsLifted) {
  for (const double R : {1e-3, 2.0}) {
    const Gaussian<2> z{Vector<2>(5.0, 5.0), R * SquareMatrix<2>::Identity()};
    Gaussian<4> x;
    const auto innovation = update(dwna<2>(1.0), spread_along_the_diagonal(1e16), z, x);
    const double augmented = (1e16 + R) * (1.0 + 128.0 * epsilon);
    EXPECT_EQ(innovation.covariance, (SquareMatrix<2>{{augmented, 1e16}, {1e16, augmented}}));
    EXPECT_CLOSE(1e15 * innovation.squared_distance, 2.5, 1e-9);
    EXPECT_CLOSE(innovation.log_likelihood,
                 -0.5 * std::log((augmented - 1e16) * (augmented + 1e16)) - std::log(2.0 * std::numbers::pi), 1e-3);
    for (const int axis : {0, 1}) EXPECT_NEAR(x.mean(axis), 5.0, std::sqrt(R));
    EXPECT_EQ(x.mean.tail<2>(), Vector<2>::Zero());
    EXPECT_TRUE(positive_semi_definite(x.covariance));
  }
  // Far above rounding it is S itself.
  Gaussian<4> x;
  const Gaussian<2> z{Vector<2>(5.0, 5.0), 1e-3 * SquareMatrix<2>::Identity()};
  EXPECT_EQ(update(dwna<2>(1.0), spread_along_the_diagonal(1e10), z, x).covariance(0, 0), 1e10 + 1e-3);
}

/// The squares of such residuals are no numbers, and with correlated errors their sums neither; it is far all the same.
TEST(Kalman, WhatIsBeyondAllNumbersIsInfinitelyFar) {
  const Gaussian<4> prior{Vector<4>::Zero(), 1e-6 * SquareMatrix<4>::Identity()};
  for (const double far : {1e155, 1e160, 1.797e308})
    for (const double correlation : {0.0, 0.9, -0.9})
      for (const Vector<2>& at : {Vector<2>(far, far), Vector<2>(-far, far), Vector<2>(0.0, far)}) {
        Gaussian<4> x;
        const SquareMatrix<2> R{{1e-4, 1e-4 * correlation}, {1e-4 * correlation, 1e-4}};
        const auto innovation = update(dwna<2>(1.0), prior, {at, R}, x);
        EXPECT_EQ(innovation.squared_distance, infinity);
        EXPECT_EQ(innovation.log_likelihood, -infinity);
      }
}

TEST(Kalman, RefusesAnInnovationCovarianceThatIsNotPositiveDefiniteAndNamesTheModel) {
  const Gaussian<4> certain{Vector<4>::Zero(), SquareMatrix<4>::Zero()};
  Gaussian<4> x;
  const Gaussian<2> exact{Vector<2>::Zero(), SquareMatrix<2>::Zero()};
  const Gaussian<1> impossible{Vector<1>(1.0), SquareMatrix<1>(-1.0)};
  EXPECT_REFUSED(std::domain_error, ("innovation covariance", "dwna", "not positive definite"),
                 update(dwna<2>(1.0), certain, exact, x));
  EXPECT_REFUSED(std::domain_error, ("innovation covariance", "model", "not positive definite"),
                 update(still, certain, impossible, first, x));
}

}  // namespace kalman_test
