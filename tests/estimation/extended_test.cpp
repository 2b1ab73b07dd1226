#include "estimation/quadratic.hpp"

namespace extended_test {

TEST(Extended, OfAQuadraticKnowsNothingOfItsCurvature) {
  expect_quadratics([](const OwnMotion& model) { return Extended{model}; },
                    [](const Vector<3>& g, const SquareMatrix<3>&) { return g.squaredNorm(); }, 0.0);
}

}  // namespace extended_test
