#include <sigmax/estimation/known_turn.hpp>

#include <gtest/gtest.h>

#include <numbers>

#include <sigmax/estimation/white_noise.hpp>

#include "estimation/motion_laws.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::generated_step;
using support::holds;
using support::number_between;
using support::require_dense_prediction;
using support::require_integral_of;
using support::require_near_covariance;
using support::require_near_matrix;
using support::require_steps_to_add_up;
using support::throws;

static_assert(LinearMotion<KnownTurn<2>> && axes_of<KnownTurn<2>> == 2);
static_assert(LinearMotion<KnownTurn<3>> && axes_of<KnownTurn<3>> == 3);

TEST(KnownTurn, IsTheIntegral) {
  holds([] {
    const double w = number_between(-2.0, 2.0), q = number_between(0.1, 5.0), dt = number_between(0.1, 3.0);
    const Eigen::MatrixXd plane{{0, 0, 1, 0}, {0, 0, 0, 1}, {0, 0, 0, -w}, {0, 0, w, 0}};
    Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(4, 4);
    noise(2, 2) = noise(3, 3) = q;
    require_integral_of(plane, noise, KnownTurn<2>{w, q}, dt);

    Eigen::MatrixXd space = Eigen::MatrixXd::Zero(6, 6), noise_in_space = Eigen::MatrixXd::Zero(6, 6);
    space.topRightCorner(3, 3).setIdentity();
    space(3, 4) = -w;
    space(4, 3) = w;
    noise_in_space.bottomRightCorner(3, 3).diagonal().setConstant(q);
    require_integral_of(space, noise_in_space, KnownTurn<3>{w, q}, dt);
  });
}

TEST(KnownTurn, StepsAddUpForAnyRate) {
  holds([] {
    const double w = std::pow(10.0, number_between(-9.0, 0.5));
    require_steps_to_add_up(KnownTurn<2>{w, 2.0}, generated_step(), generated_step());
    require_steps_to_add_up(KnownTurn<3>{-w, 2.0}, generated_step(), generated_step());
  });
}

TEST(KnownTurn, WithoutARateItIsWhiteNoiseAcceleration) {
  holds([] {
    const double q = number_between(0.1, 5.0), dt = number_between(0.0, 3.0);
    for (const double w : {0.0, 1e-14}) {
      require_near_matrix(KnownTurn<3>(w, q).transition(dt), cwna<3>(q).transition(dt), 1e-12);
      require_near_matrix(KnownTurn<3>(w, q).process_covariance(dt), cwna<3>(q).process_covariance(dt), 1e-12);
    }
  });
}

TEST(KnownTurn, PredictionIsTheFormula) {
  holds([] { require_dense_prediction(KnownTurn<3>{number_between(-2.0, 2.0), 1.0}, number_between(0.0, 3.0)); });
}

TEST(KnownTurn, NamesItselfAndSharesTheComponentsOfOthers) {
  const KnownTurn<2> model{0.1, 2.0};
  EXPECT_EQ(model.name(), "known_turn");
  EXPECT_EQ(model.components(), cwna<2>(1.0).components());
  EXPECT_EQ(model.omega(), 0.1);
  EXPECT_EQ(model.q(), 2.0);
}

TEST(KnownTurn, RefusesParametersThatAreNone) {
  EXPECT_TRUE(throws<std::invalid_argument>([] { KnownTurn<2>(std::nan(""), 1.0); }, {"rate", "known_turn", "nan"}));
  EXPECT_TRUE(throws<std::invalid_argument>([] { KnownTurn<2>(0.1, -1.0); }, {"q", "known_turn", "-1"}));
}

}  // namespace
}  // namespace sigmax
