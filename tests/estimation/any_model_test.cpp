#include <sigmax/estimation/any_model.hpp>

#include <gtest/gtest.h>

#include <type_traits>

#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/kinematic_model.hpp>
#include <sigmax/estimation/unscented.hpp>

#include "support/matrices.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::near_matrix;
using support::throws;

using Turn = CoordinatedTurn<2>;
using Any = AnyModel<7, KinematicModel<2, 2>, KinematicModel<2, 3>, Extended<Turn>, Unscented<Turn>>;

static_assert(StateModel<Any>);
static_assert(!LinearMotion<Any>, "so that the Kalman filter does not take it for its own");
static_assert(std::is_convertible_v<Extended<Turn>, Any>);
static_assert(!std::is_convertible_v<KinematicModel<3, 2>, Any>, "none of the models");

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

template <class Model>
void expect_as(const Model& model) {
  const Any any = model;
  EXPECT_EQ(any.size(), model.size());
  EXPECT_EQ(any.name(), model.name());
  EXPECT_EQ(any.components(), model.components());

  auto expected = some_estimate(model);
  EstimateOf<Any> found{expected.mean, expected.covariance};
  EXPECT_PRED_FORMAT3(near_matrix, prediction_covariance(any, found, 0.7), prediction_covariance(model, expected, 0.7),
                      0.0);
  predict(model, expected, 0.7, expected);
  predict(any, found, 0.7, found);
  EXPECT_PRED_FORMAT3(near_matrix, found.mean, expected.mean, 0.0);
  EXPECT_PRED_FORMAT3(near_matrix, found.covariance, expected.covariance, 0.0);

  const Gaussian<2> z{Vector<2>(2.0, -1.0), SquareMatrix<2>{{1.0, 0.2}, {0.2, 0.5}}};
  const auto expected_innovation = update(model, expected, z, expected);
  const auto innovation = update(any, found, z, found);
  EXPECT_PRED_FORMAT3(near_matrix, found.mean, expected.mean, 0.0);
  EXPECT_PRED_FORMAT3(near_matrix, found.covariance, expected.covariance, 0.0);
  EXPECT_PRED_FORMAT3(near_matrix, innovation.residual, expected_innovation.residual, 0.0);
  EXPECT_PRED_FORMAT3(near_matrix, innovation.covariance, expected_innovation.covariance, 0.0);
  EXPECT_EQ(innovation.squared_distance, expected_innovation.squared_distance);
  EXPECT_EQ(innovation.log_likelihood, expected_innovation.log_likelihood);
}

TEST(AnyModel, IsTheModelThatItWasMadeOf) {
  expect_as(dwna<2>(3.0));
  expect_as(dwpa<2>(2.0));
  expect_as(Extended{Turn(1.0, 0.01)});
  expect_as(Unscented{Turn(1.0, 0.01)});
}

TEST(AnyModel, RefusesAnEstimateOfAnotherModel) {
  const Any turn = Extended{Turn(1.0, 0.01)};
  auto wrong = EstimateOf<Any>{some_estimate(dwna<2>(3.0)).mean, some_estimate(dwna<2>(3.0)).covariance};
  const Gaussian<2> z{Vector<2>::Zero(), SquareMatrix<2>::Identity()};
  EXPECT_TRUE(throws<std::invalid_argument>([&] { predict(turn, wrong, 1.0, wrong); }, {"coordinated_turn", "4", "5"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { update(turn, wrong, z, wrong); }, {"coordinated_turn", "4", "5"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { prediction_covariance(turn, wrong, 1.0); }, {"coordinated_turn"}));
}

}  // namespace
}  // namespace sigmax
