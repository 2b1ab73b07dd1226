// Sensors that take turns, step by step, in one multiple-model filter, against the restatement.

#include "hybrid/banks.hpp"
#include "support/nonlinear_restatement.hpp"

namespace interacting_sensors_test {

const Vector<2> radar_at(14000.0, 6000.0), camera_at(30000.0, 7000.0);
constexpr double no_bearing = 1e9;

/// The manoeuvring target is seen by a position, a radar away from the origin, and a bearing taken from across the
/// ±180° line, in turn: act(dt, z, sensor, the same in the restatement's terms, the azimuth if it is one).
template <class Act, class Miss>
void sightings(std::size_t count, const Act& act, const Miss& miss) {
  std::mt19937_64 generator(23);
  std::normal_distribution<double> normal;
  std::size_t k = 0;
  for (const Scan& scan : manoeuvring_target(count)) {
    const std::size_t turn = k++ % 3;
    if (!scan.z) {
      miss(scan.dt);
    } else if (turn == 0) {
      act(scan.dt, *scan.z, PositionSensor<2>{}, restatement::seen_by_matrix(entries(scan.z->mean)), no_bearing);
    } else if (turn == 1) {
      const Vector<2> from = scan.z->mean - radar_at;
      const Gaussian<2> z{
          Vector<2>(from.norm() + 5.0 * normal(generator), std::atan2(from(1), from(0)) + 0.002 * normal(generator)),
          SquareMatrix<2>{{25.0, 0.001}, {0.001, 4e-6}}};
      act(scan.dt, z, PolarSensor<2>{radar_at}, restatement::seen_by_radar(entries(z.mean), radar_at(0), radar_at(1)),
          no_bearing);
    } else {
      const Vector<2> from = scan.z->mean - camera_at;
      const double azimuth = std::atan2(from(1), from(0)) + 0.003 * normal(generator);
      act(scan.dt, Gaussian<1>{Vector<1>(azimuth), SquareMatrix<1>(9e-6)}, BearingSensor{camera_at},
          restatement::seen_by_bearing(azimuth, camera_at(0), camera_at(1)), azimuth);
    }
  }
}

/// Some moves are impossible, so that some pairs of modes are not there whatever measures.
TargetChoice with_gaps(TargetChoice choice) {
  choice.transition = choice.fuzzy ? Rows{{1.0, 0.5, 0.0}, {0.0, 1.0, 0.5}, {0.25, 0.0, 1.0}}
                                   : Rows{{0.8, 0.2, 0.0}, {0.0, 0.7, 0.3}, {0.25, 0.0, 0.75}};
  return choice;
}

TEST(InteractingSensors, TakeTurnsAsInTheRestatementAndAsSensorsKnownAtRunTime) {
  std::vector<TargetChoice> choices;
  for (const bool fuzzy : {false, true})
    for (const Scheme scheme : {Scheme::interacting, Scheme::second_order}) {
      choices.push_back(chosen(fuzzy, scheme));
      choices.push_back(with_gaps(chosen(fuzzy, scheme)));
    }
  for_each(choices, [](const TargetChoice& choice) {
    AnyFilter filter(choice), any = filter;
    auto expected = restated(choice, starts());
    double least = 0.0, greatest = 0.0;
    const auto agree = [&] {
      ASSERT_TRUE(agrees(filter, expected));
      ASSERT_PRED_FORMAT3(same_state, any, filter, 0.0);
    };
    sightings(
        150,
        [&](double dt, const auto& z, const auto& sensor, const auto& see, double azimuth) {
          filter.step(dt, z, sensor);
          any.step(dt, {z.mean, z.covariance}, AnySensor(sensor));
          expected.step(dt, see, dense(z.covariance));
          agree();
          if (azimuth == no_bearing) return;
          least = std::min(least, azimuth);
          greatest = std::max(greatest, azimuth);
        },
        [&](double dt) {
          filter.step(dt);
          any.step(dt);
          expected.step(dt);
          agree();
        });
    EXPECT_LT(least, -3.0) << "the bearings should go across the line";
    EXPECT_GT(greatest, 3.0);
  });
}

/// Six quantities at once, more than any model of the plane has states of the same kind.
TEST(InteractingSensors, MayMeasureSixQuantitiesAtOnce) {
  const RectangularMatrix<6, 4> H{{1, 0, 0, 0}, {0, 1, 0, 0},     {0, 0, 1, 0},
                                  {0, 0, 0, 1}, {0.5, 0.5, 0, 0}, {0, 0, 1, -1}};
  AnyFilter filter(chosen(false));
  auto expected = restated(chosen(false), starts());
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal;
  SquareMatrix<6> R = 40.0 * SquareMatrix<6>::Identity();
  R(0, 5) = R(5, 0) = 7.0;
  for (int k = 0; k < 40; ++k) {
    const double t = 0.2 * (k + 1), turn = std::max(t - 4.0, 0.0);
    Gaussian<6> z{
        H * Vector<4>(12000.0 - 100.0 * t, 8000.0 - 100.0 * t + 4.0 * turn * turn, -100.0, -100.0 + 8.0 * turn), R};
    for (double& value : z.mean) value += 6.0 * normal(generator);
    filter.step(0.2, z, LinearSensor<6, 4>{H});
    expected.step(0.2, restatement::seen_by_rows(entries(z.mean), dense(H)), dense(R));
    ASSERT_TRUE(agrees(filter, expected));
    ASSERT_EQ(filter.innovations[0].residual().size(), 6);
  }
}

TEST(InteractingSensors, AComponentThatAModelLacksIsRefusedAndTheFilterIsAsItWas) {
  AnyFilter filter(chosen(true));
  const auto before = filter;
  const LinearSensor<1, 6> acceleration{RectangularMatrix<1, 6>(0, 0, 0, 0, 1, 0)};
  EXPECT_INVALID(("sees 6", "dwna", "4"), filter.step(0.2, {Vector<1>(0.0), SquareMatrix<1>(1.0)}, acceleration));
  EXPECT_PRED_FORMAT3(same_state, filter, before, 0.0);
}

}  // namespace interacting_sensors_test
