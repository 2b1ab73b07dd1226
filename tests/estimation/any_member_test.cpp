#include <sigmax/estimation/any_member.hpp>

#include <gtest/gtest.h>

#include <type_traits>

#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>

#include "support/matrices.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::near_matrix;
using support::throws;

using Turn = CoordinatedTurn<2>;
using Moves = AnyMotion<7, IndependentAxes<2, DiscreteWhiteNoise<2>>, IndependentAxes<2, DiscreteWhiteNoise<3>>, Turn>;
using Any = AnyMember<Moves>;

static_assert(StateModel<Any> && axes_of<Any> == 2);
static_assert(!LinearMotion<Any>, "so that the Kalman filter does not take it for its own");
static_assert(std::is_convertible_v<Extended<Moves>, Any>);
static_assert(!std::is_convertible_v<Extended<Turn>, Any>, "a member over another motion");

/// An estimate of the model's size, with correlations.
template <class Model>
EstimateOf<Model> some_estimate(const Model& model) {
  const Eigen::Index n = model.size();
  EstimateOf<Model> estimate;
  estimate.mean.resize(n);
  SquareMatrix<Model::state_size, Model::max_state_size> root(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    estimate.mean(i) = 1.0 - 0.3 * static_cast<double>(i);
    for (Eigen::Index k = 0; k < n; ++k) root(i, k) = i == k ? 1.5 : 1.0 / static_cast<double>(2 + i + 3 * k);
  }
  estimate.covariance = root * root.transpose();
  return estimate;
}

/// `any` does what `model` does, with a sensor that is linear and with one that is not.
template <class Model>
void expect_as(const Any& any, const Model& model, double tolerance = 0.0) {
  EXPECT_EQ(any.size(), model.size());
  EXPECT_EQ(any.name(), model.name());
  EXPECT_EQ(any.components(), model.components());

  auto expected = some_estimate(model);
  EstimateOf<Any> found{expected.mean, expected.covariance};
  EXPECT_PRED_FORMAT3(near_matrix, prediction_covariance(any, found, 0.7), prediction_covariance(model, expected, 0.7),
                      tolerance);
  predict(model, expected, 0.7, expected);
  predict(any, found, 0.7, found);
  EXPECT_PRED_FORMAT3(near_matrix, found.mean, expected.mean, tolerance);
  EXPECT_PRED_FORMAT3(near_matrix, found.covariance, expected.covariance, tolerance);

  const Gaussian<2> z{Vector<2>(2.0, -1.0), SquareMatrix<2>{{1.0, 0.2}, {0.2, 0.5}}};
  const auto updates_alike = [&](const auto& sensor) {
    auto there = expected;
    auto here = found;
    const auto expected_innovation = update(model, there, z, sensor, there);
    const auto innovation = update(any, here, z, sensor, here);
    EXPECT_PRED_FORMAT3(near_matrix, here.mean, there.mean, tolerance);
    EXPECT_PRED_FORMAT3(near_matrix, here.covariance, there.covariance, tolerance);
    EXPECT_PRED_FORMAT3(near_matrix, innovation.residual, expected_innovation.residual, tolerance);
    EXPECT_PRED_FORMAT3(near_matrix, innovation.covariance, expected_innovation.covariance, tolerance);
    EXPECT_NEAR(innovation.squared_distance, expected_innovation.squared_distance, tolerance);
    EXPECT_NEAR(innovation.log_likelihood, expected_innovation.log_likelihood, tolerance);
  };
  updates_alike(PositionSensor<2>{});
  updates_alike(PolarSensor<2>{Vector<2>(-30.0, 20.0)});
}

TEST(AnyMember, OverALinearMotionIsTheKalmanFilterWhateverTheMemberIs) {
  for (const auto& any :
       {Any{Extended<Moves>{dwna<2>(3.0)}}, Any{Unscented<Moves>{dwna<2>(3.0)}}, Any{Cubature<Moves>{dwna<2>(3.0)}}})
    EXPECT_EQ(any.motion().name(), "dwna");
  expect_as(Extended<Moves>{dwna<2>(3.0)}, Extended{dwna<2>(3.0)}, 1e-12);
  expect_as(Unscented<Moves>{dwna<2>(3.0)}, Unscented{dwna<2>(3.0)}, 1e-12);
  expect_as(Cubature<Moves>{dwpa<2>(2.0)}, Cubature{dwpa<2>(2.0)}, 1e-12);
}

TEST(AnyMember, OverATurnIsTheMemberThatItWasMadeOf) {
  const Turn turn(1.0, 0.01);
  expect_as(Extended<Moves>{turn}, Extended{turn}, 1e-12);
  expect_as(Unscented<Moves>{turn}, Unscented{turn}, 1e-12);
  expect_as(Unscented<Moves>(turn, {0.5, 2.0, 1.0}), Unscented(turn, {0.5, 2.0, 1.0}), 1e-12);
  expect_as(Cubature<Moves>{turn}, Cubature{turn}, 1e-12);
}

TEST(AnyMember, RefusesAnEstimateOfAnotherMotion) {
  for (const Any& turn : {Any{Extended<Moves>{Turn(1.0, 0.01)}}, Any{Unscented<Moves>{Turn(1.0, 0.01)}}}) {
    auto wrong = EstimateOf<Any>{some_estimate(dwna<2>(3.0)).mean, some_estimate(dwna<2>(3.0)).covariance};
    EXPECT_TRUE(
        throws<std::invalid_argument>([&] { predict(turn, wrong, 1.0, wrong); }, {"coordinated_turn", "4", "5"}));
    EXPECT_TRUE(throws<std::invalid_argument>([&] { prediction_covariance(turn, wrong, 1.0); }, {"coordinated_turn"}));
  }
}

TEST(AnyMember, RefusesASensorOfMoreThanThereIs) {
  const Any dwna_now = Extended<Moves>{dwna<2>(3.0)};
  EstimateOf<Any> x{Vector<4>::Zero(), SquareMatrix<4>::Identity()};
  const LinearSensor<1, 5> acceleration{RectangularMatrix<1, 5>(0.0, 0.0, 0.0, 0.0, 1.0)};
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] {
        update(dwna_now, x, {Vector<1>(0.0), SquareMatrix<1>(1.0)}, acceleration, x);
      },
      {"sees 5", "dwna", "4"}));
}

}  // namespace
}  // namespace sigmax
