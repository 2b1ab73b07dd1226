#include <sigmax/estimation/rts_smoother.hpp>

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include <sigmax/estimation/cubature.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/fixed_step_motion.hpp>
#include <sigmax/estimation/sensors.hpp>
#include <sigmax/estimation/unscented.hpp>

#include "support/matrices.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::dense;
using support::fixed;
using support::holds;
using support::require_near_matrix;
using support::throws;

using Model = FixedStepMotion<2>;
using Sensor = LinearSensor<1, 2>;
using Estimate = Gaussian<2>;
using Record = std::vector<FilteredStep<Estimate>>;

Model generated_model() {
  return {"any",
          {"a", "b"},
          1.0,
          support::generated_matrix<2, 2>(),
          fixed<2, 2>(support::generated_covariance(2)),
          support::generated_matrix<2, 1>()};
}

/// The filtered estimates of a model, of which the first is `start`.
template <class Moves, class Measures>
std::vector<FilteredStep<EstimateOf<Moves>>> filtered(
    const Moves& model, const Measures& sensor, const EstimateOf<Moves>& start,
    const std::vector<std::optional<MeasurementOf<Measures>>>& measurements, double dt) {
  std::vector<FilteredStep<EstimateOf<Moves>>> record{{0.0, start}};
  for (const auto& z : measurements) {
    auto estimate = record.back().state;
    predict(model, estimate, dt, estimate);
    if (z) update(model, estimate, *z, sensor, estimate);
    record.push_back({dt, estimate});
  }
  return record;
}

std::vector<std::optional<Gaussian<1>>> generated_measurements(std::size_t count) {
  std::vector<std::optional<Gaussian<1>>> result(count);
  for (auto& z : result)
    if (*rc::gen::inRange(0, 4) > 0) z = support::generated_gaussian<1>();
  return result;
}

/// The whole trajectory at once: the normal equations of its prior, its motion and its measurements.
TEST(RtsSmoother, IsTheLeastSquaresSolutionForTheWholeTrajectory) {
  holds([] {
    const Model model = generated_model();
    const auto start = support::generated_gaussian<2>();
    const auto measurements = generated_measurements(7);
    const Sensor sensor{support::generated_matrix<1, 2>()};
    const auto smoothed = smooth(model, filtered(model, sensor, start, measurements, 1.0));

    const std::size_t n = 2 * (measurements.size() + 1);
    restatement::Matrix information(n, n);
    restatement::Vector vector(n, 0.0);
    // Adds (A x − b)ᵀ C⁻¹ (A x − b).
    const auto add = [&](const restatement::Matrix& A, const restatement::Vector& b, const restatement::Matrix& C) {
      const auto weighted = restatement::transposed(A) * restatement::inverse(C).matrix;
      information = information + weighted * A;
      const auto more = weighted * b;
      for (std::size_t i = 0; i < n; ++i) vector[i] += more[i];
    };
    const auto placed = [&](const restatement::Matrix& block, std::size_t k, restatement::Matrix A) {
      for (std::size_t i = 0; i < block.rows; ++i)
        for (std::size_t j = 0; j < 2; ++j) A(i, 2 * k + j) += block(i, j);
      return A;
    };
    const auto I = restatement::identity(2);
    add(placed(I, 0, {2, n}), {start.mean(0), start.mean(1)}, dense(start.covariance));
    for (std::size_t k = 0; k < measurements.size(); ++k) {
      const auto& u = model.known_input(1.0);
      add(placed(I, k + 1, placed(-1.0 * dense(model.transition(1.0)), k, {2, n})), {u(0), u(1)},
          dense(model.process_covariance(1.0)));
      if (const auto& z = measurements[k])
        add(placed(dense(sensor.measurement_matrix()), k + 1, {1, n}), {z->mean(0)}, dense(z->covariance));
    }
    const auto covariance = restatement::inverse(information).matrix;
    const auto mean = covariance * vector;
    for (std::size_t k = 0; k < smoothed.size(); ++k) {
      require_near_matrix(smoothed[k].mean, restatement::Matrix(2, 1, {mean[2 * k], mean[2 * k + 1]}), 1e-9);
      require_near_matrix(smoothed[k].covariance,
                          restatement::Matrix(2, 2,
                                              {covariance(2 * k, 2 * k), covariance(2 * k, 2 * k + 1),
                                               covariance(2 * k + 1, 2 * k), covariance(2 * k + 1, 2 * k + 1)}),
                          1e-9);
    }
  });
}

