// Over 1,000 runs matched to their model, mean NEES and NIS of every member lie inside their 95 % band.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include <sigmax/estimation/chi_square.hpp>
#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/metrics.hpp>
#include <sigmax/estimation/ornstein_uhlenbeck.hpp>
#include <sigmax/estimation/sensors.hpp>

#include "estimation/members.hpp"

namespace sigmax {
namespace {

constexpr int runs = 1000;
constexpr int steps = 20;
constexpr double degree = std::numbers::pi / 180.0;

template <int N>
Vector<N> drawn(const SquareMatrix<N>& covariance, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  const Vector<N> w = Vector<N>::NullaryExpr([&] { return normal(generator); });
  return detail::covariance_root(covariance, "noise") * w;
}

struct Consistency {
  double nees = 0.0;  ///< of the last estimate
  double nis = 0.0;   ///< of all measurements
};

/// Truth and measurements come from the model, the start from the prior; every fifth measurement is missed.
template <class Filter, class Model, class Sensor>
Consistency consistency(const Filter& filter, const Model& model, const Sensor& sensor, const EstimateOf<Model>& start,
                        const SquareMatrix<Sensor::measurement_size>& R, double dt) {
  constexpr int N = Model::state_size;
  constexpr int M = Sensor::measurement_size;
  std::mt19937_64 generator(1);
  Consistency mean;
  int measured = 0;
  for (int run = 0; run < runs; ++run) {
    Vector<N> truth = start.mean + drawn<N>(start.covariance, generator);
    EstimateOf<Model> estimate = start;
    for (int k = 0; k < steps; ++k) {
      const double step = k % 3 == 0 ? 0.5 * dt : dt;
      truth = propagated(model, truth, step) + drawn<N>(model.process_covariance(step), generator);
      predict(filter, estimate, step, estimate);
      if (k % 5 == 4) continue;
      const Gaussian<M> z{predicted_measurement(model, sensor, truth) + drawn<M>(R, generator), R};
      mean.nis += update(filter, estimate, z, sensor, estimate).squared_distance;
      ++measured;
    }
    mean.nees += nees(estimate, truth) / runs;
  }
  mean.nis /= measured;
  return mean;
}

template <class Filter, class Model, class Sensor>
void expect_consistent(const char* name, const Filter& filter, const Model& model, const Sensor& sensor,
                       const EstimateOf<Model>& start, const SquareMatrix<Sensor::measurement_size>& R,
                       double dt = 1.0) {
  const Consistency found = consistency(filter, model, sensor, start, R, dt);
  const Band nees_band = chi_square_band(Model::state_size, runs);
  const Band nis_band = chi_square_band(Sensor::measurement_size, runs * steps * 4 / 5);
  EXPECT_GE(found.nees, nees_band.lower) << name;
  EXPECT_LE(found.nees, nees_band.upper) << name;
  EXPECT_GE(found.nis, nis_band.lower) << name;
  EXPECT_LE(found.nis, nis_band.upper) << name;
}

template <class Model, class Sensor>
void expect_all_consistent(const Model& model, const Sensor& sensor, const EstimateOf<Model>& start,
                           const SquareMatrix<Sensor::measurement_size>& R) {
  expect_consistent("extended", Extended{model}, model, sensor, start, R);
  expect_consistent("unscented", Unscented{model}, model, sensor, start, R);
  expect_consistent("cubature", Cubature{model}, model, sensor, start, R);
}

TEST(MemberConsistency, OfALinearModel) {
  const auto model = dwna<2>(1.0);
  const PositionSensor<2> sensor;
  Gaussian<4> start{Vector<4>(1000.0, 2000.0, 10.0, -20.0), SquareMatrix<4>::Zero()};
  start.covariance.diagonal() << 400.0, 400.0, 25.0, 25.0;
  const SquareMatrix<2> R{{100.0, 20.0}, {20.0, 100.0}};
  expect_consistent("kalman", model, model, sensor, start, R);
  expect_all_consistent(model, sensor, start, R);
}

TEST(MemberConsistency, OfLinearMotionsSeenByARadar) {
  Gaussian<6> start{Vector<6>(12e3, 8e3, 1e3, -100.0, -100.0, 0.0), SquareMatrix<6>::Zero()};
  start.covariance.diagonal() << 400.0, 400.0, 400.0, 100.0, 100.0, 25.0;
  const SquareMatrix<3> R = PolarSensor<3>::measurement({}, {10.0, 0.1 * degree, 0.1 * degree}).covariance;
  expect_all_consistent(dwna<3>(3.0), PolarSensor<3>{}, start, R);
  expect_all_consistent(ou_velocity<3>(0.1, 15.0, Vector<3>(-100.0, -100.0, 0.0)), PolarSensor<3>{}, start, R);
}

TEST(MemberConsistency, OfATurnSeenByARadar) {
  Gaussian<5> start{Vector<5>(12e3, 8e3, -100.0, -100.0, 0.05), SquareMatrix<5>::Zero()};
  start.covariance.diagonal() << 400.0, 400.0, 25.0, 25.0, 1e-4;
  const SquareMatrix<2> R = PolarSensor<2>::measurement({}, {10.0, 0.1 * degree, 0.0}).covariance;
  expect_all_consistent(CoordinatedTurn<2>{1.0, 1e-5}, PolarSensor<2>{}, start, R);
}

}  // namespace
}  // namespace sigmax
