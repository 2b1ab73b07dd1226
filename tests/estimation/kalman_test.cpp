#include <sigmax/estimation/kalman.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include <sigmax/estimation/fixed_step_model.hpp>
#include <sigmax/estimation/kinematic_model.hpp>

#include "support/matrices.hpp"
#include "support/restatement.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::entries;
using support::generated_covariance;
using support::generated_gaussian;
using support::generated_matrix;
using support::holds;
using support::near;
using support::require_near;
using support::require_near_matrix;
using support::throws;

template <int N>
std::vector<std::string> numbered() {
  std::vector<std::string> names;
  for (int i = 0; i < N; ++i) names.push_back("x" + std::to_string(i));
  return names;
}

template <int N, int M>
FixedStepModel<N, M> measuring(const Eigen::Matrix<double, M, N>& H,
                               const SquareMatrix<N>& F = SquareMatrix<N>::Identity(),
                               const SquareMatrix<N>& Q = SquareMatrix<N>::Zero()) {
  return {"model", numbered<N>(), 1.0, F, Q, H};
}

TEST(Kalman, OneNumberByHand) {
  const auto one = SquareMatrix<1>::Identity().eval();
  const auto model = measuring<1, 1>(one, one, one);
  Gaussian<1> estimate{Vector<1>::Zero(), one};
  predict(model, estimate, 1.0, estimate);
  EXPECT_EQ(estimate.covariance(0, 0), 2.0);
  const auto innovation = update(model, estimate, Gaussian<1>{Vector<1>{4.0}, 2.0 * one}, estimate);
  EXPECT_EQ(innovation.residual(0), 4.0);
  EXPECT_EQ(innovation.covariance(0, 0), 4.0);
  EXPECT_PRED_FORMAT3(near, innovation.squared_distance, 4.0, 1e-15);
  EXPECT_PRED_FORMAT3(near, innovation.log_likelihood, -2.0 - 0.5 * std::log(8.0 * std::numbers::pi), 1e-15);
  EXPECT_PRED_FORMAT3(near, estimate.mean(0), 2.0, 1e-15);
  EXPECT_PRED_FORMAT3(near, estimate.covariance(0, 0), 1.0, 1e-15);
}

TEST(Kalman, PredictionIsTheFormula) {
  holds([] {
    const auto F = generated_matrix<4, 4>();
    const auto Q = generated_covariance<4>();
    const Vector<4> u = generated_matrix<4, 1>();
    const FixedStepModel<4, 2> model{"model", numbered<4>(), 1.0, F, Q, generated_matrix<2, 4>(), u};
    const auto prior = generated_gaussian<4>();
    Gaussian<4> predicted;
    predict(model, prior, 1.0, predicted);
    require_near_matrix(predicted.mean, F * prior.mean + u, 1e-12);
    require_near_matrix(predicted.covariance, F * prior.covariance * F.transpose() + Q, 1e-12);
    RC_ASSERT(predicted.covariance == predicted.covariance.transpose());
  });
}

template <int N>
SquareMatrix<N> inverse(const SquareMatrix<N>& matrix) {
  const auto result = restatement::inverse({N, N, entries(matrix)}).matrix;
  return SquareMatrix<N>::NullaryExpr(
      [&](Eigen::Index i, Eigen::Index j) { return result(static_cast<std::size_t>(i), static_cast<std::size_t>(j)); });
}

/// (29)–(32) as printed, by an explicit inverse.
template <int N, int M>
Gaussian<N> as_printed(const Eigen::Matrix<double, M, N>& H, const Gaussian<N>& prior, const Gaussian<M>& z) {
  const SquareMatrix<M> S = H * prior.covariance * H.transpose() + z.covariance;
  const Eigen::Matrix<double, N, M> W = prior.covariance * H.transpose() * inverse<M>(S);
  return {prior.mean + W * (z.mean - H * prior.mean), prior.covariance - W * S * W.transpose()};
}

TEST(Kalman, JosephsFormEqualsThePrintedOne) {
  holds([] {
    const auto H = generated_matrix<2, 4>();
    const auto prior = generated_gaussian<4>();
    const auto z = generated_gaussian<2>();
    Gaussian<4> posterior;
    update(measuring<4, 2>(H), prior, z, posterior);
    const auto expected = as_printed<4, 2>(H, prior, z);
    require_near_matrix(posterior.mean, expected.mean, 1e-11);
    require_near_matrix(posterior.covariance, expected.covariance, 1e-11);
    RC_ASSERT(posterior.covariance == posterior.covariance.transpose());
  });
}

