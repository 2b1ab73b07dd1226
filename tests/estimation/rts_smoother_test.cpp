#include <sigmax/estimation/rts_smoother.hpp>

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include <sigmax/estimation/any_model.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/fixed_step_motion.hpp>

#include "support/matrices.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using namespace support;

using Model = FixedStepMotion<2>;
using Record = std::vector<FilteredStep<Gaussian<2>>>;

/// The whole trajectory at once: the normal equations of its prior, its motion and its measurements.
TEST(RtsSmoother, IsTheLeastSquaresSolutionForTheWholeTrajectory) {
  holds([] {
    const Model model{"any",
                      {"a", "b"},
                      1.0,
                      generated_matrix<2, 2>(),
                      fixed<2, 2>(generated_covariance(2)),
                      generated_matrix<2, 1>()};
    const LinearSensor<1, 2> sensor{generated_matrix<1, 2>()};
    Record record{{0.0, generated_gaussian<2>()}};
    std::vector<std::optional<Gaussian<1>>> measurements(7);
    for (auto& z : measurements) {
      auto estimate = predict(model, record.back().state, 1.0);
      if (*rc::gen::inRange(0, 4) > 0) {
        z = generated_gaussian<1>();
        estimate = update(model, estimate, *z, sensor);
      }
      record.push_back({1.0, estimate});
    }
    const auto smoothed = smooth(model, record);
    RC_ASSERT(smoothed.size() == record.size());
    RC_ASSERT(smoothed.back().mean == record.back().state.mean);
    RC_ASSERT(smoothed.back().covariance == record.back().state.covariance);

    const std::size_t n = 2 * record.size();
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
    const auto& start = record.front().state;
    add(placed(I, 0, {2, n}), {start.mean(0), start.mean(1)}, dense(start.covariance));
    for (std::size_t k = 0; k < measurements.size(); ++k) {
      const auto& u = model.known_input(1.0);
      add(placed(I, k + 1, placed(-1.0 * dense(model.transition(1.0)), k, {2, n})), {u(0), u(1)},
          dense(model.process_covariance(1.0)));
      if (const auto& z = measurements[k])
        add(placed(dense(sensor.measurement_matrix()), k + 1, {1, n}), {z->mean(0)}, dense(z->covariance));
    }
    const auto covariance = matrix_of(restatement::inverse(information).matrix);
    const auto mean = (covariance * vector_of(vector)).eval();
    for (std::size_t k = 0; k < smoothed.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(2 * k);
      require_near_matrix(smoothed[k].mean, mean.segment(at, 2), 1e-9);
      require_near_matrix(smoothed[k].covariance, covariance.block(at, at, 2, 2), 1e-9);
    }
  });
}

TEST(RtsSmoother, OfAnEmptyRecordIsNothing) { EXPECT_TRUE(smooth(AnyModel{dwna<1>(1.0)}, {}).empty()); }

TEST(RtsSmoother, TakesASingularProcessCovarianceAndAStepOfNoTime) {
  const auto model = dwpa<2>(0.0);
  std::vector<FilteredStep<Gaussian<6>>> record{{0.0, {Vector<6>::Zero(), SquareMatrix<6>::Identity()}}};
  for (const double dt : {0.5, 0.0, 1.0}) {
    const auto predicted = predict(model, record.back().state, dt);
    record.push_back({dt, update(model, predicted, {Vector<2>{dt, 1.0}, SquareMatrix<2>::Identity()})});
  }
  // Without noise the trajectory is its last state, taken back.
  const auto smoothed = smooth(model, record);
  double left = 0.0;
  for (std::size_t k = record.size(); k-- > 0;) {
    const auto there = model.transition(left);
    EXPECT_PRED_FORMAT3(near_matrix, there * smoothed[k].mean, record.back().state.mean, 1e-12);
    EXPECT_PRED_FORMAT3(near_matrix, there * smoothed[k].covariance * there.transpose(), record.back().state.covariance,
                        1e-12);
    left += record[k].dt;
  }
}

TEST(RtsSmoother, NamesTheModelWhoseCovarianceLostDefiniteness) {
  const Gaussian<2> lost{Vector<2>::Zero(), SquareMatrix<2>{{1.0, 2.0}, {2.0, 1.0}}};
  Gaussian<2> result;
  EXPECT_TRUE(throws<std::domain_error>([&] { smooth_step(dwna<1>(1.0), lost, 0.0, lost, result); },
                                        {"model 'dwna'", "not positive semi-definite"}));
}

}  // namespace
}  // namespace sigmax
