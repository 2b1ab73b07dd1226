// The filters in numbers beside their plain restatement, of models of many sizes: rows go by blocks of ten, and from 17
// states on there is no room on the stack.

#include "estimation/restated.hpp"

namespace filtering_test {

using restatement::State;

using Dense = restatement::Matrix;
using Restated = restatement::NonlinearModel;
using Columns = Eigen::MatrixXd;

constexpr double dt = 0.5;
constexpr std::size_t sizes[] = {1, 2, 3, 4, 6, 9, 10, 11, 12, 13, 14, 17, 33};

/// Tangents, points with and without a centre, and with a centre of a negative weight.
std::vector<SigmaPointWeights> rules(std::size_t n) {
  const double size = static_cast<double>(n);
  return {{}, {size, 0.0, 2.0}, {size, 0.0, 0.0}, {0.8 * size, -0.25, 1.0}, {1.5 * size, 1.0 / 3.0, 0.1}};
}
restatement::Points points_of(const State& x, const SigmaPointWeights& rule) {
  restatement::Points points;
  if (rule.centre_of_covariance != 0.0) points = {{x.mean}, {rule.centre_of_mean}, {rule.centre_of_covariance}};
  add_pairs(points, x, rule.spread);
  return points;
}

/// A motion of the model as compiled code sees it.
detail::ModelRef ref_of(const OwnMotion& motion, const SigmaPointWeights& rule) {
  return {&motion, &detail::motion_table<OwnMotion, true>, rule};
}

/// A sensor that sees the first k states of the model, and how compiled code asks it.
struct Sees {
  const Restated& model;
  int k;
};
int seen(const void* pointer) { return static_cast<const Sees*>(pointer)->k; }
void measure(const void* pointer, const void*, const double* x, int n, int m, double* z, double* H) {
  const Sees& sees = *static_cast<const Sees*>(pointer);
  restatement::Vector state(x, x + sees.k);
  state.resize(static_cast<std::size_t>(n), 1e9);  // of which nothing is seen
  if (z) Eigen::Map<Eigen::VectorXd>(z, m) = vector_of(sees.model.h(state));
  if (H) Eigen::Map<Columns>(H, m, sees.k) = matrix_of(sees.model.H(state)).leftCols(sees.k);
}
/// The first number is an angle, and a difference in it less than half a turn.
void difference(const void*, const double* z, const double* predicted, int m, int count, double* result) {
  for (int i = 0; i < m * count; ++i) {
    const double apart = z[i] - predicted[i % m];
    result[i] = i % m == 0 ? restatement::in_half_a_turn(apart) : apart;
  }
}
constexpr detail::SensorTable bends{false, false, seen, measure, difference}, is_linear{false, true, seen, measure},
    leads{true, true, seen};

/// What `predict` and the functions beside it make of a model, as the restatement says; and a step of the smoother is
/// x + A (yˢ − y) and P + A (Pˢ − P_y) Aᵀ with A = Cov(x, y) P_y⁻¹.
void expect_prediction(const detail::ModelRef& model, const Restated& restated, const State& prior, const State& next) {
  SCOPED_TRACE(testing::Message() << prior.mean.size() << " states, spread " << model.points.spread);
  const Estimate start = estimate_of(prior), smoothed = estimate_of(next);
  const auto n = start.size();
  const auto points = points_of(prior, model.points);
  const State expected =
      model.by_points() ? points_prediction(restated, points, dt) : extended_prediction(restated, prior, dt);
  const Columns cross = matrix_of(model.by_points() ? points_cross_covariance(restated, prior, points, dt)
                                                    : prior.covariance * transposed(restated.F(prior.mean, dt)));
  Estimate found = smoothed, in_place = start;
  detail::predict(model, detail::view(start), dt, detail::view(found));
  EXPECT_CLOSE(found, expected, 1e-9);
  EXPECT_EQ(found.covariance, found.covariance.transpose());
  detail::predict(model, detail::view(in_place), dt, detail::view(in_place));
  EXPECT_CLOSE(in_place, found, 0.0);
  Columns with_state(n, n), F(n, n), Q(n, n);
  detail::prediction_covariance(model, detail::view(start), dt, with_state.data());
  EXPECT_CLOSE(with_state, cross, 1e-9);

  // As a linear step it has the same mean and covariances.
  Estimate step = start;
  detail::linearised_step(model, detail::view(start), dt, step.mean.data(), F.data(), Q.data());
  step.covariance = F * start.covariance * F.transpose() + Q;
  EXPECT_CLOSE(step, expected, 1e-8);
  EXPECT_CLOSE(start.covariance * F.transpose(), cross, 1e-9);

  const Columns A = cross * found.covariance.inverse();
  const Estimate back{start.mean + A * (smoothed.mean - found.mean),
                      start.covariance + A * (smoothed.covariance - found.covariance) * A.transpose()};
  Estimate over_start = start, over_next = smoothed;
  detail::smooth_step(model, detail::view(start), dt, detail::view(smoothed), detail::view(found));
  EXPECT_CLOSE(found, back, 1e-8);
  detail::smooth_step(model, detail::view(over_start), dt, detail::view(smoothed), detail::view(over_start));
  EXPECT_CLOSE(over_start, found, 0.0);
  detail::smooth_step(model, detail::view(start), dt, detail::view(over_next), detail::view(over_next));
  EXPECT_CLOSE(over_next, found, 0.0);
}

TEST(Filtering, EveryPredictionIsItsRestatement) {
  Draws draws(1);
  for (const std::size_t n : sizes) {
    const State prior = draws.state(n), next = draws.state(n);
    const OwnLinearMotion linear{{drawn_model(draws, n, 1, n, 0.0), n}};
    const OwnMotion motion{drawn_model(draws, n, 1, n, 0.3), n};
    for (const auto& rule : rules(n)) {
      expect_prediction({&linear, &detail::motion_table<OwnLinearMotion, false>, rule}, linear.own.model, prior, next);
      expect_prediction(ref_of(motion, rule), motion.model, prior, next);
    }
  }
}

struct Updated {
  Estimate posterior;
  Columns residual, S;
  detail::InnovationView innovation;

