#include <sigmax/estimation/cubature.hpp>

#include <gtest/gtest.h>

#include <sigmax/estimation/unscented.hpp>

#include "estimation/quadratic.hpp"

namespace sigmax {
namespace {

using support::holds;
using support::number_between;
using support::Quadratic;
using support::require_near;
using support::require_near_matrix;
using support::require_quadratic;

TEST(Cubature, OfAQuadraticHasTheExactMeanAndItsOwnVariance) {
  holds([] {
    require_quadratic([](const auto& model) { return Cubature{model}; },
                      [](const Vector<3>& g, const SquareMatrix<3>& B) {
                        return g.squaredNorm() + 0.75 * B.diagonal().squaredNorm() - 0.25 * B.trace() * B.trace();
                      });
  });
}

TEST(Cubature, OfASquareMissesTheFourthMoment) {
  holds([] {
    const double m = number_between(-3.0, 3.0), P = number_between(0.1, 4.0);
    const Gaussian<1> z{Vector<1>(5.0), SquareMatrix<1>(1.0)};
    Gaussian<1> x{Vector<1>(m), SquareMatrix<1>(P)};
    const Quadratic<1> square{0.0, Vector<1>(0.0), SquareMatrix<1>(2.0)};
    const auto innovation = update(Cubature{square}, x, z, square, x);
    require_near(innovation.residual(0), 5.0 - m * m - P, 1e-12);
    require_near(innovation.covariance(0), 4.0 * m * m * P + 1.0, 1e-12);  // less 2P²
  });
}

TEST(Cubature, IsTheUnscentedFilterWhoseCentreWeighsNothing) {
  holds([] {
    const auto prior = support::generated_gaussian<3>();
    const Quadratic<3> model{0.5, support::generated_matrix<3, 1>(),
                             support::fixed<3, 3>(restatement::symmetrised(support::generated(3, 3)))};
    const Gaussian<1> z{Vector<1>(1.0), SquareMatrix<1>(20.0)};
    Gaussian<3> x, y;
    RC_PRE(update(Cubature{model}, prior, z, model, x).covariance(0) > 1.0);
    update(Unscented{model, {1.0, 0.0, 0.0}}, prior, z, model, y);
    require_near_matrix(x.mean, y.mean, 1e-12);
    require_near_matrix(x.covariance, y.covariance, 1e-12);
  });
}

}  // namespace
}  // namespace sigmax
