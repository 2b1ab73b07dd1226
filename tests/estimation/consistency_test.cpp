#include "support/sigmax.hpp"

namespace consistency_test {

/// Innovations of m numbers, each with this standard deviation and correlation with the one before.
InnovationTally tally_of(std::size_t m, std::size_t rows, double sigma, double correlation) {
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal;
  InnovationTally tally;
  std::vector<double> before, now(m, 0.0);
  for (std::size_t k = 0; k < rows; ++k) {
    for (double& number : now)
      number = sigma * normal(generator) * (k == 0 ? 1.0 : std::sqrt(1.0 - correlation * correlation)) +
               correlation * number;
    tally.add(now, before);
    before = now;
  }
  return tally;
}

TEST(InnovationTally, ByHand) {
  InnovationTally tally;
  const std::vector<double> first{1.0, 2.0}, second{3.0, -1.0}, third{2.0};
  tally.add(first);
  tally.add(second, first);
  tally.add(third, second);  // of another size: they are no neighbours
  EXPECT_EQ(tally.count(), 3U);
  EXPECT_CLOSE(tally.mean_nis(), (5.0 + 10.0 + 4.0) / 3.0, 1e-15);
  EXPECT_CLOSE(tally.expected_nis(), (2.0 + 2.0 + 1.0) / 3.0, 1e-15);
  EXPECT_CLOSE(tally.share_inside(), 1.0 / 3.0, 1e-15);  // 5.99 of two quantities, 3.84 of one
  EXPECT_CLOSE(tally.mean_square(), 19.0 / 5.0, 1e-15);
  EXPECT_CLOSE(tally.autocorrelation(), (3.0 - 2.0) / 19.0, 1e-15);
  EXPECT_CLOSE(tally.autocorrelation_band(), 1.96 * std::sqrt(2.0) / 5.0, 1e-15);
  EXPECT_CLOSE(tally.median_nis(), 5.0, 1e-3);
}

TEST(InnovationTally, OfARightFilterIsInItsBands) {
  for (const std::size_t m : {1U, 3U, 8U}) {
    const InnovationTally tally = tally_of(m, 4000, 1.0, 0.0);
    EXPECT_GT(tally.mean_square(), tally.band().lower);
    EXPECT_LT(tally.mean_square(), tally.band().upper);
    EXPECT_LT(std::abs(tally.autocorrelation()), tally.autocorrelation_band());
    EXPECT_NEAR(tally.mean_nis(), static_cast<double>(m), 0.2);
    EXPECT_NEAR(tally.share_inside(), 0.95, 0.01);
  }
}

TEST(InnovationTally, FindsErrorsThatAreGreaterThanBelievedOrLast) {
  const InnovationTally wide = tally_of(3, 4000, 1.2, 0.0), slow = tally_of(3, 4000, 1.0, 0.3);
  EXPECT_GT(wide.mean_square(), wide.band().upper);
  EXPECT_LT(wide.share_inside(), 0.94);
  EXPECT_NEAR(slow.autocorrelation(), 0.3, 0.03);
  EXPECT_GT(slow.autocorrelation(), slow.autocorrelation_band());
}

TEST(InnovationTally, KnowsTheMedianOfManyNis) {
  std::mt19937_64 generator(5);
  std::chi_squared_distribution<double> chi_square(3.0);
  InnovationTally tally;
  std::vector<double> all;
  for (int k = 0; k < 10001; ++k) {
    all.push_back(chi_square(generator));
    tally.add_nis(all.back(), 3);
  }
  std::nth_element(all.begin(), all.begin() + 5000, all.end());
  EXPECT_NEAR(tally.median_nis() / all[5000], 1.0, 1e-3);
  EXPECT_NEAR(tally.share_inside(), 0.95, 0.01);
  InnovationTally exact;
  for (int k = 0; k < 3; ++k) exact.add_nis(0.0, 1);
  EXPECT_EQ(exact.median_nis(), 0.0);
  EXPECT_EQ(InnovationTally().median_nis(), 0.0);
}

}  // namespace consistency_test
