#include <sigmax/estimation/discrete_white_noise.hpp>

#include <gtest/gtest.h>

#include <limits>

#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/estimation/extended.hpp>

#include "support/matrices.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::dense;
using support::generated_gaussian;
using support::generated_matrix;
using support::holds;
using support::near;
using support::near_matrix;
using support::number_between;
using support::require_near_matrix;
using support::throws;

TEST(DiscreteWhiteNoise, DwnaIsThatOfThePaperAtFiveHertz) {
  const auto model = dwna<1>(3.0);
  EXPECT_PRED_FORMAT3(near_matrix, model.transition(0.2), (SquareMatrix<2>{{1, 0.2}, {0, 1}}), 1e-15);
  EXPECT_PRED_FORMAT3(near_matrix, model.process_covariance(0.2), (SquareMatrix<2>{{0.0036, 0.036}, {0.036, 0.36}}),
                      1e-15);
}

TEST(DiscreteWhiteNoise, DwnaIsThatOfThePaperAtTwoSeconds) {
  const auto model = dwna<1>(3.0);
  EXPECT_EQ(model.transition(2.0), (SquareMatrix<2>{{1, 2}, {0, 1}}));
  EXPECT_EQ(model.process_covariance(2.0), (SquareMatrix<2>{{36, 36}, {36, 36}}));
}

TEST(DiscreteWhiteNoise, DwpaIsThatOfThePaperAtFiveHertz) {
  const auto model = dwpa<1>(3.0);
  EXPECT_PRED_FORMAT3(near_matrix, model.transition(0.2), (SquareMatrix<3>{{1, 0.2, 0.02}, {0, 1, 0.2}, {0, 0, 1}}),
                      1e-15);
  EXPECT_PRED_FORMAT3(near_matrix, model.process_covariance(0.2),
                      (SquareMatrix<3>{{0.0036, 0.036, 0.18}, {0.036, 0.36, 1.8}, {0.18, 1.8, 9}}), 1e-15);
}

TEST(DiscreteWhiteNoise, DwpaIsThatOfThePaperAtTwoSeconds) {
  const auto model = dwpa<1>(3.0);
  EXPECT_EQ(model.transition(2.0), (SquareMatrix<3>{{1, 2, 2}, {0, 1, 2}, {0, 0, 1}}));
  EXPECT_EQ(model.process_covariance(2.0), (SquareMatrix<3>{{36, 36, 18}, {36, 36, 18}, {18, 18, 9}}));
}

TEST(DiscreteWhiteNoise, TheGainIsHalfTheSquareTheStepAndOne) {
  EXPECT_EQ(DiscreteWhiteNoise<3>(1.0).input_gain(2.0), (Vector<3>{2.0, 2.0, 1.0}));
  EXPECT_EQ(DiscreteWhiteNoise<2>(1.0).input_gain(2.0), (Vector<2>{2.0, 2.0}));
  EXPECT_EQ(DiscreteWhiteNoise<3>(1.0).transition(3.0).row(0), (Eigen::RowVector3d{1.0, 3.0, 4.5}));
}

TEST(DiscreteWhiteNoise, AxesAreIndependentAndStatesAreOrderedByDerivative) {
  const auto model = dwna<2>(3.0);
  EXPECT_EQ(model.components(), (std::vector<std::string>{"x", "y", "vx", "vy"}));
  EXPECT_EQ(model.transition(2.0), (SquareMatrix<4>{{1, 0, 2, 0}, {0, 1, 0, 2}, {0, 0, 1, 0}, {0, 0, 0, 1}}));
  EXPECT_EQ(model.process_covariance(2.0),
            (SquareMatrix<4>{{36, 0, 36, 0}, {0, 36, 0, 36}, {36, 0, 36, 0}, {0, 36, 0, 36}}));
}

TEST(DiscreteWhiteNoise, NamesItselfAndItsComponents) {
  EXPECT_EQ(dwna<3>(1.0).name(), "dwna");
  EXPECT_EQ(dwpa<3>(1.0).name(), "dwpa");
  EXPECT_EQ(dwpa<1>(1.0).components(), (std::vector<std::string>{"x", "vx", "ax"}));
  EXPECT_EQ(dwna<3>(1.0).components(), (std::vector<std::string>{"x", "y", "z", "vx", "vy", "vz"}));
  EXPECT_EQ(dwpa<3>(1.0).components(), (std::vector<std::string>{"x", "y", "z", "vx", "vy", "vz", "ax", "ay", "az"}));
}

