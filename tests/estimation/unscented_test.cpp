#include <sigmax/estimation/unscented.hpp>

#include <gtest/gtest.h>

#include "estimation/quadratic.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::holds;
using support::near;
using support::number_between;
using support::Quadratic;
using support::require_near;
using support::require_quadratic;
using support::throws;

TEST(Unscented, OfAQuadraticHasTheExactMeanAndItsOwnVariance) {
  holds([] {
    const UnscentedScaling s{number_between(0.3, 2.0), number_between(0.0, 3.0), number_between(-1.0, 3.0)};
    const double c = s.alpha * s.alpha * (3.0 + s.kappa);
    require_quadratic(
        [&](const auto& model) {
          return Unscented{model, s};
        },
        [&](const Vector<3>& g, const SquareMatrix<3>& B) {
          return g.squaredNorm() + 0.25 * c * B.diagonal().squaredNorm() +
                 0.25 * (s.beta - s.alpha * s.alpha) * B.trace() * B.trace();
        });
  });
}

TEST(Unscented, OfASquareIsExactByDefaultAndWithTheFourthMomentMatched) {
  // z = x² of x ~ N(m, P): mean m² + P, variance 4m²P + 2P², covariance with x 2mP.
  holds([] {
    const double m = number_between(-3.0, 3.0), P = number_between(0.1, 4.0), R = number_between(0.1, 4.0);
    for (const auto& s : {UnscentedScaling{}, UnscentedScaling{1.0, 0.0, 2.0}, UnscentedScaling{0.5, 2.0, 0.0}}) {
      Gaussian<1> x{Vector<1>(m), SquareMatrix<1>(P)};
      const Quadratic<1> square{0.0, Vector<1>(0.0), SquareMatrix<1>(2.0)};
      const auto innovation =
          update(Unscented{square, s}, x, Gaussian<1>{Vector<1>(5.0), SquareMatrix<1>(R)}, square, x);
      const double S = 4.0 * m * m * P + 2.0 * P * P + R;
      require_near(innovation.residual(0), 5.0 - m * m - P, 1e-12);
      require_near(innovation.covariance(0), S, 1e-12);
      require_near(x.mean(0), m + 2.0 * m * P / S * (5.0 - m * m - P), 1e-11);
      require_near(x.covariance(0), P - 4.0 * m * m * P * P / S, 1e-11);
    }
  });
}

TEST(Unscented, PredictsASquareExactly) {
  // The same through f, with Q added: x' = x².
  holds([] {
    const double m = number_between(-3.0, 3.0), P = number_between(0.1, 4.0);
    const Quadratic<1> model{0.0, Vector<1>(0.0), SquareMatrix<1>(2.0)};
    Gaussian<1> x{Vector<1>(m), SquareMatrix<1>(P)};
    const auto cross = prediction_covariance(Unscented{model}, x, 1.0);
    predict(Unscented{model}, x, 1.0, x);
    require_near(x.mean(0), m * m + P, 1e-12);
    require_near(x.covariance(0), 4.0 * m * m * P + 2.0 * P * P + 1.0, 1e-11);
    require_near(cross(0), 2.0 * m * P, 1e-12);
  });
}

TEST(Unscented, ItsDefaultWeightsAreNotNegative) {
  const auto weights = Unscented{Quadratic<3>{}}.weights();
  EXPECT_EQ(weights.spread, 3.0);
  EXPECT_EQ(weights.centre_of_mean, 0.0);
  EXPECT_EQ(weights.centre_of_covariance, 2.0);
}

TEST(Unscented, WeightsAreThoseOfWanAndVanDerMerwe) {
  const double n = 3.0, alpha = 0.5, beta = 2.0, kappa = 1.0, lambda = alpha * alpha * (n + kappa) - n;
  const auto weights = Unscented{Quadratic<3>{}, {alpha, beta, kappa}}.weights();
  EXPECT_PRED_FORMAT3(near, weights.spread, n + lambda, 1e-15);
  EXPECT_PRED_FORMAT3(near, weights.centre_of_mean, lambda / (n + lambda), 1e-15);
  EXPECT_PRED_FORMAT3(near, weights.centre_of_covariance, lambda / (n + lambda) + 1.0 - alpha * alpha + beta, 1e-15);
}

TEST(Unscented, ANegativeWeightThatTakesTheDefinitenessAwayIsRefused) {
  // With β = −4 the variance of a square is 4m²P + P²(c − α² + β) + Q = 1 − 4 + 1 for m = 0: there is no such Gaussian.
  const Quadratic<1> square{0.0, Vector<1>(0.0), SquareMatrix<1>(2.0)};
  const Unscented filter{square, {1.0, -4.0, 0.0}};
  Gaussian<1> x{Vector<1>(0.0), SquareMatrix<1>(1.0)};
  EXPECT_TRUE(throws<std::domain_error>([&] { predict(filter, x, 1.0, x); },
                                        {"covariance", "quadratic", "not positive semi-definite"}));
  EXPECT_TRUE(throws<std::domain_error>(
      [&] {
        update(filter, Gaussian<1>{Vector<1>(0.0), SquareMatrix<1>(1.0)},
               Gaussian<1>{Vector<1>(0.0), SquareMatrix<1>(1.0)}, square, x);
      },
      {"innovation covariance", "quadratic", "not positive definite"}));
}

TEST(Unscented, RefusesAScalingWithoutSpread) {
  for (const auto& s :
       {UnscentedScaling{0.0, 2.0, 0.0}, UnscentedScaling{1.0, 2.0, -3.0}, UnscentedScaling{1.0, 2.0, -4.0},
        UnscentedScaling{std::nan(""), 2.0, 0.0}, UnscentedScaling{1.0, std::nan(""), 0.0}})
    EXPECT_TRUE(throws<std::invalid_argument>(
        [&] {
          Unscented{Quadratic<3>{}, s};
        },
        {"unscented", "quadratic", "alpha", "beta", "kappa", "3 states"}));
}

TEST(Unscented, ShowsItsScaling) { EXPECT_EQ((Unscented{Quadratic<3>{}, {0.5, 2.0, 1.0}}.scaling().kappa), 1.0); }

}  // namespace
}  // namespace sigmax
