#include "estimation/restated.hpp"

namespace sensing_test {

using Dwna = IndependentAxes<3, DiscreteWhiteNoise<2>>;
using Dwpa = IndependentAxes<3, DiscreteWhiteNoise<3>>;
const auto dwna_now = dwna<3>(1.0);
const auto dwpa_now = dwpa<3>(1.0);

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
static_assert(SensorOf<SquaredLast, Dwna> && SensorOf<SquaredLast, AnyModel> && !LinearSensorOf<SquaredLast, Dwna>);
static_assert(LinearSensorOf<Last, Dwna> && LinearSensorOf<Last, AnyModel>);
static_assert(LinearSensorOf<PositionSensor<3>, Dwna> && measures_leading_components<PositionSensor<3>>);
static_assert(LinearSensorOf<LinearSensor<2, 5>, Dwna> && !measures_leading_components<LinearSensor<2, 5>>);
static_assert(LinearSensorOf<ComponentSensor<2>, Dwna>);
static_assert(SensorOf<PolarSensor<2>, Dwna> && !LinearSensorOf<PolarSensor<2>, Dwna>);
static_assert(SensorOf<BearingSensor, AnyModel>);
static_assert(!Sensing<int> && !Sensing<Dwna>);
static_assert(!SensorOf<Sideways, int> && !SensorOf<int, Dwna>);

/// Of one quantity and one component seen, with functions of these sizes: what is of another does not compile.
template <int Measured, int Rows, int Columns, int Differs>
struct Shaped {
  static constexpr int seen_size = 1;
  static constexpr int measurement_size = 1;
  Vector<Measured> measure(const Vector<1>&) const { return {}; }
  RectangularMatrix<Rows, Columns> measurement_jacobian(const Vector<1>&) const { return {}; }
  Vector<Differs> measurement_difference(const Vector<1>&, const Vector<1>&) const { return {}; }
};
static_assert(SensorOf<Shaped<1, 1, 1, 1>, Dwna> && !SensorOf<Shaped<2, 1, 1, 1>, Dwna>);
static_assert(!SensorOf<Shaped<1, 2, 1, 1>, Dwna> && !SensorOf<Shaped<1, 1, 2, 1>, Dwna>);
static_assert(!SensorOf<Shaped<1, 1, 1, 2>, Dwna>);
template <int Rows, int Columns, int OfModel>
struct ShapedMatrix {
  static constexpr int seen_size = 1;
  static constexpr int measurement_size = 1;
  RectangularMatrix<Rows, Columns> measurement_matrix() const { return {}; }
};
template <int Rows, int Columns>
struct ShapedMatrix<Rows, Columns, 1> {
  static constexpr int measurement_size = 1;
  RectangularMatrix<Rows, Columns> measurement_matrix(const Dwna&) const { return {}; }
};
static_assert(SensorOf<ShapedMatrix<1, 1, 0>, Dwna> && !SensorOf<ShapedMatrix<1, 2, 0>, Dwna>);
static_assert(SensorOf<ShapedMatrix<1, 6, 1>, Dwna> && !SensorOf<ShapedMatrix<2, 2, 1>, Dwna>);

// Neither does a sensor that sees more than a model has, as far as the compiler knows.
static_assert(!SensorOf<PositionSensor<3>, IndependentAxes<1, DiscreteWhiteNoise<2>>>);
static_assert(!SensorOf<LinearSensor<1, 7>, Dwna> && SensorOf<LinearSensor<1, 7>, Dwpa>);
static_assert(SensorOf<LinearSensor<1, 7>, AnyModel>, "it is seen at run time");

/// A measurement of nothing as it is seen about a state: its H, and as residual −h(x).
template <class Model, class Sensor>
auto seen(const Model& model, const Sensor& sensor, const StateOf<Model>& x) {
  const StateMatrixOf<Model> P = StateMatrixOf<Model>::Identity(x.size(), x.size());
  return linearised_measurement(model, {x, P},
                                {MeasuredOf<Sensor>::Zero(), SquareMatrix<Sensor::measurement_size>::Zero()}, sensor);
}

TEST(Sensing, ASensorOfMoreThanARunTimeModelHasIsRefused) {
  const AnyModel six = dwna_now, nine = dwpa_now;
  const LinearSensor<1, 9> acceleration{RectangularMatrix<1, 9>::Unit(8)};
  EXPECT_EQ(-seen(nine, acceleration, Vector<9>::Constant(2.0)).residual, Vector<1>(2.0));
  const std::initializer_list<std::string_view> words{"sees 9 components", "dwna", "6"};
  const Vector<6> x = Vector<6>::Ones();
  EXPECT_NO_THROW(seen(six, PolarSensor<3>{}, x));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { seen(six, acceleration, x); }, words));
}