template <int Axes, int Order>
void leading_components() {
  holds([] {
    constexpr int N = Axes * Order;
    const KinematicModel<Axes, Order> model{1.0};
    const auto prior = generated_gaussian<N>();
    const auto z = generated_gaussian<Axes>();
    Gaussian<N> posterior, expected;
    const auto innovation = update(model, prior, z, posterior);
    const auto dense = update(measuring<N, Axes>(model.measurement_matrix()), prior, z, expected);
    require_near_matrix(posterior.mean, expected.mean, 1e-11);
    require_near_matrix(posterior.covariance, expected.covariance, 1e-11);
    require_near_matrix(innovation.residual, dense.residual, 1e-12);
    require_near_matrix(innovation.covariance, dense.covariance, 1e-12);
    require_near(innovation.squared_distance, dense.squared_distance, 1e-11);
    require_near(innovation.log_likelihood, dense.log_likelihood, 1e-11);
    RC_ASSERT(posterior.covariance == posterior.covariance.transpose());

    using RunTime = KinematicModel<Axes, Eigen::Dynamic>;
    const EstimateOf<RunTime> run_time_prior{prior.mean, prior.covariance};
    EstimateOf<RunTime> run_time;
    const auto same = update(RunTime{model}, run_time_prior, z, run_time);
    require_near_matrix(run_time.mean, posterior.mean, 1e-13);
    require_near_matrix(run_time.covariance, posterior.covariance, 1e-13);
    require_near(same.log_likelihood, innovation.log_likelihood, 1e-13);
  });
}

TEST(Kalman, SkippingTheZerosOfHChangesNothing) {
  leading_components<1, 2>();
  leading_components<2, 3>();
  leading_components<3, 2>();
}

TEST(Kalman, TheLogLikelihoodIsThatOfTheGaussianDensity) {
  holds([] {
    const auto H = generated_matrix<2, 3>();
    const auto prior = generated_gaussian<3>();
    const auto z = generated_gaussian<2>();
    Gaussian<3> posterior;
    const auto innovation = update(measuring<2 + 1, 2>(H), prior, z, posterior);
    const SquareMatrix<2> S = H * prior.covariance * H.transpose() + z.covariance;
    const Vector<2> nu = z.mean - H * prior.mean;
    const double determinant = S(0, 0) * S(1, 1) - S(0, 1) * S(1, 0);
    const double squared =
        (S(1, 1) * nu(0) * nu(0) - 2.0 * S(0, 1) * nu(0) * nu(1) + S(0, 0) * nu(1) * nu(1)) / determinant;
    require_near(innovation.squared_distance, squared, 1e-10);
    require_near(innovation.log_likelihood,
                 std::log(std::exp(-0.5 * squared) / (2.0 * std::numbers::pi * std::sqrt(determinant))), 1e-10);
  });
}

TEST(Kalman, IsInvariantUnderInvertibleStateChanges) {
  holds([] {
    // Unit lower times unit upper triangular: invertible, and neither orthogonal nor diagonal.
    SquareMatrix<3> T = SquareMatrix<3>::Identity();
    T.triangularView<Eigen::StrictlyLower>() = generated_matrix<3, 3>();
    SquareMatrix<3> upper = SquareMatrix<3>::Identity();
    upper.triangularView<Eigen::StrictlyUpper>() = generated_matrix<3, 3>();
    T = (T * upper).eval();
    const SquareMatrix<3> T_inverse = inverse<3>(T);

    const auto F = generated_matrix<3, 3>();
    const auto Q = generated_covariance<3>();
    const auto H = generated_matrix<2, 3>();
    const auto start = generated_gaussian<3>();
    const auto z = generated_gaussian<2>();
    const auto model = measuring<3, 2>(H, F, Q);
    const auto changed = measuring<3, 2>(H * T_inverse, T * F * T_inverse, T * Q * T.transpose());

    Gaussian<3> here = start;
    Gaussian<3> there{T * start.mean, T * start.covariance * T.transpose()};
    predict(model, here, 1.0, here);
    predict(changed, there, 1.0, there);
    const auto innovation = update(model, here, z, here);
    const auto innovation_there = update(changed, there, z, there);
    require_near_matrix(there.mean, T * here.mean, 1e-9);
    require_near_matrix(there.covariance, T * here.covariance * T.transpose(), 1e-9);
    require_near(innovation_there.log_likelihood, innovation.log_likelihood, 1e-9);
  });
}

