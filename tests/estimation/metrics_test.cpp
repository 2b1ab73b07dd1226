#include <sigmax/estimation/metrics.hpp>

#include <gtest/gtest.h>

#include "support/matrices.hpp"
#include "support/restatement.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::entries;
using support::generated_gaussian;
using support::generated_matrix;
using support::holds;
using support::near;
using support::require_near;
using support::throws;

TEST(Metrics, TheRootMeanSquareIsThat) {
  RootMeanSquare rms;
  EXPECT_EQ(rms.count(), 0U);
  EXPECT_EQ(rms.value(), 0.0);
  rms.add(3.0);
  rms.add(-4.0);
  EXPECT_PRED_FORMAT3(near, rms.value(), std::sqrt(12.5), 1e-15);
  rms.add_square(11.0);
  EXPECT_EQ(rms.count(), 3U);
  EXPECT_PRED_FORMAT3(near, rms.value(), std::sqrt(12.0), 1e-15);
}

TEST(Metrics, TheNormalizedErrorByHand) {
  const SquareMatrix<2> P{{4.0, 0.0}, {0.0, 9.0}};
  EXPECT_PRED_FORMAT3(near, (normalized_error_squared<2, 2>(Vector<2>{2.0, 6.0}, P)), 1.0 + 4.0, 1e-15);
  EXPECT_PRED_FORMAT3(near, nees(Gaussian<2>{Vector<2>{3.0, 3.0}, P}, Vector<2>{1.0, -3.0}), 5.0, 1e-15);
}

TEST(Metrics, TheNormalizedErrorIsThatOfTheInverse) {
  holds([] {
    const auto estimate = generated_gaussian<4>();
    const Vector<4> truth = generated_matrix<4, 1>();
    const auto error = entries(estimate.mean - truth);
    const auto inverse = restatement::inverse({4, 4, entries(estimate.covariance)}).matrix;
    require_near(nees(estimate, truth), restatement::dot(error, restatement::product(inverse, error)), 1e-9);
  });
}

TEST(Metrics, TheNormalizedErrorKnowsNoUnits) {
  holds([] {
    const auto estimate = generated_gaussian<3>();
    const Vector<3> truth = generated_matrix<3, 1>();
    const Vector<3> units{1000.0, 0.01, 57.3};
    const Gaussian<3> converted{units.cwiseProduct(estimate.mean),
                                units.asDiagonal() * estimate.covariance * units.asDiagonal()};
    require_near(nees(converted, Vector<3>{units.cwiseProduct(truth)}), nees(estimate, truth), 1e-10);
  });
}

TEST(Metrics, RefusesACovarianceThatIsNotPositiveDefinite) {
  const Vector<2> error{1.0, 1.0};
  EXPECT_TRUE(throws<std::domain_error>(
      [&] {
        normalized_error_squared<2, 2>(error, SquareMatrix<2>{{1.0, 0.0}, {0.0, 0.0}});
      },
      {"positive definite"}));
  EXPECT_TRUE(throws<std::domain_error>(
      [&] {
        normalized_error_squared<2, 2>(error, SquareMatrix<2>{{1.0, 2.0}, {2.0, 1.0}});
      },
      {"positive definite"}));
}

}  // namespace
}  // namespace sigmax
