/// What a member makes of a motion and of a sensor as linear ones, beside the regression written down: points, sums
/// over them, and F = Cov(f, x) P⁻¹.

#include <sigmax/estimation/linearised.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/cubature.hpp>
#include <sigmax/estimation/sensors.hpp>
#include <sigmax/estimation/unscented.hpp>

#include "support/matrices.hpp"

namespace sigmax {
namespace {

using support::near_matrix;
using State = Vector<5>;
using Square = SquareMatrix<5>;

const CoordinatedTurn<2> turn{2.0, 1e-3};
const PolarSensor<2> radar{Vector<2>{-3e3, 500.0}};
constexpr double dt = 2.5;

Gaussian<5> prior() {
  Gaussian<5> result{State::Zero(), Square::Zero()};
  result.mean << 1200.0, -800.0, 90.0, 60.0, 0.15;
  const State sigma = (State() << 30.0, 20.0, 6.0, 8.0, 0.1).finished();
  for (int i = 0; i < 5; ++i)
    for (int k = 0; k < 5; ++k) result.covariance(i, k) = sigma(i) * sigma(k) * (i == k ? 1.0 : 0.3 / (1 + i + k));
  return result;
}

/// A point of a rule: where it lies from the mean, and its weights.
struct Point {
  State offset;
  double in_mean, in_covariance;
};
std::vector<Point> points(double spread, double centre_in_mean, double centre_in_covariance) {
  const Square L = Eigen::LLT<Square>(prior().covariance).matrixL();
  std::vector<Point> result{{State::Zero(), centre_in_mean, centre_in_covariance}};
  for (int i = 0; i < 5; ++i)
    for (const double sign : {1.0, -1.0})
      result.push_back({sign * std::sqrt(spread) * L.col(i), 0.5 / spread, 0.5 / spread});
  return result;
}

/// The mean of f, F, and the covariance of what F leaves unexplained.
template <int M>
struct Regression {
  Vector<M> mean = Vector<M>::Zero();
  RectangularMatrix<M, 5> F = RectangularMatrix<M, 5>::Zero();
  SquareMatrix<M> rest = SquareMatrix<M>::Zero();

  template <class Function>
  Regression(const std::vector<Point>& rule, const Function& f) {
    for (const Point& each : rule) mean += each.in_mean * f(State(prior().mean + each.offset));
    for (const Point& each : rule) {
      const Vector<M> deviation = f(State(prior().mean + each.offset)) - mean;
      F += each.in_covariance * deviation * each.offset.transpose();
      rest += each.in_covariance * deviation * deviation.transpose();
    }
    F = (F * prior().covariance.inverse()).eval();
    rest -= F * prior().covariance * F.transpose();
  }
};

template <class Filter>
void equals_the_regression(const Filter& member, const std::vector<Point>& rule) {
  const auto step = linearised_step(member, prior(), dt);
  const Regression<5> expected(rule, [](const State& x) { return turn.propagate(x, dt); });
  EXPECT_PRED_FORMAT3(near_matrix, step.mean, expected.mean, 1e-9);
  EXPECT_PRED_FORMAT3(near_matrix, step.F, expected.F, 1e-9);
  EXPECT_PRED_FORMAT3(near_matrix, step.Q, (expected.rest + turn.process_covariance(dt)).eval(), 1e-9);

  const Gaussian<2> z{Vector<2>{4500.0, -0.4}, Vector<2>{100.0, 1e-4}.asDiagonal()};
  const auto seen = linearised_measurement(member, prior(), z, radar);
  const Regression<2> measured(rule, [](const State& x) { return radar.measure(Vector<2>(x.head<2>())); });
  EXPECT_PRED_FORMAT3(near_matrix, seen.residual, (z.mean - measured.mean).eval(), 1e-9);
  EXPECT_PRED_FORMAT3(near_matrix, seen.H, measured.F, 1e-9);
  EXPECT_PRED_FORMAT3(near_matrix, seen.R, (measured.rest + z.covariance).eval(), 1e-9);

  const AnyMember<CoordinatedTurn<2>> any{member};
  EXPECT_EQ(linearised_step(any, prior(), dt).F, step.F);
  EXPECT_EQ(linearised_measurement(any, prior(), z, radar).H, seen.H);
}

TEST(Linearised, ByTheUnscentedRuleIsTheRegressionOverItsPoints) {
  equals_the_regression(Unscented{turn, {1.0, 0.0, 1.0}}, points(6.0, 1.0 / 6.0, 1.0 / 6.0));  // λ = 1
  const double alpha = 0.5, spread = alpha * alpha * 5.0, centre = 1.0 - 5.0 / spread;         // λ = α² n − n
  equals_the_regression(Unscented{turn, {alpha, 2.0, 0.0}}, points(spread, centre, centre + 1.0 - alpha * alpha + 2.0));
}
TEST(Linearised, ByTheCubatureRuleIsTheRegressionOverItsPoints) {
  equals_the_regression(Cubature{turn}, points(5.0, 0.0, 0.0));
}

/// Differences of f over 2h, h small.
template <int M, class Function>
RectangularMatrix<M, 5> slopes(const Function& f) {
  RectangularMatrix<M, 5> result;
  for (int k = 0; k < 5; ++k) {
    const double h = 1e-5 * std::sqrt(prior().covariance(k, k));
    const State step = h * State::Unit(k);
    result.col(k) = (f(State(prior().mean + step)) - f(State(prior().mean - step))) / (2.0 * h);
  }
  return result;
}

TEST(Linearised, OfTheExtendedFilterHasTheSlopesAtTheMean) {
  const Extended member{turn};
  const auto step = linearised_step(member, prior(), dt);
  EXPECT_PRED_FORMAT3(near_matrix, step.mean, turn.propagate(prior().mean, dt), 1e-12);
  EXPECT_PRED_FORMAT3(near_matrix, step.F, slopes<5>([](const State& x) { return turn.propagate(x, dt); }), 1e-5);
  EXPECT_PRED_FORMAT3(near_matrix, step.Q, turn.process_covariance(dt), 1e-12);
  const Gaussian<2> z{Vector<2>{4500.0, -0.4}, Vector<2>{100.0, 1e-4}.asDiagonal()};
  const auto seen = linearised_measurement(member, prior(), z, radar);
  const auto measure = [](const State& x) { return radar.measure(Vector<2>(x.head<2>())); };
  EXPECT_PRED_FORMAT3(near_matrix, seen.H, slopes<2>(measure), 1e-7);
  EXPECT_PRED_FORMAT3(near_matrix, seen.residual, (z.mean - measure(prior().mean)).eval(), 1e-12);
  EXPECT_EQ(seen.R, z.covariance);
}

/// A component that is known for certain has no slope, and the others theirs as before.
TEST(Linearised, NothingIsRegressedOnWhatDoesNotVary) {
  Gaussian<5> certain = prior();
  certain.covariance.row(4).setZero();
  certain.covariance.col(4).setZero();
  const auto step = linearised_step(Cubature{turn}, certain, dt);
  EXPECT_EQ(step.F.col(4), State::Zero());
  const Square spread = step.F * certain.covariance * step.F.transpose() + step.Q;
  Gaussian<5> predicted = certain;
  predict(Cubature{turn}, certain, dt, predicted);
  EXPECT_PRED_FORMAT3(near_matrix, spread, predicted.covariance, 1e-9);
}

}  // namespace
}  // namespace sigmax
