// The laws that every member of the family obeys: Extended, Unscented, Cubature.
#include <Eigen/LU>

#include <sigmax/estimation/member.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/sensors.hpp>

#include "estimation/members.hpp"
#include "support/nonlinear_restatement.hpp"

namespace sigmax {
namespace {

using support::dense;
using support::entries;
using support::fixed;
using support::generated;
using support::generated_covariance;
using support::generated_gaussian;
using support::generated_scaling;
using support::HiddenMotion;
using support::HiddenSensor;
using support::holds;
using support::near;
using support::near_matrix;
using support::number_between;
using support::require_near;
using support::require_near_gaussian;
using support::require_near_innovation;
using support::require_near_matrix;
using support::with_default_members;
using support::with_every_member;

constexpr double pi = std::numbers::pi;
using Dense = restatement::Matrix;
using Linear = FixedStepMotion<4>;
using Hidden = HiddenSensor<2, 4>;

const std::vector<std::string> components{"a", "b", "c", "d"};

Linear linear(const Dense& F, const Dense& Q, const Vector<4>& u = Vector<4>::Zero()) {
  return {"linear", components, 1.0, fixed<4, 4>(F), fixed<4, 4>(Q), u};
}

TEST(Member, OfALinearModelIsTheKalmanFilter) {
  holds([] {
    const Linear kalman = linear(generated(4, 4), generated_covariance(4), fixed<4, 1>(generated(4, 1)));
    const LinearSensor<2, 4> sensor{support::generated_matrix<2, 4>()};
    const auto prior = generated_gaussian<4>();
    const auto z = generated_gaussian<2>();
    Gaussian<4> predicted, posterior;
    predict(kalman, prior, 1.0, predicted);
    const auto expected = update(kalman, prior, z, sensor, posterior);
    with_every_member(HiddenMotion<4>{kalman}, [&](const auto& member) {
      Gaussian<4> found;
      predict(member, prior, 1.0, found);
      require_near_gaussian(found, predicted);
      require_near_matrix(prediction_covariance(member, prior, 1.0), prediction_covariance(kalman, prior, 1.0));
      const auto innovation = update(member, prior, z, Hidden{sensor.measurement_matrix()}, found);
      require_near_gaussian(found, posterior);
      require_near_innovation(innovation, expected);
    });
  });
}

TEST(Member, OfALinearMotionPredictsAsTheKalmanFilterExactly) {
  const auto motion = dwpa<3>(2.0);
  const Gaussian<9> prior{Vector<9>::LinSpaced(1.0, 9.0), SquareMatrix<9>::Identity()};
  Gaussian<9> expected;
  predict(motion, prior, 0.3, expected);
  with_default_members(motion, [&](const auto& member) {
    Gaussian<9> found;
    predict(member, prior, 0.3, found);
    EXPECT_EQ(found.mean, expected.mean);
    EXPECT_EQ(found.covariance, expected.covariance);
  });
}

TEST(Member, IsInvariantUnderInvertibleStateChangesOfALinearModel) {
  holds([] {
    auto lower = generated(4, 4), upper = generated(4, 4);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        lower(i, j) = i > j ? 0.5 * lower(i, j) : i == j ? 1.0 : 0.0;
        upper(i, j) = i < j ? 0.5 * upper(i, j) : i == j ? 1.0 : 0.0;
      }
    const auto T = lower * upper;
    const auto T_inverse = restatement::inverse(T).matrix;
    const auto F = generated(4, 4), H = generated(2, 4), Q = generated_covariance(4);
    const auto start = generated_gaussian<4>();
    const auto z = generated_gaussian<2>();
    const HiddenMotion<4> motion{linear(F, Q)};
    const HiddenMotion<4> changed{linear(T * F * T_inverse, restatement::symmetrised(T * Q * transposed(T)))};
    const Hidden sensor{fixed<2, 4>(H)}, changed_sensor{fixed<2, 4>(H * T_inverse)};
    const Gaussian<4> start_there{fixed<4, 1>(T * dense(start.mean)),
                                  fixed<4, 4>(restatement::symmetrised(T * dense(start.covariance) * transposed(T)))};
    const auto compare = [&](const auto& here, const auto& there) {
      Gaussian<4> x, y;
      predict(here, start, 1.0, x);
      predict(there, start_there, 1.0, y);
      const auto innovation = update(here, x, z, sensor, x);
      require_near_innovation(update(there, y, z, changed_sensor, y), innovation);
      require_near_matrix(y.mean, T * dense(x.mean));
      require_near_matrix(y.covariance, T * dense(x.covariance) * transposed(T));
    };
    const auto scaling = generated_scaling();
    compare(Extended{motion}, Extended{changed});
    compare(Unscented{motion, scaling}, Unscented{changed, scaling});
    compare(Cubature{motion}, Cubature{changed});
  });
}

/// A turn and the radar that sees it in other coordinates y = T x, with T lower triangular.
struct Changed {
  static constexpr int state_size = 5;
  static constexpr int max_state_size = 5;
  static constexpr int seen_size = 5;
  static constexpr int measurement_size = 2;
  CoordinatedTurn<2> turn;
  PolarSensor<2> radar;
  SquareMatrix<5> T, T_inverse;

