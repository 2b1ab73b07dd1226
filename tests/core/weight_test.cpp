#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <sigmax/core/weight.hpp>

#include "support/near.hpp"

namespace sigmax {
namespace {

using support::near;

/// ⊕ of 0.5 ⊗ 0.25 and 1 ⊗ 0.125, on the scale of the algebra.
template <Algebra A>
double combined() {
  const std::vector<double> weights{Weight<A>::of(0.25), Weight<A>::of(0.125)}, factors{0.5, 1.0};
  return Weight<A>::value(Weight<A>::combine(
      2, [&](std::size_t i) { return weights[i]; }, [&](std::size_t i) { return factors[i]; }));
}

TEST(Weight, OfWhatScalesIsALogarithm) {
  EXPECT_EQ(Weight<Sigma>::of(0.5), std::log(0.5));
  EXPECT_EQ(Weight<Max>::of(0.0), Weight<Max>::excluded);
  EXPECT_EQ(Weight<Max>::times(-1.0, -2.0), -3.0);
  EXPECT_PRED_FORMAT3(near, combined<Sigma>(), 0.25, 1e-15);
  EXPECT_PRED_FORMAT3(near, combined<Max>(), 0.125, 1e-15);
  std::vector<double> weights{-1e6, -1e6 - 1.0, log_zero};
  Weight<Sigma>::to_values(weights);
  EXPECT_PRED_FORMAT3(near, weights, (std::vector{1.0, std::exp(-1.0), 0.0}), 1e-15);
}

TEST(Weight, OfWhatDoesNotScaleIsTheNumber) {
  EXPECT_EQ(Weight<MaxMin>::of(0.3), 0.3);
  EXPECT_EQ(Weight<MaxMin>::excluded, 0.0);
  EXPECT_EQ(Weight<MaxMin>::times(0.25, 0.5), 0.25);
  EXPECT_EQ(combined<MaxMin>(), 0.25);
  std::vector<double> weights{0.3, 0.1};
  Weight<MaxMin>::to_values(weights);
  EXPECT_EQ(weights, (std::vector{0.3, 0.1}));
}

}  // namespace
}  // namespace sigmax
