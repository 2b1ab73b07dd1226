#include <sigmax/estimation/metrics.hpp>

#include <gtest/gtest.h>

#include "support/matrices.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::dense;
using support::fixed;
using support::generated;
using support::generated_gaussian;
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
    const auto estimate = generated_gaussian<3>();
    const auto truth = generated(3, 1);
    const auto error = dense(estimate.mean) - truth;
    const auto inverse = restatement::inverse(dense(estimate.covariance)).matrix;
    require_near(nees(estimate, Vector<3>{fixed<3, 1>(truth)}),
                 (restatement::transposed(error) * inverse * error)(0, 0), 1e-9);
  });
}

TEST(Metrics, TheNormalizedErrorKnowsNoUnits) {
  holds([] {
    const auto estimate = generated_gaussian<3>();
    const auto truth = generated(3, 1);
    const restatement::Matrix units(3, 3, {1000.0, 0, 0, 0, 0.01, 0, 0, 0, 57.3});
    const Gaussian<3> converted{fixed<3, 1>(units * dense(estimate.mean)),
                                fixed<3, 3>(units * dense(estimate.covariance) * units)};
    require_near(nees(converted, Vector<3>{fixed<3, 1>(units * truth)}), nees(estimate, Vector<3>{fixed<3, 1>(truth)}),
                 1e-10);
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
