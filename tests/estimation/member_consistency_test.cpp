// Over 1,000 runs matched to their model, mean NEES and NIS of every member lie inside their 95 % band.

#include "support/linearised.hpp"

namespace member_consistency_test {

constexpr int runs = 1000;
constexpr int steps = 20;

using State = StateOf<AnyModel>;
using Covariance = StateMatrixOf<AnyModel>;

State drawn(const Covariance& covariance, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  const auto n = covariance.rows();
  Covariance root(n, n);
  EXPECT_EQ(detail::covariance_root(covariance.data(), static_cast<int>(n), root.data()), 0);
  return root * State::NullaryExpr(n, [&] { return normal(generator); });
}

void expect_inside(double value, const Band& band, const AnyModel& filter) {
  EXPECT_GE(value, band.lower) << filter.name();
  EXPECT_LE(value, band.upper) << filter.name();
}

/// Truth and measurements come from the motion, the start from the prior; every fifth measurement is missed.
template <class Moves>
void expect_consistent(const Moves& motion, const AnySensor& sensor, const EstimateOf<AnyModel>& start,
                       const Covariance& R) {
  const AnyModel truth_model = Extended{motion};
  const auto m = static_cast<int>(R.rows());
  const MeasurementOf<AnySensor> none{Vector<Eigen::Dynamic, 6>::Zero(m), R};
  for (const AnyModel& filter : {AnyModel{Extended{motion}}, AnyModel{Unscented{motion}}, AnyModel{Cubature{motion}}}) {
    std::mt19937_64 generator(1);
    double nees = 0.0;  // of the last estimate
    double nis = 0.0;   // of all measurements
    for (int run = 0; run < runs; ++run) {
      State truth = start.mean + drawn(start.covariance, generator);
      EstimateOf<AnyModel> estimate = start;
      MeasurementOf<AnySensor> z = none;
      for (int k = 0; k < steps; ++k) {
        const double dt = k % 3 == 0 ? 0.5 : 1.0;
        const auto moved = linearised_step(truth_model, {truth, start.covariance}, dt);
        truth = moved.mean + drawn(moved.Q, generator);
        predict(filter, estimate, dt, estimate);
        if (k % 5 == 4) continue;
        z.mean =
            drawn(R, generator) - linearised_measurement(truth_model, {truth, start.covariance}, none, sensor).residual;
        nis += update(filter, estimate, z, sensor, estimate).squared_distance;
      }
      const State error = estimate.mean - truth;
      nees +=
          detail::normalized_error_squared(error.data(), estimate.covariance.data(), static_cast<int>(error.size()));
    }
    constexpr int measured = runs * steps * 4 / 5;
    expect_inside(nees / runs, chi_square_band(static_cast<int>(start.size()), runs), filter);
    expect_inside(nis / measured, chi_square_band(m, measured), filter);
  }
}

EstimateOf<AnyModel> known_to(const State& mean, const State& variances) { return {mean, variances.asDiagonal()}; }

TEST(MemberConsistency, OfALinearModel) {
  expect_consistent(dwna<2>(1.0), PositionSensor<2>{},
                    known_to(Vector<4>(1000.0, 2000.0, 10.0, -20.0), Vector<4>(400.0, 400.0, 25.0, 25.0)),
                    SquareMatrix<2>{{100.0, 20.0}, {20.0, 100.0}});
}

TEST(MemberConsistency, OfLinearMotionsSeenByARadar) {
  const auto start =
      known_to(Vector<6>(12e3, 8e3, 1e3, -100.0, -100.0, 0.0), Vector<6>(400.0, 400.0, 400.0, 100.0, 100.0, 25.0));
  const auto R = PolarSensor<3>{}.measurement({}, {10.0, degrees(0.1), degrees(0.1)}).z.covariance;
  expect_consistent(dwna<3>(3.0), PolarSensor<3>{}, start, R);
  expect_consistent(ou_velocity<3>(0.1, 15.0, Vector<3>(-100.0, -100.0, 0.0)), PolarSensor<3>{}, start, R);
}

TEST(MemberConsistency, OfATurnSeenByARadar) {
  expect_consistent(CoordinatedTurn<2>{1.0, std::sqrt(1e-5)}, PolarSensor<2>{},
                    known_to(Vector<5>(12e3, 8e3, -100.0, -100.0, 0.05), Vector<5>(400.0, 400.0, 25.0, 25.0, 1e-4)),
                    PolarSensor<2>{}.measurement({}, {10.0, degrees(0.1)}).z.covariance);
}

}  // namespace member_consistency_test