TEST(DiscreteWhiteNoise, AKnownAccelerationEntersAsTheNoiseDoes) {
  const auto model = dwna<2>(0.0, Vector<2>{3.0, -5.0});
  EXPECT_EQ(model.known_input(2.0), (Vector<4>{6.0, -10.0, 6.0, -10.0}));
  const Gaussian<4> start{Vector<4>{1.0, 2.0, 10.0, 20.0}, SquareMatrix<4>::Identity()};
  Gaussian<4> predicted;
  predict(model, start, 2.0, predicted);
  EXPECT_EQ(predicted.mean, (Vector<4>{27.0, 32.0, 16.0, 10.0}));
}

template <int Axes, int Order>
void structured_equals_dense() {
  holds([] {
    using Moves = IndependentAxes<Axes, DiscreteWhiteNoise<Order>>;
    const Moves model{DiscreteWhiteNoise<Order>{number_between(0.0, 4.0)}, generated_matrix<Axes, 1>()};
    const double dt = number_between(0.01, 3.0);
    const auto prior = generated_gaussian<Axes * Order>();
    Gaussian<Axes * Order> structured;
    predict(model, prior, dt, structured);
    const auto F = dense(model.transition(dt));
    require_near_matrix(structured.mean, F * dense(prior.mean) + dense(model.known_input(dt)), 1e-12);
    require_near_matrix(structured.covariance,
                        F * dense(prior.covariance) * restatement::transposed(F) + dense(model.process_covariance(dt)),
                        1e-12);
    RC_ASSERT(structured.covariance == structured.covariance.transpose());

    const Extended<AnyMotion<3 * Axes, Moves>> same{model};
    const Gaussian<Eigen::Dynamic, 3 * Axes> run_time_prior{prior.mean, prior.covariance};
    Gaussian<Eigen::Dynamic, 3 * Axes> run_time;
    predict(same, run_time_prior, dt, run_time);
    RC_ASSERT(run_time.mean == structured.mean);
    RC_ASSERT(run_time.covariance == structured.covariance);
  });
}

TEST(DiscreteWhiteNoise, StructuredPredictionEqualsTheDenseOneOnOneAxis) {
  structured_equals_dense<1, 2>();
  structured_equals_dense<1, 3>();
}
TEST(DiscreteWhiteNoise, StructuredPredictionEqualsTheDenseOneOnTwoAxes) { structured_equals_dense<2, 3>(); }
TEST(DiscreteWhiteNoise, StructuredPredictionEqualsTheDenseOneOnThreeAxes) { structured_equals_dense<3, 2>(); }

TEST(DiscreteWhiteNoise, PredictionMayOverwriteItsPrior) {
  const auto model = dwpa<2>(1.5);
  Gaussian<6> estimate{Vector<6>{1, 2, 3, 4, 5, 6}, 2.0 * SquareMatrix<6>::Identity()};
  Gaussian<6> expected;
  predict(model, estimate, 0.7, expected);
  predict(model, estimate, 0.7, estimate);
  EXPECT_EQ(estimate.mean, expected.mean);
  EXPECT_EQ(estimate.covariance, expected.covariance);
}

TEST(DiscreteWhiteNoise, WithoutNoiseTwoStepsAreOne) {
  const auto model = dwpa<1>(0.0);
  const Gaussian<3> start{Vector<3>{1, -2, 3}, SquareMatrix<3>{{4, 1, 0}, {1, 3, 1}, {0, 1, 2}}};
  Gaussian<3> twice, once;
  predict(model, start, 0.3, twice);
  predict(model, twice, 0.5, twice);
  predict(model, start, 0.8, once);
  EXPECT_PRED_FORMAT3(near_matrix, twice.mean, once.mean, 1e-13);
  EXPECT_PRED_FORMAT3(near_matrix, twice.covariance, once.covariance, 1e-13);
}

TEST(DiscreteWhiteNoise, ShowsItsParameters) {
  const auto model = dwna<3>(2.5, Vector<3>{1, 2, 3});
  EXPECT_EQ(model.law().sigma_w(), 2.5);
  EXPECT_EQ(model.input(), (Vector<3>{1, 2, 3}));
  EXPECT_EQ(model.size(), 6);
}

TEST(DiscreteWhiteNoise, RefusesANoiseThatIsNone) {
  EXPECT_TRUE(throws<std::invalid_argument>([] { dwna<3>(-1.0); }, {"sigma_w", "dwna", "-1"}));
  EXPECT_TRUE(throws<std::invalid_argument>([] { dwpa<3>(std::numeric_limits<double>::infinity()); },
                                            {"sigma_w", "dwpa", "inf"}));
  EXPECT_TRUE(throws<std::invalid_argument>([] { dwpa<3>(std::numeric_limits<double>::quiet_NaN()); },
                                            {"sigma_w", "dwpa", "nan"}));
}

}  // namespace
}  // namespace sigmax
