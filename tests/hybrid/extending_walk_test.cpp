// The code of docs/extending.md that needs filters, and the values that it claims.
#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <tuple>

#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/sensors.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include "known_motions.hpp"
#include "support/matrices.hpp"

namespace sigmax {
namespace {

struct Drift {
  static constexpr int order = 1;
  double q;
  std::string_view name() const { return "drift"; }
  SquareMatrix<1> transition(double) const { return SquareMatrix<1>(1.0); }
  SquareMatrix<1> process_covariance(double dt) const { return SquareMatrix<1>(q * dt); }
  Vector<1> input_gain(double dt) const { return Vector<1>(dt); }
};

struct Speedometer {
  static constexpr int seen_size = 4;
  static constexpr int measurement_size = 1;
  template <class Scalar>
  Eigen::Matrix<Scalar, 1, 1> measure(const Eigen::Matrix<Scalar, 4, 1>& x) const {
    using std::sqrt;
    return Eigen::Matrix<Scalar, 1, 1>(Scalar(sqrt(Scalar(x(2) * x(2) + x(3) * x(3)))));
  }
};

TEST(ExtendingWalk, ALawOfMotion) {
  const IndependentAxes<2, Drift> drift{Drift{0.5}};
  const auto x = predict(drift, {Vector<2>(1.0, 2.0), SquareMatrix<2>::Identity()}, 4.0);
  EXPECT_EQ(x.mean, (Vector<2>(1.0, 2.0)));
  EXPECT_NEAR(x.covariance(0, 0), 3.0, 1e-12);
  EXPECT_EQ(x.covariance(0, 1), 0.0);
}

TEST(ExtendingWalk, ARowOfTheMotionsThatHaveNames) {
  using namespace detail;
  constexpr auto row = MotionRow(
      "drift", no_manoeuvre, []<int A>(const MotionChoice& c) { return IndependentAxes<A, Drift>{Drift{c[sigma_w]}}; },
      sigma_w);
  const MotionOfRow<2, decltype(row)> drift = row.make.operator()<2>(MotionChoice{});
  EXPECT_EQ(drift.law().q, MotionChoice{}[MotionParameter::sigma_w]);
  EXPECT_TRUE(row.has[static_cast<std::size_t>(MotionParameter::sigma_w)]);
}

TEST(ExtendingWalk, SensorsThatTakeTurns) {
  const RandomVariable mode{"mode", {"steady", "manoeuvring"}};
  const Vector<2> harbour(900.0, 0.0);
  Gaussian<6> start{Vector<6>(5000.0, 500.0, 0.0, 50.0, 0.0, 0.0), 100.0 * SquareMatrix<6>::Identity()};
  InteractingMultipleModel filter{std::tuple{dwna<2>(1.0), dwpa<2>(1.0)},
                                  Relation{mode, mode, {{0.95, 0.05}, {0.05, 0.95}}}, start};
  filter.step(1.0, PolarSensor<2>::measurement({5030.2, 0.1096, 0.0}, {10.0, 0.002, 0.0}), PolarSensor<2>{});
  filter.step(0.5, PolarSensor<2>::measurement({4140.1, 0.1393, 0.0}, {10.0, 0.002, 0.0}), PolarSensor<2>{harbour});
  filter.step(0.0, {Vector<1>(0.1145), SquareMatrix<1>(1e-6)}, BearingSensor{});
  filter.step(0.5, {Vector<1>(50.0), SquareMatrix<1>(1.0)}, Speedometer{});
  const auto found = filter.estimate();
  EXPECT_NEAR(found.mean(3), 50.0, 1.0);
  EXPECT_LT(found.covariance(3, 3), 3.0) << "the velocity is along y, and known to about 1 m/s";
  EXPECT_GT(found.covariance(2, 2), 30.0);
  EXPECT_EQ(filter.innovations()[0].residual.size(), 1);
}

}  // namespace
}  // namespace sigmax
