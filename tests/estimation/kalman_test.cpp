#include <sigmax/estimation/kalman.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/fixed_step_motion.hpp>

#include "support/matrices.hpp"
#include "support/restatement.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using restatement::transposed;
using support::dense;
using support::fixed;
using support::generated;
using support::generated_covariance;
using support::generated_gaussian;
using support::holds;
using support::near;
using support::near_matrix;
using support::require_near;
using support::require_near_matrix;
using support::throws;

using Dense = restatement::Matrix;
using Model = FixedStepMotion<4>;
using Sensor = LinearSensor<2, 4>;
using SensorOfOne = LinearSensor<1, 4>;  // measures one number

const std::vector<std::string> components{"a", "b", "c", "d"};

/// One step of 1 s, by matrices in the restatement's terms.
Model model_of(const Dense& F, const Dense& Q, const Vector<4>& u = Vector<4>::Zero()) {
  return {"model", components, 1.0, fixed<4, 4>(F), fixed<4, 4>(Q), u};
}
const Model still = model_of(restatement::identity(4), restatement::identity(4));
Sensor measuring(const Dense& H) { return Sensor{fixed<2, 4>(H)}; }
SensorOfOne measuring_one(const Dense& H) { return SensorOfOne{fixed<1, 4>(H)}; }
Dense row(const Dense& matrix, std::size_t i) {
  Dense result(1, matrix.columns);
  for (std::size_t j = 0; j < matrix.columns; ++j) result(0, j) = matrix(i, j);
  return result;
}

Gaussian<1> scalar(double mean, double variance) { return {Vector<1>{mean}, SquareMatrix<1>{variance}}; }

TEST(Kalman, OneNumberByHand) {
  Gaussian<4> estimate{Vector<4>::Zero(), SquareMatrix<4>::Identity()};
  predict(still, estimate, 1.0, estimate);
  EXPECT_PRED_FORMAT3(near, estimate.covariance(0, 0), 2.0, 1e-13);  // 128 ε more, for rounding
  const auto innovation = update(still, estimate, scalar(4.0, 2.0), measuring_one(Dense(1, 4, {1, 0, 0, 0})), estimate);
  EXPECT_EQ(innovation.residual(0), 4.0);
  EXPECT_PRED_FORMAT3(near, innovation.covariance(0, 0), 4.0, 1e-13);
  EXPECT_PRED_FORMAT3(near, innovation.squared_distance, 4.0, 1e-13);
  EXPECT_PRED_FORMAT3(near, innovation.log_likelihood, -2.0 - 0.5 * std::log(8.0 * std::numbers::pi), 1e-13);
  EXPECT_PRED_FORMAT3(near_matrix, estimate.mean, (Vector<4>{2, 0, 0, 0}), 1e-13);
  EXPECT_PRED_FORMAT3(near_matrix, estimate.covariance.diagonal(), (Vector<4>{1, 2, 2, 2}), 1e-13);
}

TEST(Kalman, PredictionIsTheFormula) {
  holds([] {
    const auto F = generated(4, 4), u = generated(4, 1), Q = generated_covariance(4);
    const auto prior = generated_gaussian<4>();
    Gaussian<4> predicted;
    predict(model_of(F, Q, fixed<4, 1>(u)), prior, 1.0, predicted);
    require_near_matrix(predicted.mean, F * dense(prior.mean) + u, 1e-12);
    require_near_matrix(predicted.covariance, F * dense(prior.covariance) * transposed(F) + Q, 1e-12);
    RC_ASSERT(predicted.covariance == predicted.covariance.transpose());
  });
}

TEST(Kalman, JosephsFormEqualsThePrintedOne) {
  holds([] {
    const auto H = generated(2, 4);
    const auto prior = generated_gaussian<4>();
    const auto z = generated_gaussian<2>();
    Gaussian<4> posterior;
    const auto innovation = update(still, prior, z, measuring(H), posterior);

    const auto P = dense(prior.covariance), x = dense(prior.mean);
    const auto S = H * P * transposed(H) + dense(z.covariance);         // (31)
    const auto W = P * transposed(H) * restatement::inverse(S).matrix;  // (32)
    const auto nu = dense(z.mean) - H * x;
    require_near_matrix(innovation.residual, nu, 1e-12);
    require_near_matrix(innovation.covariance, S, 1e-12);
    require_near_matrix(posterior.mean, x + W * nu, 1e-11);                       // (29)
    require_near_matrix(posterior.covariance, P - W * S * transposed(W), 1e-11);  // (30)
    RC_ASSERT(posterior.covariance == posterior.covariance.transpose());

    // log N(ν; 0, S) with the inverse and the determinant of a 2 × 2 matrix by hand.
    const double determinant = S(0, 0) * S(1, 1) - S(0, 1) * S(1, 0);
    const double a = nu(0, 0), b = nu(1, 0);
    const double squared = (S(1, 1) * a * a - 2.0 * S(0, 1) * a * b + S(0, 0) * b * b) / determinant;
    require_near(innovation.squared_distance, squared, 1e-10);
    require_near(innovation.log_likelihood, -0.5 * squared - std::log(2.0 * std::numbers::pi * std::sqrt(determinant)),
                 1e-10);
  });
}

