// The laws that every member of the family obeys: Extended, Unscented, Cubature.
#include <sigmax/estimation/member.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/sensors.hpp>

#include "estimation/restated.hpp"

namespace sigmax {
namespace {

using restatement::State;
using restatement::transposed;
using support::dense;
using support::drawn_model;
using support::Draws;
using support::Estimate;
using support::estimate_of;
using support::every_member;
using support::near;
using support::near_matrix;
using support::OwnLinearMotion;
using support::OwnMotion;
using support::OwnSensor;

constexpr double pi = std::numbers::pi;
using Dense = restatement::Matrix;
using Restated = restatement::NonlinearModel;

EstimateOf<AnyModel> start_of(const State& state) {
  const Estimate same = estimate_of(state);
  return {same.mean, same.covariance};
}
MeasurementOf<OwnSensor> measured(const State& z) {
  const Estimate same = estimate_of(z);
  return {same.mean, same.covariance};
}

/// A prediction and an update of the restated model's sensor.
struct Stepped {
  EstimateOf<AnyModel> predicted, posterior;
  InnovationOf<OwnSensor> innovation;
};
Stepped stepped(const AnyModel& filter, const OwnSensor& sensor, const State& start, const State& z, double dt = 1.0) {
  Stepped result;
  predict(filter, start_of(start), dt, result.predicted);
  result.innovation = update(filter, result.predicted, measured(z), sensor, result.posterior);
  return result;
}

void expect_near(const Stepped& found, const Stepped& expected, double tolerance) {
  EXPECT_PRED_FORMAT3(near_matrix, found.predicted.mean, expected.predicted.mean, tolerance);
  EXPECT_PRED_FORMAT3(near_matrix, found.predicted.covariance, expected.predicted.covariance, tolerance);
  EXPECT_PRED_FORMAT3(near_matrix, found.posterior.mean, expected.posterior.mean, tolerance);
  EXPECT_PRED_FORMAT3(near_matrix, found.posterior.covariance, expected.posterior.covariance, tolerance);
  EXPECT_PRED_FORMAT3(near_matrix, found.innovation.residual, expected.innovation.residual, tolerance);
  EXPECT_PRED_FORMAT3(near_matrix, found.innovation.covariance, expected.innovation.covariance, tolerance);
  EXPECT_PRED_FORMAT3(near, found.innovation.squared_distance, expected.innovation.squared_distance, tolerance);
  EXPECT_PRED_FORMAT3(near, found.innovation.log_likelihood, expected.innovation.log_likelihood, tolerance);
}

TEST(Member, OfALinearModelIsTheKalmanFilter) {
  Draws draws(1);
  for (int run = 0; run < 50; ++run) {
    const OwnMotion hidden{drawn_model(draws, 4, 2, 4, 0.0), 4};
    const State start = draws.state(4), z = draws.state(2);
    const Stepped expected = stepped(OwnLinearMotion{hidden}, {hidden.model}, start, z);
    for (const AnyModel& member : every_member(hidden)) {
      expect_near(stepped(member, {hidden.model}, start, z), expected, 1e-9);
      EXPECT_PRED_FORMAT3(near_matrix, prediction_covariance(member, start_of(start), 1.0),
                          prediction_covariance(AnyModel{OwnLinearMotion{hidden}}, start_of(start), 1.0), 1e-9);
    }
  }
}

TEST(Member, OfALinearMotionPredictsAsTheKalmanFilterExactly) {
  const auto motion = dwpa<3>(2.0);
  const EstimateOf<AnyModel> prior{Vector<9>::LinSpaced(1.0, 9.0), SquareMatrix<9>::Identity()};
  const auto expected = predict(AnyModel{motion}, prior, 0.3);
  for (const AnyModel& member : every_member(motion)) {
    EXPECT_EQ(predict(member, prior, 0.3).mean, expected.mean);
    EXPECT_EQ(predict(member, prior, 0.3).covariance, expected.covariance);
  }
}

/// The same model of y = T x.
Restated changed(const Restated& model, const Dense& T) {
  const Dense back = restatement::inverse(T).matrix;
  using restatement::Vector;
  return {[=](const Vector& y, double dt) { return T * model.f(back * y, dt); },
          [=](const Vector& y, double dt) { return T * model.F(back * y, dt) * back; },
          [=](double dt) { return restatement::symmetrised(T * model.Q(dt) * transposed(T)); },
          [=](const Vector& y) { return model.h(back * y); },
          [=](const Vector& y) { return model.H(back * y) * back; },
          model.is_angle};
}
State changed(const State& x, const Dense& T) {
  return {T * x.mean, restatement::symmetrised(T * x.covariance * transposed(T))};
}

/// Sigma points lie along the columns of Cholesky's root, which is T L in other coordinates if T is lower triangular;
/// the Kalman filter, the extended one and those with points of a linear model are the same under any T.
TEST(Member, IsInvariantUnderInvertibleChangesOfTheState) {
  Draws draws(2);
  for (int run = 0; run < 50; ++run) {
    Dense lower = draws.matrix(4, 4), upper = draws.matrix(4, 4);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        lower(i, j) = i > j ? 0.5 * lower(i, j) : i == j ? 1.0 : 0.0;
        upper(i, j) = i < j ? 0.5 * upper(i, j) : i == j ? 1.0 : 0.0;
      }
    const OwnMotion linear{drawn_model(draws, 4, 2, 4, 0.0), 4}, bent{drawn_model(draws, 4, 2, 4, 0.3), 4};
    const State start = draws.state(4), z = draws.state(2);
    const auto expect_invariant = [&](const AnyModel& here, const AnyModel& there, const Restated& model,
                                      const Dense& T) {
      Stepped expected = stepped(here, {model}, start, z);
      for (auto* x : {&expected.predicted, &expected.posterior})
        *x = start_of(changed({support::entries(x->mean), dense(x->covariance)}, T));
      expect_near(stepped(there, {changed(model, T)}, changed(start, T), z), expected, 1e-9);
    };
    const Dense any = lower * upper;
    const OwnMotion linear_there{changed(linear.model, any), 4}, bent_there{changed(bent.model, any), 4},
        bent_lower{changed(bent.model, lower), 4};
    expect_invariant(OwnLinearMotion{linear}, OwnLinearMotion{linear_there}, linear.model, any);
    expect_invariant(Extended{bent}, Extended{bent_there}, bent.model, any);
    for (std::size_t i = 0; i < every_member(bent).size(); ++i) {
      expect_invariant(every_member(linear)[i], every_member(linear_there)[i], linear.model, any);
      expect_invariant(every_member(bent)[i], every_member(bent_lower)[i], bent.model, lower);
    }
  }
}

TEST(Member, IndependentLinearMeasurementsOneByOneAreTheBatch) {
  Draws draws(3);
  for (int run = 0; run < 50; ++run) {
    const OwnMotion motion{drawn_model(draws, 4, 2, 4, 0.0), 4};
    const Dense H = motion.model.H(draws.vector(4));
    const auto prior = start_of(draws.state(4));
    State z = draws.state(2);
    z.covariance(0, 1) = z.covariance(1, 0) = 0.0;
    auto filters = every_member(motion);
    filters.emplace_back(OwnLinearMotion{motion});
    for (const AnyModel& filter : filters) {
      EstimateOf<AnyModel> batch, sequential = prior;
      const auto both = update(filter, prior, measured(z), OwnSensor{motion.model}, batch);
      double log_likelihood = 0.0;
      for (std::size_t i = 0; i < 2; ++i) {
        const Dense row(1, 4, {H(i, 0), H(i, 1), H(i, 2), H(i, 3)});
        const OwnSensor one{support::bent(Dense(4, 4), z.mean, Dense(4, 4), row, 0.0)};
        log_likelihood +=
            update(filter, sequential, measured({{z.mean[i]}, Dense(1, 1, {z.covariance(i, i)})}), one, sequential)
                .log_likelihood;
      }
      EXPECT_PRED_FORMAT3(near_matrix, sequential.mean, batch.mean, 1e-9);
      EXPECT_PRED_FORMAT3(near_matrix, sequential.covariance, batch.covariance, 1e-9);
      EXPECT_PRED_FORMAT3(near, log_likelihood, both.log_likelihood, 1e-9);
    }
  }
}

TEST(Member, AnAzimuthAcrossHalfATurnIsAnAzimuthLikeAnother) {
  // The same scene, turned by half a turn about the radar, so that the azimuth jumps among the points, or not.
  const SquareMatrix<2> R{{1.0, 0.0}, {0.0, 0.0025}};
  for (const double truth : {-0.001, 0.0, 0.001})
    for (const double seen : {-0.05, 0.001, 0.05})
      for (const AnyModel& member : every_member(dwna<2>(1.0))) {
        const auto posterior_at = [&](double turn, Innovation<2>& innovation) {
          EstimateOf<AnyModel> x{Vector<4>(100.0 * std::cos(turn + truth), 100.0 * std::sin(turn + truth), 0.0, 0.0),
                                 SquareMatrix<4>::Identity() * 4.0};
          const double azimuth = std::remainder(turn + seen, 2.0 * pi);
          innovation = update(member, x, Gaussian<2>{Vector<2>(101.0, azimuth), R}, PolarSensor<2>{}, x);
          return x;
        };
        Innovation<2> ahead, behind;
        const auto here = posterior_at(0.0, ahead), there = posterior_at(pi, behind);
        EXPECT_PRED_FORMAT3(near_matrix, there.mean, -here.mean, 1e-12);
        EXPECT_PRED_FORMAT3(near_matrix, there.covariance, here.covariance, 1e-12);
        EXPECT_PRED_FORMAT3(near_matrix, behind.residual, ahead.residual, 1e-12);
        EXPECT_PRED_FORMAT3(near, behind.log_likelihood, ahead.log_likelihood, 1e-12);
      }
}

TEST(Member, ShowsItsMotion) {
  const Cubature member{dwna<3>(2.0)};
  EXPECT_EQ(member.name(), "dwna");
  EXPECT_EQ(member.size(), 6);
  EXPECT_EQ(member.components(), dwna<3>(2.0).components());
  EXPECT_EQ(member.motion().law().sigma_w(), 2.0);
  EXPECT_EQ(axes_of<Cubature<CoordinatedTurn<3>>>, 3);
}

}  // namespace
}  // namespace sigmax
