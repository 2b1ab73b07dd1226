// The code of docs/extending.md that needs filters, and the values that it claims.

#include "known_motions.hpp"
#include "support/sigmax.hpp"

namespace extending_walk_test {

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
  constexpr auto row =
      motion_row("drift", no_manoeuvre,
                 []<int A>(const MotionChoice& c) { return IndependentAxes<A, Drift>{Drift{c[sigma_w]}}; }, {sigma_w});
  static_assert(row.derivatives == 1 && row.linear && !row.manoeuvres);
  EXPECT_TRUE(row.has_parameter(sigma_w) && !row.has_parameter(tau));
  for (const int axes : {1, 2, 3}) {
    const AnyModel drift = row.make(MotionChoice{}, axes, MemberType::ekf);
    EXPECT_EQ(drift.name(), "drift");
    EXPECT_EQ(drift.size(), axes);
    EstimateOf<AnyModel> x{Eigen::VectorXd::Zero(axes), Eigen::MatrixXd::Identity(axes, axes)};
    predict(drift, x, 4.0, x);
    EXPECT_NEAR(x.covariance(0, 0), 1.0 + 4.0 * MotionChoice{}[sigma_w], 1e-12);
  }
}

TEST(ExtendingWalk, SensorsThatTakeTurns) {
  const RandomVariable mode{"mode", {"steady", "manoeuvring"}};
  const Vector<2> harbour(900.0, 0.0);
  Gaussian<6> start{Vector<6>(5000.0, 500.0, 0.0, 50.0, 0.0, 0.0), 100.0 * SquareMatrix<6>::Identity()};
  InteractingMultipleModel filter{std::tuple{dwna<2>(1.0), dwpa<2>(1.0)},
                                  Relation{mode, mode, {{0.95, 0.05}, {0.05, 0.95}}}, start};
  filter.step(1.0, PolarSensor<2>{}.measurement({5030.2, degrees(6.28)}, {10.0, degrees(0.1)}));
  filter.step(0.5, PolarSensor<2>{harbour}.measurement({4140.1, degrees(7.98)}, {10.0, degrees(0.1)}));
  filter.step(0.0, BearingSensor{}.measurement(degrees(6.56), degrees(0.06)));
  filter.step(0.5, {Vector<1>(50.0), SquareMatrix<1>(1.0)}, Speedometer{});
  const auto found = filter.estimate();
  EXPECT_NEAR(found.mean(3), 50.0, 1.0);
  EXPECT_LT(found.covariance(3, 3), 3.0) << "the velocity is along y, and known to about 1 m/s";
  EXPECT_GT(found.covariance(2, 2), 30.0);
  EXPECT_EQ(filter.innovations()[0].residual().size(), 1);
}

struct Braking {
  static constexpr int axes = 1, state_size = 2, max_state_size = 2;
  Eigen::Index size() const { return 2; }
  std::string_view name() const { return "braking"; }
  std::vector<std::string> components() const { return {"x", "vx"}; }
  Vector<2> propagate(const Vector<2>& x, double dt) const {
    return {x(0) + dt * x(1), x(1) - dt * 0.01 * x(1) * std::abs(x(1))};
  }
  SquareMatrix<2> process_covariance(double dt) const { return dt * SquareMatrix<2>::Identity(); }
};

struct Mast {
  static constexpr int seen_size = 1, measurement_size = 1;
  double height;
  Vector<1> measure(const Vector<1>& x) const { return Vector<1>(std::hypot(x(0), height)); }
  Vector<1> measurement_jacobian(const Vector<1>& x) const { return x / std::hypot(x(0), height); }
};

AnyModel model_called(const std::string& name) {
  if (name == "braking") return Unscented{Braking{}};
  return known_model({name}, 1);
}
AnySensor sensor_called(const std::string& name) {
  if (name == "mast") return Mast{30.0};
  return PositionSensor<1>{};
}

double place(const std::vector<std::string>& motions, const std::vector<std::pair<std::string, double>>& seen) {
  std::vector<AnyModel> models;
  for (const auto& name : motions) models.push_back(model_called(name));
  const RandomVariable mode{"mode", motions};
  const Gaussian<2> start{Vector<2>(0.0, 30.0), 100.0 * SquareMatrix<2>::Identity()};
  InteractingMultipleModel filter{models, TimedTransition{mode, rates_of_sojourns({20.0, 5.0})}, start};
  for (const auto& [sensor, z] : seen) filter.step(1.0, {Vector<1>(z), SquareMatrix<1>(1.0)}, sensor_called(sensor));
  return filter.estimate().mean(0);
}

TEST(ExtendingWalk, ABankChosenAtRunTime) {
  EXPECT_NEAR(place({"dwna", "braking"}, {{"mast", 42.4}, {"position", 55.0}, {"position", 75.0}}), 75.0, 1.0);
  // Both predict 30 m, and that is what the mast sees at its height.
  EXPECT_NEAR(place({"dwna", "cwna"}, {{"mast", std::hypot(30.0, 30.0)}}), 30.0, 1e-9);
}

}  // namespace extending_walk_test
