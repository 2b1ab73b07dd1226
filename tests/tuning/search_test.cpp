#include <sigmax/tuning/search.hpp>

#include "support/sigmax.hpp"

namespace search_test {

/// Six decades, with a wide valley at 30 and the deeper one at 0.01.
double two_valleys(const std::vector<double>& x) {
  const double at = std::log10(x[0]);
  double sum = std::min(std::pow(at - 1.5, 2), std::pow(3.0 * (at + 2.0), 2) - 1.0);
  for (std::size_t i = 1; i < x.size(); ++i) sum += std::pow(std::log(x[i] / 2.0), 2);
  return sum;
}

std::vector<FitParameter> parameters(std::size_t n) {
  return std::vector<FitParameter>(n, {.name = "x", .start = 30.0, .least = 1e-4, .most = 1e4});
}

TEST(Search, FindsTheDeeperOfTwoValleysWhichALocalOneDoesNot) {
  for (const std::size_t n : {1U, 2U, 5U}) {
    EXPECT_NEAR(search(parameters(n), two_valleys, {.samples = 0}).values[0], 31.6, 1.0);
    const Fit found = search(parameters(n), two_valleys);
    EXPECT_NEAR(found.values[0], 0.01, 0.001) << n;
    EXPECT_NEAR(found.values[n - 1], n == 1 ? 0.01 : 2.0, 0.05);
    EXPECT_LE(found.evaluations, 2 + 64 * n + 3 * 25 * (n + 1));
    EXPECT_EQ(search(parameters(n), two_valleys).values, found.values);
    EXPECT_NE(search(parameters(n), two_valleys, {.seed = 2}).values, found.values);
  }
}

TEST(Search, StaysWithinBounds) {
  const auto bounded = [](const std::vector<double>& x) {
    EXPECT_TRUE(x[0] > 0.99e-4 && x[0] < 1.01e4);
    return two_valleys(x);
  };
  EXPECT_NEAR(search(parameters(1), bounded).values[0], 0.01, 0.001);
  EXPECT_EQ(search({}, [](const auto&) { return 7.0; }).loss, 7.0);
}

}  // namespace search_test
