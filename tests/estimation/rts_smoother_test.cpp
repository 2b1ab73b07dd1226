#include "support/nonlinear_restatement.hpp"
#include "support/sigmax.hpp"

namespace rts_smoother_test {

/// The whole trajectory at once: its Gaussian, and all measurements as one.
PROPERTY(RtsSmoother, IsTheUpdateOfTheWholeTrajectoryByAllMeasurements) {
  using restatement::transposed;
  constexpr std::size_t steps = 7, n = 2 * (steps + 1);
  const auto F = generated(2, 2), Q = generated_covariance(2), u = generated(2, 1), H = generated(1, 2);
  const FixedStepMotion<2> model("any", {"a", "b"}, 1.0, fixed<2, 2>(F), fixed<2, 2>(Q), fixed<2, 1>(u));
  const LinearSensor<1, 2> sensor{fixed<1, 2>(H)};

  // x_k = Σ Fᵏ⁻ʲ ξ_j of the independent ξ_0 = x_0 and ξ_j = u + w_j.
  std::vector<FilteredStep<Gaussian<2>>> record{{0.0, generated_gaussian<2>()}};
  restatement::Matrix A(n, n), D(n, n), seen(steps, n), R(steps, steps);
  restatement::Vector mean(n), z(steps);
  for (std::size_t j = 0; j <= steps; ++j) {
    auto power = restatement::identity(2);
    for (std::size_t k = j; k <= steps; ++k, power = F * power)
      for (std::size_t i = 0; i < 4; ++i) A(2 * k + i / 2, 2 * j + i % 2) = power.values[i];
    const auto covariance = j == 0 ? dense(record.front().state.covariance) : Q;
    for (std::size_t i = 0; i < 4; ++i) D(2 * j + i / 2, 2 * j + i % 2) = covariance.values[i];
    for (std::size_t i = 0; i < 2; ++i) mean[2 * j + i] = j == 0 ? record.front().state.mean(i == 1) : u.values[i];
  }
  restatement::State all{A * mean, A * D * transposed(A)};

  for (std::size_t k = 0; k < steps; ++k) {
    auto estimate = predict(model, record.back().state, 1.0);
    R(k, k) = 1.0;
    if (*rc::gen::inRange(0, 4) > 0) {  // else nothing is seen of the step
      const auto measured = generated_gaussian<1>();
      z[k] = measured.mean(0);
      R(k, k) = measured.covariance(0);
      for (std::size_t i = 0; i < 2; ++i) seen(k, 2 * k + 2 + i) = H(0, i);
      estimate = update(model, estimate, measured, sensor);
    }
    record.push_back({1.0, estimate});
  }
  all = restatement::corrected(all, restatement::difference(z, seen * all.mean),
                               seen * all.covariance * transposed(seen) + R, all.covariance * transposed(seen))
            .posterior;
  const auto smoothed = smooth(model, record);
  RC_ASSERT(smoothed.back().covariance == record.back().state.covariance);
  for (std::size_t k = 0; k <= steps; ++k) {
    const auto at = static_cast<Eigen::Index>(2 * k);
    require_near(smoothed[k].mean, vector_of(all.mean).segment(at, 2), 1e-8);
    require_near(smoothed[k].covariance, matrix_of(all.covariance).block(at, at, 2, 2), 1e-8);
  }
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
    EXPECT_CLOSE(there * smoothed[k].mean, record.back().state.mean, 1e-12);
    EXPECT_CLOSE(there * smoothed[k].covariance * there.transpose(), record.back().state.covariance, 1e-12);
    left += record[k].dt;
  }
}

TEST(RtsSmoother, NamesTheModelWhoseCovarianceLostDefiniteness) {
  const Gaussian<2> lost{Vector<2>::Zero(), SquareMatrix<2>{{1.0, 2.0}, {2.0, 1.0}}};
  Gaussian<2> result;
  EXPECT_REFUSED(std::domain_error, ("model 'dwna'", "not positive semi-definite"),
                 smooth_step(dwna<1>(1.0), lost, 0.0, lost, result));
}

}  // namespace rts_smoother_test
