#include <sigmax/estimation/model.hpp>

#include <gtest/gtest.h>

#include <type_traits>

#include <sigmax/estimation/fixed_step_model.hpp>
#include <sigmax/estimation/kinematic_model.hpp>

namespace sigmax {
namespace {

/// A model of one's own needs these expressions and no base class.
struct RandomWalk {
  static constexpr int state_size = 1;
  static constexpr int max_state_size = 1;
  static constexpr int measurement_size = 1;
  Eigen::Index size() const { return 1; }
  std::string_view name() const { return "random walk"; }
  std::vector<std::string> components() const { return {"x"}; }
  SquareMatrix<1> transition(double) const { return SquareMatrix<1>::Identity(); }
  SquareMatrix<1> process_covariance(double dt) const { return dt * SquareMatrix<1>::Identity(); }
  Vector<1> known_input(double) const { return Vector<1>::Zero(); }
  SquareMatrix<1> measurement_matrix() const { return SquareMatrix<1>::Identity(); }
};

struct Nameless : RandomWalk {
  void name() const {}
};

// A matrix of another size does not compile.
struct WideTransition : RandomWalk {
  RectangularMatrix<1, 2> transition(double) const { return RectangularMatrix<1, 2>::Zero(); }
};
struct TallNoise : RandomWalk {
  RectangularMatrix<2, 1> process_covariance(double) const { return RectangularMatrix<2, 1>::Zero(); }
};
struct LongInput : RandomWalk {
  Vector<2> known_input(double) const { return Vector<2>::Zero(); }
};
struct TallMeasurement : RandomWalk {
  Vector<2> measurement_matrix() const { return Vector<2>::Zero(); }
};
static_assert(!LinearMotion<WideTransition>);
static_assert(!LinearMotion<TallNoise>);
static_assert(!LinearMotion<LongInput>);
static_assert(LinearMotion<TallMeasurement> && !LinearModel<TallMeasurement>);

static_assert(LinearModel<RandomWalk>);
static_assert(LinearModel<FixedStepModel<4, 2>>);
static_assert(LinearModel<KinematicModel<3, 2>>);
static_assert(LinearModel<KinematicModel<1, 3>>);
static_assert(LinearModel<KinematicModel<3, Eigen::Dynamic>>);
static_assert(!LinearModel<int>);
static_assert(!LinearModel<Nameless>);

static_assert(std::is_same_v<EstimateOf<KinematicModel<3, 2>>, Gaussian<6>>);
static_assert(std::is_same_v<EstimateOf<KinematicModel<3, Eigen::Dynamic>>, Gaussian<Eigen::Dynamic, 9>>);
static_assert(std::is_same_v<MeasurementOf<KinematicModel<3, Eigen::Dynamic>>, Gaussian<3>>);
static_assert(std::is_same_v<MeasurementOf<FixedStepModel<4, 2>>, Gaussian<2>>);

static_assert(measures_leading_components<KinematicModel<2, 3>>);
static_assert(!measures_leading_components<FixedStepModel<4, 2>>);
static_assert(!measures_leading_components<RandomWalk>);

TEST(LinearModel, WhatClaimsToMeasureItsLeadingComponentsDoes) {
  const KinematicModel<2, Eigen::Dynamic> model{1.0, Vector<2>::Zero(), 3};
  Eigen::Matrix<double, 2, 6> expected;
  expected << 1, 0, 0, 0, 0, 0,  //
      0, 1, 0, 0, 0, 0;
  EXPECT_EQ(model.measurement_matrix(), expected);
}

}  // namespace
}  // namespace sigmax
