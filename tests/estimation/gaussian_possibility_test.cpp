#include "support/sigmax.hpp"

namespace gaussian_possibility_test {

using restatement::transposed;

/// Σ = A Aᵀ of any rank: at m + A y the distance is that of the least such y, which of independent columns is y itself.
/// What A does not reach is impossible.
template <int N>
void knows_its_support() {
  holds([] {
    const auto rank = *rc::gen::inRange<std::size_t>(1, std::size_t{N} + 1);
    auto A = generated(N, rank);
    for (std::size_t k = 0; k < rank; ++k) A(k, k) += 2.0;  // independent columns
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t k = 0; k < rank; ++k) A(i, k) *= std::pow(10.0, number_between(-1.0, 1.0) * (i % 2 ? 1.0 : 0.0));
    const Vector<N> m = fixed<N, 1>(10.0 * generated(N, 1));
    const GaussianPossibility<N> pi{{m, fixed<N, N>(restatement::symmetrised(A * transposed(A)))}};
    const auto y = generated(rank, 1);
    const Vector<N> x = m + fixed<N, 1>(A * y);
    const auto least = transposed(y) * y;
    if (!(pi.log(x) > log_zero)) RC_FAIL("a point of the support is impossible");
    require_near(pi.log(x), -0.5 * least(0, 0), 1e-5);
    if (rank < N) RC_ASSERT(pi(x + 1e-2 * Vector<N>::Unit(N - 1)) == 0.0);
  });
}

TEST(GaussianPossibility, OfASingularCovarianceOfAnyRankKnowsItsSupport) {
  knows_its_support<1>();
  knows_its_support<2>();
  knows_its_support<4>();
  knows_its_support<6>();
}

/// What counts as rounding is small: a variance of 1e-12 of the greatest one is none, and off a support is off it.
TEST(GaussianPossibility, TakesOnlyRoundingForNothing) {
  const GaussianPossibility<2> thin{{Vector<2>::Zero(), SquareMatrix<2>{{4.0, 0.0}, {0.0, 1e-13}}}};
  EXPECT_NEAR(thin.log({0.0, std::sqrt(1e-13)}), -0.5, 1e-9);
  const GaussianPossibility<2> flat{{Vector<2>::Zero(), SquareMatrix<2>{{4.0, 0.0}, {0.0, 0.0}}}};
  EXPECT_EQ(flat.log({1.0, 1e-8}), -0.125);
  EXPECT_EQ(flat.log({1.0, 1e-6}), log_zero);
}

/// π = p / sup p, (34), and p = π / ∫ π, (35), with the density written out.
PROPERTY(GaussianPossibility, IsTheDensityOnTheRatioScale) {
  const auto gaussian = generated_gaussian<3>();
  const auto [inverse, log_determinant] = restatement::inverse(dense(gaussian.covariance));
  const auto offset = generated(3, 1);
  const double greatest = std::exp(-0.5 * log_determinant) / std::pow(2.0 * std::numbers::pi, 1.5);
  const double p = greatest * std::exp(-0.5 * (transposed(offset) * inverse * offset)(0, 0));
  const GaussianPossibility<3> pi{gaussian};
  RC_ASSERT(pi(gaussian.mean) == 1.0);
  require_near(pi(gaussian.mean + fixed<3, 1>(offset)), p / greatest, 1e-12);
  require_near(pi.density().covariance, gaussian.covariance, 0.0);
}

TEST(GaussianPossibility, WithoutUncertaintyIsPossibleOnlyAtItsMean) {
  const GaussianPossibility<2> pi{{Vector<2>{1.0, 2.0}, SquareMatrix<2>::Zero()}};
  EXPECT_EQ(pi({1.0, 2.0}), 1.0);
  EXPECT_EQ(pi({1.0, 2.0 + 1e-12}), 0.0);
}

TEST(GaussianPossibility, RefusesWhatIsNoCovariance) {
  const auto make = [](double variance) {
    return GaussianPossibility<2>{{Vector<2>::Zero(), SquareMatrix<2>{{1.0, 0.0}, {0.0, variance}}}};
  };
  EXPECT_REFUSED(std::domain_error, ("positive semi-definite"), make(-1e-3));
  EXPECT_INVALID(("finite"), make(NAN));
}

PROPERTY(GaussianPossibility, LikelihoodsDifferByTheFactorOfTheDensity) {
  const FixedStepMotion<3> model("still", {"a", "b", "c"}, 1.0, SquareMatrix<3>::Identity(), SquareMatrix<3>::Zero());
  const LinearSensor<2, 3> sensor{generated_matrix<2, 3>()};
  Gaussian<3> posterior;
  const auto prior = generated_gaussian<3>();
  const auto z = generated_gaussian<2>();
  const auto innovation = update(model, prior, z, sensor, posterior);
  const auto H = dense(sensor.measurement_matrix());
  const auto S = H * dense(prior.covariance) * transposed(H) + dense(z.covariance);
  const double determinant = S(0, 0) * S(1, 1) - S(0, 1) * S(1, 0);
  require_near(log_possibility(innovation) - innovation.log_likelihood,
               0.5 * std::log(std::pow(2.0 * std::numbers::pi, 2.0) * determinant), 1e-9);
}

}  // namespace gaussian_possibility_test
