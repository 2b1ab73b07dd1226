#include <sigmax/estimation/sensing.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/sensors.hpp>

#include "support/matrices.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::generated_matrix;
using support::holds;
using support::near;
using support::near_matrix;
using support::require_near_matrix;
using support::throws;

using Dwna = IndependentAxes<3, DiscreteWhiteNoise<2>>;
using Dwpa = IndependentAxes<3, DiscreteWhiteNoise<3>>;
using RunTime = AnyMotion<9, Dwna, Dwpa>;

/// A sensor of one's own needs these expressions and no base class: it sees how far a pendulum swings to a side.
struct Sideways {
  static constexpr int seen_size = 1;
  static constexpr int measurement_size = 1;
  template <class Scalar>
  Eigen::Matrix<Scalar, 1, 1> measure(const Eigen::Matrix<Scalar, 1, 1>& x) const {
    using std::sin;
    return Eigen::Matrix<Scalar, 1, 1>(Scalar(sin(x(0))));
  }
};
/// One that asks the model: the last component, whatever it is, squared.
struct SquaredLast {
  static constexpr int measurement_size = 1;
  template <class Model, class State>
  auto measure(const Model& model, const State& x) const {
    const auto last = x(model.size() - 1);
    return Eigen::Matrix<typename State::Scalar, 1, 1>(typename State::Scalar(last * last));
  }
};
/// And a linear one.
struct Last {
  static constexpr int measurement_size = 1;
  template <StateModel Model>
  auto measurement_matrix(const Model& model) const {
    RectangularMatrix<1, Model::state_size, 1, Model::max_state_size> H;
    H.setZero(1, model.size());
    H(0, model.size() - 1) = 1.0;
    return H;
  }
};

static_assert(SensorOf<Sideways, Dwna> && !LinearSensorOf<Sideways, Dwna>);
static_assert(SensorOf<SquaredLast, Dwna> && SensorOf<SquaredLast, RunTime> && !LinearSensorOf<SquaredLast, Dwna>);
static_assert(LinearSensorOf<Last, Dwna> && LinearSensorOf<Last, RunTime>);
static_assert(LinearSensorOf<PositionSensor<3>, Dwna> && measures_leading_components<PositionSensor<3>>);
static_assert(LinearSensorOf<LinearSensor<2, 5>, Dwna> && !measures_leading_components<LinearSensor<2, 5>>);
static_assert(SensorOf<PolarSensor<2>, Dwna> && !LinearSensorOf<PolarSensor<2>, Dwna>);
static_assert(SensorOf<BearingSensor, RunTime>);
static_assert(!Sensing<int> && !Sensing<Dwna>);
static_assert(!SensorOf<Sideways, int> && !SensorOf<int, Dwna>);

// What is of another size than the sensor says does not compile.
struct LongMeasurement : Sideways {
  Vector<2> measure(const Vector<1>&) const { return Vector<2>::Zero(); }
};
struct WideJacobian : Sideways {
  Eigen::RowVector2d measurement_jacobian(const Vector<1>&) const { return {0.0, 0.0}; }
};
struct TallJacobian : Sideways {
  Vector<2> measurement_jacobian(const Vector<1>&) const { return Vector<2>::Zero(); }
};
struct LongDifference : Sideways {
  Vector<2> measurement_difference(const Vector<1>&, const Vector<1>&) const { return Vector<2>::Zero(); }
};
struct WideMatrix {
  static constexpr int seen_size = 1;
  static constexpr int measurement_size = 1;
  Eigen::RowVector2d measurement_matrix() const { return {1.0, 0.0}; }
};
struct TallMatrixOfModel {
  static constexpr int measurement_size = 1;
  SquareMatrix<2> measurement_matrix(const Dwna&) const { return SquareMatrix<2>::Identity(); }
};
static_assert(!SensorOf<LongMeasurement, Dwna>);
static_assert(!SensorOf<WideJacobian, Dwna> && !SensorOf<TallJacobian, Dwna>);
static_assert(!SensorOf<LongDifference, Dwna>);
static_assert(!SensorOf<WideMatrix, Dwna>);
static_assert(!SensorOf<TallMatrixOfModel, Dwna>);

