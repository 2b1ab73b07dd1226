// Prediction and update of every member allocate nothing.

#include "support/allocations.hpp"
#include "support/sigmax.hpp"

namespace member_allocation_test {

template <class Filter, class Sensor>
void expect_none(const Filter& filter, const EstimateOf<Filter>& start, const MeasurementOf<Sensor>& z,
                 const Sensor& sensor) {
  EstimateOf<Filter> x = start;
  EXPECT_EQ(allocations_of([&] { predict(filter, x, 0.5, x); }), 0U) << filter.name();
  EXPECT_EQ(allocations_of([&] { update(filter, x, z, sensor, x); }), 0U) << filter.name();
  EXPECT_EQ(allocations_of([&] { prediction_covariance(filter, x, 0.5); }), 0U) << filter.name();
}

const auto radar =
    PolarSensor<3>{}.measurement({1e4, radians(0.7), radians(0.1)}, {10.0, radians(0.002), radians(0.002)}).z;

template <class Moves>
void expect_none_of_any(const Moves& motion) {
  const Eigen::Index n = motion.size();
  EstimateOf<AnyModel> start{StateOf<AnyModel>::Zero(n), StateMatrixOf<AnyModel>::Identity(n, n)};
  start.mean.head<3>() << 8e3, 6e3, 1e3;
  for (const AnyModel& any : {AnyModel{Extended{motion}}, AnyModel{Unscented{motion}}, AnyModel{Cubature{motion}}}) {
    expect_none(any, start, {radar.mean, radar.covariance}, AnySensor{PolarSensor<3>{}});
    expect_none(any, start, {radar.mean, radar.covariance}, AnySensor{PositionSensor<3>{}});
  }
}

TEST(MemberAllocation, OfAnyModelAndSensorIsNone) {
  expect_none_of_any(dwpa<3>(1.0));
  expect_none_of_any(singer<3>(0.1, 1.0));
  expect_none_of_any(CoordinatedTurn<3>{1.0, 0.01});
  EXPECT_EQ(allocations_of([] { AnySensor{PolarSensor<3>{}}; }), 0U) << "those of the library lie in place";
}

/// Has no Jacobian, so it is differentiated automatically.
struct Drag {
  static constexpr int state_size = 2;
  static constexpr int max_state_size = 2;
  static constexpr int seen_size = 2;
  static constexpr int measurement_size = 1;
  Eigen::Index size() const { return 2; }
  std::string_view name() const { return "drag"; }
  std::vector<std::string> components() const { return {"x", "vx"}; }
  template <class Scalar>
  Eigen::Matrix<Scalar, 2, 1> propagate(const Eigen::Matrix<Scalar, 2, 1>& x, double dt) const {
    return {Scalar(x(0) + dt * x(1)), Scalar(x(1) - 0.1 * dt * x(1) * x(1))};
  }
  SquareMatrix<2> process_covariance(double dt) const { return dt * SquareMatrix<2>::Identity(); }
  template <class Scalar>
  Eigen::Matrix<Scalar, 1, 1> measure(const Eigen::Matrix<Scalar, 2, 1>& x) const {
    return Eigen::Matrix<Scalar, 1, 1>(Scalar(x(0) * x(1)));
  }
};

TEST(MemberAllocation, OfAutomaticDifferentiationIsNone) {
  expect_none(Extended{Drag{}}, {Vector<2>(1.0, 2.0), SquareMatrix<2>::Identity()},
              {Vector<1>(2.0), SquareMatrix<1>(1.0)}, Drag{});
}

TEST(MemberAllocation, OfTheKalmanFilterIsNone) {
  const Gaussian<9> start{Vector<9>::Zero(), SquareMatrix<9>::Identity()};
  expect_none(singer<3>(0.1, 1.0), start, {Vector<3>(1.0, 2.0, 3.0), SquareMatrix<3>::Identity()}, PositionSensor<3>{});
  expect_none(singer<3>(0.1, 1.0), start, {Vector<2>(1.0, 2.0), SquareMatrix<2>::Identity()},
              LinearSensor<2, 6>{RectangularMatrix<2, 6>::Ones()});
}

}  // namespace member_allocation_test