TEST(Kalman, IndependentMeasurementsOneByOneAreTheBatch) {
  holds([] {
    const auto H = generated_matrix<2, 4>();
    const auto prior = generated_gaussian<4>();
    auto z = generated_gaussian<2>();
    z.covariance(0, 1) = z.covariance(1, 0) = 0.0;
    Gaussian<4> batch, sequential;
    const auto both = update(measuring<4, 2>(H), prior, z, batch);
    const auto part = [&](int i) { return Gaussian<1>{z.mean.segment<1>(i), z.covariance.block<1, 1>(i, i)}; };
    const auto first = update(measuring<4, 1>(H.row(0)), prior, part(0), sequential);
    const auto second = update(measuring<4, 1>(H.row(1)), sequential, part(1), sequential);
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

/// Ten thousand steps with R between 1e-10 and 1e10 and steps between 1 ms and 10 s.
template <class Model>
void stress(const Model& model, const std::vector<double>& steps) {
  constexpr int N = Model::state_size;
  constexpr int M = Model::measurement_size;
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> exponent(-10.0, 10.0);
  Gaussian<N> estimate{Vector<N>::Zero(), 1e6 * SquareMatrix<N>::Identity()};
  for (std::size_t k = 0; k < 10000; ++k) {
    predict(model, estimate, steps[k % steps.size()], estimate);
    const Vector<M> R = Vector<M>::NullaryExpr([&] { return std::pow(10.0, exponent(generator)); });
    update(model, estimate, Gaussian<M>{Vector<M>::Constant(std::sin(0.01 * static_cast<double>(k))), R.asDiagonal()},
           estimate);
    ASSERT_EQ(estimate.covariance, estimate.covariance.transpose()) << "at step " << k;
    ASSERT_TRUE(all_finite(estimate)) << "at step " << k;
    if (k % 100 != 99) continue;
    // Scaled to a unit diagonal, so that a small variance counts as much as a large one.
    const Vector<N> scale = estimate.covariance.diagonal().cwiseSqrt().cwiseInverse();
    const SquareMatrix<N> correlation = scale.asDiagonal() * estimate.covariance * scale.asDiagonal();
    const Eigen::LLT<SquareMatrix<N>> factor(correlation + 1e-12 * SquareMatrix<N>::Identity());
    ASSERT_EQ(factor.info(), Eigen::Success) << "at step " << k;
  }
}

TEST(Kalman, CovariancesStaySymmetricAndPositiveUnderStress) {
  stress(dwpa<2>(3.0), {0.001, 10.0, 0.2});
  stress(dwna<1>(0.01), {0.001, 10.0, 0.2});
  stress(measuring<3, 2>(Eigen::Matrix<double, 2, 3>{{1, 1, 0}, {0, 1, -1}},
                         SquareMatrix<3>{{1, 1, 0.5}, {0, 1, 1}, {0, 0, 1}}, 1e-6 * SquareMatrix<3>::Identity()),
         {1.0});
}

TEST(Kalman, RefusesAnInnovationCovarianceThatIsNotPositiveDefiniteAndNamesTheModel) {
  const Gaussian<2> certain{Vector<2>::Zero(), SquareMatrix<2>::Zero()};
  Gaussian<2> posterior;
  EXPECT_TRUE(throws<std::domain_error>(
      [&] {
        update(dwna<1>(1.0), certain, Gaussian<1>{Vector<1>{1.0}, SquareMatrix<1>::Zero()}, posterior);
      },
      {"innovation covariance", "dwna", "not positive definite"}));
  EXPECT_TRUE(throws<std::domain_error>(
      [&] {
        update(measuring<2, 1>(Eigen::RowVector2d{1, 1}), certain,
               Gaussian<1>{Vector<1>{1.0}, -SquareMatrix<1>::Identity()}, posterior);
      },
      {"innovation covariance", "model", "not positive definite"}));
}

}  // namespace
}  // namespace sigmax