/// Says its matrix row by row.
struct ByRows {
  static constexpr int seen_size = 4;
  static constexpr int measurement_size = 2;
  Eigen::Matrix<double, 2, 4, Eigen::RowMajor> measurement_matrix() const {
    return RectangularMatrix<2, 4>{{1, 2, 3, 4}, {5, 6, 7, 8}};
  }
};

TEST(Sensing, AMatrixIsOverAllComponents) {
  const LinearSensor<2, 4> sensor{RectangularMatrix<2, 4>{{1, 2, 3, 4}, {5, 6, 7, 8}}};
  const RectangularMatrix<2, 6> all{{1, 2, 3, 4, 0, 0}, {5, 6, 7, 8, 0, 0}};
  EXPECT_EQ(seen(dwna_now, sensor, Vector<6>::Ones()).H, all);
  EXPECT_EQ(seen(AnyModel{dwna_now}, sensor, Vector<6>::Ones()).H, all);
  EXPECT_EQ(seen(dwna_now, ByRows{}, Vector<6>::Ones()).H, all);
  EXPECT_EQ(-seen(dwna_now, sensor, Vector<6>::Ones()).residual, (Vector<2>(10.0, 26.0)));
  EXPECT_EQ(seen(dwna_now, PositionSensor<2>{}, Vector<6>::Ones()).H, (RectangularMatrix<2, 6>::Identity()));
}

TEST(Sensing, ASensorMayAskTheModel) {
  const Vector<9> x = Vector<9>::LinSpaced(1.0, 9.0);
  EXPECT_EQ(-seen(dwpa_now, SquaredLast{}, x).residual, Vector<1>(81.0));
  EXPECT_EQ(-seen(dwna_now, SquaredLast{}, x.head<6>()).residual, Vector<1>(36.0));
  EXPECT_EQ(seen(dwna_now, SquaredLast{}, x.head<6>()).H, (RectangularMatrix<1, 6>(0.0, 0.0, 0.0, 0.0, 0.0, 12.0)));
  EXPECT_EQ(seen(dwna_now, Last{}, x.head<6>()).H, (RectangularMatrix<1, 6>(0.0, 0.0, 0.0, 0.0, 0.0, 1.0)));
  EXPECT_EQ(-seen(AnyModel{dwpa_now}, Last{}, x).residual, Vector<1>(9.0));
}

struct WithJacobian : Sideways {
  SquareMatrix<1> measurement_jacobian(const Vector<1>& x) const { return 7.0 * x; }
};

TEST(Sensing, JacobiansAreDifferentiatedWhereTheyAreNotGiven) {
  EXPECT_CLOSE(seen(dwna_now, Sideways{}, 0.3 * Vector<6>::Ones()).H(0), std::cos(0.3), 1e-15);
  EXPECT_EQ(seen(AnyModel{dwna_now}, SquaredLast{}, Vector<6>::Constant(2.0)).H(5), 4.0);
  EXPECT_EQ(seen(dwna_now, WithJacobian{}, Vector<6>::Ones()).H(0), 7.0);
}

/// Sees the angle itself, modulo a turn.
struct Angle {
  static constexpr int seen_size = 1;
  static constexpr int measurement_size = 1;
  Vector<1> measure(const Vector<1>& x) const { return Vector<1>(std::remainder(x(0), 2.0 * std::numbers::pi)); }
  Vector<1> measurement_difference(const Vector<1>& z, const Vector<1>& predicted) const {
    return Vector<1>(std::remainder(z(0) - predicted(0), 2.0 * std::numbers::pi));
  }
};
/// Says that its mean is 1, whatever the points are.
struct OneAlways : Angle {
  template <class Points, class Weights>
  Vector<1> measurement_mean(const Points&, const Weights&) const {
    return Vector<1>(1.0);
  }
};

/// The residual of an angle of −3.1 where points lie about 3.1, some of them beyond half a turn.
TEST(Sensing, DifferencesAndMeansAreItsOwn) {
  const Unscented filter{dwna<1>(1.0)};
  const Gaussian<2> prior{Vector<2>(3.1, 0.0), SquareMatrix<2>{{0.25, 0.0}, {0.0, 1.0}}};
  const Gaussian<1> z{Vector<1>(-3.1), SquareMatrix<1>(0.01)};
  const auto residual = [&](const auto& sensor) {
    Gaussian<2> x;
    return update(filter, prior, z, sensor, x).residual(0);
  };
  const double turn = 2.0 * std::numbers::pi;
  EXPECT_CLOSE(residual(Angle{}), turn - 6.2, 1e-14);
  EXPECT_CLOSE(residual(OneAlways{}), turn - 4.1, 1e-14);
}

}  // namespace sensing_test