// Neither does a sensor that sees more than a model has, as far as the compiler knows.
static_assert(!SensorOf<PositionSensor<3>, IndependentAxes<1, DiscreteWhiteNoise<2>>>);
static_assert(!SensorOf<LinearSensor<1, 7>, Dwna> && SensorOf<LinearSensor<1, 7>, Dwpa>);
static_assert(SensorOf<LinearSensor<1, 7>, RunTime>, "it is seen at run time");

/// Sees as many components as only an acceleration has, if at run time.
struct ThirdAcceleration {
  static constexpr int seen_size = 9;
  static constexpr int measurement_size = 1;
  Vector<1> measure(const Vector<9>& seen) const { return Vector<1>(seen(8) * seen(8)); }
};

TEST(Sensing, ASensorOfMoreThanARunTimeModelHasIsRefused) {
  const RunTime dwna_now = dwna<3>(1.0), dwpa_now = dwpa<3>(1.0);
  const PolarSensor<3> radar;
  const Vector<Eigen::Dynamic, 9> x = Vector<9>::Ones();
  EXPECT_EQ(predicted_measurement(dwpa_now, ThirdAcceleration{}, x), Vector<1>(1.0));
  const Vector<Eigen::Dynamic, 9> fewer = Vector<6>::Ones();
  EXPECT_NO_THROW(predicted_measurement(dwna_now, radar, fewer));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { predicted_measurement(dwna_now, ThirdAcceleration{}, fewer); },
                                            {"sees 9 components", "dwna", "6"}));
}

TEST(Sensing, WhatASensorSeesIsTheLeadingPartOfTheState) {
  holds([] {
    const CoordinatedTurn<3> turn{0.5, 0.1};
    const PolarSensor<2> radar{Vector<2>(500.0, 600.0)};
    const Vector<7> x = generated_matrix<7, 1>();
    RC_ASSERT(predicted_measurement(turn, radar, x) == radar.measure(Vector<2>(x.head<2>())));
    RectangularMatrix<2, 7> H = RectangularMatrix<2, 7>::Zero();
    H.leftCols<2>() = radar.measurement_jacobian(x.head<2>());
    RC_ASSERT(measurement_jacobian(turn, radar, x) == H);
  });
}

TEST(Sensing, AMatrixIsOverAllComponents) {
  const RectangularMatrix<2, 4> leading{{1, 2, 3, 4}, {5, 6, 7, 8}};
  RectangularMatrix<2, 6> all = RectangularMatrix<2, 6>::Zero();
  all.leftCols<4>() = leading;
  const LinearSensor<2, 4> sensor{leading};
  EXPECT_EQ(measurement_matrix(dwna<3>(1.0), sensor), all);
  EXPECT_EQ(measurement_matrix(RunTime{dwna<3>(1.0)}, sensor), all);
  EXPECT_EQ(measurement_jacobian(dwna<3>(1.0), sensor, Vector<6>::Ones()), all);
  EXPECT_EQ(predicted_measurement(dwna<3>(1.0), sensor, Vector<6>::Ones()), (Vector<2>(10.0, 26.0)));
  RectangularMatrix<2, 6> position = RectangularMatrix<2, 6>::Zero();
  position(0, 0) = position(1, 1) = 1.0;
  EXPECT_EQ(measurement_matrix(dwna<3>(1.0), PositionSensor<2>{}), position);
}

TEST(Sensing, ASensorMayAskTheModel) {
  const Vector<9> x = Vector<9>::LinSpaced(1.0, 9.0);
  EXPECT_EQ(predicted_measurement(dwpa<3>(1.0), SquaredLast{}, x), Vector<1>(81.0));
  EXPECT_EQ(predicted_measurement(dwna<3>(1.0), SquaredLast{}, x.head<6>()), Vector<1>(36.0));
  EXPECT_EQ(measurement_jacobian(dwna<3>(1.0), SquaredLast{}, x.head<6>()),
            (RectangularMatrix<1, 6>(0.0, 0.0, 0.0, 0.0, 0.0, 12.0)));
  EXPECT_EQ(measurement_matrix(dwna<3>(1.0), Last{}), (RectangularMatrix<1, 6>(0.0, 0.0, 0.0, 0.0, 0.0, 1.0)));
  EXPECT_EQ(predicted_measurement(RunTime{dwpa<3>(1.0)}, Last{}, x), Vector<1>(9.0));
}