template <int Order>
void leading_components() {
  holds([] {
    constexpr int N = 2 * Order;
    using Moves = IndependentAxes<2, DiscreteWhiteNoise<Order>>;
    const Moves moves{DiscreteWhiteNoise<Order>{1.0}};
    const auto prior = generated_gaussian<N>();
    const auto z = generated_gaussian<2>();
    Gaussian<N> posterior;
    const auto innovation = update(moves, prior, z, posterior);

    Dense H(2, N);
    H(0, 0) = H(1, 1) = 1.0;
    const auto P = dense(prior.covariance), x = dense(prior.mean);
    const auto S = H * P * transposed(H) + dense(z.covariance);
    const auto S_inverse = restatement::inverse(S);
    const auto W = P * transposed(H) * S_inverse.matrix;
    const auto nu = dense(z.mean) - H * x;
    const double squared = (transposed(nu) * S_inverse.matrix * nu)(0, 0);
    require_near_matrix(innovation.residual, nu, 1e-12);
    require_near_matrix(innovation.covariance, S, 1e-12);
    require_near(innovation.squared_distance, squared, 1e-11);
    require_near(innovation.log_likelihood,
                 -0.5 * (squared + S_inverse.log_determinant) - std::log(2.0 * std::numbers::pi), 1e-11);
    require_near_matrix(posterior.mean, x + W * nu, 1e-11);
    require_near_matrix(posterior.covariance, P - W * S * transposed(W), 1e-11);
    RC_ASSERT(posterior.covariance == posterior.covariance.transpose());

    using RunTime = Extended<AnyMotion<6, Moves>>;
    EstimateOf<RunTime> run_time{prior.mean, prior.covariance};
    const auto same = update(RunTime{moves}, run_time, z, run_time);
    require_near_matrix(run_time.mean, posterior.mean, 1e-13);
    require_near_matrix(run_time.covariance, posterior.covariance, 1e-13);
    require_near(same.log_likelihood, innovation.log_likelihood, 1e-13);
  });
}

TEST(Kalman, SkippingTheZerosOfHChangesNothing) {
  leading_components<2>();
  leading_components<3>();
}

TEST(Kalman, IsInvariantUnderInvertibleStateChanges) {
  holds([] {
    // Unit lower times unit upper triangular: well conditioned, and neither orthogonal nor diagonal.
    auto lower = generated(4, 4), upper = generated(4, 4);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        lower(i, j) = i > j ? 0.5 * lower(i, j) : i == j ? 1.0 : 0.0;
        upper(i, j) = i < j ? 0.5 * upper(i, j) : i == j ? 1.0 : 0.0;
      }
    const auto T = lower * upper;
    const auto T_inverse = restatement::inverse(T).matrix;

    const auto F = generated(4, 4), H = generated(2, 4), Q = generated_covariance(4);
    const auto start = generated_gaussian<4>();
    const auto z = generated_gaussian<2>();
    const auto model = model_of(F, Q), changed = model_of(T * F * T_inverse, T * Q * transposed(T));

    Gaussian<4> here = start;
    Gaussian<4> there{fixed<4, 1>(T * dense(start.mean)), fixed<4, 4>(T * dense(start.covariance) * transposed(T))};
    predict(model, here, 1.0, here);
    predict(changed, there, 1.0, there);
    const auto innovation = update(model, here, z, measuring(H), here);
    const auto innovation_there = update(changed, there, z, measuring(H * T_inverse), there);
    require_near_matrix(there.mean, T * dense(here.mean), 1e-9);
    require_near_matrix(there.covariance, T * dense(here.covariance) * transposed(T), 1e-9);
    require_near(innovation_there.log_likelihood, innovation.log_likelihood, 1e-9);
  });
}

TEST(Kalman, IndependentMeasurementsOneByOneAreTheBatch) {
  holds([] {
    const auto H = generated(2, 4);
    const auto prior = generated_gaussian<4>();
    auto z = generated_gaussian<2>();
    z.covariance(0, 1) = z.covariance(1, 0) = 0.0;
    Gaussian<4> batch, sequential;
    const auto both = update(still, prior, z, measuring(H), batch);
    const auto one = [&](const Gaussian<4>& before, Eigen::Index i) {
      return update(still, before, scalar(z.mean(i), z.covariance(i, i)),
                    measuring_one(row(H, static_cast<std::size_t>(i))), sequential);
    };
    const auto first = one(prior, 0);
    const auto second = one(sequential, 1);
    require_near_matrix(sequential.mean, batch.mean, 1e-10);
    require_near_matrix(sequential.covariance, batch.covariance, 1e-10);
    require_near(first.log_likelihood + second.log_likelihood, both.log_likelihood, 1e-10);
  });
}