  Eigen::Index size() const { return 5; }
  std::string_view name() const { return "changed"; }
  std::vector<std::string> components() const { return turn.components(); }
  Vector<5> propagate(const Vector<5>& y, double dt) const { return T * turn.propagate(Vector<5>(T_inverse * y), dt); }
  SquareMatrix<5> transition_jacobian(const Vector<5>& y, double dt) const {
    return T * turn.transition_jacobian(Vector<5>(T_inverse * y), dt) * T_inverse;
  }
  SquareMatrix<5> process_covariance(double dt) const { return T * turn.process_covariance(dt) * T.transpose(); }
  Vector<2> measure(const Vector<5>& y) const { return radar.measure(Vector<2>((T_inverse * y).head<2>())); }
  RectangularMatrix<2, 5> measurement_jacobian(const Vector<5>& y) const {
    return radar.measurement_jacobian((T_inverse * y).head<2>()) * T_inverse.topRows<2>();
  }
  Vector<2> measurement_difference(const Vector<2>& a, const Vector<2>& b) const {
    return radar.measurement_difference(a, b);
  }
};

/// A target anywhere 50 to 150 m away, known to some metres.
Gaussian<5> generated_turning() {
  const double range = number_between(50.0, 150.0), azimuth = number_between(-pi, pi);
  Gaussian<5> x = generated_gaussian<5>();
  x.mean << range * std::cos(azimuth), range * std::sin(azimuth), number_between(-10.0, 10.0),
      number_between(-10.0, 10.0), number_between(0.05, 0.6);
  x.covariance.row(4) *= 0.05;
  x.covariance.col(4) *= 0.05;
  return x;
}
Gaussian<2> generated_polar(const Vector<5>& x) {
  const double azimuth = std::atan2(x(1), x(0)) + number_between(-0.05, 0.05);
  return {Vector<2>(x.head<2>().norm() + number_between(-3.0, 3.0), std::remainder(azimuth, 2.0 * pi)),
          SquareMatrix<2>{{4.0, 0.001}, {0.001, 0.0025}}};
}

TEST(Member, OfANonLinearModelIsInvariantUnderTriangularStateChanges) {
  // The points lie along the columns of Cholesky's root, which is T L in the other coordinates if T is lower triangular
  // with a positive diagonal. The extended filter is invariant under any change.
  holds([] {
    SquareMatrix<5> T = fixed<5, 5>(generated(5, 5)).triangularView<Eigen::StrictlyLower>();
    for (int i = 0; i < 5; ++i) T(i, i) = number_between(0.5, 2.0);
    SquareMatrix<5> turned = T;
    turned.row(0).swap(turned.row(1));
    const CoordinatedTurn<2> turn{0.5, 0.01};
    const PolarSensor<2> radar;
    const auto start = generated_turning();
    const auto z = generated_polar(start.mean);
    const auto compare = [&](const auto& here, const auto& there) {
      const auto& change = there.motion().T;
      Gaussian<5> x, y, y0{change * start.mean, change * start.covariance * change.transpose()};
      detail::mirror_lower(y0.covariance);
      predict(here, start, 0.5, x);
      predict(there, y0, 0.5, y);
      const auto innovation = update(here, x, z, radar, x);
      require_near_innovation(update(there, y, z, there.motion(), y), innovation, 1e-8);
      require_near_matrix(y.mean, change * x.mean, 1e-8);
      require_near_matrix(y.covariance, change * x.covariance * change.transpose(), 1e-8);
    };
    const Changed triangular{turn, radar, T, T.inverse()};
    compare(Extended{turn}, Extended{Changed{turn, radar, turned, turned.inverse()}});
    compare(Unscented{turn}, Unscented{triangular});
    compare(Cubature{turn}, Cubature{triangular});
  });
}

TEST(Member, IndependentLinearMeasurementsOneByOneAreTheBatch) {
  holds([] {
    const auto H = generated(2, 4);
    const auto prior = generated_gaussian<4>();
    auto z = generated_gaussian<2>();
    z.covariance(0, 1) = z.covariance(1, 0) = 0.0;
    const auto one = [&](std::size_t i) {
      Dense row(1, 4);
      for (std::size_t j = 0; j < 4; ++j) row(0, j) = H(i, j);
      return HiddenSensor<1, 4>{fixed<1, 4>(row)};
    };
    const auto scalar = [&](Eigen::Index i) {
      return Gaussian<1>{Vector<1>(z.mean(i)), SquareMatrix<1>(z.covariance(i, i))};
    };
    with_every_member(HiddenMotion<4>{linear(restatement::identity(4), Dense(4, 4))}, [&](const auto& member) {
      Gaussian<4> batch, sequential;
      const double together = update(member, prior, z, Hidden{fixed<2, 4>(H)}, batch).log_likelihood;
      const double before = update(member, prior, scalar(0), one(0), sequential).log_likelihood;
      const double after = update(member, sequential, scalar(1), one(1), sequential).log_likelihood;
      require_near_gaussian(sequential, batch);
      require_near(before + after, together);
    });
  });
}

/// A coordinated turn in the plane seen by a radar, in plain formulas.
restatement::NonlinearModel restated_turn(double q, double q_omega) {
  using restatement::Vector;
  return {[](const Vector& x, double T) -> Vector {
            const double w = x[4], s = std::sin(w * T), c = std::cos(w * T);
            return {x[0] + s / w * x[2] - (1 - c) / w * x[3], x[1] + (1 - c) / w * x[2] + s / w * x[3],
                    c * x[2] - s * x[3], s * x[2] + c * x[3], w};
          },
          [](const Vector& x, double T) -> Dense {
            const double w = x[4], s = std::sin(w * T), c = std::cos(w * T), vx = x[2], vy = x[3];
            const double fx = (c * T * vx - s * vx / w) / w - (s * T * vy + (c - 1) * vy / w) / w;
            const double fy = (s * T * vx - (1 - c) * vx / w) / w + (c * T * vy - s * vy / w) / w;
            return {5,
                    5,
                    {1,
                     0,
                     s / w,
                     -(1 - c) / w,
                     fx,  //
                     0,
                     1,
                     (1 - c) / w,
                     s / w,
                     fy,  //
                     0,
                     0,
                     c,
                     -s,
                     -s * T * vx - c * T * vy,  //
                     0,
                     0,
                     s,
                     c,
                     c * T * vx - s * T * vy,  //
                     0,
                     0,
                     0,
                     0,
                     1}};
          },
          [q, q_omega](double T) -> Dense {
            const double a = q * T * T * T / 3, b = q * T * T / 2, c = q * T;
            return {5, 5, {a, 0, b, 0, 0, 0, a, 0, b, 0, b, 0, c, 0, 0, 0, b, 0, c, 0, 0, 0, 0, 0, q_omega * T}};
          },
          [](const Vector& x) -> Vector {
            return {std::hypot(x[0], x[1]), std::atan2(x[1], x[0])};
          },
          [](const Vector& x) -> Dense {
            const double r = std::hypot(x[0], x[1]);
            return {2, 5, {x[0] / r, x[1] / r, 0, 0, 0, -x[1] / (r * r), x[0] / (r * r), 0, 0, 0}};
          },
          {false, true}};
}

TEST(Member, IsItsPlainRestatement) {
  holds([] {
    const double q = number_between(0.1, 2.0), q_omega = number_between(0.0, 0.01), dt = number_between(0.1, 1.5);
    const CoordinatedTurn<2> model{q, q_omega};
    const auto restated = restated_turn(q, q_omega);
    const auto prior = generated_turning();
    const auto z = generated_polar(prior.mean);
    const restatement::State state{entries(prior.mean), dense(prior.covariance)};
    const auto compare = [&](const auto& member, const restatement::State& predicted,
                             const restatement::Updated& updated) {
      Gaussian<5> found;
      predict(member, prior, dt, found);
      require_near(entries(found.mean), predicted.mean, 1e-9);
      require_near_matrix(found.covariance, predicted.covariance, 1e-9);
      RC_ASSERT(found.covariance == found.covariance.transpose());
      const auto innovation = update(member, prior, z, PolarSensor<2>{}, found);
      require_near(entries(innovation.residual), updated.nu, 1e-9);
      require_near_matrix(innovation.covariance, updated.S, 1e-9);
      require_near(innovation.squared_distance, updated.squared, 1e-9);
      require_near(innovation.log_likelihood, updated.log_likelihood, 1e-9);
      require_near(entries(found.mean), updated.posterior.mean, 1e-9);
      require_near_matrix(found.covariance, updated.posterior.covariance, 1e-9);
      RC_ASSERT(found.covariance == found.covariance.transpose());
    };
    const restatement::Vector measured = entries(z.mean);
    const Dense R = dense(z.covariance);
    compare(Extended{model}, extended_prediction(restated, state, dt), extended_update(restated, state, measured, R));
    require_near_matrix(prediction_covariance(Extended{model}, prior, dt),
                        state.covariance * transposed(restated.F(state.mean, dt)), 1e-9);
    const auto scaling = generated_scaling();
    for (const auto& s : {UnscentedScaling{}, scaling}) {
      const auto points = unscented_points(state, s.alpha, s.beta, s.kappa);
      compare(Unscented{model, s}, points_prediction(restated, points, dt),
              points_update(restated, state, points, measured, R));
      require_near_matrix(prediction_covariance(Unscented{model, s}, prior, dt),
                          points_cross_covariance(restated, state, points, dt), 1e-9);
    }
    const auto points = restatement::cubature_points(state);
    compare(Cubature{model}, points_prediction(restated, points, dt),
            points_update(restated, state, points, measured, R));
    require_near_matrix(prediction_covariance(Cubature{model}, prior, dt),
                        points_cross_covariance(restated, state, points, dt), 1e-9);
  });
}

TEST(Member, MayOverwriteItsPrior) {
  const CoordinatedTurn<2> model{0.5, 0.01};
  const Gaussian<5> prior{Vector<5>(80.0, 60.0, 3.0, -4.0, 0.2), SquareMatrix<5>::Identity()};
  const Gaussian<2> z{Vector<2>(101.0, 0.6), SquareMatrix<2>{{4.0, 0.0}, {0.0, 0.01}}};
  with_default_members(model, [&](const auto& member) {
    Gaussian<5> predicted, updated, in_place = prior;
    predict(member, prior, 0.7, predicted);
    update(member, predicted, z, PolarSensor<2>{}, updated);
    predict(member, in_place, 0.7, in_place);
    update(member, in_place, z, PolarSensor<2>{}, in_place);
    EXPECT_EQ(in_place.mean, updated.mean);
    EXPECT_EQ(in_place.covariance, updated.covariance);
  });
}

TEST(Member, AnAzimuthAcrossHalfATurnIsAnAzimuthLikeAnother) {
  // The same scene, turned by half a turn about the radar, so that the azimuth jumps among the points, or not.
  const auto model = dwna<2>(1.0);
  const SquareMatrix<2> R{{1.0, 0.0}, {0.0, 0.0025}};
  for (const double truth : {-0.001, 0.0, 0.001})
    for (const double measured : {-0.05, 0.001, 0.05})
      with_default_members(model, [&](const auto& member) {
        const auto posterior_at = [&](double turn, Innovation<2>& innovation) {
          Gaussian<4> x{Vector<4>::Zero(), SquareMatrix<4>::Identity() * 4.0};
          x.mean << 100.0 * std::cos(turn + truth), 100.0 * std::sin(turn + truth), 0.0, 0.0;
          const double azimuth = std::remainder(turn + measured, 2.0 * pi);
          innovation = update(member, x, Gaussian<2>{Vector<2>(101.0, azimuth), R}, PolarSensor<2>{}, x);
          return x;
        };
        Innovation<2> ahead, behind;
        const auto here = posterior_at(0.0, ahead);
        const auto there = posterior_at(pi, behind);
        EXPECT_PRED_FORMAT3(near_matrix, there.mean, Vector<4>(-here.mean), 1e-12);
        EXPECT_PRED_FORMAT3(near_matrix, there.covariance, here.covariance, 1e-12);
        EXPECT_PRED_FORMAT3(near_matrix, behind.residual, ahead.residual, 1e-12);
        EXPECT_PRED_FORMAT3(near, behind.log_likelihood, ahead.log_likelihood, 1e-12);
      });
}

TEST(Member, HoldsARunTimeMotion) {
  const PolarSensor<3> radar{};
  const auto fixed_model = dwna<3>(2.0);
  const AnyMotion<9, IndependentAxes<3, DiscreteWhiteNoise<2>>, IndependentAxes<3, DiscreteWhiteNoise<3>>> model =
      fixed_model;
  const Gaussian<6> start{Vector<6>(8e3, 3e3, 1e3, -100.0, 50.0, 0.0), 100.0 * SquareMatrix<6>::Identity()};
  const auto z = PolarSensor<3>::measurement({8.5e3, 0.36, 0.12}, {10.0, 0.002, 0.002});
  const auto compare = [&](const auto& known, const auto& run_time) {
    Gaussian<6> expected;
    Gaussian<Eigen::Dynamic, 9> found{start.mean, start.covariance};
    predict(known, start, 0.5, expected);
    predict(run_time, found, 0.5, found);
    const auto innovation = update(known, expected, z, radar, expected);
    EXPECT_PRED_FORMAT3(near, update(run_time, found, z, radar, found).log_likelihood, innovation.log_likelihood,
                        1e-12);
    EXPECT_PRED_FORMAT3(near_matrix, found.mean, expected.mean, 1e-12);
    EXPECT_PRED_FORMAT3(near_matrix, found.covariance, expected.covariance, 1e-12);
    EXPECT_PRED_FORMAT3(near_matrix, prediction_covariance(run_time, found, 0.5),
                        prediction_covariance(known, expected, 0.5), 1e-12);
  };
  compare(Extended{fixed_model}, Extended{model});
  compare(Unscented{fixed_model}, Unscented{model});
  compare(Cubature{fixed_model}, Cubature{model});
}

TEST(Member, ShowsItsMotion) {
  const auto model = dwna<3>(2.0);
  with_default_members(model, [&](const auto& member) {
    EXPECT_EQ(member.name(), "dwna");
    EXPECT_EQ(member.size(), 6);
    EXPECT_EQ(member.components(), model.components());
    EXPECT_EQ(member.motion().law().sigma_w(), 2.0);
  });
}

}  // namespace
}  // namespace sigmax