/// A sensor whose Jacobian nobody gives: the squared distance from the origin.
struct SquaredDistance {
  static constexpr int seen_size = 3;
  static constexpr int measurement_size = 1;
  template <class Scalar>
  Eigen::Matrix<Scalar, 1, 1> measure(const Eigen::Matrix<Scalar, 3, 1>& p) const {
    return Eigen::Matrix<Scalar, 1, 1>(Scalar(p(0) * p(0) + p(1) * p(1) + p(2) * p(2)));
  }
};

TEST(Sensing, JacobiansAreDifferentiatedWhereTheyAreNotGiven) {
  const Vector<Eigen::Dynamic, 9> x = Vector<6>(1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
  EXPECT_EQ(measurement_jacobian(RunTime{dwna<3>(1.0)}, SquaredDistance{}, x),
            (RectangularMatrix<1, 6>(2.0, 4.0, 6.0, 0.0, 0.0, 0.0)));
  EXPECT_PRED_FORMAT3(near, measurement_jacobian(dwna<3>(1.0), Sideways{}, 0.3 * Vector<6>::Ones())(0), std::cos(0.3),
                      1e-15);
}

struct WithJacobian : Sideways {
  SquareMatrix<1> measurement_jacobian(const Vector<1>& x) const { return 7.0 * x; }
};

TEST(Sensing, AGivenJacobianIsTaken) {
  EXPECT_EQ(measurement_jacobian(dwna<3>(1.0), WithJacobian{}, Vector<6>::Ones())(0), 7.0);
}

/// Sees the angle itself, modulo a turn.
struct Circular : Sideways {
  Vector<1> measurement_difference(const Vector<1>& z, const Vector<1>& predicted) const {
    return Vector<1>(std::remainder(z(0) - predicted(0), 2.0 * std::numbers::pi));
  }
};
/// Averages its angles as points of a circle.
struct OnACircle : Circular {
  template <class Points, class Weights>
  Vector<1> measurement_mean(const Points& points, const Weights& weights) const {
    double c = 0.0, s = 0.0;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      c += weights(i) * std::cos(points(0, i));
      s += weights(i) * std::sin(points(0, i));
    }
    return Vector<1>(std::atan2(s, c));
  }
};

TEST(Sensing, DifferencesAndMeansAreItsOwn) {
  const double pi = std::numbers::pi;
  const Vector<1> a(3.0), b(-3.0);
  EXPECT_EQ(measurement_difference(Sideways{}, a, b), Vector<1>(6.0));
  EXPECT_PRED_FORMAT3(near, measurement_difference(Circular{}, a, b)(0), 6.0 - 2.0 * pi, 1e-15);

  const Eigen::RowVector2d points(3.0, -3.0);
  const Vector<2> halves(0.5, 0.5), uneven(0.25, 0.75);
  EXPECT_PRED_FORMAT3(near, measurement_mean(Sideways{}, points, uneven)(0), -1.5, 1e-15);
  EXPECT_PRED_FORMAT3(near, measurement_mean(Circular{}, points, halves)(0), pi, 1e-15);
  EXPECT_PRED_FORMAT3(near, measurement_mean(Circular{}, points, uneven)(0), 3.0 + 0.75 * (2.0 * pi - 6.0), 1e-15);
  EXPECT_PRED_FORMAT3(near, measurement_mean(OnACircle{}, points, uneven)(0),
                      std::atan2(-0.5 * std::sin(3.0), std::cos(3.0)), 1e-15);
}

struct Broken : Sideways {
  Vector<1> measure(const Vector<1>& x) const { return Vector<1>(std::log(x(0))); }
  SquareMatrix<1> measurement_jacobian(const Vector<1>&) const { return SquareMatrix<1>(std::nan("")); }
};

TEST(Sensing, RefusesWhatIsNotFiniteAndNamesTheState) {
  Vector<6> x = 4.0 * Vector<6>::Ones();
  x(0) = -2.5;
  EXPECT_TRUE(throws<std::domain_error>([&] { predicted_measurement(dwna<3>(1.0), Broken{}, x); },
                                        {"h(x)", "dwna", "not finite", "x = (-2.5", "4.0"}));
  EXPECT_TRUE(throws<std::domain_error>([&] { measurement_jacobian(dwna<3>(1.0), Broken{}, x); },
                                        {"Jacobian of h", "dwna", "-2.5"}));
}

}  // namespace
}  // namespace sigmax
