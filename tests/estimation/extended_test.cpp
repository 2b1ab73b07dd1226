#include <sigmax/estimation/extended.hpp>

#include <gtest/gtest.h>

#include "estimation/quadratic.hpp"

namespace sigmax {
namespace {

using support::holds;
using support::number_between;
using support::Quadratic;
using support::require_near;
using support::require_quadratic;

TEST(Extended, OfAQuadraticKnowsNothingOfItsCurvature) {
  holds([] {
    require_quadratic([](const auto& model) { return Extended{model}; },
                      [](const Vector<3>& g, const SquareMatrix<3>&) { return g.squaredNorm(); }, 0.0);
  });
}

TEST(Extended, PredictsByTheTangent) {
  holds([] {
    const double m = number_between(-3.0, 3.0), P = number_between(0.1, 4.0);
    Gaussian<1> x{Vector<1>(m), SquareMatrix<1>(P)};
    predict(Extended{Quadratic<1>{0.0, Vector<1>(0.0), SquareMatrix<1>(2.0)}}, x, 1.0, x);
    require_near(x.mean(0), m * m, 1e-13);
    require_near(x.covariance(0), 4.0 * m * m * P + 1.0, 1e-13);
  });
}

}  // namespace
}  // namespace sigmax
