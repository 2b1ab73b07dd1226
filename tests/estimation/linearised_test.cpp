#include "estimation/quadratic.hpp"

namespace linearised_test {

const CoordinatedTurn<2> turn{2.0, 1e-3};
const PolarSensor<2> radar{Vector<2>{-3e3, 500.0}};
const Gaussian<5> prior{Vector<5>(1200.0, -800.0, 90.0, 60.0, 0.15),
                        Vector<5>(900.0, 400.0, 36.0, 64.0, 0.01).asDiagonal()};
const Gaussian<2> z{Vector<2>{4500.0, -0.4}, Vector<2>{100.0, 1e-4}.asDiagonal()};

TEST(Linearised, OfALinearModelIsTheModelItself) {
  const auto motion = dwna<2>(3.0, Vector<2>(1.0, -2.0));
  const Gaussian<4> x{Vector<4>(1.0, 2.0, 3.0, 4.0), SquareMatrix<4>::Identity()};
  const LinearSensor<2, 3> sensor{RectangularMatrix<2, 3>{{1, 2, 3}, {4, 5, 6}}};
  for (const AnyModel& model : {AnyModel{motion}, AnyModel{Cubature{motion}}}) {
    const auto step = linearised_step(model, {x.mean, x.covariance}, 2.0);
    EXPECT_EQ(step.mean, motion.transition(2.0) * x.mean + motion.known_input(2.0));
    EXPECT_EQ(step.F, motion.transition(2.0));
    EXPECT_EQ(step.Q, motion.process_covariance(2.0));
    const auto seen = linearised_measurement(model, {x.mean, x.covariance}, z, sensor);
    EXPECT_EQ(seen.residual, z.mean - Vector<2>(14.0, 32.0));
    EXPECT_EQ(seen.H, (RectangularMatrix<2, 4>{{1, 2, 3, 0}, {4, 5, 6, 0}}));
    EXPECT_EQ(seen.R, z.covariance);
  }
}

TEST(Linearised, OfTheExtendedFilterHasTheSlopesAtTheMean) {
  const auto step = linearised_step(Extended{turn}, prior, 2.5);
  EXPECT_EQ(step.mean, turn.propagate(prior.mean, 2.5));
  EXPECT_EQ(step.F, turn.transition_jacobian(prior.mean, 2.5));
  EXPECT_EQ(step.Q, turn.process_covariance(2.5));
  const auto seen = linearised_measurement(Extended{turn}, prior, z, radar);
  const Vector<2> at = prior.mean.head<2>();
  EXPECT_EQ(seen.residual, z.mean - radar.measure(at));
  EXPECT_EQ(seen.H.leftCols<2>(), radar.measurement_jacobian(at));
  EXPECT_EQ((seen.H.rightCols<3>()), (RectangularMatrix<2, 3>::Zero()));
  EXPECT_EQ(seen.R, z.covariance);
}

/// x² about N(m, P) is m² + P + 2m (x − m) and a rest of variance 2P².
TEST(Linearised, WhatPointsLeaveUnexplainedIsNoise) {
  const AnyModel filter = Unscented{square};
  const auto step = linearised_step(filter, one_number(3.0, 0.5), 1.0);
  EXPECT_CLOSE(step.mean(0), 9.5, 1e-14);
  EXPECT_CLOSE(step.F(0), 6.0, 1e-14);
  EXPECT_CLOSE(step.Q(0), 1.5, 1e-14);
  const auto seen =
      linearised_measurement(filter, one_number(3.0, 0.5), measured_number(5.0, 7.0), OwnSensor{square.model});
  EXPECT_CLOSE(seen.residual(0), -4.5, 1e-14);
  EXPECT_CLOSE(seen.H(0), 6.0, 1e-14);
  EXPECT_CLOSE(seen.R(0), 7.5, 1e-14);
}

/// A component that is known for certain has no slope, and the others theirs as before.
TEST(Linearised, NothingIsRegressedOnWhatDoesNotVary) {
  Gaussian<5> certain = prior;
  certain.covariance(4, 4) = 0.0;
  const auto step = linearised_step(Cubature{turn}, certain, 2.5);
  EXPECT_EQ(step.F.col(4), Vector<5>::Zero());
  EXPECT_CLOSE(step.F * certain.covariance * step.F.transpose() + step.Q,
               predict(Cubature{turn}, certain, 2.5).covariance, 1e-9);
}

}  // namespace linearised_test