  Updated(const Estimate& start, Eigen::Index m)
      : posterior(start), residual(m, 1), S(m, m), innovation{residual.data(), S.data()} {}
};

/// What `update` and the linearised measurement make of a sensor of the first k states, as the restatement says.
void expect_update(const detail::ModelRef& model, const detail::SensorTable& table, int k, const Restated& restated,
                   const State& prior, const State& measured) {
  const Sees sees{restated, k};
  const detail::SensorRef sensor{&sees, &table};
  const Estimate start = estimate_of(prior), z = estimate_of(measured);
  const auto m = z.size();
  const auto expected = model.by_points() ? points_update(restated, prior, points_of(prior, model.points),
                                                          measured.mean, measured.covariance)
                                          : extended_update(restated, prior, measured.mean, measured.covariance);
  Updated found(start, m), in_place(start, m);
  found.posterior.mean.setZero();
  detail::update(model, detail::view(start), detail::view(z), sensor, detail::view(found.posterior), found.innovation);
  ASSERT_CLOSE(found.residual, vector_of(expected.nu), 1e-9);
  ASSERT_CLOSE(found.S, matrix_of(expected.S), 1e-9);
  ASSERT_CLOSE(found.innovation.squared_distance, expected.squared_distance, 1e-8);
  ASSERT_CLOSE(found.innovation.log_likelihood, expected.log_density, 1e-8);
  ASSERT_CLOSE(found.posterior, expected.posterior, 1e-8);
  ASSERT_EQ(found.posterior.covariance, found.posterior.covariance.transpose());
  detail::update(model, detail::view(in_place.posterior), detail::view(z), sensor, detail::view(in_place.posterior),
                 in_place.innovation);
  ASSERT_CLOSE(in_place.posterior, found.posterior, 0.0);

  // As a linear measurement it has the same residual, S and correction.
  Columns residual(m, 1), H(m, start.size()), R(m, m);
  detail::linearised_measurement(model, detail::view(start), detail::view(z), sensor, residual.data(), H.data(),
                                 R.data());
  const Columns PHt = start.covariance * H.transpose();
  ASSERT_CLOSE(residual, found.residual, 1e-9);
  ASSERT_CLOSE(H * PHt + R, found.S, 1e-8);
  ASSERT_CLOSE(start.mean + PHt * found.S.inverse() * residual, found.posterior.mean, 1e-8);
}

TEST(Filtering, EveryUpdateIsItsRestatement) {
  Draws draws(2);
  for (const std::size_t n : sizes)
    for (const std::size_t k : {std::size_t{1}, (n + 1) / 2, n})
      for (const auto& rule : rules(n)) {
        SCOPED_TRACE(testing::Message() << n << " states, " << k << " seen, spread " << rule.spread);
        const State prior = draws.state(n);
        for (const std::size_t m : {1UL, 2UL, 3UL, 6UL, 8UL}) {
          const OwnMotion linear{drawn_model(draws, n, m, k, 0.0), n};
          OwnMotion bent{drawn_model(draws, n, m, k, 0.3), n};
          bent.model.is_angle[0] = true;
          const double size = static_cast<double>(n);  // so that the points are less than half a turn apart
          const State near_by{prior.mean, 0.05 / (size * size) * prior.covariance};
          expect_update(ref_of(linear, rule), is_linear, static_cast<int>(k), linear.model, prior, draws.state(m));
          State measured = draws.state(m);
          measured.mean[0] += 3.0;
          expect_update(ref_of(bent, rule), bends, static_cast<int>(k), bent.model, near_by, measured);
        }
        Dense position(k, n);
        for (std::size_t i = 0; i < k; ++i) position(i, i) = 1.0;
        const OwnMotion leading{bent(draws.matrix(n, n), draws.vector(n), draws.covariance(n), position, 0.0), n};
        expect_update(ref_of(leading, rule), leads, static_cast<int>(k), leading.model, prior, draws.state(k));
      }
}

TEST(Filtering, ALawAlongIndependentAxesMovesEachAxisByItself) {
  Draws draws(4);
  for (const int order : {1, 2, 3})
    for (const int axes : {1, 2, 3}) {
      const auto derivatives = static_cast<std::size_t>(order), n = derivatives * static_cast<std::size_t>(axes);
      Dense F = draws.matrix(derivatives, derivatives), Q = draws.covariance(derivatives);
      const restatement::Vector input = draws.vector(n);
      detail::AxisLaw law;
      law.order = order;
      for (int i = 0; i < order; ++i) {
        for (int k = 0; k < i; ++k) F.values[static_cast<std::size_t>(k + i * order)] = 0.0;  // upper triangular
        if (draws.number() < 0.0) F.values[static_cast<std::size_t>(i + i * order)] = 1.0;
      }
      const Columns F_s = matrix_of(F), Q_s = matrix_of(Q);
      std::copy_n(F_s.data(), order * order, law.F);
      std::copy_n(Q_s.data(), order * order, law.Q);
      std::copy_n(input.data(), n, law.input);
      const Dense I = restatement::identity(n / derivatives);
      const Restated restated = bent(kronecker(F, I), input, kronecker(Q, I), Dense(1, n), 0.0);
      const State prior = draws.state(n);
      const Estimate start = estimate_of(prior);
      Estimate found = estimate_of(draws.state(n)), in_place = start;
      detail::predict(law, axes, detail::view(start), detail::view(found));
      detail::predict(law, axes, detail::view(in_place), detail::view(in_place));
      EXPECT_CLOSE(found, extended_prediction(restated, prior, dt), 1e-12) << order << ", " << axes;
      EXPECT_EQ(found.covariance, found.covariance.transpose());
      EXPECT_CLOSE(in_place, found, 0.0);
    }
}

/// p → A p + b, and its derivatives by A; what is no derivative, as a rate of turn, stays.
TEST(Filtering, ATransformationMovesThePositionAndItsDerivatives) {
  Draws draws(5);
  for (const std::size_t axes : {1UL, 2UL, 3UL})
    for (const std::size_t n : {axes, 2 * axes + (axes == 1 ? 0 : 1), 3 * axes}) {
      const Dense A = draws.matrix(axes, axes);
      const Columns by_columns = matrix_of(A);
      const restatement::Vector b = draws.vector(axes);
      Dense all = restatement::identity(n);
      for (std::size_t i = 0; i < n - n % axes; ++i)
        for (std::size_t j = 0; j < axes; ++j) all(i, i - i % axes + j) = A(i % axes, j);
      const State before = draws.state(n);
      State expected{all * before.mean, all * before.covariance * transposed(all)};
      for (std::size_t i = 0; i < axes; ++i) expected.mean[i] += b[i];
      Estimate found = estimate_of(before);
      detail::transform(by_columns.data(), b.data(), static_cast<int>(axes), detail::view(found));
      EXPECT_CLOSE(found, expected, 1e-12) << n << " states, " << axes << " axes";
      EXPECT_EQ(found.covariance, found.covariance.transpose());
    }
}

/// A start in place, an action that throws, and the start again.
template <class Exception, class Action>
void expect_unchanged(const Estimate& start, const Action& action) {
  Estimate x = start;
  EXPECT_THROW(action(detail::view(x)), Exception);
  EXPECT_TRUE((x.mean.array() == start.mean.array() || start.mean.array().isNaN()).all());
  EXPECT_EQ(x.covariance, start.covariance);
}

TEST(Filtering, AnEstimateIsAsItWasIfSomethingIsThrown) {
  Draws draws(6);
  const OwnMotion motion{drawn_model(draws, 3, 2, 2, 0.3), 3};
  Restated nowhere = motion.model;
  nowhere.f = [](const restatement::Vector& x, double) { return restatement::Vector(x.size(), NAN); };
  const OwnMotion lost{nowhere, 3};
  const Estimate start = estimate_of(draws.state(3));
  Estimate indefinite = start, unknown = start, z = estimate_of(draws.state(2)), not_measured = z, negative = z;
  indefinite.covariance(2, 2) = -1.0;
  unknown.mean(1) = NAN;
  not_measured.mean(1) = NAN;
  negative.covariance *= -100.0;
  const Sees sees{motion.model, 2};
  for (const auto& rule : rules(3)) {
    const detail::ModelRef model = ref_of(motion, rule), without_f = ref_of(lost, rule);
    expect_unchanged<std::domain_error>(start, [&](detail::View x) { detail::predict(without_f, x, dt, x); });
    expect_unchanged<std::domain_error>(unknown, [&](detail::View x) { detail::predict(model, x, dt, x); });
    const auto updates = [&](const Estimate& measured, const detail::SensorTable& table) {
      return [&](detail::View x) {
        Columns residual(2, 1), S(2, 2);
        detail::InnovationView innovation{residual.data(), S.data()};
        detail::update(model, x, detail::view(measured), {&sees, &table}, x, innovation);
      };
    };
    for (const auto* table : {&bends, &is_linear, &leads}) {
      expect_unchanged<std::invalid_argument>(start, updates(not_measured, *table));
      expect_unchanged<std::domain_error>(start, updates(negative, *table));
      expect_unchanged<std::domain_error>(unknown, updates(z, *table));
    }
    if (!model.by_points()) continue;
    expect_unchanged<std::domain_error>(indefinite, [&](detail::View x) { detail::predict(model, x, dt, x); });
    expect_unchanged<std::domain_error>(indefinite, updates(z, bends));
    expect_unchanged<std::domain_error>(
        indefinite, [&](detail::View x) { detail::smooth_step(model, x, dt, detail::view(start), x); });
  }
}

}  // namespace filtering_test
