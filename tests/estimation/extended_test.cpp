#include "estimation/quadratic.hpp"

namespace {

TEST(Extended, OfAQuadraticKnowsNothingOfItsCurvature) {
  expect_quadratics([](const OwnMotion& model) { return Extended{model}; },
                    [](const Vector<3>& g, const SquareMatrix<3>&) { return g.squaredNorm(); }, 0.0);
}

TEST(Extended, PredictsByTheTangent) {
  const auto x = predict(AnyModel{Extended{square}}, one_number(-3.0, 0.5), 1.0);
  EXPECT_CLOSE(x.mean(0), 9.0, 1e-13);
  EXPECT_CLOSE(x.covariance(0), 4.0 * 9.0 * 0.5 + 1.0, 1e-13);
}

}  // namespace
