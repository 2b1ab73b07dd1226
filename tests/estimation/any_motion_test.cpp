#include <sigmax/estimation/any_motion.hpp>

#include <gtest/gtest.h>

#include <type_traits>

#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/cubature.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/sensors.hpp>
#include <sigmax/estimation/unscented.hpp>

#include "support/matrices.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::generated_gaussian;
using support::holds;
using support::require_near;
using support::require_near_matrix;
using support::throws;

using Turn = CoordinatedTurn<2>;
using Any = AnyMotion<7, IndependentAxes<2, DiscreteWhiteNoise<2>>, IndependentAxes<2, DiscreteWhiteNoise<3>>, Turn>;

static_assert(NonlinearMotion<Any> && !LinearMotion<Any>);
static_assert(std::is_convertible_v<Turn, Any>);
static_assert(!std::is_convertible_v<IndependentAxes<3, DiscreteWhiteNoise<2>>, Any>, "none of the motions");

/// The member over the motion itself and over that motion as any: all that a filter or smoother asks of them.
template <template <class> class Member, class Motion>
void filters_as(const Motion& motion) {
  holds([&] {
    const PolarSensor<2> radar{Vector<2>(-3.0, 2.0)};
    const Member member{motion};
    const Member any{Any{motion}};
    RC_ASSERT(any.size() == member.size());
    RC_ASSERT(any.name() == member.name());
    RC_ASSERT(any.components() == member.components());

    auto expected = generated_gaussian<Motion::state_size>();
    expected.mean.template head<2>() += Vector<2>(40.0, 30.0);  // away from the radar
    EstimateOf<Any> found{expected.mean, expected.covariance};
    require_near_matrix(prediction_covariance(any, found, 0.7), prediction_covariance(member, expected, 0.7), 1e-9);
    predict(member, expected, 0.7, expected);
    predict(any, found, 0.7, found);
    require_near_matrix(found.mean, expected.mean, 1e-9);
    require_near_matrix(found.covariance, expected.covariance, 1e-9);

    Gaussian<2> z{radar.measure(Vector<2>(expected.mean.template head<2>())), SquareMatrix<2>{{1.0, 0.0}, {0.0, 0.01}}};
    z.mean += Vector<2>(0.5, -0.02);
    const auto expected_innovation = update(member, expected, z, radar, expected);
    const auto innovation = update(any, found, z, radar, found);
    require_near_matrix(found.mean, expected.mean, 1e-9);
    require_near_matrix(found.covariance, expected.covariance, 1e-9);
    require_near(innovation.log_likelihood, expected_innovation.log_likelihood, 1e-9);
  });
}

template <class Motion>
void filters_as_by_every_member(const Motion& motion) {
  filters_as<Extended>(motion);
  filters_as<Unscented>(motion);
  filters_as<Cubature>(motion);
}

TEST(AnyMotion, FiltersAsTheMotionThatItIs) {
  filters_as_by_every_member(dwna<2>(3.0, Vector<2>(1.0, -2.0)));
  filters_as_by_every_member(dwpa<2>(2.0));
  filters_as_by_every_member(Turn(1.0, 0.01));
}

TEST(AnyMotion, RefusesAStateOfAnotherMotion) {
  const Any turn = Turn(1.0, 0.01);
  const Vector<Eigen::Dynamic, 7> wrong = Vector<4>::Zero();
  EXPECT_TRUE(throws<std::invalid_argument>([&] { turn.propagate(wrong, 1.0); }, {"coordinated_turn", "4", "5"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { turn.transition_jacobian(wrong, 1.0); }, {"coordinated_turn"}));
}

}  // namespace
}  // namespace sigmax
