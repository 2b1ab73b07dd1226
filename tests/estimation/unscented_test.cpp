#include "estimation/quadratic.hpp"

namespace unscented_test {

TEST(Unscented, OfAQuadraticHasTheExactMeanAndItsOwnVariance) {
  for (const auto& s : {UnscentedScaling{}, UnscentedScaling{0.4, 2.5, -0.8}, UnscentedScaling{1.8, 0.2, 2.5}}) {
    const double c = s.alpha * s.alpha * (3.0 + s.kappa);
    expect_quadratics([&](const OwnMotion& model) { return Unscented(model, s); },
                      [&](const Vector<3>& g, const SquareMatrix<3>& B) {
                        return g.squaredNorm() + 0.25 * c * B.diagonal().squaredNorm() +
                               0.25 * (s.beta - s.alpha * s.alpha) * B.trace() * B.trace();
                      });
  }
}

TEST(Unscented, WeightsAreThoseOfWanAndVanDerMerwe) {
  for (const auto& [alpha, beta, kappa] : {UnscentedScaling{}, UnscentedScaling{0.5, 2.0, 1.0}}) {
    const double n = 3.0, lambda = alpha * alpha * (n + kappa) - n;
    const Unscented filter{OwnMotion{{}, 3}, {alpha, beta, kappa}};
    const auto weights = filter.weights();
    EXPECT_CLOSE(weights.spread, n + lambda, 1e-15);
    EXPECT_CLOSE(weights.centre_of_mean, lambda / (n + lambda), 1e-15);
    EXPECT_CLOSE(weights.centre_of_covariance, lambda / (n + lambda) + 1.0 - alpha * alpha + beta, 1e-15);
    EXPECT_EQ(filter.scaling().kappa, kappa);
  }
}

TEST(Unscented, ANegativeWeightThatTakesTheDefinitenessAwayIsRefused) {
  // With β = −4 the variance of a square is 4m²P + P²(c − α² + β) + Q = 1 − 4 + 1 for m = 0: there is no such Gaussian.
  const AnyModel filter = Unscented{square, {1.0, -4.0, 0.0}};
  EXPECT_REFUSED(std::domain_error, ("covariance", "own", "not positive semi-definite"),
                 predict(filter, one_number(0.0, 1.0), 1.0));
  EXPECT_REFUSED(std::domain_error, ("innovation covariance", "own", "not positive definite"),
                 update(filter, one_number(0.0, 1.0), measured_number(0.0, 1.0), OwnSensor{square.model}));
}

TEST(Unscented, RefusesAScalingWithoutSpread) {
  for (const auto& s :
       {UnscentedScaling{0.0, 2.0, 0.0}, UnscentedScaling{1.0, 2.0, -3.0}, UnscentedScaling{1.0, 2.0, -4.0},
        UnscentedScaling{not_a_number, 2.0, 0.0}, UnscentedScaling{1.0, not_a_number, 0.0}})
    EXPECT_INVALID(("unscented", "own", "alpha", "beta", "kappa", "3 states"), Unscented(OwnMotion{{}, 3}, s));
}

}  // namespace unscented_test
