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

}  // namespace members_as_modes_test