TEST(Kalman, UpdateMayOverwriteItsPrior) {
  const auto model = dwpa<2>(1.0);
  SquareMatrix<6> P = SquareMatrix<6>::Constant(0.5);
  P.diagonal().setConstant(3.0);
  Gaussian<6> estimate{Vector<6>{1, 2, 3, 4, 5, 6}, P};
  const Gaussian<2> z{Vector<2>{-1, 4}, SquareMatrix<2>{{2, 0.5}, {0.5, 1}}};
  Gaussian<6> expected;
  update(model, estimate, z, expected);
  update(model, estimate, z, estimate);
  EXPECT_EQ(estimate.mean, expected.mean);
  EXPECT_EQ(estimate.covariance, expected.covariance);
}

/// Whether a covariance is positive semi-definite, scaled to a unit diagonal, so that a small variance counts as much
/// as a large one.
testing::AssertionResult positive_semi_definite(Dense covariance) {
  const Dense original = covariance;
  const std::size_t n = covariance.rows;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      covariance(i, j) = original(i, j) / std::sqrt(original(i, i) * original(j, j)) + (i == j ? 1e-12 : 0.0);
  for (std::size_t k = 0; k < n; ++k) {  // elimination: the pivots of a positive definite matrix are positive
    if (!(covariance(k, k) > 0.0)) return testing::AssertionFailure() << "pivot " << k << " is " << covariance(k, k);
    for (std::size_t i = k + 1; i < n; ++i)
      for (std::size_t j = n; j-- > k;) covariance(i, j) -= covariance(i, k) / covariance(k, k) * covariance(k, j);
  }
  return testing::AssertionSuccess();
}

/// Ten thousand steps with R between 1e-10 and 1e10 and steps between 1 ms and 10 s.
template <class Moves, class Measures = PositionSensor<2>>
void stress(const Moves& model, const std::vector<double>& steps, const Measures& sensor = {}) {
  constexpr int N = Moves::state_size;
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> exponent(-10.0, 10.0);
  Gaussian<N> estimate{Vector<N>::Zero(), 1e6 * SquareMatrix<N>::Identity()};
  Gaussian<2> z{Vector<2>::Zero(), SquareMatrix<2>::Zero()};
  for (std::size_t k = 0; k < 10000; ++k) {
    predict(model, estimate, steps[k % steps.size()], estimate);
    z.mean(0) = z.mean(1) = std::sin(0.01 * static_cast<double>(k));
    for (Eigen::Index i = 0; i < 2; ++i) z.covariance(i, i) = std::pow(10.0, exponent(generator));
    update(model, estimate, z, sensor, estimate);
    ASSERT_EQ(estimate.covariance, estimate.covariance.transpose()) << "at step " << k;
    ASSERT_TRUE(detail::all_finite(estimate)) << "at step " << k;
    if (k % 100 != 99) continue;
    ASSERT_TRUE(positive_semi_definite(dense(estimate.covariance))) << "at step " << k;
  }
}

TEST(Kalman, CovariancesStaySymmetricAndPositiveUnderStress) {
  stress(dwpa<2>(3.0), {0.001, 10.0, 0.2});
  stress(dwna<2>(0.01), {0.001, 10.0, 0.2});
  stress(
      model_of(Dense(4, 4, {1, 1, 0.5, 0, 0, 1, 1, 0, 0, 0, 1, 0.2, 0.1, 0, 0, 0.9}), 1e-6 * restatement::identity(4)),
      {1.0}, measuring(Dense(2, 4, {1, 1, 0, 0, 0, 1, -1, 1})));
}

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
}

/// The squares of such residuals are no numbers, and with correlated errors their sums neither; it is far all the same.
TEST(Kalman, WhatIsBeyondAllNumbersIsInfinitelyFar) {
  const auto model = dwna<2>(1.0);
  const Gaussian<4> prior{Vector<4>::Zero(), 1e-6 * SquareMatrix<4>::Identity()};
  for (const double far : {1e155, 1e160, 1.797e308})
    for (const double correlation : {0.0, 0.9, -0.9})
      for (const Vector<2>& at : {Vector<2>(far, far), Vector<2>(-far, far), Vector<2>(0.0, far)}) {
        Gaussian<4> x;
        const SquareMatrix<2> R{{1e-4, 1e-4 * correlation}, {1e-4 * correlation, 1e-4}};
        const auto innovation = update(model, prior, {at, R}, x);
        EXPECT_EQ(innovation.squared_distance, std::numeric_limits<double>::infinity());
        EXPECT_EQ(innovation.log_likelihood, -std::numeric_limits<double>::infinity());
      }
}

TEST(Kalman, RefusesAnInnovationCovarianceThatIsNotPositiveDefiniteAndNamesTheModel) {
  const Gaussian<4> certain{Vector<4>::Zero(), SquareMatrix<4>::Zero()};
  Gaussian<4> posterior;
  EXPECT_TRUE(throws<std::domain_error>(
      [&] {
        update(dwna<2>(1.0), certain, {Vector<2>::Zero(), SquareMatrix<2>::Zero()}, posterior);
      },
      {"innovation covariance", "dwna", "not positive definite"}));
  EXPECT_TRUE(throws<std::domain_error>(
      [&] {
        update(still, certain, scalar(1.0, -1.0), measuring_one(Dense(1, 4, {1, 1, 0, 0})), posterior);
      },
      {"innovation covariance", "model", "not positive definite"}));
}

}  // namespace
}  // namespace sigmax
