#include <sigmax/estimation/observed.hpp>

#include <gtest/gtest.h>

#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/kalman.hpp>
#include <sigmax/estimation/kinematic_model.hpp>
#include <sigmax/estimation/sensors.hpp>

#include "support/matrices.hpp"

namespace sigmax {
namespace {

using support::generated_gaussian;
using support::generated_matrix;
using support::holds;
using support::near_matrix;
using support::require_near_matrix;

using Linear = Observed<KinematicModel<3, 2>, PositionSensor<2>>;
using Polar3 = Observed<KinematicModel<3, 3>, PolarSensor<3>>;
using Turning = Observed<CoordinatedTurn<3>, PolarSensor<2>>;

static_assert(LinearModel<Linear> && NonlinearModel<Linear> && measures_leading_components<Linear>);
static_assert(LinearMotion<Polar3> && NonlinearModel<Polar3> && !LinearModel<Polar3>);
static_assert(!LinearMotion<Turning> && NonlinearModel<Turning>);

// A sensor of another shape than it says does not compile, nor one that sees more axes than there are.
struct Odd : PositionSensor<2> {
  Vector<3> measure(const Vector<2>&) const { return Vector<3>::Zero(); }
};
static_assert(!PositionSensing<Odd>);
static_assert(!PositionSensing<int>);

TEST(Observed, MovesAsItsMotionAndMeasuresAsItsSensor) {
  holds([] {
    const CoordinatedTurn<3> turn{0.5, 0.1};
    const PolarSensor<2> radar{Vector<2>(500.0, 600.0)};
    const Turning model{turn, radar};
    const Vector<7> x = generated_matrix<7, 1>();
    RC_ASSERT(model.propagate(x, 0.7) == turn.propagate(x, 0.7));
    RC_ASSERT(model.process_covariance(0.7) == turn.process_covariance(0.7));
    RC_ASSERT(model.transition_jacobian(x, 0.7) == turn.transition_jacobian(x, 0.7));
    RC_ASSERT(model.measure(x) == radar.measure(Vector<2>(x.head<2>())));
    RectangularMatrix<2, 7> H = RectangularMatrix<2, 7>::Zero();
    H.leftCols<2>() = radar.measurement_jacobian(x.head<2>());
    RC_ASSERT(model.measurement_jacobian(x) == H);
  });
}

TEST(Observed, ALinearMotionHasItsTransitionAsItsJacobian) {
  const auto motion = dwna<3>(2.0, Vector<3>(1.0, 2.0, 3.0));
  const Observed model{motion, PolarSensor<3>{}};
  const Vector<6> x(1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
  EXPECT_EQ(model.transition_jacobian(x, 0.5), motion.transition(0.5));
  EXPECT_PRED_FORMAT3(near_matrix, model.propagate(x, 0.5), motion.transition(0.5) * x + motion.known_input(0.5),
                      1e-15);
}

TEST(Observed, ByAPositionSensorIsLinearAndMayMeasureFewerAxes) {
  holds([] {
    const Linear plane{dwna<3>(2.0), PositionSensor<2>{}};
    const auto prior = generated_gaussian<6>();
    const auto z = generated_gaussian<2>();
    // The third coordinate tells nothing if its variance is immense.
    Gaussian<3> with_altitude{Vector<3>(z.mean(0), z.mean(1), 0.0), SquareMatrix<3>::Zero()};
    with_altitude.covariance.topLeftCorner<2, 2>() = z.covariance;
    with_altitude.covariance(2, 2) = 1e14;
    Gaussian<6> found, expected;
    predict(plane, prior, 0.5, found);
    predict(dwna<3>(2.0), prior, 0.5, expected);
    RC_ASSERT(found.covariance == expected.covariance);
    update(plane, found, z, found);
    update(dwna<3>(2.0), expected, with_altitude, expected);
    require_near_matrix(found.mean, expected.mean, 1e-10);
    require_near_matrix(found.covariance, expected.covariance, 1e-10);
  });
}

/// A sensor of one's own whose Jacobian nobody gives: the squared distance from the origin.
struct SquaredDistance {
  static constexpr int axes = 3;
  static constexpr int measurement_size = 1;
  template <class Scalar>
  Eigen::Matrix<Scalar, 1, 1> measure(const Eigen::Matrix<Scalar, 3, 1>& p) const {
    return Eigen::Matrix<Scalar, 1, 1>(Scalar(p(0) * p(0) + p(1) * p(1) + p(2) * p(2)));
  }
};

TEST(Observed, DifferentiatesASensorThatGivesNoJacobian) {
  const Observed model{KinematicModel<3, Eigen::Dynamic>{dwna<3>(1.0)}, SquaredDistance{}};
  const Vector<Eigen::Dynamic, 9> x = Vector<6>(1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
  EXPECT_EQ(model.measurement_jacobian(x), (RectangularMatrix<1, 6>(2.0, 4.0, 6.0, 0.0, 0.0, 0.0)));
  EXPECT_EQ(model.measurement_difference(Vector<1>(5.0), Vector<1>(3.0)), Vector<1>(2.0));
}

TEST(Observed, ShowsItsParts) {
  const Turning model{CoordinatedTurn<3>{0.5, 0.1}, PolarSensor<2>{Vector<2>(5.0, 6.0)}};
  EXPECT_EQ(model.name(), "coordinated_turn");
  EXPECT_EQ(model.size(), 7);
  EXPECT_EQ(model.components().back(), "omega");
  EXPECT_EQ(model.motion().q(), 0.5);
  EXPECT_EQ(model.sensor().origin(), (Vector<2>(5.0, 6.0)));
}

}  // namespace
}  // namespace sigmax
