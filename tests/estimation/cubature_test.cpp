#include <sigmax/estimation/cubature.hpp>

#include <gtest/gtest.h>

#include "estimation/quadratic.hpp"

namespace sigmax {
namespace {

using support::measured_number;
using support::near;
using support::near_matrix;
using support::one_number;
using support::OwnMotion;
using support::OwnSensor;
using support::square;

TEST(Cubature, OfAQuadraticHasTheExactMeanAndItsOwnVariance) {
  support::expect_quadratics([](const OwnMotion& model) { return Cubature{model}; },
                             [](const Vector<3>& g, const SquareMatrix<3>& B) {
                               return g.squaredNorm() + 0.75 * B.diagonal().squaredNorm() -
                                      0.25 * B.trace() * B.trace();
                             });
}

TEST(Cubature, OfASquareMissesTheFourthMoment) {
  const double m = -1.5, P = 0.7;
  EstimateOf<AnyModel> x;
  const auto innovation =
      update(AnyModel{Cubature{square}}, one_number(m, P), measured_number(5.0, 1.0), OwnSensor{square.model}, x);
  EXPECT_PRED_FORMAT3(near, innovation.residual(0), 5.0 - m * m - P, 1e-12);
  EXPECT_PRED_FORMAT3(near, innovation.covariance(0), 4.0 * m * m * P + 1.0, 1e-12);  // less 2P²
}

/// f writes down where it is asked.
struct Asked {
  static constexpr int state_size = 3;
  static constexpr int max_state_size = 3;
  std::vector<Vector<3>>* points;
  Eigen::Index size() const { return 3; }
  std::string_view name() const { return "asked"; }
  std::vector<std::string> components() const { return {"a", "b", "c"}; }
  Vector<3> propagate(const Vector<3>& x, double) const { return points->push_back(x), x; }
  SquareMatrix<3> process_covariance(double) const { return SquareMatrix<3>::Zero(); }
};

TEST(Cubature, ItsPointsLieAlongTheColumnsOfTheRoot) {
  std::vector<Vector<3>> points;
  const Gaussian<3> x{Vector<3>(1.0, 2.0, 3.0), SquareMatrix<3>{{4, 2, 0}, {2, 10, 0}, {0, 0, 0}}};
  predict(Cubature{Asked{&points}}, x, 1.0);
  const Vector<3> first = std::sqrt(3.0) * Vector<3>(2.0, 1.0, 0.0), second = std::sqrt(3.0) * Vector<3>(0.0, 3.0, 0.0);
  const std::vector<Vector<3>> expected{x.mean + first, x.mean + second, x.mean,  // nothing is unknown of the third
                                        x.mean - first, x.mean - second, x.mean};
  EXPECT_EQ(points, expected);
}

TEST(Cubature, IsTheUnscentedFilterWhoseCentreWeighsNothing) {
  const OwnMotion model = support::quadratic(0.5, {0.3, -0.2, 0.9}, {3, 3, {1, 0.5, 0, 0.5, -0.7, 0.2, 0, 0.2, 0.4}});
  const EstimateOf<AnyModel> prior{Vector<3>(0.1, 0.2, -0.4), 0.5 * SquareMatrix<3>::Identity()};
  EstimateOf<AnyModel> x, y;
  update(AnyModel{Cubature{model}}, prior, measured_number(1.0, 2.0), OwnSensor{model.model}, x);
  update(AnyModel{Unscented{model, {1.0, 0.0, 0.0}}}, prior, measured_number(1.0, 2.0), OwnSensor{model.model}, y);
  EXPECT_PRED_FORMAT3(near_matrix, x.mean, y.mean, 1e-12);
  EXPECT_PRED_FORMAT3(near_matrix, x.covariance, y.covariance, 1e-12);
}

}  // namespace
}  // namespace sigmax
