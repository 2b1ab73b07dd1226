#include "support/sigmax.hpp"

namespace consistency_test {

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
  EXPECT_CLOSE(tally.band().upper, chi_square_band(1, 5).upper, 1e-15);
  InnovationTally of_many;
  for (const double nis : {15.50, 15.51}) of_many.add_nis(nis, 8);
  EXPECT_EQ(of_many.share_inside(), 0.5);  // 15.507 of eight
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
