#include "estimation/quadratic.hpp"

namespace cubature_test {

TEST(Cubature, OfAQuadraticHasTheExactMeanAndItsOwnVariance) {
  expect_quadratics([](const OwnMotion& model) { return Cubature{model}; },
                    [](const Vector<3>& g, const SquareMatrix<3>& B) {
                      return g.squaredNorm() + 0.75 * B.diagonal().squaredNorm() - 0.25 * B.trace() * B.trace();
                    });
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

}  // namespace cubature_test