TEST(RtsSmoother, LeavesTheLastEstimateAndAnEmptyRecordAsTheyAre) {
  holds([] {
    const Model model = generated_model();
    const Sensor sensor{support::generated_matrix<1, 2>()};
    const auto record = filtered(model, sensor, support::generated_gaussian<2>(), generated_measurements(5), 1.0);
    const auto smoothed = smooth(model, record);
    RC_ASSERT(smoothed.size() == record.size());
    RC_ASSERT(smoothed.back().mean == record.back().state.mean);
    RC_ASSERT(smoothed.back().covariance == record.back().state.covariance);
  });
  const SquareMatrix<2> I = SquareMatrix<2>::Identity();
  EXPECT_TRUE(smooth(Model{"any", {"a", "b"}, 1.0, I, I}, Record{}).empty());
}

TEST(RtsSmoother, TakesASingularProcessCovarianceAndAStepOfNoTime) {
  const auto model = dwpa<2>(0.0);
  Gaussian<6> start{Vector<6>::Zero(), SquareMatrix<6>::Identity()};
  std::vector<FilteredStep<Gaussian<6>>> record{{0.0, start}};
  for (const double dt : {0.5, 0.0, 1.0}) {
    auto estimate = record.back().state;
    predict(model, estimate, dt, estimate);
    update(model, estimate, Gaussian<2>{Vector<2>{dt, 1.0}, SquareMatrix<2>::Identity()}, estimate);
    record.push_back({dt, estimate});
  }
  // Without noise the trajectory is its last state, taken back.
  const auto smoothed = smooth(model, record);
  for (std::size_t k = 0; k < 3; ++k) {
    double left = 0.0;
    for (std::size_t later = k + 1; later < record.size(); ++later) left += record[later].dt;
    const Vector<6> there = model.transition(left) * smoothed[k].mean;
    EXPECT_PRED_FORMAT3(support::near_matrix, there, record.back().state.mean, 1e-12);
    const SquareMatrix<6> spread = model.transition(left) * smoothed[k].covariance * model.transition(left).transpose();
    EXPECT_PRED_FORMAT3(support::near_matrix, spread, record.back().state.covariance, 1e-12);
  }
}

/// Of a linear motion every member knows the same covariance of x_k and x_k+1.
TEST(RtsSmoother, SmoothsALinearMotionAlikeThroughEveryMember) {
  const auto motion = dwpa<2>(2.0);
  const PositionSensor<2> sensor;
  std::vector<std::optional<Gaussian<2>>> measurements;
  for (int k = 0; k < 8; ++k)
    if (k == 3)
      measurements.push_back(std::nullopt);
    else
      measurements.push_back(Gaussian<2>{Vector<2>{std::sin(k), 2.0 * k}, 0.5 * SquareMatrix<2>::Identity()});
  const Gaussian<6> start{Vector<6>::Ones(), 4.0 * SquareMatrix<6>::Identity()};
  const auto expected = smooth(motion, filtered(motion, sensor, start, measurements, 0.7));
  const auto equals = [&](const auto& member) {
    const auto smoothed = smooth(member, filtered(member, sensor, start, measurements, 0.7));
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_PRED_FORMAT3(support::near_matrix, smoothed[k].mean, expected[k].mean, 1e-9);
      EXPECT_PRED_FORMAT3(support::near_matrix, smoothed[k].covariance, expected[k].covariance, 1e-9);
    }
  };
  equals(Extended{motion});
  equals(Unscented{motion});
  equals(Cubature{motion});
}

TEST(RtsSmoother, NamesTheModelWhoseCovarianceLostDefiniteness) {
  const auto model = dwna<1>(1.0);
  const Gaussian<2> lost{Vector<2>::Zero(), SquareMatrix<2>{{1.0, 2.0}, {2.0, 1.0}}};
  Gaussian<2> result;
  EXPECT_TRUE(throws<std::domain_error>([&] { smooth_step(model, lost, 0.0, lost, result); },
                                        {"model 'dwna'", "not positive semi-definite"}));
}

}  // namespace
}  // namespace sigmax
