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

/// log π on 181 nodes.
using Logs = std::vector<double>;
using OfNode = std::function<double(std::size_t)>;
double node(std::size_t i) { return -9.0 + 0.1 * static_cast<double>(i); }
Logs logs(const OfNode& function) {
  Logs result(181);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = function(i);
  return result;
}

/// Its maximum as a function of a real number, by the parabola through the best node and its neighbours: where it is,
/// its value and its second derivative. That is exact where log π is a parabola, and that it stays one is part of what
/// is tested.
struct Vertex {
  double at, value, curvature;
  explicit Vertex(const Logs& all) {
    const auto best = std::max_element(all.begin() + 1, all.end() - 1);
    const double slope = 0.5 * (best[1] - best[-1]), bend = best[1] - 2.0 * best[0] + best[-1];
    at = node(static_cast<std::size_t>(best - all.begin())) - 0.1 * slope / bend;
    value = best[0] - 0.5 * slope * slope / bend;
    curvature = bend / 0.01;
  }
};

double parabola(double x, double variance) { return -0.5 * x * x / variance; }

/// (36), (37) by plain loops over a grid, in a system that changes at every step and is measured now and then only.
TEST(GaussianPossibility, SupremaOnAGridAreTheKalmanFilter) {
  struct Step {
    double F, u, Q, H, R;
    std::optional<double> z;
  };
  const std::vector<Step> steps{{1.0, 0.5, 0.3, 1.0, 0.8, 1.1},   {0.7, 0.0, 0.5, 2.0, 1.5, {}},
                                {-1.2, 0.1, 0.2, 0.5, 0.4, -0.7}, {1.1, -0.4, 1.0, 1.0, 1.0, {}},
                                {0.9, 0.0, 0.6, -1.0, 0.5, 1.6},  {1.3, 0.2, 0.25, 1.0, 2.0, 0.3}};
  Logs grid = logs([](std::size_t i) { return parabola(node(i) - 0.4, 1.2); });
  GaussianPossibility<1> pi{{Vector<1>{0.4}, SquareMatrix<1>{1.2}}};
  for (const Step& at : steps) {
    const FixedStepMotion<1> model("walk", {"x"}, 1.0, SquareMatrix<1>{at.F}, SquareMatrix<1>{at.Q}, Vector<1>{at.u});
    const LinearSensor<1, 1> sensor{SquareMatrix<1>{at.H}};
    grid = logs([&](std::size_t to) {
      return Vertex(logs([&](std::size_t from) {
               return grid[from] + parabola(node(to) - at.F * node(from) - at.u, at.Q);
             }))
          .value;
    });
    pi = predict(model, pi, 1.0);
    if (at.z) {
      grid = logs([&](std::size_t i) { return grid[i] + parabola(*at.z - at.H * node(i), at.R); });
      const double supremum = Vertex(grid).value;
      for (double& log : grid) log -= supremum;
      const Gaussian<1> measured{Vector<1>{*at.z}, SquareMatrix<1>{at.R}};
      Gaussian<1> unused;
      EXPECT_CLOSE(log_possibility(update(model, pi.density(), measured, sensor, unused)), supremum, 1e-9);
      pi = update(model, pi, measured, sensor);
    }
    const Vertex peak(grid);
    EXPECT_CLOSE(pi.mean()(0), peak.at, 1e-9);
    EXPECT_CLOSE(pi.covariance()(0, 0), -1.0 / peak.curvature, 1e-9);
    EXPECT_CLOSE(peak.value, 0.0, 1e-9);
    for (std::size_t i = 40; i < 140; ++i) EXPECT_CLOSE(pi.log(Vector<1>{node(i)}), grid[i], 1e-9);
  }
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
