// Every member of the Kalman family is a mode of a multiple-model filter.

#include "hybrid/banks.hpp"

namespace members_as_modes_test {

Gaussian<2> measurement(int k) {
  const double t = 0.5 * (k + 1);
  return {Vector<2>(1000.0 + 50.0 * t + 4.0 * t * t, 2000.0 - 60.0 * t + 3.0 * std::sin(5.0 * t)),
          25.0 * SquareMatrix<2>::Identity()};
}

TEST(MembersAsModes, OverLinearModelsTheyAreTheKalmanFilter) {
  const RandomVariable mode{"mode", 2};
  const Relation transition{mode, mode, {{0.9, 0.1}, {0.2, 0.8}}};
  const Gaussian<6> start{Vector<6>(1000.0, 2000.0, 50.0, -60.0, 0.0, 0.0), 100.0 * SquareMatrix<6>::Identity()};
  InteractingMultipleModel expected{std::tuple{dwna<2>(3.0), singer<2>(0.2, 2.0)}, transition, start};
  InteractingMultipleModel found{Models{Unscented{dwna<2>(3.0)}, Cubature{singer<2>(0.2, 2.0)}}, transition, start};
  for (int k = 0; k < 40; ++k) {
    if (k % 7 == 3) {
      expected.step(0.5);
      found.step(0.5);
    } else {
      expected.step(0.5, measurement(k));
      found.step(0.5, measurement(k), PositionSensor<2>{});
    }
    ASSERT_PRED_FORMAT3(same_state, shown(found), shown(expected), 1e-9);
    ASSERT_CLOSE(shown(found).nis, shown(expected).nis, 1e-9);
  }
}

TEST(MembersAsModes, OneAloneIsItself) {
  const Unscented member{CoordinatedTurn<2>{1.0, 1e-4}};
  const FuzzyVariable mode{"mode", 1};
  Gaussian<5> x{Vector<5>(1e3, 2e3, 50.0, -60.0, 0.1), 100.0 * SquareMatrix<5>::Identity()};
  x.covariance(4, 4) = 0.01;
  InteractingMultipleModel filter{std::tuple{member}, Relation{mode, mode, {{1.0}}}, x};
  for (int k = 0; k < 20; ++k) {
    const Vector<2> seen = PolarSensor<2>{}.measure(measurement(k).mean);
    const auto z = PolarSensor<2>::measurement({seen(0), seen(1), 0.0}, {5.0, 0.005, 0.0});
    predict(member, x, 0.5, x);
    const auto innovation = update(member, x, z, PolarSensor<2>{}, x);
    filter.step(0.5, z, PolarSensor<2>{});
    EXPECT_EQ(filter.innovations()[0].log_likelihood, innovation.log_likelihood);
    EXPECT_EQ(filter.estimate<0>().mean, x.mean);
  }
}

TEST(MembersAsModes, ATurnIsRecognisedAndItsRateIsFound) {
  // A target flies straight, then turns at 0.1 rad/s; a radar sees it without errors, across ±180° of azimuth.
  const RandomVariable mode{"mode", {"straight", "turn"}};
  const Relation transition{mode, mode, {{0.95, 0.05}, {0.05, 0.95}}};
  const PolarSensor<2> radar;
  Gaussian<5> x{Vector<5>(-8e3, 500.0, 0.0, -100.0, 0.0), 100.0 * SquareMatrix<5>::Identity()};
  x.covariance(4, 4) = 0.01;
  InteractingMultipleModel filter{std::tuple{Extended{dwna<2>(0.1)}, Unscented{CoordinatedTurn<2>{0.1, 1e-5}}},
                                  transition, x};
  const CoordinatedTurn<2> truth{0.0, 0.0};
  Vector<5> state = x.mean;
  for (int k = 0; k < 30; ++k) {
    state(4) = k < 10 ? 0.0 : 0.1;
    state = truth.propagate(state, 1.0);
    filter.step(1.0, {radar.measure(Vector<2>(state.head<2>())), SquareMatrix<2>{{25.0, 0.0}, {0.0, 1e-6}}}, radar);
    if (k == 9) {
      EXPECT_EQ(filter.most_likely_mode(), 0U);
    }
  }
  EXPECT_EQ(filter.most_likely_mode(), 1U);
  EXPECT_GT(filter.belief()[1], 0.9);
  EXPECT_EQ(filter.components().back(), "omega");
  EXPECT_NEAR(filter.estimate<1>().mean(4), 0.1, 0.005);
  EXPECT_NEAR(filter.estimate().mean(0), state(0), 2.0);
  EXPECT_NEAR(filter.estimate().mean(1), state(1), 2.0);
}

}  // namespace members_as_modes_test
